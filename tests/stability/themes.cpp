#include "stability/themes.h"

namespace stability {

std::vector<Theme> all_themes() {
    return {
        {"curvature", curvature_sweeps},
        {"slope", slope_sweeps},
        {"chart", chart_sweeps},
        {"relief", relief_sweeps},
        {"warning", warning_sweeps},
        {"tilt", tilt_sweeps},
        {"shadow", shadow_sweeps},
        {"minification", minification_sweeps},
        {"sky", sky_sweeps},
        {"distance", distance_sweeps},
        {"precision", precision_sweeps},
        {"thread", thread_sweeps},
    };
}

} // namespace stability
