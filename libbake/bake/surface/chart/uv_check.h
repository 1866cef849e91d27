// The UV charts of a mesh: what a bake into them will meet.
#pragma once
#include "bake/mesh/triangulate.h"

namespace bake {

struct UvCheckOptions {
    double zero_area = 1e-12; ///< a triangle has no uv area up to this part of the squared diagonal of the uv bounds
    int overlap_size = 1024;  ///< samples along a tile's side that overlaps are measured with; 0: not measured
};

/// Value below which a share of the surface's area lies.
struct Spread {
    double p5 = 0, median = 0, p95 = 0;
};

/// Counts are of triangles where they say so, else of faces. Triangles with a corner that has no uv are left out.
struct UvCheck {
    std::size_t triangles = 0;            ///< with uvs
    std::size_t mirrored_triangles = 0;   ///< clockwise in uv
    std::size_t degenerate_triangles = 0; ///< without area in uv
    double covered = 0;                   ///< uv area under at least one face, as sampled
    double overlap = 0;                   ///< part of it under more than one face, 0 to 1
    Vec2d min{0}, max{0};                 ///< bounds of the uvs in use
    std::vector<int> udim_tiles;          ///< 1001 + floor(u) + 10 floor(v), ascending
    std::size_t outside_faces = 0;        ///< faces that lie, wholly or in part, where no UDIM tile is
    std::size_t crossing_faces = 0;       ///< faces that lie in more than one tile
    Spread density;                       ///< sqrt(uv area / area); the median as it is, p5 and p95 over the median
    Spread stretch;                       ///< larger over smaller singular value of the map uv to surface, from 1 on
};

UvCheck check_uvs(const Mesh& mesh, const std::vector<Triangle>& triangles, const UvCheckOptions& options = {});

} // namespace bake
