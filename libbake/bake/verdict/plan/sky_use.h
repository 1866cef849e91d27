// What a scene shows of its sky, and how sharply.
#pragma once
#include "bake/verdict/plan/worst_probe.h"

namespace bake {

struct SkyUse {
    bool lit = false;      ///< surfaces reflect its light by lobes, sampled or filtered
    bool mirrored = false; ///< by a mirror, or seen through glass
    bool seen = false;     ///< a ray through the centre of a pixel, of a lattice of at most 64 x 64, hits nothing
    double lobe_width = 2; ///< of the sharpest lobe, radians about the mirror direction; 2 for Lambert, 0 for a mirror
    std::string sharpest;  ///< name of its material
    bool any() const noexcept { return lit || mirrored || seen; }
};

SkyUse sky_use(const Scene& scene, std::span<const PartOptions::View> views);

/// Width of a lobe about the mirror direction, radians: 1 / sqrt(s) with s = -d ln K / dt at its centre (environment/filter,
/// lobe.h). (r.v)^n has s = n; (n.h)^n has a quarter of that, because h turns half as far as r. 2 for Lambert; 0 for mirrors
/// and glass.
double lobe_width(const Lobe& lobe) noexcept;

/// Faces of which four texels lie within the width of a lobe hold all that it can tell apart, suns excepted; at most `most`.
int face_for(double lobe_width, int most) noexcept;

} // namespace bake
