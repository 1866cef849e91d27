// The materials of an asset with the files of their textures, as both formats write them.
#pragma once
#include "bake/base/block_writer.h"
#include "bake/mesh/asset/asset.h"
#include <set>
#include <span>

namespace bake {

struct LookTexture {
    std::string file{}; ///< in the folder of the asset; empty: none
    GltfSampler sampler{};

    explicit operator bool() const { return !file.empty(); }
};

struct Look {
    std::string name{};    ///< letters, digits and '_', each once
    std::string title{};   ///< the name in the mesh, as UTF-8
    GltfMaterial values{}; ///< its textures are those that follow
    LookTexture normal{}, base_color{}, metallic_roughness{}, emissive{}, occlusion{};
    double occlusion_strength = 1;
    GltfTextureUvs uvs{}; ///< on which all of its textures lie
};

struct LookFile {
    std::string name;
    std::span<const std::uint8_t> bytes;
};

struct Looks {
    std::vector<Look> looks;            ///< of those that a face has
    std::vector<std::uint32_t> of_face; ///< faces
    std::vector<LookFile> files;        ///< views of the asset's images and maps
    std::vector<std::string> notes;
};

/// The looks of the asset that is written as `path`.
Looks looks_of(const std::string& path, const TextAsset& asset);

/// `text` with '_' for all that is no letter, digit or '_', and before a digit at its begin.
std::string identifier(const std::string& text);

/// The name, or the name with a number: one that is not taken yet. It is taken then.
std::string unique_name(std::string name, std::set<std::string>& taken);

/// Appends the shortest text that reads back as the same float.
void put_number(std::string& out, float value);
/// "(1, 0.5, 0)" for 3 values and these marks.
std::string tuple(std::span<const float> values, const char* open = "(", const char* close = ")");

void write_usda(BlockWriter& out, const TextAsset& asset, const Looks& looks, const Facts& facts);
void write_mtlx(BlockWriter& out, const Looks& looks, const Facts& facts);

} // namespace bake
