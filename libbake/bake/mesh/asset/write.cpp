#include "bake/base/content_hash.h"
#include "bake/base/error.h"
#include "bake/base/printable.h"
#include "bake/mesh/asset/looks.h"
#include "bake/mesh/gltf/container.h"
#include "bake/mesh/mesh_corner.h"
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace bake {
namespace {

namespace fs = std::filesystem;

void refuse_moved_uvs(const std::string& path, const Looks& looks) {
    for (const Look& look : looks.looks)
        if (look.uvs.moves())
            throw Error(Refusal::unsuitable,
                        path + ": not written, KHR_texture_transform moves the uvs of the material " + look.title +
                            ", and this file has no mesh in which they could be moved; write a .usda or a .glb");
}

/// What no material can hold.
void add_notes(const TextAsset& asset, bool usda, Looks& looks) {
    std::size_t two_sided = 0, cut_out = 0;
    for (const Look& look : looks.looks) {
        two_sided += look.values.double_sided ? 1 : 0;
        const std::string& mode = look.values.alpha_mode;
        cut_out += mode == "MASK" || (mode == "BLEND" && look.base_color) ? 1 : 0;
    }
    const auto note = [&looks](const char* text) { looks.notes.emplace_back(text); };
    if (usda && two_sided > 0 && two_sided < looks.looks.size())
        note("USD knows double-sided meshes, not materials: all faces are seen from both sides");
    if (!usda && cut_out > 0) note("the alpha of textures and the alphaMode MASK are not kept in MaterialX");
    if (!usda && std::any_of(asset.maps.begin(), asset.maps.end(),
                             [](const GltfMap& map) { return map.slot == GltfMap::Slot::occlusion; }))
        note("standard_surface has no input for occlusion: the map stands beside the file, and nothing names it");
    if (std::any_of(asset.mesh.attributes.begin(), asset.mesh.attributes.end(),
                    [](const Attribute& a) { return a.name.rfind("COLOR_", 0) == 0; }))
        note("vertex colours are not kept");
}

/// Whether the file that is replaced, if there is one, names the picture. It is no input, and so is read by itself.
bool names_picture(const std::string& path, const std::string& name) {
    std::ifstream in(path, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    return text.find("@./" + name + "@") != std::string::npos || text.find('"' + name + '"') != std::string::npos;
}

/// The user chose the name of the file alone: a picture must not replace one that has nothing to do with it.
void refuse_strangers(const std::string& path, const std::vector<LookFile>& files) {
    for (const LookFile& file : files) {
        const std::string target = (fs::path(path).parent_path() / file.name).string();
        std::error_code ignored;
        if (fs::exists(target, ignored) && file_hash(target) != content_hash(file.bytes.data(), file.bytes.size()) &&
            !names_picture(path, file.name))
            throw Error(Refusal::usage, target + ": is there already, and a picture of " +
                                            fs::path(path).filename().string() +
                                            " would replace it; choose another name or folder");
    }
}

} // namespace

TextAssetWritten write_text_asset(const std::string& path, const TextAsset& asset, const Facts& facts) {
    const bool usda = asset_text(path) == AssetText::usda;
    const fs::path name = fs::path(path).filename();
    if (usda && name.string().find('@') != std::string::npos)
        throw Error(Refusal::usage, path + ": USD ends the names of files at '@'; choose a name without it");
    if (printable(name.string()) != name.string())
        throw Error(Refusal::usage, printable(path) +
                                        ": has characters that are no text, which the names of its pictures "
                                        "would have too; choose another name");
    refuse_unless_finite(asset.mesh, path);
    Looks looks = looks_of(path, asset);
    if (!usda) refuse_moved_uvs(path, looks);
    add_notes(asset, usda, looks);
    refuse_strangers(path, looks.files);
    OutputSet together;
    TextAssetWritten done;
    const auto write = [&done](const std::string& file, const auto& fill) {
        BlockWriter out(file);
        fill(out);
        out.commit();
        done.bytes += out.bytes();
    };
    for (const LookFile& file : looks.files)
        write((fs::path(path).parent_path() / file.name).string(), [&](BlockWriter& out) { put(out, file.bytes); });
    write(path, [&](BlockWriter& out) {
        if (usda) write_usda(out, asset, looks, facts);
        else write_mtlx(out, looks, facts);
    });
    together.commit();
    done.notes = std::move(looks.notes);
    return done;
}

} // namespace bake
