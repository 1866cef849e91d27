// glTF files of a few squares with or without uvs, put together by hand.
#pragma once
#include "mesh/gltf/gltf_files.h"
#include <string>
#include <vector>

namespace bake::test {

/// A unit square in the plane z = 0.
struct SquarePart {
    std::vector<int> uv_sets; ///< numbers n of its TEXCOORD_n, each of which fills 0 to 1
    int material = -1;        ///< -1: none
    int mesh = 0;
};

/// The squares side by side from x = 0 on, two units apart, as primitives of their meshes, each of which has a node.
/// `materials` are the names of the materials.
inline std::string square_parts(const std::vector<SquarePart>& parts, const std::vector<std::string>& materials) {
    bake_tests::Buffer buffer;
    buffer.put<float>({0, 1, 1, 1, 1, 0, 0, 0});
    buffer.put<std::uint16_t>({0, 1, 2, 0, 2, 3});
    std::string views = R"({"buffer":0,"byteLength":32},{"buffer":0,"byteOffset":32,"byteLength":12})";
    std::string accessors = R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC2"},)"
                            R"({"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"})";
    std::vector<std::string> primitives;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const float x = 2 * float(i);
        const std::string low = std::to_string(2 * i), high = std::to_string(2 * i + 1), at = std::to_string(i + 2);
        views += R"(,{"buffer":0,"byteOffset":)" + std::to_string(buffer.bytes.size()) + R"(,"byteLength":48})";
        buffer.put<float>({x, 0, 0, x + 1, 0, 0, x + 1, 1, 0, x, 1, 0});
        accessors += R"(,{"bufferView":)" + at + R"(,"componentType":5126,"count":4,"type":"VEC3","min":[)" + low +
                     R"(,0,0],"max":[)" + high + ",1,0]}";
        std::string primitive = R"({"attributes":{"POSITION":)" + at;
        for (const int set : parts[i].uv_sets) primitive += R"(,"TEXCOORD_)" + std::to_string(set) + R"(":0)";
        primitive += R"(},"indices":1)";
        if (parts[i].material >= 0) primitive += R"(,"material":)" + std::to_string(parts[i].material);
        primitives.resize(std::max(primitives.size(), std::size_t(parts[i].mesh) + 1));
        std::string& of_mesh = primitives[std::size_t(parts[i].mesh)];
        of_mesh += (of_mesh.empty() ? "" : ",") + primitive + "}";
    }
    const auto list = [](const auto& items, const auto& text) {
        std::string out;
        for (std::size_t i = 0; i < items.size(); ++i) out += (i > 0 ? "," : "") + text(i);
        return "[" + out + "]";
    };
    std::string rest = R"(,"bufferViews":[)" + views + R"(],"accessors":[)" + accessors + R"(],"meshes":)" +
                       list(primitives, [&](std::size_t i) { return R"({"primitives":[)" + primitives[i] + "]}"; }) +
                       R"(,"nodes":)" +
                       list(primitives, [](std::size_t i) { return R"({"mesh":)" + std::to_string(i) + "}"; }) +
                       R"(,"scenes":[{"nodes":)" + list(primitives, [](std::size_t i) { return std::to_string(i); }) +
                       R"(}],"scene":0)";
    if (!materials.empty())
        rest +=
            R"(,"materials":)" + list(materials, [&](std::size_t i) { return R"({"name":")" + materials[i] + "\"}"; });
    return bake_tests::gltf_text(buffer.bytes, rest);
}

} // namespace bake::test
