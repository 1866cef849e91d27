// What we bake, in three.js in a headless Chromium beside our tracer: normals, the sky and reflected light.
// docs/clients.md has the figures.
#include "bake/mesh/file/mesh_io.h"
#include "bake/mesh/gltf/io.h"
#include "bake/preview/render.h"
#include "bake/preview/scene_io.h"
#include "bake/surface/chart/tangent_space.h"
#include "browser.h"
#include "cli/command.h"
#include "preview/little_scenes.h"
#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>
#include <sys/wait.h>

using namespace bake;
using namespace bake::test;
using nlohmann::json;

namespace {

/// A mesh with one normal map, and glTF files of them.
struct Baked {
    Folder folder;
    std::string name;
    Mesh mesh;                    ///< with MikkTSpace tangents
    Vec3f position{0}, target{0}; ///< of the camera
    int size = 256;

    /// Writes a glTF file. Its texture is interpolated and has no mip levels, so that both sample it alike.
    void write_model(const std::string& file, float metallic = 0, float roughness = 0.5f) const {
        const std::string map = contents(folder / "normal.png");
        GltfMaterial material{.name = "baked"};
        material.normal = GltfTexture{0, 0, 1, {10497, 10497, 9729, 9729}};
        material.base_color_factor = Vec4f(0.8f, 0.5f, 0.3f, 1);
        material.metallic = metallic, material.roughness = roughness;
        write_gltf(folder / file,
                   Gltf{mesh, {material}, {{"normal", "image/png", "", {map.begin(), map.end()}}}, {}, {}});
    }

