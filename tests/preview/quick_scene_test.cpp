#include "bake/base/error.h"
#include "bake/picture/image_io.h"
#include "bake/preview/map_kind.h"
#include "bake/preview/quick_scene.h"
#include "cli/command.h"
#include "preview/little_scenes.h"
#include <algorithm>
#include <doctest/doctest.h>

using namespace bake;
using bake::test::Folder;

namespace {

Image<float> picture(int channels, const std::function<float(int, int, int)>& value) {
    Image<float> image(16, 16, channels);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x)
            for (int c = 0; c < channels; ++c) image.at(x, y, c) = value(x, y, c);
    return image;
}

/// Waves of height, 8 bits.
std::string write_height(const Folder& folder) {
    const std::string file = folder / "height.png";
    write_image(file, picture(1, [](int x, int y, int) { return float((x * 3 + y * 5) % 16) / 15; }),
                {.depth = Depth::u8});
    return file;
}

std::string write_normals(const Folder& folder) {
    const std::string file = folder / "normals.png";
    const auto value = [](int x, int y, int c) {
        const Vec3f n = glm::normalize(Vec3f(0.4f * std::sin(float(x)), 0.4f * std::cos(float(y)), 1));
        return 0.5f * n[c] + 0.5f;
    };
    write_image(file, picture(3, value), {.depth = Depth::u8});
    return file;
}

std::string write_slopes(const Folder& folder) {
    const std::string file = folder / "slopes.exr";
    write_image(file, picture(2, [](int x, int y, int c) { return 0.1f * float(c == 0 ? x % 4 : y % 3); }),
                {.depth = Depth::float32, .channels = {"b_u", "b_v"}});
    return file;
}

std::string write_colours(const Folder& folder) {
    const std::string file = folder / "colours.png";
    write_image(file, picture(3, [](int x, int y, int c) { return float((x * (c + 1) + y * 7) % 16) / 15; }),
                {.depth = Depth::u8});
    return file;
}

MapKind guess(const std::string& file) {
    ImageInfo info;
    const Image<float> image = read_image(file, &info);
    return guess_map_kind(image, info);
}

