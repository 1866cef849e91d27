#include "bake/base/error.h"
#include "bake/mesh/file/mesh_io.h"
#include "bake/picture/image_io.h"
#include "bake/preview/scene_camera.h"
#include "bake/preview/scene_io.h"
#include "cli/command.h"
#include "preview/little_scenes.h"
#include <cmath>
#include <doctest/doctest.h>

using namespace bake;
using bake::test::Folder;
using bake::test::seen_at;

namespace {

SceneEntries read(const Folder& folder, const std::string& text) {
    test::write_file(folder / "scene.toml", text);
    return read_scene(folder / "scene.toml");
}

void check_refused_at(int line, const std::string& named, const std::string& text, bool loaded = false) {
    const Folder folder;
    const std::string head = folder / "scene.toml:" + std::to_string(line) + ": ";
    try {
        const SceneEntries entries = read(folder, text);
        if (loaded) load(entries);
        FAIL("not refused: " << text);
    } catch (const Error& error) {
        const std::string message = error.what();
        CHECK_MESSAGE(error.refusal == Refusal::unreadable, message);
        CHECK_MESSAGE(message.rfind(head, 0) == 0, message);
        CHECK_MESSAGE(message.find(named) != std::string::npos, message);
    }
}

/// Stripes along u: dark and bright, `count` of each.
void write_stripes(const std::string& file, int count) {
    Image<float> image(64, 64, 1);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) image.at(x, y) = float((x * 2 * count / 64) % 2);
    write_image(file, image, {.depth = Depth::u8});
}

