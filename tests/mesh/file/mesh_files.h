// Files for the tests of meshes: temporary ones, our own, and the shared collection.
#pragma once
#include "bake/base/error.h"
#include "bake/mesh/file/mesh_io.h"
#include "folders.h"
#include <algorithm>
#include <cstdlib>
#include <doctest/doctest.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <unistd.h>

namespace bake_tests {

using bake::test::source_folder;

/// A folder of this test alone, gone with it.
struct TemporaryFolder {
    std::filesystem::path path;
    TemporaryFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "bake_mesh_XXXXXX").string();
        path = mkdtemp(name.data());
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
    std::string file(const std::string& name) const { return (path / name).string(); }
    std::string write(const std::string& name, const std::string& bytes) const {
        std::filesystem::remove(path / name); // a file system may flush to disk when a file is written over
        std::ofstream(path / name, std::ios::binary) << bytes;
        return file(name);
    }
};

inline std::string bytes_of(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

inline bake::Mesh read_text(const std::string& name, const std::string& bytes) {
    const TemporaryFolder folder;
    return bake::read_mesh(folder.write(name, bytes));
}

/// What read_mesh refuses a file with, the folder left out; "read" when it reads it.
struct Outcome {
    int code = 0;
    std::string reason = "read";
};
inline Outcome outcome_of(const std::filesystem::path& path) {
    try {
        bake::read_mesh(path.string());
        return {};
    } catch (const bake::Error& error) {
        std::string reason = error.what();
        const std::string folder = path.parent_path().string() + "/";
        if (reason.rfind(folder, 0) == 0) reason.erase(0, folder.size());
        return {int(error.refusal), reason};
    }
}
inline Outcome outcome_of_text(const std::string& name, const std::string& bytes) {
    const TemporaryFolder folder;
    return outcome_of(folder.write(name, bytes));
}

inline bool same_attributes(const bake::Mesh& a, const bake::Mesh& b) {
    return std::equal(a.attributes.begin(), a.attributes.end(), b.attributes.begin(), b.attributes.end(),
                      [](const bake::Attribute& x, const bake::Attribute& y) {
                          return x.name == y.name && x.components == y.components && x.values == y.values;
                      });
}

inline bool same_mesh(const bake::Mesh& a, const bake::Mesh& b) {
    return same_attributes(a, b) && a.tangents == b.tangents && a.positions == b.positions && a.normals == b.normals &&
           a.uvs == b.uvs && a.face_begin == b.face_begin && a.corner_position == b.corner_position &&
           a.corner_normal == b.corner_normal && a.corner_uv == b.corner_uv && a.materials == b.materials &&
           a.groups == b.groups && a.face_material == b.face_material && a.face_group == b.face_group;
}

/// Same values at every corner, whatever the indices.
inline bool same_corners(const bake::Mesh& a, const bake::Mesh& b) {
    if (a.face_begin != b.face_begin || a.corner_uv.empty() != b.corner_uv.empty() ||
        a.corner_normal.empty() != b.corner_normal.empty())
        return false;
    for (std::size_t c = 0; c < a.corners(); ++c) {
        if (a.positions[a.corner_position[c]] != b.positions[b.corner_position[c]]) return false;
        if (!a.corner_uv.empty() && a.uvs[a.corner_uv[c]] != b.uvs[b.corner_uv[c]]) return false;
        if (!a.corner_normal.empty() && a.normals[a.corner_normal[c]] != b.normals[b.corner_normal[c]]) return false;
    }
    return true;
}

} // namespace bake_tests
