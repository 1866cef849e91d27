#include "asset_output.h"
#include "bake/mesh/file/mesh_io.h"
#include "bake/picture/encode_png.h"
#include "bake/surface/chart/mesh_surface.h"
#include "bake/surface/chart/tangent_space.h"
#include <filesystem>

namespace bake {
namespace {

/// The tangents that make_bake_target() computes, and normals for corners that have none.
void add_tangent_space(Mesh& mesh) {
    const std::vector<Triangle> triangles = triangulate(mesh);
    const std::vector<Vec3f> normals = corner_normals(mesh, triangles);
    mesh.tangents = corner_tangents(mesh, triangles, normals);
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
    for (GltfMap& map : maps) {
        const auto image = std::uint32_t(out.images.size());
        out.images.push_back({map.name, "image/png", stem + "_" + map.name + ".png", std::move(map.png)});
        for (GltfMaterial& material : out.materials)
            (map.slot == GltfMap::Slot::normal ? material.normal : material.occlusion) = GltfTexture{.image = image};
    }
    write_gltf(args.out, out, facts);
}

} // namespace

GltfMap asset_map(GltfMap::Slot slot, const Image<float>& map, Depth depth) {
    return {slot, slot == GltfMap::Slot::normal ? "normal" : "occlusion", encode_png(map, depth)};
}

void write_asset(const NormalMapArgs& args, std::vector<GltfMap> maps, const Facts& facts,
                 std::vector<std::string>& notes) {
    MeshOptions reading = args.read;
    reading.pieces = true;
    Mesh mesh = read_mesh(args.mesh, reading);
    add_tangent_space(mesh);
    if (mesh_format(args.mesh) != MeshFormat::gltf) {
        write_new(args, std::move(mesh), std::move(maps), facts);
        return;
    }
    const GltfCarry carry{.tangents = true,
                          .maps = std::move(maps),
                          .facts = facts,
                          .uv_set = args.read.uv_set,
                          .flip_v = !args.read.flip_v};
    for (std::string& line : carry_gltf(args.out, args.mesh, mesh, carry).notes) notes.push_back(std::move(line));
}

} // namespace bake
