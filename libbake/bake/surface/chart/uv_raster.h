// Which triangle of a mesh lies under each texel of its UV chart.
#pragma once
#include "bake/mesh/triangulate.h"
#include "bake/picture/image.h"
#include <span>

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

/// Rasterises the unit square [0,1]^2 of the UV chart to width x height texels; the image is empty if either is below
/// 1. A texel whose centre lies in or on a triangle gets that triangle and its exact barycentrics. If several faces
/// contain the centre, the lowest face is used, so that the result does not depend on the number of threads. A texel
/// whose centre lies in no triangle, but whose square touches one, gets the nearest point of the nearest such triangle
/// (of the lowest face on ties): rasterisation is conservative at chart borders. A centre on a shared edge counts as
/// inside only one of the faces, so that adjacent faces do not overlap. Faces with a corner without uv are skipped.
/// `triangles` are in the order of faces. Corners are snapped to 2^30 steps per unit; uvs are clamped to +-10^8.
UvRaster uv_raster(const Mesh& mesh, const std::vector<Triangle>& triangles, int width, int height);

/// The same for other places of the texels than their centres, a band of rows at a time, because the rasters of many places do
/// not fit in memory together. Texels whose place lies in no triangle stay empty.
class PlaceRaster {
public:
    /// Both must outlive the object. Width and height are at least 1.
    PlaceRaster(const Mesh& mesh, const std::vector<Triangle>& triangles, int width, int height);
    static constexpr int band_rows = 16;
    int bands() const noexcept { return int(begin_.size()) - 1; }
    /// `place`: right and down from each texel's upper left corner, from 0 to 1. hits: the rows of the band one after the other, of
    /// which the last band can have fewer.
    void band(int band, const Vec2d& place, std::span<TexelHit> hits) const;

private:
    const Mesh& mesh_;
    const std::vector<Triangle>& triangles_;
    int width_, height_;
    std::vector<std::size_t> begin_; ///< of each band in triangle_
    std::vector<std::uint32_t> triangle_;
};

} // namespace bake
