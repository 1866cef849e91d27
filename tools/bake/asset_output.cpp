#include "asset_output.h"
#include "bake/base/text.h"
#include "bake/mesh/asset/asset.h"
#include "bake/mesh/file/mesh_io.h"
#include "bake/mesh/gltf/document.h"
#include "bake/picture/encode_png.h"
#include "bake/surface/chart/mesh_surface.h"
#include "bake/surface/chart/tangent_space.h"
#include "inputs/material_choice.h"
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

namespace bake {
namespace {

/// The tangents that make_bake_target() computes, and normals for corners that have none.
void add_tangent_space(Mesh& mesh, const std::string& material, const std::string& path) {
    const std::vector<Triangle> triangles = triangulate(mesh);
    const std::vector<Vec3f> normals = corner_normals(mesh, triangles);
    mesh.tangents = corner_tangents(mesh, triangles, normals);
    if (!material.empty()) { // its faces were baked without the others
        Mesh alone = mesh;
        choose_material(alone, material, path);
        const std::vector<Vec4f> own = corner_tangents(alone, triangles, normals);
        for (std::size_t c = 0; c < own.size(); ++c)
            if (alone.corner_uv[c] != no_index) mesh.tangents[c] = own[c];
    }
    mesh.corner_normal.resize(mesh.corners(), no_index);
    std::vector<std::uint32_t> of_position(mesh.positions.size(), no_index); // which are smooth
    for (std::size_t c = 0; c < mesh.corners(); ++c) {
        if (mesh.corner_normal[c] != no_index) continue;
        std::uint32_t& normal = of_position[mesh.corner_position[c]];
        if (normal == no_index || mesh.normals[normal] != normals[c]) {
            normal = std::uint32_t(mesh.normals.size());
            mesh.normals.push_back(normals[c]);
        }
        mesh.corner_normal[c] = normal;
    }
}

/// A file with plain materials of the mesh's names.
void write_new(const NormalMapArgs& args, Mesh mesh, std::vector<GltfMap> maps, const Facts& facts) {
    Gltf out{.mesh = std::move(mesh)};
    if (out.mesh.materials.empty() || out.mesh.face_material.empty()) {
        out.mesh.materials = {"baked"};
        out.mesh.face_material.assign(out.mesh.faces(), 0);
    }
    for (const std::string& name : out.mesh.materials) out.materials.push_back({.name = name, .metallic = 0});
    const std::string stem = std::filesystem::path(args.out).stem().string();
    std::set<std::uint32_t> baked;
    for (std::size_t f = 0; f < out.mesh.faces(); ++f)
        if (out.mesh.corner_uv[out.mesh.face_begin[f]] != no_index) baked.insert(out.mesh.face_material[f]);
    for (GltfMap& map : maps) {
        const auto image = std::uint32_t(out.images.size());
        out.images.push_back({map.name, "image/png", stem + "_" + map.name + ".png", std::move(map.png)});
        for (std::uint32_t m = 0; m < out.materials.size(); ++m)
            if (GltfMaterial& material = out.materials[m];
                baked.count(m) > 0 && (args.material.empty() || args.material == material.name))
                (map.slot == GltfMap::Slot::normal ? material.normal : material.occlusion) =
                    GltfTexture{.image = image};
    }
    write_gltf(args.out, out, facts);
}

/// What of a glTF file neither a mesh in world space nor its materials hold.
void note_lost_parts(const std::string& path, const GltfDocument& document, std::vector<std::string>& notes) {
    const auto root = nlohmann::json::parse(document.text.begin(), document.text.end(), nullptr, false);
    std::string lost;
    const auto add = [&lost](bool there, const char* what) {
        if (there) lost += (lost.empty() ? "" : ", ") + std::string(what);
    };
    add(root.contains("animations"), "animations");
    add(root.contains("skins"), "skins");
    add(document.cameras != "[]", "cameras");
    add(document.lights != "[]", "lights");
    if (!lost.empty()) notes.push_back("not kept in " + ending(path) + ": " + lost);
}

/// .usda and .mtlx.
void write_text(const NormalMapArgs& args, const AssetSource& from, std::vector<GltfMap> maps, const Facts& facts,
                std::vector<std::string>& notes) {
    TextAsset asset{.mesh = {}, .maps = std::move(maps), .uv_set = from.read.uv_set, .map_material = args.material};
    asset.gltf = mesh_format(from.path) == MeshFormat::gltf;
    const bool usda = asset_text(args.out) == AssetText::usda;
    if (asset.gltf) {
        Gltf gltf = read_gltf(from.path, {.flip_v = !from.read.flip_v});
        take_texture_uvs(gltf, from.path, {.uv_set = from.read.uv_set, .flip_v = !from.read.flip_v});
        asset.materials = std::move(gltf.materials), asset.images = std::move(gltf.images);
        if (usda && gltf.nodes.size() > 1)
            notes.push_back(std::to_string(gltf.nodes.size()) + " nodes are one mesh in world space in .usda");
        asset.mesh = flatten(std::move(gltf));
        note_lost_parts(args.out, read_gltf_document(from.path), notes);
    } else {
        asset.mesh = read_mesh(from.path, from.read);
    }
    add_tangent_space(asset.mesh, args.material, from.path);
    for (std::string& line : write_text_asset(args.out, asset, facts).notes) notes.push_back(std::move(line));
}

} // namespace

AssetSource asset_source(const NormalMapArgs& args) {
    if (args.displaced.empty() || asset_text(args.out) == AssetText::mtlx) return {args.mesh, args.read};
    return {args.displaced, displaced_reading(args)};
}

void refuse_other_uvs(const NormalMapArgs& args, const NormalMapReport& report) {
    if (writes_asset(args) && 2 * report.uncovered > report.covered + report.border)
        throw Error(Refusal::unsuitable, args.displaced + ": its uvs are not those of " + args.mesh +
                                             ", where the map lies; displace that mesh, or write a picture");
}

GltfMap asset_map(GltfMap::Slot slot, const Image<float>& map, Depth depth) {
    return {slot, slot == GltfMap::Slot::normal ? "normal" : "occlusion", encode_png(map, depth)};
}

void write_asset(const NormalMapArgs& args, std::vector<GltfMap> maps, const Facts& facts,
                 std::vector<std::string>& notes) {
    const AssetSource from = asset_source(args);
    if (asset_text(args.out)) {
        write_text(args, from, std::move(maps), facts, notes);
        return;
    }
    MeshOptions reading = from.read;
    reading.pieces = true;
    Mesh mesh = read_mesh(from.path, reading);
    add_tangent_space(mesh, args.material, from.path);
    if (mesh_format(from.path) != MeshFormat::gltf) {
        write_new(args, std::move(mesh), std::move(maps), facts);
        return;
    }
    const GltfCarry carry{.tangents = true,
                          .maps = std::move(maps),
                          .facts = facts,
                          .uv_set = from.read.uv_set,
                          .flip_v = !from.read.flip_v,
                          .map_material = args.material};
    for (std::string& line : carry_gltf(args.out, from.path, mesh, carry).notes) notes.push_back(std::move(line));
}

} // namespace bake
