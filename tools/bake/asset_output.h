// Baked maps with their mesh: -o asset.glb, .gltf, .usda and .mtlx of the verb normal-map.
#pragma once
#include "bake/mesh/gltf/carry.h"
#include "normal_map_options.h"

namespace bake {

/// The map as the normalTexture or occlusionTexture of all materials.
GltfMap asset_map(GltfMap::Slot slot, const Image<float>& map, Depth depth);

/// Writes args.out: a copy of the mesh's glTF file, or a new one for other formats, with the maps and with the tangents
/// that they are baked in; or a text of write_text_asset(). Adds notes on what is not kept.
void write_asset(const NormalMapArgs& args, std::vector<GltfMap> maps, const Facts& facts,
                 std::vector<std::string>& notes);

} // namespace bake