    /// A scene of the file with further lines for [render]. The sky lights it without shadows, and textures are
    /// looked up without mips, as in three.js.
    Scene scene(const std::string& file, const std::string& render) const {
        const auto triple = [](const Vec3f& v) {
            return "[" + std::to_string(v.x) + ", " + std::to_string(v.y) + ", " + std::to_string(v.z) + "]\n";
        };
        write_file(folder / "scene.toml",
                   "[render]\nshadows = false\nbounces = 0\ntexture-filter = \"off\"\nsize = " + std::to_string(size) +
                       "\n" + render + "[camera]\nfov-deg = 35\nposition = " + triple(position) + "target = " +
                       triple(target) + "[sky]\nfaces = \"sky_%s.png\"\n[[mesh]]\nfile = \"" + file + "\"\n");
        return load(read_scene(folder / "scene.toml"));
    }
};

void take_mesh(Baked& baked, const fs::path& file) {
    baked.mesh = read_mesh(file.string());
    baked.mesh.materials = {"baked"};
    baked.mesh.face_material.assign(baked.mesh.faces(), 0);
    baked.mesh.groups.clear(), baked.mesh.face_group.clear();
    if (baked.mesh.tangents.empty()) add_tangents(baked.mesh);
}

void bake_sky(const Baked& baked) {
    const Run run = run_bake(baked.folder, {"cubemap", (own_meshes() / "sky_%s.png").string(), "--yaw", "40", "--size",
                                            "128", "-o", "sky_%s.png"});
    REQUIRE_MESSAGE(run.code == 0, run.err);
}

/// The torus of meshes/ with a map of bricks, under our own sky turned by 40 degrees.
void bake_torus(Baked& baked) {
    const Run run = run_bake(baked.folder, {"normal-map", (own_meshes() / "torus.obj").string(), "--height",
                                            (own_meshes() / "bricks.png").string(), "--amplitude", "0.5%", "--size",
                                            "256", "-o", "normal.png"});
    REQUIRE_MESSAGE(run.code == 0, run.err);
    take_mesh(baked, own_meshes() / "torus.obj");
    bake_sky(baked);
    baked.name = "torus", baked.position = Vec3f(1.2f, 2.6f, 3.8f);
}

/// A mesh of ../shared/data with a normal map of ../shared/data.
void take_real(Baked& baked, const std::string& mesh_file, const std::string& map, const Vec3f& from) {
    fs::copy_file(shared_data() / "meshes" / map, baked.folder / "normal.png");
    take_mesh(baked, shared_data() / "meshes" / mesh_file);
    bake_sky(baked);
    const Bounds box = bounds(baked.mesh);
    baked.name = mesh_file, baked.target = 0.5f * (box.min + box.max);
    baked.position = baked.target + glm::normalize(from) * float(1.5 * diagonal(box));
}

/// Runs scripts/three_viewer; each output has its name as key "file".
std::vector<Image<float>> three(const Baked& baked, const Camera& camera, const json& outputs) {
    const auto triple = [](const Vec3f& v) { return json{v.x, v.y, v.z}; };
    json job = {{"size", {baked.size, baked.size}}, {"outputs", outputs}};
    for (const char* face : {"px", "nx", "py", "ny", "pz", "nz"})
        job["sky"].push_back(std::string("sky_") + face + ".png");
    job["camera"] = {{"position", triple(camera.position)},
                     {"target", triple(camera.target)},
                     {"up", triple(camera.up)},
                     {"fov_deg", camera.fov_deg}};
    write_file(baked.folder / "job.json", job.dump());
    const std::string log = baked.folder / "three.log";
    const int status = std::system(("'" + (source_folder() / "scripts/three_viewer").string() + "' '" +
                                    (baked.folder / "job.json") + "' >'" + log + "' 2>&1")
                                       .c_str());
    REQUIRE_MESSAGE((WIFEXITED(status) && WEXITSTATUS(status) == 0), contents(log));
    CHECK(contents(log) == ""); // three.js and the browser complain of nothing

    std::vector<Image<float>> images;
    for (const json& output : outputs) {
        const std::string bytes = contents(baked.folder / output["file"].get<std::string>());
        images.emplace_back(baked.size, baked.size, 4);
        REQUIRE(bytes.size() == images.back().size() * sizeof(float));
        std::memcpy(images.back().data(), bytes.data(), bytes.size());
    }
    return images;
}

int channel(const char* name) {
    const std::vector<std::string>& all = layer_channels();
    return int(std::find(all.begin(), all.end(), name) - all.begin());
}

/// Whether all pixels within `reach` show the mesh, `hit`, or the sky, and none is across an edge from this one: 2 % of the
/// distance.
bool inside(const Image<float>& layers, int x, int y, int reach, bool hit) {
    const int depth = channel("Z");
    if (x < reach || y < reach || x >= layers.width() - reach || y >= layers.height() - reach) return false;
    const float here = layers.at(x, y, depth);
    for (int j = y - reach; j <= y + reach; ++j)
        for (int i = x - reach; i <= x + reach; ++i)
            if (layers.at(i, j, 3) != float(hit) || std::abs(layers.at(i, j, depth) - here) > 0.02f * here)
                return false;
    return true;
}

struct Angles {
    std::size_t pixels = 0;
    double mean = 0, p99 = 0, most = 0;
};

Angles compare_normals(const Image<float>& ours, const Image<float>& theirs) {
    std::vector<double> all;
    const int n = channel("N.X");
    for (int y = 0; y < ours.height(); ++y)
        for (int x = 0; x < ours.width(); ++x)
            if (inside(ours, x, y, 2, true) && theirs.at(x, y, 3) == 1)
                all.push_back(angle_deg(Vec3f(ours.at(x, y, n), ours.at(x, y, n + 1), ours.at(x, y, n + 2)),
                                        Vec3f(theirs.at(x, y, 0), theirs.at(x, y, 1), theirs.at(x, y, 2))));
    Angles out;
    out.pixels = all.size();
    if (all.empty()) return out;
    std::sort(all.begin(), all.end());
    for (const double a : all) out.mean += a / double(all.size());
    out.p99 = all[all.size() * 99 / 100], out.most = all.back();
    return out;
}

double level(double linear) {
    const double v = std::clamp(linear, 0.0, 1.0);
    return 255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055);
}

struct Levels {
    std::size_t pixels = 0;
    double mean = 0, bias = 0, brightness = 0; ///< in levels of an 8-bit sRGB picture
};

