#include "bake/preview/scene_positions.h"
#include "preview/little_scenes.h"
#include <doctest/doctest.h>

using namespace bake;
using namespace bake::test;

TEST_SUITE("unit") {

    TEST_CASE("scene positions: a far mesh has absolute positions, and a note once their rounding can be seen") {
        for (const double x : {0.0, 1e3, 1e6}) {
            Mesh mesh = plane_mesh(2);
            mesh.origin = {x, 0, -x};
            std::vector<std::string> notes;
            make_absolute(mesh, "far.obj", notes);
            CHECK(mesh.origin == Vec3d(0));
            CHECK(mesh.positions[0] == Vec3f(Vec3d(x - 1, -1, -x)));
            REQUIRE(notes.size() == (x > 1e5 ? 1 : 0));
            for (const std::string& note : notes) {
                CHECK(note.starts_with("far.obj: lies 1.41e+06 from the origin"));
                CHECK(note.find("rounded by up to 0.06 (diagonal 2.828)") != std::string::npos);
            }
        }
    }

    TEST_CASE("scene: relief on a mesh of 1e-12 is told, a plain mesh and a mesh of 1e-6 are not") {
        for (const auto& [size, relief, told] :
             {std::tuple(1e-12f, true, true), {1e-12f, false, false}, {1e-6f, true, false}}) {
            Mesh mesh = plane_mesh();
            for (Vec3f& p : mesh.positions) p *= size;
            Material material;
            if (relief) material.bump_table = texture(2, 2, 2, [](float, float, float* to) { to[0] = to[1] = 0; });
            Scene scene = one_mesh(std::move(mesh), material);
            build(scene);
            CHECK(scene.notes.size() == (told ? 1 : 0));
            if (told) CHECK(scene.notes[0].find("scale the scene up") != std::string::npos);
        }
    }

} // TEST_SUITE
