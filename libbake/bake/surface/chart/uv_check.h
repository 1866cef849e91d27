// Checks the UV charts of a mesh before a bake.
#pragma once
#include "bake/surface/chart/uv_tiles.h"

namespace bake {

struct UvCheckOptions {
    double zero_area = 1e-12; ///< largest uv area of a degenerate triangle, over the squared diagonal of the uv bounds
    int overlap_size = 1024;  ///< samples per side of a tile for measuring overlaps; 0: not measured
};

/// Percentiles, weighted by the area of the surface.
struct Spread {
    double p5 = 0, median = 0, p95 = 0;
};

/// The names say whether triangles or faces are counted. Triangles with a corner without uv are not counted.
struct UvCheck {
    std::size_t triangles = 0;            ///< with uvs
    std::size_t mirrored_triangles = 0;   ///< clockwise in uv
    std::size_t degenerate_triangles = 0; ///< without area in uv
    double covered = 0;                   ///< uv area under at least one face, as sampled
    double overlap = 0;                   ///< fraction of it under more than one face
    Vec2d min{0}, max{0};                 ///< bounds of the uvs in use
    std::vector<int> udim_tiles;          ///< 1001 + floor(u) + 10 floor(v), ascending
    std::size_t outside_faces = 0;        ///< faces that are wholly or partly outside the UDIM tiles
    std::size_t crossing_faces = 0;       ///< faces in more than one tile
    UvTiles tiles;                        ///< how a bake places the charts
    Spread density;                       ///< sqrt(uv area / area): its median, and p5 and p95 divided by the median
    Spread stretch;                       ///< ratio of the singular values of the map uv to surface, at least 1
};

UvCheck check_uvs(const Mesh& mesh, const std::vector<Triangle>& triangles, const UvCheckOptions& options = {});

} // namespace bake
