// Baked maps with their mesh: -o asset.glb, .gltf, .usda and .mtlx of the verb normal-map.
#pragma once
#include "bake/mesh/gltf/carry.h"
#include "normal_map_options.h"

namespace bake {

/// The mesh file that an asset has, and how it is read.
struct AssetSource {
    std::string path;
    MeshOptions read;
};
/// The mesh, or the displaced one to which its map is relative; a .mtlx has the materials of the mesh.
AssetSource asset_source(const NormalMapArgs& args);

/// Throws Error{Refusal::unsuitable} if the displaced mesh of an asset lacks most of the map's charts.
void refuse_other_uvs(const NormalMapArgs& args, const NormalMapReport& report);

/// The map as the normalTexture or occlusionTexture of all materials.
GltfMap asset_map(GltfMap::Slot slot, const Image<float>& map, Depth depth);

/// Writes args.out: a copy of the glTF file of asset_source(), or a new one for other formats, with the maps and with
/// the tangents that they are baked in; or a text of write_text_asset(). Adds notes on what is not kept.
void write_asset(const NormalMapArgs& args, std::vector<GltfMap> maps, const Facts& facts,
                 std::vector<std::string>& notes);

} // namespace bake
