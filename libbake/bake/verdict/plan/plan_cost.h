// What a model costs, as stated here rather than timed.
//
// Triangles are those that are drawn: of all meshes that share the model. Object bytes are the mesh as the tracer holds it,
// once, with Embree's tree. Texture bytes are those of 8-bit textures with all smaller levels, which add a third:
//   bump table 2 channels, normal map and map relative to a displaced mesh 3 channels, of the size of the height, or of
//   the map that is baked from a high-poly mesh
// Milliseconds are those of a million rays of the preview tracer on one core of a desktop processor:
//   trace   300 + 40 log2(triangles drawn)
//   lookups  60 for a bump table, 90 for a normal map, 30 more where what lookups average away widens the highlight
// The constants are round numbers of the right size. They order models; they are not measured times.
#pragma once
#include "bake/verdict/plan/plan.h"

namespace bake {

struct CostInput {
    std::int64_t triangles = 0; ///< of one mesh without relief
    int meshes = 1;             ///< that share the model
    int width = 0, height = 0;  ///< of the height, or of the map from a high-poly mesh, texels
    std::int64_t high = 0;      ///< triangles of the high-poly mesh; 0: there is none
};
RungCost model_cost(const CostInput& input, const ShadeMethod& method) noexcept;

/// Bytes of a map of 8-bit channels with all smaller levels.
std::int64_t map_bytes(int width, int height, int channels) noexcept;

} // namespace bake
