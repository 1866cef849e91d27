#include "stability/themes.h"

namespace stability {

std::vector<Theme> all_themes() {
    return {
        {"curvature", curvature_sweeps},
        {"tilt", tilt_sweeps},     // normals
        {"shadow", shadow_sweeps}, // and silhouettes
        {"minification", minification_sweeps},
        {"sky", sky_sweeps},             // environments
        {"distance", distance_sweeps},   // and size
        {"precision", precision_sweeps}, // float against double
        {"thread", thread_sweeps},
    };
}

} // namespace stability
