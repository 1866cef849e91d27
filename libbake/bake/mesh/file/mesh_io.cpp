#include "bake/mesh/file/mesh_io.h"
#include "bake/base/error.h"
#include "bake/base/memory.h"
#include "bake/base/output_file.h"
#include "bake/base/text.h"
#include "bake/mesh/file/obj.h"
#include "bake/mesh/file/ply.h"
#include "bake/mesh/gltf/io.h"
#include "bake/mesh/mesh_corner.h"
#include "bake/mesh/uv_set.h"
#include <new>

namespace bake {
namespace {

Error unknown_format(Refusal refusal, const std::string& path) {
    const std::string found = ending(path);
    return Error(refusal, path + ": " + (found.empty() ? "a name without ending" : "'" + found + "'") +
                              " is not a mesh format known here; use .obj, .ply, .gltf or .glb");
}

Mesh read_gltf_mesh(const std::string& path, const MeshOptions& options) {
    Gltf gltf = read_gltf(path, {.flip_v = !options.flip_v});
    take_texture_uvs(gltf, path, {.uv_set = options.uv_set, .flip_v = !options.flip_v});
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
    Mesh mesh = read_format(format, path, options);
    if (mesh.faces() == 0)
        throw Error(Refusal::unsuitable, path + ": has no faces (" + std::to_string(mesh.positions.size()) +
                                             " points); export it as a polygon mesh");
    return mesh;
}

std::int64_t write_mesh(const std::string& path, const Mesh& mesh, const Facts& facts) {
    const MeshFormat format = mesh_format(path);
    if (format == MeshFormat::unknown) throw unknown_format(Refusal::usage, path);
    if (format == MeshFormat::gltf) return write_gltf(path, mesh).bytes;
    refuse_unless_finite(mesh, path);
    return format == MeshFormat::obj ? write_obj(path, mesh, facts) : write_ply(path, mesh, facts);
}

} // namespace bake
