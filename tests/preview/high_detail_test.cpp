// Meshes of a scene that name their high-poly mesh.
#include "bake/base/error.h"
#include "bake/mesh/file/mesh_io.h"
#include "bake/preview/high_detail.h"
#include "bake/preview/scene_io.h"
#include "preview/bumpy_square.h"

using namespace bake;
using namespace bake::test;

namespace {

Scene shown(const Folder& folder, const std::string& more = "") {
    write_file(folder / "s.toml", bumpy_scene(from_near) + more);
    return load(read_scene(folder / "s.toml"));
}

void check_refused_at(int line, const std::string& named, const std::string& scene) {
    const Folder folder;
    write_bumpy_square(folder);
    fs::copy_file(own_meshes() / "dots.png", folder / "dots.png");
    write_file(folder / "s.toml", scene);
    try {
        load(read_scene(folder / "s.toml"));
        FAIL("not refused: " << scene);
    } catch (const Error& error) {
        const std::string message = error.what();
        CHECK_MESSAGE(message.rfind(folder / "s.toml:" + std::to_string(line) + ": ", 0) == 0, message);
        CHECK_MESSAGE(message.find(named) != std::string::npos, message);
    }
}

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("high_detail: a mesh is shown without the detail, with its normals, or as the high-poly mesh") {
        const Folder folder;
        write_bumpy_square(folder);
        const auto triangles = [](const Scene& scene) { return scene.instances[0].shape->surface.triangles.size(); };
        for (const char* shade : {"", "shade = \"plain\"\n"}) {
            const Scene scene = shown(folder, shade);
            CHECK(triangles(scene) == 2);
            CHECK_FALSE(scene.instances[0].material->normal_map);
        }
        const Scene mapped = shown(folder, "shade = \"normal\"\n");
        CHECK(triangles(mapped) == 2);
        REQUIRE(mapped.instances[0].material->normal_map);
        CHECK(mapped.instances[0].material->normal_map->width() == 64);
        CHECK(mapped.instances[0].material->reflectance.diffuse == Vec3f(0.6f));
        const Scene high = shown(folder, "shade = \"high\"\n");
        CHECK(triangles(high) == 2048);
        CHECK_FALSE(high.instances[0].material->normal_map);
        CHECK(high.instances[0].material->reflectance.diffuse == Vec3f(0.6f));
    }

    TEST_CASE("high_detail: instances have the model of their mesh or their own, and share maps") {
        const Folder folder;
        write_bumpy_square(folder);
        const std::string instance = "[[instance]]\nmesh = \"square\"\ntranslate = [2, 0, 0]\n";
        const Scene scene = shown(folder, "shade = \"normal\"\n" + instance + instance + "shade = \"high\"\n" +
                                              instance + "normal-size = 32\n");
        REQUIRE(scene.instances.size() == 4);
        CHECK(scene.instances[1].material == scene.instances[0].material);
        CHECK(scene.instances[2].shape->surface.triangles.size() == 2048);
        CHECK(scene.instances[3].material->normal_map->width() == 32);
    }

    TEST_CASE("high_detail: the map has the slopes of the high-poly mesh, and a small one those of a large one") {
        const Folder folder;
        write_bumpy_square(folder);
        const Mesh low = read_mesh(folder / "low.obj");
        std::vector<std::string> notes;
        const HighEntry entry{.file = folder / "high.obj", .shade = Shade::normal, .size = 256};
        const Texture map = high_normal_map(entry, low, "low.obj", notes);
        CHECK(notes.empty());
        double most = 0;
        for (std::size_t i = 0; i < map->size(); i += 3)
            most = std::max(most, std::abs(double(map->data()[i])) / double(map->data()[i + 2]));
        CHECK(most == doctest::Approx(0.02 * 8 * pi).epsilon(0.02));
        // A texel of 16 x 16 is a quarter of a wave wide: its mean slope is four fifths of that in its middle.
        const Texture coarse = high_normal_map({.file = entry.file, .size = 16}, low, "low.obj", notes);
        double x = 0, z = 0;
        for (int j = 0; j < 16; ++j)
            for (int i = 0; i < 16; ++i)
                x += double(map->at(64 + i, 128 + j, 0)), z += double(map->at(64 + i, 128 + j, 2));
        const double slope = double(coarse->at(4, 8, 0)) / double(coarse->at(4, 8, 2));
        CHECK(std::abs(slope) > 0.1);
        CHECK(slope == doctest::Approx(x / z).epsilon(0.03));
    }

    TEST_CASE("high_detail: a note tells of a high-poly mesh that lies elsewhere") {
        const Folder folder;
        write_bumpy_square(folder);
        write_file(folder / "high.obj", "v 9 0 9\nv 9 0 10\nv 10 0 10\nvn 0 1 0\nf 1//1 2//1 3//1\n");
        const Scene scene = shown(folder, "shade = \"normal\"\n");
        REQUIRE(scene.notes.size() > 0);
        CHECK(scene.notes[0].find("find no detail of it") != std::string::npos);
    }

    TEST_CASE("high_detail: what does not go together is refused with its line") {
        const std::string good = bumpy_scene(from_near);
        const auto with = [&](const std::string& old, const std::string& now) {
            std::string scene = good;
            return scene.replace(scene.find(old), old.size(), now);
        };
        check_refused_at(16, "no.obj: no such file", with("high.obj", "no.obj"));
        check_refused_at(16, "no.obj: no such file", with("high.obj", "no.obj") + "shade = \"normal\"\n");
        check_refused_at(16, "no.obj: no such file", with("high.obj", "no.obj") + "shade = \"high\"\n");
        check_refused_at(20, "give one of \"plain\", \"normal\", \"high\"", good + "shade = \"exact\"\n");
        check_refused_at(17, "\"flat\"", good + "flat = true\n");
        check_refused_at(18, "faces of its own", with("low.obj\"", "low.obj\"\nsubdivide = \"catmark\""));
        check_refused_at(17, "\"clay\" has one, too", with("diffuse = 0.6", "bump = \"b.png\""));
        check_refused_at(18, "\"normal-size\"", with("= 64", "= 0"));
        check_refused_at(17, "\"normal-size\" is of a [[mesh]] with \"high\"",
                         with("high = \"high.obj\" # 2048 triangles\n", ""));
        check_refused_at(16, "uvs repeat",
                         with("diffuse = 0.6", "albedo = \"dots.png\"") + "repeat = 2\nshade = \"normal\"\n");
    }
}
