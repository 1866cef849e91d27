#include "bake/mesh/file/mesh_io.h"
#include "bake/base/error.h"
#include "bake/mesh/file/obj.h"
#include "bake/mesh/file/ply.h"
#include "bake/mesh/gltf/io.h"
#include "bake/mesh/mesh_corner.h"
#include <filesystem>
#include <new>

namespace bake {
namespace {

enum class Format { obj, ply, gltf, unknown };

std::string ending(const std::string& path) { return std::filesystem::path(path).extension().string(); }

Format format_of(const std::string& path) {
    std::string lower = ending(path);
    for (char& c : lower)
        if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
    return lower == ".obj"                       ? Format::obj
           : lower == ".ply"                     ? Format::ply
           : lower == ".glb" || lower == ".gltf" ? Format::gltf
                                                 : Format::unknown;
}

Error unknown_format(Refusal refusal, const std::string& path) {
    const std::string found = ending(path);
    return Error(refusal, path + ": " + (found.empty() ? "a name without ending" : "'" + found + "'") +
                              " is not a mesh format known here; use .obj, .ply, .gltf or .glb");
}

Mesh read_format(Format format, const std::string& path, const MeshOptions& options) {
    try {
        if (format == Format::gltf) return flatten(read_gltf(path, {.flip_v = !options.flip_v}));
        Mesh mesh = format == Format::obj ? read_obj(path) : read_ply(path);
        for (Vec2f& uv : mesh.uvs)
            if (options.flip_v) uv.y = 1 - uv.y;
        return mesh;
    } catch (const std::bad_alloc&) {
        throw Error(Refusal::unsuitable, path + ": does not fit in the memory that is free; split the mesh");
    }
}

} // namespace

bool is_gltf(const std::string& path) { return format_of(path) == Format::gltf; }

Mesh read_mesh(const std::string& path, const MeshOptions& options) {
    const Format format = format_of(path);
    if (format == Format::unknown) throw unknown_format(Refusal::unreadable, path);
    Mesh mesh = read_format(format, path, options);
    if (mesh.faces() == 0)
        throw Error(Refusal::unsuitable, path + ": has no faces (" + std::to_string(mesh.positions.size()) +
                                             " points); export it as a polygon mesh");
    return mesh;
}

void write_mesh(const std::string& path, const Mesh& mesh) {
    const Format format = format_of(path);
    if (format == Format::unknown) throw unknown_format(Refusal::usage, path);
    if (format == Format::gltf) {
        write_gltf(path, mesh);
        return;
    }
    refuse_unless_finite(mesh, path);
    if (format == Format::obj) write_obj(path, mesh);
    else write_ply(path, mesh);
}

} // namespace bake
