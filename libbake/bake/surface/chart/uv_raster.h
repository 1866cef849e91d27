// Which triangle of a mesh lies under each texel of its UV chart.
#pragma once
#include "bake/mesh/triangulate.h"
#include "bake/picture/image.h"

namespace bake {

/// Point on a triangle: position = (1 - b1 - b2) corner[0] + b1 corner[1] + b2 corner[2].
/// Members are not initialised, so that creating an image does not write it twice.
struct TexelHit {
    std::uint32_t triangle; ///< index in the triangles given, no_index where the texel is empty
    float b1, b2;           ///< 0 where the texel is empty
};

struct UvRaster {
    Image<TexelHit> hits;            ///< one per texel
    std::int64_t covered = 0;        ///< texels whose centre lies in a triangle
    std::int64_t border = 0;         ///< texels filled only because a triangle touches their square
    std::int64_t overlapped = 0;     ///< texels whose centre lies inside more than one face
    std::int64_t outside_faces = 0;  ///< faces with no point in the unit square
    std::int64_t crossing_faces = 0; ///< faces partly outside the unit square
    std::int64_t degenerate = 0;     ///< triangles without area in uv, which cover nothing
};

/// Rasters the unit square [0,1]^2 of the UV chart at width x height texels; no image when either is below 1.
/// A texel whose centre lies in or on a triangle gets that triangle and its exact barycentrics; where several claim it
/// the lowest face wins, so the result does not depend on the number of threads. A texel whose centre lies in none but
/// whose square touches a triangle gets the nearest point of the nearest such triangle (lowest face on ties): charts
/// are conservative at their borders. A centre on an edge that faces share is inside one of them only, so that faces
/// side by side do not overlap. Faces that have a corner without uv are skipped; triangles come in the order of faces.
/// Corners are snapped to a grid of 2^30 steps per unit; uvs are clamped to +-10^8.
UvRaster uv_raster(const Mesh& mesh, const std::vector<Triangle>& triangles, int width, int height);

} // namespace bake