std::string refusal_of(const std::function<void()>& work, Refusal why = Refusal::usage) {
    try {
        work();
    } catch (const Error& error) {
        CHECK_MESSAGE(error.refusal == why, error.what());
        return error.what();
    }
    FAIL("not refused");
    return "";
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("material_of: numbers, colours, words and files; a later value replaces an earlier one") {
        const MaterialEntry m = material_of("diffuse=.5,specular=0.1:0.2:0.3,shininess=40,reflect=#ff8000,"
                                            "normal=maps/n.png,directx=true,encoding=unorm,repeat=4:2,diffuse=.25");
        CHECK(m.reflectance.diffuse == Vec3f(0.25f));
        CHECK(m.reflectance.specular == Vec3f(0.1f, 0.2f, 0.3f));
        CHECK(m.reflectance.shininess == 40);
        CHECK(m.reflect.x == 1);
        CHECK(m.reflect.y == doctest::Approx(0.2158605).epsilon(1e-5)); // 128 / 255 by IEC 61966-2-1
        CHECK(m.reflect.z == 0);
        CHECK(m.normal_map == "maps/n.png");
        CHECK(m.directx);
        CHECK(m.encoding == NormalEncoding::unorm);
        CHECK(m.repeat == Vec2f(4, 2));
        CHECK(m.line == 0);
    }

    TEST_CASE("material_of: values replace the defaults, and what neither gives is that of a [[material]]") {
        const MaterialEntry m = material_of("specular=0", "specular=.5,shininess=9");
        CHECK(m.reflectance.specular == Vec3f(0));
        CHECK(m.reflectance.shininess == 9);
        CHECK(m.reflectance.diffuse == Reflectance{}.diffuse);
    }

    TEST_CASE("guess_map_kind: by channels and values") {
        const Folder folder;
        CHECK(guess(write_height(folder)) == MapKind::height);
        CHECK(guess(write_normals(folder)) == MapKind::normal);
        CHECK(guess(write_slopes(folder)) == MapKind::bump);
        CHECK(guess(write_colours(folder)) == MapKind::colour);
    }

    TEST_CASE("quick_scene: a map is taken for what it looks like, or for what is asked") {
        const Folder folder;
        std::vector<std::string> notes;
        const auto material = [&](const std::string& map, MapKind as = MapKind::automatic) {
            return quick_scene({.map = map, .shape = "cube", .as = as}, notes).materials.at(0);
        };
        const std::string normals = write_normals(folder), colours = write_colours(folder);
        CHECK(material(normals).normal_map == normals);
        CHECK(material(colours).albedo == colours);
        CHECK(material(colours, MapKind::normal).normal_map == colours);
        CHECK(material(write_slopes(folder)).bump_table == folder / "slopes.exr");
        CHECK(!material(normals, MapKind::height).relief.file.empty());
        CHECK(notes.size() == 4); // three guesses and an amplitude
    }

    TEST_CASE("quick_scene: a height becomes a relief of 2 % of the shape's diagonal, times bump-scale") {
        const Folder folder;
        const std::string file = write_height(folder);
        std::vector<std::string> notes;
        const SceneEntries entries = quick_scene({.map = file, .shape = "cube:a=2", .material = "bump-scale=3"}, notes);
        const ReliefEntry& relief = entries.materials.at(0).relief;
        CHECK(relief.file == file);
        CHECK(relief.relative);
        CHECK(relief.amplitude.value() == doctest::Approx(0.06));
        CHECK(notes.back().find(": the amplitude is 0.208, 6 %") != std::string::npos); // of sqrt 12
    }

    TEST_CASE("quick_scene: a height takes the method that --material names, displacement too") {
        const Folder folder;
        std::vector<std::string> notes;
        const SceneEntries entries =
            quick_scene({.map = write_height(folder), .shape = "plane", .material = "shade=displace:4"}, notes);
        const Scene scene = load(entries);
        const Scene plain = load(quick_scene({.map = write_height(folder), .shape = "plane"}, notes));
        CHECK(scene.bvh->triangle_count() == 16 * plain.bvh->triangle_count());
    }

    TEST_CASE("quick_scene: every shape is lit, in the picture, and its plane faces the camera") {
        const Folder folder;
        const std::string map = write_normals(folder);
        for (const char* shape : {"sphere", "plane", "cube", "torus", "saddle"}) {
            CAPTURE(shape);
            std::vector<std::string> notes;
            const Scene scene = load(quick_scene({.map = map, .shape = shape}, notes));
            CHECK(scene.lights.size() == 3);
            const Vec3f background = test::seen_at(scene, 0.5, 0.5);
            CHECK(background == scene.sky.background);
            int lit = 0;
            for (int y = 0; y < 64; y += 4)
                for (int x = 0; x < 64; x += 4) {
                    const Vec3f seen = test::seen_at(scene, x + 0.5, y + 0.5);
                    lit += seen != background && seen.x + seen.y + seen.z > 0.3f;
                }
            CHECK(lit > 25); // of 256
        }
    }

    TEST_CASE("set_sky: labels is the built-in sky, anything else a file that replaces the scene's") {
        SceneEntries entries;
        entries.sky.scale = 3;
        set_sky(entries, "sky_%s.png");
        CHECK(entries.sky.image == "sky_%s.png");
        CHECK(entries.sky.scale == 1);
        CHECK(!entries.labels);
        set_sky(entries, "labels");
        CHECK(entries.sky.image.empty());
        const Scene scene = load(entries);
        CHECK(!scene.sky.cube.empty());
    }

} // TEST_SUITE
TEST_SUITE("stability") {

    TEST_CASE("material_of: a wrong text is a usage error with the text and the nearest key") {
        const auto refused = [](const std::string& text) {
            const std::string message = refusal_of([&] { material_of(text); });
            CHECK_MESSAGE(message.rfind("`material` " + text + ": ", 0) == 0, message);
            return message;
        };
        CHECK(has(refused("difuse=1"), "did you mean \"diffuse\"?"));
        CHECK(has(refused("diffuse"), "KEY=VALUE"));
        CHECK(has(refused("diffuse="), "KEY=VALUE"));
        CHECK(has(refused("diffuse=1,"), "KEY=VALUE"));
        CHECK(has(refused("diffuse=#12345g"), "\"diffuse\""));
        CHECK(has(refused("diffuse=1:2"), "\"diffuse\" is not a list of 3 numbers; join them by colons"));
        CHECK(has(refused("diffuse=1:2:x"), "\"diffuse\""));
        CHECK(has(refused("diffuse=nan"), "\"diffuse\""));
        CHECK(has(refused("diffuse=-1"), "\"diffuse\""));
        CHECK(has(refused("diffuse=1e99"), "\"diffuse\""));
        CHECK(has(refused("shininess=a"), "\"shininess\""));
        CHECK(has(refused("directx=yes"), "\"directx\""));
        CHECK(has(refused("repeat=0"), "\"repeat\""));
        CHECK(has(refused("repeat=1:2:3"), "\"repeat\""));
        CHECK(has(refused("bump=a.exr,normal=b.png"), "\"normal\""));
        CHECK(has(refused("name=gold"), "name"));
    }

    TEST_CASE("quick_scene: two textures for one place, an unknown shape, a missing map") {
        const Folder folder;
        const std::string map = write_normals(folder);
        std::vector<std::string> notes;
        const auto refused = [&](const QuickScene& quick, Refusal why = Refusal::usage) {
            return refusal_of([&] { load(quick_scene(quick, notes)); }, why);
        };
        CHECK(has(refused({.map = map, .shape = "cube", .material = "bump=t.exr"}), "place of"));
        CHECK(has(refused({.map = map, .shape = "sphare"}), "did you mean \"sphere\"?"));
        CHECK(has(refused({.map = folder / "gone.png", .shape = "cube"}, Refusal::unreadable), "gone.png"));
        const std::string message = refused({.mesh = folder / "gone.obj"}, Refusal::unreadable);
        CHECK(message.rfind(folder / "gone.obj", 0) == 0); // no line of a scene in front
    }

} // TEST_SUITE
