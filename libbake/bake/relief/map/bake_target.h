// What a normal map is baked with: its options, and the mesh that it is for.
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
    int width = 0, height = 0; ///< texels of the map; 0: as the height
    NormalMethod method = NormalMethod::exact;
    HeightOptions height_options;
    Filter filter = Filter::automatic;
    Space space = Space::tangent;
    bool directx = false; ///< green points down
    int padding = 16;     ///< texels filled beyond the charts' borders
};

/// The mesh side of a bake, made once: the jets, the tangent space, and which triangle lies under each texel.
struct BakeTarget {
    MeshSurface surface;
    std::vector<Vec4f> tangents; ///< corners
    UvRaster raster;
    ConstantScale<float> scale; ///< mean |p_u| and |p_v| over the charts
};
/// The mesh must outlive it. Throws Error{Refusal::unsuitable} for a mesh without uvs (`path` is named in it).
BakeTarget make_bake_target(const Mesh& mesh, const std::string& path, int width, int height);

} // namespace bake
