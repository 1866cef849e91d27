// Baked materials as text: USD (.usda), which holds the mesh too, and MaterialX (.mtlx), which holds materials alone.
#pragma once
#include "bake/mesh/gltf/carry.h"
#include <optional>

namespace bake {

enum class AssetText { usda, mtlx };

/// By the ending of the name, in upper or lower case; nothing for other endings.
std::optional<AssetText> asset_text(const std::string& path);

struct TextAsset {
    Mesh mesh; ///< in world space, with normals and with the uvs on which the maps lie, v up
    std::vector<GltfMaterial> materials{}; ///< those of the names of the mesh; the others are white and not metallic
    std::vector<GltfImage> images{};       ///< of the materials
    std::vector<GltfMap> maps{};           ///< of all materials, instead of their own
    bool gltf = false;                     ///< the mesh is one of a glTF file, where faces may have no material
    int uv_set = -1;                       ///< as in GltfUvOptions
    std::string map_material{};            ///< name of the materials that get the maps; empty: all
};

struct TextAssetWritten {
    std::int64_t bytes = 0;         ///< of all files
    std::vector<std::string> notes; ///< what the format does not hold, one line each
};

/// Writes .usda or .mtlx by the name, and the pictures beside it: <stem>_<name of the map>.png, and <stem>_image<n> for image
/// n of the materials. All appear together. The text has the shortest numbers that read back as the same floats.
/// .usda: one Mesh of triangles (those of triangulate()), a GeomSubset for each of several materials, UsdPreviewSurface.
/// .mtlx: a standard_surface for each material that the mesh shows.
/// Of the materials are kept: base colour, metallic, roughness, emission, occlusion (.usda), their textures where these lie
/// on the uvs of the maps, opacity, and whether both sides are seen (.usda). All else is named in the notes.
/// Throws Error{Refusal::unwritable}. Throws Error{Refusal::usage} for a name with '@', at which USD ends file names,
/// or with control characters, and for a picture that would replace a file of other contents, unless the file that is replaced
/// names it.
/// Throws Error{Refusal::unsuitable} for values that are not finite, and for a .mtlx whose maps lie on uvs that are moved
/// by KHR_texture_transform.
TextAssetWritten write_text_asset(const std::string& path, const TextAsset& asset, const Facts& facts = {});

/// How the .usda or .mtlx file was made, as record_text() of base/provenance.h has it, and the pictures that it names.
struct TextAssetContent {
    std::string record;
    std::vector<std::string> pictures; ///< relative to the folder of the file, each once, sorted
    std::size_t materials = 0;
};

/// Throws Error{Refusal::unreadable} for a file that does not begin as its format does.
TextAssetContent read_text_asset(const std::string& path);

} // namespace bake
