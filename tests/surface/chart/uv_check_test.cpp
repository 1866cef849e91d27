#include "bake/mesh/file/mesh_io.h"
#include "bake/surface/chart/uv_check.h"
#include "folders.h"
#include "surface/chart/charts.h"
#include <cstdlib>
#include <doctest/doctest.h>
#include <filesystem>

using namespace bake;
using namespace bake_tests;

namespace {

UvCheck check(const Mesh& mesh) { return check_uvs(mesh, triangulate(mesh)); }

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("check_uvs: a plain chart") {
        const UvCheck c = check(charts({{{0, 0}, 0.5f, 0.5f}}));
        CHECK(c.triangles == 2);
        CHECK(c.mirrored_triangles == 0);
        CHECK(c.degenerate_triangles == 0);
        CHECK(c.overlap == 0);
        CHECK(c.covered == doctest::Approx(0.25).epsilon(0.01));
        CHECK(c.max == Vec2d(0.5, 0.5));
        CHECK(c.udim_tiles == std::vector<int>{1001});
        CHECK(c.density.median == doctest::Approx(0.5));
        CHECK(c.density.p5 == doctest::Approx(1));
        CHECK(c.stretch.median == doctest::Approx(1));
    }

    TEST_CASE("check_uvs: mirrored, flat and missing uvs are counted by triangle") {
        Mesh mesh = charts({{{0, 0}, -0.4f, 0.4f}, {{0.5f, 0}, 0, 0.4f}, {{0.5f, 0.5f}, 0.3f, 0.3f}});
        const UvCheck c = check(mesh);
        CHECK(c.triangles == 6);
        CHECK(c.mirrored_triangles == 2);
        CHECK(c.degenerate_triangles == 2);
        mesh.corner_uv[8] = no_index;
        CHECK(check(mesh).triangles < 6);
        mesh.corner_uv.clear();
        CHECK(check(mesh).triangles == 0);
    }

    TEST_CASE("check_uvs: overlap is the part of the covered area under more than one face") {
        // Two unit squares, half of each over the other: 0.5 of 1.5.
        const UvCheck half = check(charts({{{0, 0}}, {{0.5f, 0}}}));
        CHECK(half.overlap == doctest::Approx(1.0 / 3).epsilon(0.01));
        CHECK(half.covered == doctest::Approx(1.5).epsilon(0.01));
        CHECK(check(charts({{{0, 0}}, {{0, 0}}})).overlap == doctest::Approx(1));
        // Neighbours that share a border do not overlap.
        CHECK(check(charts({{{0, 0}, 0.5f, 1}, {{0.5f, 0}, 0.5f, 1}})).overlap == doctest::Approx(0).epsilon(0.002));
    }

    TEST_CASE("check_uvs: UDIM tiles, a border belonging to the tile inside") {
        const UvCheck c = check(charts({{{0, 0}}, {{2, 1}}, {{9, 3}, 0.5f, 0.5f}}));
        CHECK(c.udim_tiles == std::vector<int>{1001, 1013, 1040});
        CHECK(c.crossing_faces == 0);
        CHECK(c.outside_faces == 0);
        const UvCheck across = check(charts({{{0.5f, 0.2f}, 1, 0.5f}, {{-0.5f, 0}, 0.4f, 0.4f}}));
        CHECK(across.udim_tiles == std::vector<int>{1001, 1002});
        CHECK(across.crossing_faces == 1);
        CHECK(across.outside_faces == 1);
        CHECK(check(charts({{{-4e-6f, 0}, 1.000008f, 1}})).udim_tiles == std::vector<int>{1001}); // off by rounding
        // u across thousands of tiles takes no time and no memory.
        CHECK(check(charts({{{-1e6f, -1e6f}, 2e6f, 2e6f}})).udim_tiles.size() == 9000);
    }

    TEST_CASE("check_uvs: density and stretch are spread over the surface's area") {
        // Half the surface at twice the density, and 4 : 1 stretched charts.
        const UvCheck c = check(charts({{{0, 0}, 0.2f, 0.2f}, {{0.5f, 0}, 0.4f, 0.4f}}));
        CHECK(c.density.median == doctest::Approx(0.2));
        CHECK(c.density.p95 == doctest::Approx(2));
        CHECK(check(charts({{{0, 0}, 0.8f, 0.2f}})).stretch.p95 == doctest::Approx(4));
    }

    TEST_CASE("check_uvs: a sliver in space counts with its stretch, however thin it is") {
        for (const float thin : {1e-3f, 1e-6f, 1e-9f, 1e-12f}) {
            Mesh sliver = charts({{{0, 0}}});
            sliver.positions = {{0, 0, 0}, {1, 0, 0}, {0.75f, thin, 0}, {-0.25f, thin, 0}};
            // The map (u, v) to (u - v / 4, thin v): the squared singular values have the sum 17 / 16 and the product thin^2.
            CAPTURE(thin);
            CHECK(check(sliver).stretch.median * double(thin) == doctest::Approx(17.0 / 16).epsilon(1e-5));
        }
    }
}

TEST_SUITE("real" * doctest::skip(test::no_shared_data())) {
    TEST_CASE("check_uvs: the facts known of real meshes") {
        const auto data = test::shared_data();
        const auto load = [&](const char* name) { return check(read_mesh((data / name).string())); };
        const UvCheck head = load("meshes/leeperrysmith/LeePerrySmith.obj");
        CHECK(head.mirrored_triangles == 662);
        CHECK(head.degenerate_triangles == 12);
        CHECK(head.overlap < 0.001);
        CHECK(load("meshes/gltf/armor.obj").mirrored_triangles == 9130);
        const UvCheck teapot = load("meshes/materialx/teapot.obj");
        CHECK(teapot.overlap == doctest::Approx(0.5).epsilon(0.05));
        CHECK(teapot.max.x == doctest::Approx(1.017).epsilon(0.001));
        const UvCheck cage = load("meshes/opensubdiv/catmark_righthanded.obj");
        CHECK(cage.triangles - cage.degenerate_triangles == 500);
        CHECK(cage.mirrored_triangles == 250);
        CHECK(cage.degenerate_triangles == 368);
        CHECK(cage.overlap > 0.99);
        const UvCheck knot = load("meshes/trimesh/quadknot.obj");
        CHECK(knot.degenerate_triangles == knot.triangles);
        CHECK(load("meshes/trimesh/fuze.obj").mirrored_triangles == 128);
        const UvCheck jacked = load("bad/meshes/trimesh_jacked.obj");
        CHECK(jacked.overlap > 0.99);
        CHECK(2 * jacked.mirrored_triangles == jacked.triangles);
        const UvCheck tube = load("bad/meshes/trimesh_tube.obj");
        CHECK(tube.degenerate_triangles == 28);
        CHECK(tube.overlap > 0.99);
        CHECK(load("meshes/materialx/cube.obj").udim_tiles ==
              std::vector<int>{1001, 1002, 1003, 1011, 1012, 1013, 1023});
    }
}