std::vector<Vec3f> look(const Scene& scene) {
    std::vector<Vec3f> seen;
    for (int y = 1; y < 64; y += 3)
        for (int x = 1; x < 64; x += 3) seen.push_back(seen_at(scene, x + 0.37, y + 0.61));
    return seen;
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("scene: a shape is the mesh that is tessellated for it, and a file of a shape is beside the scene") {
        const Folder folder;
        const SceneEntries entries = read(folder, R"(mesh = [{shape = "torus:R=2,r=0.5"},
            {shape = "sphere", segments = [12, 6]}, {shape = "cube", segments = 3},
            {shape = "revolution:profile=vase.txt", segments = [8, 4]}])");
        CHECK(entries.meshes.at(3).shape == "revolution:profile=" + folder / "vase.txt");
        test::write_file(folder / "vase.txt", "1 0\n0.6 1\n0.8 2\n");
        const Scene scene = load(entries);
        REQUIRE(scene.shapes.size() == 4);
        CHECK(scene.shapes[0]->mesh.faces() == 96 * 48);
        CHECK(scene.shapes[1]->mesh.faces() == 12 * 6);
        CHECK(scene.shapes[2]->mesh.faces() == 6 * 9);
        CHECK(scene.shapes[3]->mesh.faces() == 8 * 4);
        CHECK(bounds(scene.shapes[0]->mesh).max.x == doctest::Approx(2.5));
    }

    TEST_CASE(
        "scene: an instance shares the shape of its mesh, with its own placement and its own or the same material") {
        const Folder folder;
        const Scene scene = load(read(folder, R"(
material = [{name = "red", diffuse = [1, 0, 0]}, {name = "blue", diffuse = [0, 0, 1]}]
mesh = [{name = "ball", shape = "sphere", material = "red", translate = [5, 0, 0], scale = 3}]
instance = [{mesh = "ball", translate = [0, 2, 0]}, {mesh = "ball", material = "blue", scale = 2}])"));
        CHECK(scene.shapes.size() == 1);
        REQUIRE(scene.instances.size() == 3);
        CHECK(scene.instances[1].translate == Vec3f(0, 2, 0));
        CHECK(scene.instances[1].linear == glm::mat3(1));
        CHECK(scene.instances[1].material->name == "red");
        CHECK(scene.instances[2].material->name == "blue");
        CHECK(scene.instances[2].linear == glm::mat3(2));
    }

    TEST_CASE("scene: the ground lies just below the meshes or at its height, and does not move the camera") {
        const Folder folder;
        const std::string ball = "mesh = [{shape = \"sphere:R=2\", translate = [1, 5, 0]}]\n";
        const Scene without = load(read(folder, ball));
        const Scene with = load(read(folder, ball + "[ground]\n"));
        CHECK(with.camera.position == without.camera.position);
        REQUIRE(with.instances.size() == 2);
        const double diagonal = 4 * std::sqrt(3.0);
        CHECK(with.instances[1].translate.y < 3);
        CHECK(with.instances[1].translate.y > 3 - 1e-3);
        CHECK(with.instances[1].linear[0].x == doctest::Approx(20 * diagonal));
        // It faces up: the light from above reaches it.
        const Scene floor = load(read(folder, R"(light = [{type = "directional", from = [0, 1, 0]}]
camera = {position = [0, 5, 0.1], target = [0, 0, 0]}
[ground]
height = -2
size = 8
)"));
        CHECK(floor.instances.at(0).translate == Vec3f(0, -2, 0));
        CHECK(bounds(floor).max.x == 4);
        CHECK(seen_at(floor, 32, 32).x == doctest::Approx(0.8).epsilon(1e-5));
    }

    TEST_CASE("scene: repeat of a material, of a mesh, or of the picture itself look the same; the factors multiply") {
        const Folder folder;
        write_stripes(folder / "one.png", 1);
        write_stripes(folder / "four.png", 4);
        const auto seen = [&](const std::string& material, const std::string& mesh) {
            return look(load(read(folder, R"(light = [{type = "ambient"}]
camera = {position = [0, 5, 0.1], target = [0, 0, 0], fov-deg = 12}
mesh = [{shape = "plane", material = "m")" + mesh +
                                              "}]\nmaterial = [{name = \"m\", " + material + "}]\n")));
        };
        const std::vector<Vec3f> four = seen("albedo = \"four.png\"", "");
        const auto off = [&](const std::vector<Vec3f>& other) {
            int count = 0; // where a texel's border is filtered over another width
            for (std::size_t i = 0; i < four.size(); ++i) count += glm::length(four[i] - other[i]) > 0.02f;
            return double(count) / double(four.size());
        };
        CHECK(off(seen("albedo = \"one.png\"", "")) > 0.4);
        CHECK(off(seen("albedo = \"one.png\", repeat = 4", "")) < 0.15);
        CHECK(off(seen("albedo = \"one.png\", repeat = [4, 1]", "")) < 0.15);
        CHECK(off(seen("albedo = \"one.png\"", ", repeat = [4, 1]")) < 0.15);
        CHECK(off(seen("albedo = \"one.png\", repeat = [2, 1]", ", repeat = 2")) < 0.15);
    }

    TEST_CASE("scene: a repeated bump table keeps its amplitude, so that its slopes on the surface are as many times "
              "steeper") {
        const Folder folder;
        Image<float> table(1, 1, 2);
        table.at(0, 0, 0) = 0.05f, table.at(0, 0, 1) = 0;
        write_image(folder / "slope.exr", table, {.depth = Depth::float32, .channels = {"b_u", "b_v"}});
        const auto brightness = [&](const std::string& repeat) {
            const Scene scene = load(read(folder, R"(light = [{type = "directional", from = [0, 1, 0]}]
camera = {position = [0, 5, 0.1], target = [0, 0, 0]}
mesh = [{shape = "plane", material = "m"}]
material = [{name = "m", diffuse = 1, bump = "slope.exr", repeat = )" +
                                                      repeat + "}]\n"));
            return double(seen_at(scene, 32, 32).x);
        };
        // The slope s tilts the normal so that n.l = 1 / sqrt(1 + s^2).
        for (const int repeat : {1, 3, 10})
            CHECK(brightness(std::to_string(repeat)) ==
                  doctest::Approx(1 / std::sqrt(1 + std::pow(0.05 * repeat, 2))).epsilon(1e-5));
    }

    TEST_CASE("scene: several cameras; the first is taken, an orthographic one has its height") {
        const Folder folder;
        SceneEntries entries = read(folder, R"(mesh = [{shape = "sphere"}]
light = [{type = "ambient"}]
[[camera]]
name = "front"
position = [0, 0, 9]
target = [0, 0, 0]
[[camera]]
name = "plan"
type = "orthographic"
position = [0, 9, 0]
target = [0, 0, 0]
height = 6
)");
        REQUIRE(entries.cameras.size() == 2);
        CHECK(load(entries).camera.position == Vec3f(0, 0, 9));
        CHECK(read_camera(folder / "scene.toml").frame.position == Vec3f(0, 0, 9));
        entries.camera = 1;
        const Scene scene = load(entries);
        CHECK(scene.camera.orthographic);
        // The ball of radius 1 covers a disc of radius 64 / 6 pixels.
        for (const double r : {0.0, 10.3})
            for (const double turn : {0.0, 1.0, 2.0, 3.0, 4.0, 5.0})
                CHECK(seen_at(scene, 32 + r * std::cos(turn), 32 + r * std::sin(turn)) != Vec3f(0));
        for (const double turn : {0.0, 1.0, 2.0, 3.0, 4.0, 5.0})
            CHECK(seen_at(scene, 32 + 10.8 * std::cos(turn), 32 + 10.8 * std::sin(turn)) == Vec3f(0));
    }

} // TEST_SUITE
TEST_SUITE("stability") {

    TEST_CASE("scene: a mistyped key, material, mesh or table is refused with its line and the nearest name") {
        check_refused_at(2, "unknown key \"pozition\" in [camera]; did you mean \"position\"?",
                         "[camera]\npozition = [0, 0, 1]\n");
        check_refused_at(1, "did you mean \"light\"?", "[lights]\n");
        check_refused_at(2, "known are", "[ground]\nbrightness = 3\n");
        check_refused_at(4, "did you mean \"gold\"?", "[[material]]\nname = \"gold\"\n[ground]\nmaterial = \"golt\"\n");
        check_refused_at(3, "did you mean \"gold\"?",
                         "material = [{name = \"gold\"}]\n[[mesh]]\nmaterial = \"glod\"\nshape = \"cube\"\n");
        check_refused_at(3, "did you mean \"ball\"?",
                         "mesh = [{name = \"ball\", shape = \"sphere\"}]\n[[instance]]\nmesh = \"bal\"\n");
        check_refused_at(3, "add a [[mesh]]",
                         "mesh = [{name = \"ball\", shape = \"sphere\"}]\n[[instance]]\nmesh = \"cube\"\n");
        check_refused_at(2, "did you mean \"torus\"?", "[[mesh]]\nshape = \"tours\"\n", true);
        check_refused_at(2, "'R' is not a key", "[[mesh]]\nshape = \"plane:R=1\"\n", true);
    }

    TEST_CASE("scene: keys that contradict each other, or are out of range, are refused with their line") {
        check_refused_at(3, "\"shape\"", "[[mesh]]\nfile = \"a.obj\"\nshape = \"cube\"\n");
        check_refused_at(3, "\"segments\"", "[[mesh]]\nfile = \"a.obj\"\nsegments = 4\n");
        check_refused_at(3, "\"segments\"", "[[mesh]]\nshape = \"cube\"\nsegments = [4, 0]\n");
        check_refused_at(2, "", "[[mesh]]\nshape = \"sphere\"\nsegments = 2\n", true); // too few around a period
        check_refused_at(3, "\"repeat\"", "[[mesh]]\nshape = \"cube\"\nrepeat = 0\n");
        check_refused_at(3, "\"repeat\"", "[[mesh]]\nshape = \"cube\"\nrepeat = [1, nan]\n");
        check_refused_at(3, "\"repeat\"", "[[mesh]]\nshape = \"cube\"\nrepeat = [1, \"2\"]\n");
        check_refused_at(6, "\"name\"",
                         "[[mesh]]\nname = \"a\"\nshape = \"cube\"\n"
                         "[[mesh]]\nshape = \"cube\"\nname = \"a\"\n");
        check_refused_at(1, "\"mesh\"", "[[instance]]\n");
        check_refused_at(3, "\"scale\"",
                         "mesh = [{name = \"a\", shape = \"cube\"}]\n[[instance]]\nscale = 0\nmesh = \"a\"\n");
        check_refused_at(2, "\"height\"", "[camera]\nheight = 3\n");
        check_refused_at(3, "\"fov-deg\"", "[camera]\ntype = \"orthographic\"\nfov-deg = 30\n");
        check_refused_at(3, "\"height\"", "[camera]\ntype = \"orthographic\"\nheight = 0\n");
        check_refused_at(2, "\"type\"", "[camera]\ntype = \"fisheye\"\n");
        check_refused_at(1, "\"name\"", "camera = [{fov-deg = 30}, {name = \"a\"}]\n");
        check_refused_at(1, "\"name\"", "camera = [{name = \"a\"}, {name = \"a\"}]\n");
        check_refused_at(1, "\"camera\"", "camera = [1, 2]\n");
        check_refused_at(2, "\"size\"", "[ground]\nsize = -1\n");
        check_refused_at(2, "\"height\"", "[ground]\nheight = inf\n");
    }

} // TEST_SUITE
