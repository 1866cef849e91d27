// Options of a normal map, and the mesh that it is baked for.
#pragma once
#include "bake/relief/map/bump_table.h"
#include "bake/relief/map/displaced_normal.h"
#include "bake/surface/chart/mesh_surface.h"
#include "bake/surface/chart/uv_tiles.h"

namespace bake {

enum class Space {
    tangent, ///< MikkTSpace
    object,
};

struct NormalMapOptions {
    int width = 0, height = 0; ///< size of the map in texels; 0: that of the height
    NormalMethod method = NormalMethod::exact;
    HeightOptions height_options;
    Filter filter = Filter::automatic;
    Space space = Space::tangent;
    bool directx = false; ///< green points down
    int padding = 16;     ///< texels filled beyond the charts' borders
    int tile = 0;         ///< UDIM number of the tile whose charts are baked; 0: all charts, modulo 1
};

/// Mean |p_u| and |p_v| over the charts, weighted by areas in uv, for constant_scale; 1 and 1 if either of them is 0.
ConstantScale<float> mean_scale(const MeshSurface& surface);

/// What a bake needs of its mesh, computed once: jets, tangent space, and the triangle under each texel.
struct BakeTarget {
    MeshSurface surface;
    std::vector<Vec4f> tangents; ///< corners
    UvRaster raster;
    ConstantScale<float> scale; ///< mean |p_u| and |p_v| over the charts
};
/// The mesh must outlive the result. Throws Error{Refusal::unsuitable}, which names `path`, for a mesh without uvs and for
/// charts that chart_raster() refuses.
BakeTarget make_bake_target(const Mesh& mesh, const std::string& path, int width, int height, int tile = 0);

} // namespace bake
