// How much of a height falls between the points of a displaced mesh, predicted from its uvs alone.
#pragma once
#include "bake/mesh/mesh.h"
#include "bake/relief/displace/types.h"

namespace bake {

struct FacetLoss {
    double rms = 0, max = 0; ///< height against its linear interpolation over the faces, object units
    double relief = 0;       ///< root mean square of the height about its mean
    double edge_texels = 0;  ///< mean edge of a face, in texels of the height
    double part() const noexcept { return relief > 0 ? rms / relief : 0; }
};

/// Parts above it show as faces.
inline constexpr double smallest_seen_part = 0.25;

/// Over about 65536 points of at most as many faces; without what the faces lose of the base surface. Zero for vectors.
FacetLoss facet_loss(const Mesh& displaced, const Relief& relief);

} // namespace bake
