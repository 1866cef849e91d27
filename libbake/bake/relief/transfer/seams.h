// Whether a normal map says the same on both sides of the seams of its charts.
#pragma once
#include "bake/relief/map/bake_target.h"

namespace bake {

struct SeamDisagreement {
    std::int64_t seams = 0, samples = 0;         ///< edges whose faces have uvs or normals of their own; points on them
    double mean = 0, percentile_95 = 0, max = 0; ///< angle between the normals of the two sides, degrees
};

/// The map is read bilinearly, as a shader does, at points about a texel apart along every seam, and decoded in the tangent space
/// of each side (or as it is, in object space). `map`: encoded, three channels. `tile`: that of the map, as NormalMapOptions; seams
/// between tiles do not count.
SeamDisagreement seam_disagreement(const BakeTarget& target, const Image<float>& map, Space space, bool directx,
                                   int tile = 0);

/// The unit normal in object space that a shader takes from a map at a point of the mesh; zero where there is none.
Vec3f shaded_normal(const BakeTarget& target, const Image<float>& map, const TexelHit& at, Space space,
                    bool directx) noexcept;

} // namespace bake
