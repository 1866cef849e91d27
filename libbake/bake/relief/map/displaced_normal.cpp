#include "bake/relief/map/displaced_normal.h"

namespace bake {

std::string_view name(NormalMethod method) noexcept {
    switch (method) {
    case NormalMethod::exact: return "exact";
    case NormalMethod::blinn: return "blinn";
    case NormalMethod::surface_gradient: return "surface-gradient";
    case NormalMethod::constant_scale: return "constant-scale";
    }
    return "";
}

} // namespace bake
