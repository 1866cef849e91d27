// A glTF file of one square, written by hand, and the scene that shows it face on.
#pragma once
#include "bake/picture/image_io.h"
#include "bake/preview/scene_entries.h"
#include "cli/command.h"
#include "mesh/gltf/gltf_files.h"
#include "preview/little_scenes.h"

namespace bake::test {

/// The square [0,1]^2 facing +Z with the material, an object of JSON. Accessors: 0 positions, 1 uvs (v down in the file, up
/// here: uv = xy), 2 uvs (u, v) = (y, 1 - x) here, 3 colours, of alpha 1, 1, .5, .5 from the bottom up, 4 indices. `rest`: further members.
inline std::string square_gltf(const std::string& material, const std::string& attributes = R"("TEXCOORD_0":1)",
                               const std::string& rest = "") {
    bake_tests::Buffer buffer;
    buffer.put<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
    buffer.put<float>({0, 1, 1, 1, 1, 0, 0, 0});
    buffer.put<float>({0, 0, 0, 1, 1, 1, 1, 0});
    buffer.put<float>({1, 0.5f, 0.25f, 1, 1, 0.5f, 0.25f, 1, 1, 0.5f, 0.25f, 0.5f, 1, 0.5f, 0.25f, 0.5f});
    buffer.put<std::uint16_t>({0, 1, 2, 0, 2, 3});
    return bake_tests::gltf_text(
        buffer.bytes,
        R"(,"bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":32},)"
        R"({"buffer":0,"byteOffset":80,"byteLength":32},{"buffer":0,"byteOffset":112,"byteLength":64},)"
        R"({"buffer":0,"byteOffset":176,"byteLength":12}],)"
        R"("accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},)"
        R"({"bufferView":1,"componentType":5126,"count":4,"type":"VEC2"},)"
        R"({"bufferView":2,"componentType":5126,"count":4,"type":"VEC2"},)"
        R"({"bufferView":3,"componentType":5126,"count":4,"type":"VEC4"},)"
        R"({"bufferView":4,"componentType":5123,"count":6,"type":"SCALAR"}],)"
        R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,)" +
            attributes +
            R"(},"indices":4,"material":0}]}],"nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}],"scene":0,"materials":[)" +
            material + "]" + rest);
}

/// Writes t.png in the folder: n x n texels of 8 bits, values of (column, row from the top, channel).
inline void write_texels(const Folder& folder, int n, int channels, const std::function<float(int, int, int)>& value) {
    Image<float> image(n, n, channels);
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x)
            for (int c = 0; c < channels; ++c) image.at(x, y, c) = value(x, y, c);
    write_image(folder / "t.png", image, {.depth = Depth::u8});
}
/// Members that make t.png texture 0; `sampler`: the members of its sampler.
inline std::string texel_texture(const std::string& sampler = "") {
    return R"(,"images":[{"uri":"t.png"}],"samplers":[{)" + sampler + R"(}],"textures":[{"source":0,"sampler":0}])";
}

/// The scene of s.gltf in ambient light of radiance 1 alone.
inline SceneEntries square_entries(const Folder& folder, const std::string& gltf) {
    write_file(folder / "s.gltf", gltf);
    SceneEntries entries;
    entries.file = folder / "s.gltf";
    entries.meshes.push_back({.file = folder / "s.gltf"});
    entries.ambient = Vec3f(1);
    entries.any_light = true;
    entries.settings.width = entries.settings.height = 64;
    entries.cameras.push_back({.position = Vec3f(0.5f, 0.5f, 2), .target = Vec3f(0.5f, 0.5f, 0)});
    entries.cameras[0].orthographic = true, entries.cameras[0].height = 1.f;
    return entries;
}
inline Scene square_scene(const Folder& folder, const std::string& gltf) { return load(square_entries(folder, gltf)); }

/// Radiance seen at the point (x, y) of the square.
inline Vec3f at_point(const Scene& scene, double x, double y) { return seen_at(scene, 64 * x, 64 * (1 - y)); }

/// The point (x, y) of the square on its shape, before placement.
inline ShapePoint point_of_square(float x, float y) {
    // Triangles (0,0) (1,0) (1,1) and (0,0) (1,1) (0,1).
    return y <= x ? ShapePoint{0, x - y, y} : ShapePoint{1, x, y - x};
}

} // namespace bake::test