/// Over the pixels of the mesh, or of the sky.
Levels compare_light(const Image<float>& ours, const Image<float>& theirs, bool hit) {
    Levels out;
    for (int y = 0; y < ours.height(); ++y)
        for (int x = 0; x < ours.width(); ++x) {
            if (!inside(ours, x, y, 2, hit)) continue;
            ++out.pixels;
            for (int c = 0; c < 3; ++c) {
                const double a = level(ours.at(x, y, c)), b = level(theirs.at(x, y, c));
                out.mean += std::abs(a - b) / 3, out.bias += (b - a) / 3, out.brightness += a / 3;
            }
        }
    if (out.pixels == 0) return out;
    out.mean /= double(out.pixels), out.bias /= double(out.pixels), out.brightness /= double(out.pixels);
    return out;
}

void check_normals(const Baked& baked) {
    baked.write_model("model.glb");
    const Scene scene = baked.scene("model.glb", "spp = 1\n");
    const Image<float> ours = render_layers(scene, scene.settings);
    const auto theirs = three(baked, scene.camera,
                              json::array({{{"what", "normals"}, {"file", "normals.f32"}, {"model", "model.glb"}}}));
    const Angles found = compare_normals(ours, theirs[0]);
    MESSAGE(baked.name << ": normals differ by " << found.mean << " degrees on average, 99 % by less than " << found.p99
                       << ", at most " << found.most << ", at " << found.pixels << " pixels");
    CHECK(found.pixels > 10000);
    CHECK(found.mean < 0.5);
    CHECK(found.p99 < 2);
}

} // namespace

TEST_SUITE("cli" * doctest::skip(no_browser())) {

    TEST_CASE("three.js: shading normals of a baked torus") {
        Baked baked;
        bake_torus(baked);
        baked.size = 512;
        check_normals(baked);
    }

    TEST_CASE("three.js: the sky behind a baked torus, and its light in metal and plastic at three roughnesses") {
        Baked baked;
        bake_torus(baked);
        baked.size = 96;
        json outputs = json::array();
        for (const float metallic : {0.f, 1.f})
            for (const float roughness : {0.2f, 0.5f, 0.8f}) {
                const std::string name = std::to_string(outputs.size());
                baked.write_model(name + ".glb", metallic, roughness);
                outputs.push_back({{"what", "radiance"},
                                   {"model", name + ".glb"},
                                   {"file", name + ".f32"},
                                   {"samples", 4},
                                   {"background", true}});
            }
        const auto theirs = three(baked, baked.scene("0.glb", "").camera, outputs);
        for (std::size_t i = 0; i < theirs.size(); ++i)
            for (const bool sampled : {true, false}) {
                // three.js has no light from below the facets cut off, nor has our light of filtered levels.
                const std::string light = sampled ? "spp = 128" : "spp = 16\nsky-light = \"irradiance\"";
                const Scene scene = baked.scene(outputs[i]["model"], light + "\n");
                const Image<float> ours = render_layers(scene, scene.settings);
                const Levels mesh = compare_light(ours, theirs[i], true), sky = compare_light(ours, theirs[i], false);
                MESSAGE(std::string(i < 3 ? "plastic" : "metal")
                        << " of roughness " << 0.2 + 0.3 * double(i % 3)
                        << std::string(sampled ? ", sampled" : ", filtered levels") << ": differs by " << mesh.mean
                        << " of 255 at " << mesh.pixels << " pixels, three.js is brighter by " << mesh.bias << " than "
                        << mesh.brightness << "; sky: " << sky.mean);
                CHECK(mesh.pixels > 1500);
                CHECK(mesh.mean < (sampled ? 4 : 2));
                CHECK(mesh.brightness > 40);
                CHECK(sky.pixels > 1500);
                CHECK(sky.mean < 0.1);
                if (i % 3 != 0) break; // the levels of the sky take a second
            }
    }
}

TEST_SUITE("real" * doctest::skip(no_shared_data() || no_browser())) {

    TEST_CASE("three.js: shading normals of a boombox and of tiles with mirrored uvs") {
        Baked boombox, tiles;
        take_real(boombox, "materialx/boombox.glb", "materialx/BoomBox_normal.png", {-1, 0.6f, 2});
        take_real(tiles, "gltf/NormalTangentTest.glb", "gltf/NormalTangentTest_image2.png", {0.1f, 0.1f, 1});
        for (Baked* baked : {&boombox, &tiles}) {
            baked->size = 512;
            check_normals(*baked);
        }
    }
}
