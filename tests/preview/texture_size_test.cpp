// Textures of fewer texels.
#include "bake/base/error.h"
#include "bake/preview/scene_io.h"
#include "bake/preview/texture_size.h"
#include "preview/gltf_square.h"
#include <doctest/doctest.h>

using namespace bake;
using namespace bake::test;

namespace {

Texture ramp(int width, int height) {
    Image<float> image(width, height, 3);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            image.at(x, y, 0) = float(x), image.at(x, y, 1) = float(y), image.at(x, y, 2) = 1;
    return std::make_shared<const Image<float>>(std::move(image));
}

SceneEntries entries(const std::string& keys) {
    const Folder folder;
    write_file(folder / "s.toml", "[[material]]\nname = \"m\"\n" + keys + "\n");
    return read_scene(folder / "s.toml");
}

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("texture size: halved until no edge is longer than asked for") {
        const Texture source = ramp(12, 4);
        CHECK(halved_to(source, 0) == source);
        CHECK(halved_to(source, 12) == source);
        CHECK_FALSE(halved_to({}, 4));
        const Texture six = halved_to(source, 11), three = halved_to(source, 3);
        CHECK(six->width() == 6);
        CHECK(six->height() == 2);
        CHECK(six->at(1, 1, 0) == doctest::Approx(2.5));
        CHECK(six->at(1, 1, 1) == doctest::Approx(2.5));
        CHECK(three->width() == 3);
        CHECK(three->height() == 1);
        CHECK(three->at(2, 0, 0) == doctest::Approx(9.5));
        CHECK(halved_to(source, 1)->size() == 3);
    }

    TEST_CASE("texture size: averaged vectors are unit vectors, others stay") {
        Image<float> image(2, 1, 3);
        const float values[] = {0.8f, 0, 0.6f, -0.8f, 0, 0.6f};
        std::copy_n(values, 6, image.data());
        const Texture source(std::make_shared<const Image<float>>(std::move(image)));
        CHECK(normals_halved_to(source, 2) == source);
        const Texture one = normals_halved_to(source, 1);
        REQUIRE(one->size() == 3);
        CHECK(one->at(0, 0, 0) == doctest::Approx(0));
        CHECK(one->at(0, 0, 2) == doctest::Approx(1));
    }

    TEST_CASE("texture size: keys of a material reduce files and what is baked") {
        const Folder folder;
        write_texels(folder, 8, 3, [](int x, int, int c) { return c == 2 ? 1.f : float(x % 2); });
        const auto material = [&](const std::string& keys) {
            write_file(folder / "s.gltf", square_gltf("{}"));
            write_file(folder / "scene.toml", "[[light]]\ntype = \"ambient\"\n[[material]]\nname = \"m\"\n" + keys +
                                                  "\n[[mesh]]\nfile = \"s.gltf\"\nmaterial = \"m\"\n");
            const Scene scene = load(read_scene(folder / "scene.toml"));
            return *scene.instances[0].material;
        };
        const Material files = material("albedo = \"t.png\"\nalbedo-size = 4\nnormal = \"t.png\"\nrelief-size = 2\n"
                                        "emission-map = \"t.png\"");
        CHECK(files.albedo->width() == 4);
        CHECK(files.normal_map->width() == 2);
        CHECK(files.maps->emission.texture->width() == 8);
        CHECK(material("height = \"t.png\"\nshade = \"normal\"\nrelief-size = 4").normal_map->width() == 4);
        CHECK(material("height = \"t.png\"\nshade = \"bump\"\nrelief-size = 4").bump_table->width() == 4);
        CHECK(material("height = \"t.png\"\nshade = \"bump\"").bump_table->width() == 8);
    }

    TEST_CASE("texture size: \"normal-depth\" shows files and what is baked as their blocks, halved first") {
        const Folder folder;
        write_texels(folder, 8, 3, [](int x, int y, int c) { return c == 2 ? 1.f : 0.1f * float(x * (y + c) % 7); });
        const auto normals = [&](const std::string& keys) {
            write_file(folder / "s.gltf", square_gltf("{}"));
            write_file(folder / "scene.toml", "[[light]]\ntype = \"ambient\"\n[[material]]\nname = \"m\"\n" + keys +
                                                  "\n[[mesh]]\nfile = \"s.gltf\"\nmaterial = \"m\"\n");
            return load(read_scene(folder / "scene.toml")).instances[0].material->normal_map;
        };
        for (const std::string source : {"normal = \"t.png\"\n", "height = \"t.png\"\nshade = \"normal\"\n"}) {
            const Texture small = normals(source + "relief-size = 4"),
                          blocks = normals(source + "relief-size = 4\nnormal-depth = \"bc5\""),
                          expected = normals_in_bc5(small);
            CHECK(!std::equal(small->data(), small->data() + small->size(), blocks->data()));
            REQUIRE(blocks->size() == expected->size());
            CHECK(std::equal(blocks->data(), blocks->data() + blocks->size(), expected->data()));
            const Texture plain = normals(source + "relief-size = 4\nnormal-depth = \"float\"");
            CHECK(std::equal(small->data(), small->data() + small->size(), plain->data()));
        }
        CHECK(normals_in_bc5({}) == Texture());
        CHECK_THROWS_WITH_AS(entries("normal-depth = \"dxt5\""),
                             doctest::Contains(":3: [[material]] \"normal-depth\" is \"dxt5\""), Error);
    }

    TEST_CASE("texture size: sizes that are none are refused with their line") {
        CHECK(entries("albedo-size = 64").materials[0].albedo_size == 64);
        CHECK_THROWS_WITH_AS(entries("albedo-size = 0"),
                             doctest::Contains(":3: [[material]] \"albedo-size\" is 0, outside 1 to"), Error);
        CHECK_THROWS_WITH_AS(entries("relief-size = \"64\""),
                             doctest::Contains(":3: [[material]] \"relief-size\" is not a whole number"), Error);
    }
}
