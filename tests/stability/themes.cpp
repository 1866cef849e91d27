#include "stability/themes.h"

namespace stability {

std::vector<Theme> all_themes() {
    return {
        {"curvature", curvature_sweeps},
    };
}

} // namespace stability
