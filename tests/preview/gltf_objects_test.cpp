#include "bake/mesh/file/mesh_io.h"
#include "bake/preview/gltf_objects.h"
#include "bake/preview/quick_scene.h"
#include "bake/preview/scene_io.h"
#include "preview/gltf_square.h"
#include <cmath>
#include <doctest/doctest.h>

using namespace bake;
using namespace bake::test;

namespace {

/// A white square in two halves of alpha: 0 where x < .5, 1 beyond.
Scene masked(const Folder& folder, const std::string& mode, const std::string& more = "") {
    write_texels(folder, 8, 4, [](int x, int, int c) { return c < 3 || x >= 4 ? 1.f : 0.f; });
    return square_scene(folder, square_gltf(R"({"alphaMode":")" + mode +
                                                R"(","doubleSided":true,)"
                                                R"("pbrMetallicRoughness":{"baseColorTexture":{"index":0})" +
                                                more + "}}",
                                            R"("TEXCOORD_0":1)", texel_texture()));
}

Ray down(float x, float y) { return {{x, y, 1}, {0, 0, -1}}; }
Ray up(float x, float y) { return {{x, y, -1}, {0, 0, 1}}; }

/// Share of 4096 rays that `stopped` holds for.
template <class Stopped> double share(Stopped&& stopped) {
    int count = 0;
    for (int i = 0; i < 64; ++i)
        for (int j = 0; j < 64; ++j) count += stopped(down((float(i) + 0.5f) / 64, (float(j) + 0.25f) / 64)) ? 1 : 0;
    return count / 4096.0;
}

std::string lights(const std::string& list, const std::string& nodes) {
    std::string text =
        square_gltf("{}", R"("TEXCOORD_0":1)", R"(,"extensions":{"KHR_lights_punctual":{"lights":[)" + list + "]}}");
    text = bake_tests::replaced(text, R"("nodes":[{"mesh":0}])", R"("nodes":[{"mesh":0},)" + nodes + "]");
    return bake_tests::replaced(text, R"("nodes":[0])", R"("nodes":[0,1])");
}

