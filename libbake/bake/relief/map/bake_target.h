// Options of a normal map, and the mesh that it is baked for.
#pragma once
#include "bake/relief/map/bump_table.h"
#include "bake/relief/map/displaced_normal.h"
#include "bake/surface/chart/mesh_surface.h"
#include "bake/surface/chart/uv_raster.h"

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
};

/// What a bake needs of its mesh, computed once: jets, tangent space, and the triangle under each texel.
struct BakeTarget {
    MeshSurface surface;
    std::vector<Vec4f> tangents; ///< corners
    UvRaster raster;
    ConstantScale<float> scale; ///< mean |p_u| and |p_v| over the charts
};
/// The mesh must outlive the result. Throws Error{Refusal::unsuitable}, which names `path`, for a mesh without uvs.
BakeTarget make_bake_target(const Mesh& mesh, const std::string& path, int width, int height);

} // namespace bake
