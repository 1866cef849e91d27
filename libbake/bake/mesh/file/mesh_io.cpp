#include "bake/mesh/file/mesh_io.h"
#include "bake/base/error.h"
#include "bake/base/memory.h"
#include "bake/base/output_file.h"
#include "bake/base/shared_loads.h"
#include "bake/base/text.h"
#include "bake/mesh/file/obj.h"
#include "bake/mesh/file/ply.h"
#include "bake/mesh/gltf/io.h"
#include "bake/mesh/mesh_corner.h"
#include "bake/mesh/uv_set.h"
#include <algorithm>
#include <iterator>
#include <new>

namespace bake {
namespace {

Error unknown_format(Refusal refusal, const std::string& path) {
    const std::string found = ending(path);
    return Error(refusal, path + ": " + (found.empty() ? "a name without ending" : "'" + found + "'") +
                              " is not a mesh format known here; use .obj, .ply, .gltf or .glb");
}

void name_pieces(Gltf& gltf) {
    Mesh& mesh = gltf.mesh;
    mesh.groups.clear();
    mesh.face_group.assign(mesh.faces(), no_index);
    for (const GltfPiece& piece : gltf.pieces) {
        const auto number = std::uint32_t(mesh.groups.size());
        mesh.groups.push_back(std::to_string(number));
        std::fill(mesh.face_group.begin() + std::ptrdiff_t(piece.first_face),
                  mesh.face_group.begin() + std::ptrdiff_t(piece.end_face), number);
    }
}

/// All sets of uvs of the mesh, as attributes.
std::vector<Attribute> file_uvs(const Mesh& mesh) {
    std::vector<Attribute> out;
    if (!mesh.corner_uv.empty()) {
        Attribute& first = out.emplace_back(Attribute{"FILE_TEXCOORD_0", 2, {}});
        for (std::uint32_t c = 0; c < mesh.corners(); ++c) {
            const Vec2f uv = uv_at(mesh, c);
            first.values.insert(first.values.end(), {uv.x, uv.y});
        }
    }
    for (const Attribute& a : mesh.attributes)
        if (a.name.rfind("TEXCOORD_", 0) == 0) out.push_back({"FILE_" + a.name, a.components, a.values});
    return out;
}

bool moves_uvs(const Gltf& gltf, int uv_set) {
    return uv_set > 0 || std::any_of(gltf.materials.begin(), gltf.materials.end(), [&](const GltfMaterial& m) {
               const GltfTextureUvs uvs = texture_uvs(m, uv_set);
               return uvs.set != 0 || uvs.moves();
           });
}

Mesh read_gltf_mesh(const std::string& path, const MeshOptions& options) {
    Gltf gltf = read_gltf(path, {.flip_v = !options.flip_v});
    std::vector<Attribute> kept;
    if (options.pieces) name_pieces(gltf);
    if (options.pieces && moves_uvs(gltf, options.uv_set)) kept = file_uvs(gltf.mesh);
    take_texture_uvs(gltf, path, {.uv_set = options.uv_set, .flip_v = !options.flip_v});
    std::move(kept.begin(), kept.end(), std::back_inserter(gltf.mesh.attributes));
    std::vector<std::string> notes = std::move(gltf.notes);
    Mesh mesh = flatten(std::move(gltf));
    notes.insert(notes.end(), mesh.notes.begin(), mesh.notes.end());
    mesh.notes = std::move(notes);
    return mesh;
}

Mesh read_format(MeshFormat format, const std::string& path, const MeshOptions& options) {
    try {
        if (format == MeshFormat::gltf) return read_gltf_mesh(path, options);
        Mesh mesh = format == MeshFormat::obj ? read_obj(path) : read_ply(path);
        if (options.uv_set >= 0) take_uv_set(mesh, options.uv_set, path);
        for (Vec2f& uv : mesh.uvs)
            if (options.flip_v) uv.y = 1 - uv.y;
        return mesh;
    } catch (const std::bad_alloc&) {
        const MemoryLimit memory = memory_limit();
        throw Error(Refusal::unsuitable,
                    path + ": does not fit in " + memory.described() + "; split the mesh, or " + memory.advice());
    }
}

/// What the mesh depends on besides the file.
std::string reading_of(const MeshOptions& options) {
    return "mesh " + std::to_string(options.flip_v) + std::to_string(options.pieces) + std::to_string(options.uv_set);
}

std::size_t memory_of(const Mesh& mesh) {
    const auto bytes = [](const auto& values) { return values.size() * sizeof(values[0]); };
    std::size_t sum = sizeof(Mesh) + bytes(mesh.positions) + bytes(mesh.normals) + bytes(mesh.uvs) +
                      bytes(mesh.face_begin) + bytes(mesh.corner_position) + bytes(mesh.corner_normal) +
                      bytes(mesh.corner_uv) + bytes(mesh.face_material) + bytes(mesh.face_group) +
                      bytes(mesh.tangents) + bytes(mesh.tags.creases) + bytes(mesh.tags.corners);
    for (const Attribute& attribute : mesh.attributes) sum += bytes(attribute.values);
    return sum;
}

} // namespace

MeshFormat mesh_format(const std::string& path) {
    if (path == null_device) return MeshFormat::ply;
    const std::string end = ending(path);
    return end == ".obj"                     ? MeshFormat::obj
           : end == ".ply"                   ? MeshFormat::ply
           : end == ".glb" || end == ".gltf" ? MeshFormat::gltf
                                             : MeshFormat::unknown;
}

Mesh read_mesh(const std::string& path, const MeshOptions& options) {
    const MeshFormat format = mesh_format(path);
    if (format == MeshFormat::unknown) throw unknown_format(Refusal::unreadable, path);
    const std::function<Mesh()> read = [&] { return read_format(format, path, options); };
    const std::function<Mesh(const Mesh&)> copy = [](const Mesh& mesh) { return mesh; };
    Mesh mesh = format == MeshFormat::gltf // has further files
                    ? read()
                    : shared_load(path, reading_of(options), read, copy, std::function(memory_of));
    if (mesh.faces() == 0)
        throw Error(Refusal::unsuitable, path + ": has no faces (" + std::to_string(mesh.positions.size()) +
                                             " points); export it as a polygon mesh");
    return mesh;
}

std::int64_t write_mesh(const std::string& path, const Mesh& mesh, const Facts& facts) {
    const MeshFormat format = mesh_format(path);
    if (format == MeshFormat::unknown) throw unknown_format(Refusal::usage, path);
    if (format == MeshFormat::gltf) return write_gltf(path, mesh, facts).bytes;
    refuse_unless_finite(mesh, path);
    return format == MeshFormat::obj ? write_obj(path, mesh, facts) : write_ply(path, mesh, facts);
}

} // namespace bake
