#include "bake/asset/mesh_io.h"
#include "bake/asset/obj.h"
#include "bake/asset/ply.h"
#include "bake/base/error.h"
#include <cmath>
#include <filesystem>
#include <new>

namespace bake {
namespace {

enum class Format { obj, ply, unknown };

std::string ending(const std::string& path) { return std::filesystem::path(path).extension().string(); }

Format format_of(const std::string& path) {
    std::string lower = ending(path);
    for (char& c : lower)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return lower == ".obj" ? Format::obj : lower == ".ply" ? Format::ply : Format::unknown;
}

Error unknown_format(Refusal refusal, const std::string& path) {
    const std::string found = ending(path);
    return Error(refusal, path + ": " + (found.empty() ? "a name without ending" : "'" + found + "'") +
                              " is not a mesh format known here; use .obj or .ply");
}

Mesh read_format(Format format, const std::string& path) {
    try {
        return format == Format::obj ? read_obj(path) : read_ply(path);
    } catch (const std::bad_alloc&) {
        throw Error(Refusal::unsuitable, path + ": does not fit in the memory that is free; split the mesh");
    }
}

/// No NaN and no infinity ever reaches a file.
template <class Vec>
void refuse_unless_finite(const std::vector<Vec>& values, const char* what, const std::string& path) {
    for (std::size_t i = 0; i < values.size(); ++i)
        for (int k = 0; k < Vec::length(); ++k)
            if (!std::isfinite(values[i][k]))
                throw Error(Refusal::unwritable, path + ": not written, " + what + " " + std::to_string(i) +
                                                     " of the mesh is not finite; check the mesh and the amplitude");
}

} // namespace

Mesh read_mesh(const std::string& path) {
    const Format format = format_of(path);
    if (format == Format::unknown) throw unknown_format(Refusal::unreadable, path);
    Mesh mesh = read_format(format, path);
    if (mesh.faces() == 0)
        throw Error(Refusal::unsuitable, path + ": has no faces (" + std::to_string(mesh.positions.size()) +
                                             " points); export it as a polygon mesh");
    return mesh;
}

void write_mesh(const std::string& path, const Mesh& mesh) {
    const Format format = format_of(path);
    if (format == Format::unknown) throw unknown_format(Refusal::usage, path);
    refuse_unless_finite(mesh.positions, "position", path);
    refuse_unless_finite(mesh.normals, "normal", path);
    refuse_unless_finite(mesh.uvs, "uv", path);
    if (format == Format::obj) write_obj(path, mesh);
    else write_ply(path, mesh);
}

} // namespace bake