const std::string node = R"({"translation":[0.5,0.5,2],"extensions":{"KHR_lights_punctual":{"light":0}}})";

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("glTF alpha mask: rays of sight and of shadow pass where alpha is below the cutoff") {
        const Folder folder;
        const Scene scene = masked(folder, "MASK");
        for (const float y : {0.1f, 0.6f, 0.9f}) {
            CHECK(!scene.bvh->intersect(down(0.3f, y)));
            CHECK(!scene.bvh->occluded(down(0.3f, y)));
            CHECK(scene.bvh->intersect(up(0.7f, y)));
            CHECK(scene.bvh->occluded(up(0.7f, y)));
        }
        // alpha 1 * .4 is below .5.
        CHECK(!masked(folder, "MASK", R"(,"baseColorFactor":[1,1,1,0.4])").bvh->intersect(down(0.7f, 0.5f)));
        CHECK(masked(folder, "OPAQUE").bvh->intersect(down(0.3f, 0.5f)));
    }

    TEST_CASE("glTF alpha: of vertex colours too") {
        const Folder folder;
        const Scene scene = square_scene(
            folder, square_gltf(R"({"alphaMode":"MASK","alphaCutoff":0.75})", R"("COLOR_0":3)")); // alpha 1 - y / 2
        CHECK(scene.bvh->intersect(down(0.5f, 0.48f)));
        CHECK(!scene.bvh->intersect(down(0.5f, 0.52f)));
    }

    TEST_CASE("glTF blend: the share of rays that pass is 1 - alpha, and the same ray always does the same") {
        const Folder folder;
        const Scene scene = masked(folder, "BLEND", R"(,"baseColorFactor":[1,1,1,0.3])");
        const auto hit = [&](const Ray& ray) { return bool(scene.bvh->intersect(ray)); };
        const auto shadow = [&](const Ray& ray) { return scene.bvh->occluded(ray); };
        // The standard deviation is .006 of 2048 rays; none is stopped on the left half.
        CHECK(share(hit) == doctest::Approx(0.15).epsilon(0.1));
        CHECK(share(shadow) == share(hit));
        CHECK(share([&](const Ray& ray) { return hit(ray) != hit(ray); }) == 0);
        // Without anything that is not opaque no filter is needed.
        CHECK(square_scene(folder, square_gltf(R"({"alphaMode":"BLEND"})")).notes.empty());
    }

    TEST_CASE("glTF sides: a surface of one side is not seen from behind, but shadows; mirroring does not matter") {
        const Folder folder;
        for (const float mirror : {1.f, -1.f}) {
            CAPTURE(mirror);
            for (const bool both : {false, true}) {
                SceneEntries entries = square_entries(folder, square_gltf(both ? R"({"doubleSided":true})" : "{}"));
                entries.meshes[0].placement.scale.x = mirror;
                const Scene scene = load(entries);
                const float x = 0.4f * mirror;
                CHECK(scene.bvh->intersect(down(x, 0.7f)));
                CHECK(bool(scene.bvh->intersect(up(x, 0.7f))) == both);
                CHECK(scene.bvh->occluded(up(x, 0.7f)));
            }
        }
    }

    TEST_CASE("glTF with several materials: each part has its own; faces without one are the format's default") {
        const Folder folder;
        Gltf gltf;
        gltf.mesh = bake_tests::rich_triangles(4, 2);
        gltf.mesh.face_material.back() = no_index;
        gltf.materials = {{.name = "brick"}, {.name = "plaster"}};
        gltf.materials[0].base_color_factor = Vec4f(0.1f, 0.2f, 0.3f, 1);
        gltf.materials[1].base_color_factor = Vec4f(0.6f, 0.5f, 0.4f, 1);
        gltf.materials[1].metallic = 0;
        gltf.nodes = {{.name = "n", .first_face = 0, .end_face = gltf.mesh.faces()}};
        write_gltf(folder / "two.glb", gltf);
        SceneEntries entries;
        entries.meshes.push_back({.file = folder / "two.glb"});
        const Scene scene = load(entries);
        REQUIRE(scene.instances.size() == 3);
        CHECK(scene.instances[0].material->name == "brick");
        CHECK(scene.instances[0].material->reflectance.diffuse == Vec3f(0.1f, 0.2f, 0.3f));
        CHECK(scene.instances[1].material->reflectance.metallic == 0);
        CHECK(scene.instances[2].material->reflectance.metallic == 1);
        CHECK(scene.instances[2].material->reflectance.diffuse == Vec3f(1));
        std::size_t faces = 0;
        for (const Instance& part : scene.instances) faces += part.shape->mesh.faces();
        CHECK(faces == gltf.mesh.faces());
        CHECK(scene.instances[2].shape->mesh.faces() == 1);
    }

    TEST_CASE("glTF in a scene: the material of the object replaces those of the file, also of an instance") {
        const Folder folder;
        write_file(folder / "s.gltf", square_gltf(R"({"pbrMetallicRoughness":{"baseColorFactor":[0.2,0.4,0.6,1]}})"));
        write_file(folder / "scene.toml", R"(
[[light]]
type = "ambient"
[[material]]
name = "red"
diffuse = [0.7, 0, 0]
[[mesh]]
file = "s.gltf"
name = "own"
[[instance]]
mesh = "own"
translate = [2, 0, 0]
[[instance]]
mesh = "own"
material = "red"
[[mesh]]
file = "s.gltf"
material = "red"
)");
        const Scene scene = load(read_scene(folder / "scene.toml"));
        REQUIRE(scene.instances.size() == 4);
        CHECK(scene.instances[0].material->reflectance.diffuse == Vec3f(0.2f, 0.4f, 0.6f));
        // The meshes of the file come first, then its instances.
        CHECK(scene.instances[2].material == scene.instances[0].material);
        CHECK(scene.instances[2].shape == scene.instances[0].shape);
        for (const std::size_t i : {1, 3}) CHECK(scene.instances[i].material->name == "red");
        std::vector<std::string> notes;
        const auto shown = [&](const std::string& material) {
            return load(quick_scene({.mesh = folder / "s.gltf", .material = material}, notes));
        };
        CHECK(shown("").instances[0].material->reflectance.diffuse == Vec3f(0.2f, 0.4f, 0.6f));
        CHECK(shown("diffuse=.5").instances[0].material->reflectance.diffuse == Vec3f(0.5f));
    }

    TEST_CASE("glTF without materials: as any other mesh") {
        const Folder folder;
        Mesh mesh = bake_tests::rich_triangles(2, 2);
        mesh.materials.clear(), mesh.face_material.clear();
        write_mesh(folder / "a.glb", mesh);
        std::vector<std::string> notes;
        const Scene scene = load(quick_scene({.mesh = folder / "a.glb"}, notes));
        REQUIRE(scene.instances.size() == 1);
        CHECK(scene.instances[0].material->reflectance.specular == Vec3f(0.25f));
    }

    TEST_CASE(
        "glTF lights: a point light of I candela gives I / r^2, a directional one its lux, a spot light in its cone") {
        const Folder folder;
        const auto irradiance = [&](const std::string& light, const Vec3f& p, float scale = 1) {
            SceneEntries entries = square_entries(folder, lights(light, node));
            entries.any_light = false;
            entries.meshes[0].placement.scale = Vec3f(scale);
            const Scene scene = load(entries);
            REQUIRE(scene.lights.size() == 1); // no default light
            return double(sample(scene.lights[0], p).radiance.y) * pi;
        };
        const Vec3f below(0.5f, 0.5f, 0), aside(1.5f, 0.5f, 1);
        CHECK(irradiance(R"({"type":"point","intensity":40,"color":[0,0.5,1]})", below) == doctest::Approx(5));
        CHECK(irradiance(R"({"type":"point","intensity":40,"color":[0,0.5,1]})", aside) == doctest::Approx(10));
        // At twice the size the light is twice as high, and as bright as it was.
        CHECK(irradiance(R"({"type":"point","intensity":64})", {1, 1, 0}, 2) == doctest::Approx(4));
        CHECK(irradiance(R"({"type":"directional","intensity":3})", aside) == doctest::Approx(3));
        CHECK(irradiance(R"({"type":"spot","intensity":40,"spot":{"outerConeAngle":0.7}})", below) ==
              doctest::Approx(10));
        CHECK(irradiance(R"({"type":"spot","intensity":40,"spot":{"outerConeAngle":0.7}})", aside) == 0);
        // Khronos: max(min(1 - (r / range)^4, 1), 0) / r^2
        CHECK(irradiance(R"({"type":"point","intensity":40,"range":4})", below) == doctest::Approx(10 * 15.0 / 16));
        CHECK(irradiance(R"({"type":"point","intensity":40,"range":1.5})", below) == 0);
    }

    TEST_CASE("glTF lights: a Lambert surface below a point light has the radiance albedo / pi * I / r^2") {
        const Folder folder;
        std::string text = lights(R"({"type":"point","intensity":40})", node);
        SceneEntries entries = square_entries(folder, text);
        entries.ambient = Vec3f(0), entries.any_light = false;
        entries.materials = {{.name = "lambert"}};
        entries.materials[0].reflectance.diffuse = Vec3f(0.5f);
        entries.meshes[0].material = 0, entries.meshes[0].own_materials = false;
        CHECK(double(at_point(load(entries), 0.5, 0.5).x) == doctest::Approx(0.5 / pi * 10).epsilon(1e-4));
        entries.meshes[0].lights = false;
        entries.any_light = true;
        CHECK(at_point(load(entries), 0.5, 0.5) == Vec3f(0));
    }

} // TEST_SUITE
TEST_SUITE("oracle") {

    TEST_CASE("glTF tangents: those of the file are used, and where they are MikkTSpace's nothing changes") {
        const Folder folder;
        write_texels(folder, 4, 3, [](int x, int y, int c) { return c == 2 ? 0.9f : 0.4f + 0.05f * float(x + y * c); });
        Gltf gltf;
        gltf.mesh = bake_tests::rich_triangles(4, 2);
        gltf.mesh.face_material.assign(gltf.mesh.faces(), 0);
        gltf.materials = {{.name = "brick", .normal = GltfTexture{0, 0, 1, {}}}};
        gltf.images = {{.uri = "t.png"}};
        gltf.images[0].bytes.assign(3, 0); // replaced below
        const std::string png = contents(folder / "t.png");
        gltf.images[0] = {.name = "t", .mime_type = "image/png", .bytes = {png.begin(), png.end()}};
        gltf.nodes = {{.name = "n", .first_face = 0, .end_face = gltf.mesh.faces()}};
        SceneEntries entries;
        entries.meshes.push_back({.file = folder / "a.glb"});
        const auto shape = [&] {
            write_gltf(folder / "a.glb", gltf);
            Scene scene = load(entries);
            REQUIRE(scene.instances.size() == 1);
            return std::move(scene.shapes[0]);
        };
        const std::vector<Vec4f> from_file = shape()->tangents;
        REQUIRE(from_file.size() == gltf.mesh.corners());
        CHECK(from_file[0] == gltf.mesh.tangents[0]);
        gltf.mesh.tangents.clear();
        const auto computed = shape();
        REQUIRE(computed->tangents.size() == gltf.mesh.corners());
        gltf.mesh.tangents = computed->tangents;
        const std::vector<Vec4f> again = shape()->tangents;
        double largest = 0;
        for (std::size_t c = 0; c < again.size(); ++c)
            largest = std::max(largest, double(glm::length(again[c] - computed->tangents[c])));
        CHECK(largest < 1e-6);
    }

} // TEST_SUITE
