#include "stability/themes.h"

namespace stability {

std::vector<Theme> all_themes() {
    return {
        {"curvature", curvature_sweeps}, {"slope", slope_sweeps},     {"chart", chart_sweeps},
        {"relief", relief_sweeps},       {"warning", warning_sweeps},
    };
}

} // namespace stability
