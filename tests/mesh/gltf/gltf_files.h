// Small glTF files put together by hand, and what becomes of them.
#pragma once
#include "bake/mesh/gltf/io.h"
#include "mesh/file/mesh_files.h"
#include <cstring>

namespace bake_tests {

/// Bytes of a buffer, low byte first as this machine has them.
struct Buffer {
    std::string bytes;
    template <class T> Buffer& put(std::initializer_list<T> values) {
        for (const T& value : values) bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
        return *this;
    }
    Buffer& align() {
        bytes.resize((bytes.size() + 3) / 4 * 4);
        return *this;
    }
};

inline std::string base64(const std::string& bytes) {
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
            bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0);
        for (std::size_t k = 0; k < 4; ++k) out += i + k <= bytes.size() ? digits[bits >> (18 - 6 * k) & 63] : '=';
    }
    return out;
}

/// A .gltf around one buffer: `rest` holds the other members, from a comma on.
inline std::string gltf_text(const std::string& bytes, const std::string& rest) {
    return R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":)" + std::to_string(bytes.size()) +
           R"(,"uri":"data:application/octet-stream;base64,)" + base64(bytes) + "\"}]" + rest + "}";
}

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    REQUIRE_MESSAGE(at != std::string::npos, from);
    return text.replace(at, from.size(), to);
}

/// A square of two triangles whose four vertices lie at offset 0 (positions), 48 (uvs), 80 (six 16-bit indices).
inline Buffer square_buffer() {
    Buffer buffer;
    buffer.put<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
    buffer.put<float>({0, 1, 1, 1, 1, 0.25f, 0, 0.25f});
    buffer.put<std::uint16_t>({0, 1, 2, 0, 2, 3});
    return buffer;
}
inline const char* const square_rest =
    R"(,"bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":32},)"
    R"({"buffer":0,"byteOffset":80,"byteLength":12}],)"
    R"("accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},)"
    R"({"bufferView":1,"componentType":5126,"count":4,"type":"VEC2"},)"
    R"({"bufferView":2,"componentType":5123,"count":6,"type":"SCALAR"}],)"
    R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"indices":2}]}],)"
    R"("nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}],"scene":0)";
inline std::string square_text() { return gltf_text(square_buffer().bytes, square_rest); }

inline bake::Gltf read_gltf_text(const std::string& text, const bake::GltfOptions& options = {}) {
    const TemporaryFolder folder;
    return bake::read_gltf(folder.write("t.gltf", text), options);
}

/// A mesh of triangles with all that a glTF keeps, in values that survive the turn of v.
inline bake::Mesh rich_triangles(int columns, int rows) {
    bake::Mesh mesh;
    const auto unit = [](float x, float y) { return glm::normalize(bake::Vec3f(x, y, 1)); };
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i <= columns; ++i) {
            const float x = float(i) / 8, y = float(j) / 8;
            mesh.positions.emplace_back(x, y, x * y / 3);
        }
    mesh.materials = {"brick", "plaster"};
    mesh.groups = {"left", "right"};
    mesh.attributes = {{"COLOR_0", 3, {}}, {"TEXCOORD_1", 2, {}}, {"mean_curvature", 1, {}}};
    const auto add = [&](int i, int j) {
        const auto p = std::uint32_t(j * (columns + 1) + i);
        mesh.corner_position.push_back(p);
        const auto face = std::uint32_t(mesh.faces());
        mesh.tangents.push_back(bake::Vec4f(unit(0.1f * float(i), 1), face % 8 < 4 ? 1 : -1));
        for (const float c : {0.25f, 0.5f, 1.0f}) mesh.attributes[0].values.push_back(c);
        for (const float c : {float(i) / 64, float(j) / 64}) mesh.attributes[1].values.push_back(c);
        mesh.attributes[2].values.push_back(float(p));
    };
    const auto close = [&](bool right) {
        mesh.face_begin.push_back(std::uint32_t(mesh.corners()));
        mesh.face_material.push_back(right ? 1 : 0);
        mesh.face_group.push_back(right ? 1 : 0);
    };
    // Left half first: a part of the file is a run of faces.
    for (const bool right : {false, true})
        for (int j = 0; j < rows; ++j)
            for (int i = right ? columns / 2 : 0; i < (right ? columns : columns / 2); ++i) {
                add(i, j), add(i + 1, j), add(i + 1, j + 1), close(right);
                add(i, j), add(i + 1, j + 1), add(i, j + 1), close(right);
            }
    // A normal and a uv of each position's own, in order of first use, but another uv on the right: a seam.
    std::vector<std::uint32_t> normal(mesh.positions.size(), bake::no_index);
    for (std::size_t p = 0; p < mesh.positions.size(); ++p)
        mesh.normals.push_back(unit(0.01f * float(p % 7), 0.02f * float(p % 5)));
    std::vector<std::vector<std::uint32_t>> uv(mesh.positions.size(), {bake::no_index, bake::no_index});
    const auto right_of = [&](std::size_t c) { return mesh.face_group[c / 3] == 1; };
    for (std::size_t c = 0; c < mesh.corners(); ++c) uv[mesh.corner_position[c]][right_of(c)] = 0; // wanted
    for (std::uint32_t p = 0; p < mesh.positions.size(); ++p)
        for (const bool right : {false, true})
            if (uv[p][right] == 0) {
                uv[p][right] = std::uint32_t(mesh.uvs.size());
                mesh.uvs.emplace_back(mesh.positions[p].x / 4, (mesh.positions[p].y + (right ? 1 : 0)) / 4);
            }
    for (std::size_t c = 0; c < mesh.corners(); ++c) {
        mesh.corner_normal.push_back(mesh.corner_position[c]);
        mesh.corner_uv.push_back(uv[mesh.corner_position[c]][right_of(c)]);
    }
    return mesh;
}

} // namespace bake_tests
