#include "bake/preview/scene_io.h"
#include "preview/gltf_square.h"
#include <doctest/doctest.h>

using namespace bake;
using namespace bake::test;

namespace {

/// A square with the keys of a material, whose textures are t.png.
Scene with(const Folder& folder, const std::string& keys) {
    write_file(folder / "s.gltf", square_gltf("{}"));
    write_file(folder / "scene.toml", "[[light]]\ntype = \"ambient\"\n[[material]]\nname = \"m\"\n" + keys +
                                          "\n[[mesh]]\nfile = \"s.gltf\"\nmaterial = \"m\"\n");
    return load(read_scene(folder / "scene.toml"));
}

Bsdf bsdf_of(const Scene& scene, float x, float y) {
    return bsdf_at(*scene.instances[0].material, *scene.instances[0].shape, point_of_square(x, y));
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("scene maps: roughness, metal, shininess and occlusion are factors, by their channels, as stored") {
        const Folder folder;
        write_texels(folder, 2, 3, [](int x, int, int c) {
            return x == 0 ? 1.f : c == 0 ? 0.2f : c == 1 ? 0.4f : 0.6f;
        });
        const Scene ggx = with(folder, "brdf = \"ggx\"\nroughness = 0.5\nroughness-map = \"t.png\"\n"
                                       "metallic-map = \"t.png\"\ndiffuse = 0.8\nocclusion-map = \"t.png\"");
        CHECK(bsdf_of(ggx, 0.25f, 0.5f).lobes[0].roughness == doctest::Approx(0.5));
        CHECK(bsdf_of(ggx, 0.75f, 0.5f).lobes[0].roughness == doctest::Approx(0.2));
        CHECK(bsdf_of(ggx, 0.75f, 0.5f).lobes[0].weight.x == doctest::Approx(0.04 * 0.4 + 0.8 * 0.6));
        CHECK(bsdf_of(ggx, 0.75f, 0.5f).ambient.x == doctest::Approx(0.8 * 0.2));
        const Scene blinn = with(folder, "specular = 0.5\nshininess = 50\nshininess-map = \"t.png\"");
        CHECK(bsdf_of(blinn, 0.25f, 0.5f).lobes[1].exponent == doctest::Approx(50));
        CHECK(bsdf_of(blinn, 0.75f, 0.5f).lobes[1].exponent == doctest::Approx(10));
    }

    TEST_CASE("scene maps: specular and emission are colours; a value that is not given is 1") {
        const Folder folder;
        write_texels(folder, 2, 3, [](int x, int, int c) { return x == 0 ? 1.f : 0.5f + 0.1f * float(c); });
        const Texture texels = read_albedo(folder / "t.png");
        const Vec3f seen = lookup3(*texels, {0.75f, 0.5f});
        const Scene given =
            with(folder, "specular = 0.5\nspecular-map = \"t.png\"\nemission = 3\nemission-map = \"t.png\"");
        CHECK(glm::length(bsdf_of(given, 0.75f, 0.5f).lobes[1].weight - 0.5f * seen) < 1e-6);
        CHECK(glm::length(bsdf_of(given, 0.75f, 0.5f).emission - 3.f * seen) < 1e-6);
        const Scene bare = with(folder, "specular-map = \"t.png\"\nemission-map = \"t.png\"");
        CHECK(glm::length(bsdf_of(bare, 0.75f, 0.5f).lobes[1].weight - seen) < 1e-6);
        CHECK(glm::length(bsdf_of(bare, 0.75f, 0.5f).emission - seen) < 1e-6);
    }

    TEST_CASE("scene maps: rays pass where the albedo's alpha is below the cutoff") {
        const Folder folder;
        write_texels(folder, 8, 4, [](int x, int, int c) { return c < 3 || x >= 4 ? 1.f : 0.f; });
        const Scene scene = with(folder, "albedo = \"t.png\"\nalpha-cutoff = 0.5");
        CHECK(!scene.bvh->intersect({{0.3f, 0.4f, 1}, {0, 0, -1}}));
        CHECK(scene.bvh->intersect({{0.7f, 0.4f, 1}, {0, 0, -1}}));
    }

} // TEST_SUITE
TEST_SUITE("stability") {

    TEST_CASE("scene maps: those that a material has no use for, and missing alpha, are refused with their line") {
        const Folder folder;
        write_texels(folder, 2, 3, [](int, int, int) { return 0.5f; });
        for (const auto& [keys, line, named] :
             {std::tuple("roughness-map = \"t.png\"", 5, "\"roughness-map\" is of materials with brdf = \"ggx\""),
              std::tuple("brdf = \"ggx\"\nspecular-map = \"t.png\"", 6, "\"specular-map\" is of materials with"),
              std::tuple("alpha-cutoff = 0.5", 5, "\"alpha-cutoff\" needs an \"albedo\""),
              std::tuple("albedo = \"t.png\"\nalpha-cutoff = 0.5", 3, "is opaque"),
              std::tuple("emission-map = \"none.png\"", 3, "none.png")}) {
            CAPTURE(keys);
            try {
                with(folder, keys);
                FAIL("not refused");
            } catch (const Error& error) {
                const std::string message = error.what();
                CHECK_MESSAGE(message.find(folder / "scene.toml:" + std::to_string(line) + ": ") == 0, message);
                CHECK_MESSAGE(message.find(named) != std::string::npos, message);
            }
        }
    }

} // TEST_SUITE
