// Which triangle of a mesh lies under each texel of its UV chart.
#pragma once
#include "bake/mesh/triangulate.h"
#include "bake/picture/image.h"

namespace bake {

/// Point on a triangle: position = (1 - b1 - b2) corner[0] + b1 corner[1] + b2 corner[2].
/// Members are not initialised, because initialising a large image takes time.
struct TexelHit {
    std::uint32_t triangle; ///< index of the triangle, no_index if the texel is empty
    float b1, b2;           ///< 0 if the texel is empty
};

struct UvRaster {
    Image<TexelHit> hits;            ///< one per texel
    std::int64_t covered = 0;        ///< texels whose centre lies in a triangle
    std::int64_t border = 0;         ///< texels filled only because a triangle touches their square
    std::int64_t overlapped = 0;     ///< texels whose centre lies inside more than one face
    std::int64_t outside_faces = 0;  ///< faces with no point in the unit square
    std::int64_t crossing_faces = 0; ///< faces partly outside the unit square
    std::int64_t degenerate = 0;     ///< triangles without area in uv, which cover nothing
    std::string tiles; ///< of chart_raster(): the tiles whose charts lie in it, if not the unit square alone
};

struct UvRasterOptions {
    Vec2d place{0.5, 0.5}; ///< in each texel, right and down from its upper left corner: what stands for the centre
    bool border = true;    ///< false: texels whose centre lies in no triangle stay empty
};

/// Rasterises the unit square [0,1]^2 of the UV chart to width x height texels; the image is empty if either is below
/// 1. A texel whose centre lies in or on a triangle gets that triangle and its exact barycentrics. If several faces
/// contain the centre, the lowest face is used, so that the result does not depend on the number of threads. A texel
/// whose centre lies in no triangle, but whose square touches one, gets the nearest point of the nearest such triangle
/// (of the lowest face on ties): rasterisation is conservative at chart borders. A centre on a shared edge counts as
/// inside only one of the faces, so that adjacent faces do not overlap. Faces with a corner without uv are skipped.
/// `triangles` are in the order of faces. Corners are snapped to 2^30 steps per unit; uvs are clamped to +-10^8.
UvRaster uv_raster(const Mesh& mesh, const std::vector<Triangle>& triangles, int width, int height,
                   const UvRasterOptions& options = {});

} // namespace bake
