#include "bake/base/parallel.h"
#include "bake/mesh/check/mesh_audit.h"
#include "bake/mesh/file/mesh_io.h"
#include "cli/command.h"
#include "mesh/check/triangle_soups.h"
#include <doctest/doctest.h>

using namespace bake;
using namespace bake::test;

namespace {

MeshAudit audited(const Mesh& mesh) { return audit(mesh, triangulate(mesh)); }

bool without_cgal() { return !audit({}, {}).available; }

// The torus R = 1, r = 0.4 with the tube's radius moved by b(u, v).
template <class Height> Mesh displaced_torus(int columns, int rows, const Height& b) {
    Mesh mesh = oracle::torus_mesh(columns, rows);
    for (int i = 0; i < columns; ++i)
        for (int j = 0; j < rows; ++j) {
            const double u = 2 * pi * i / columns, v = 2 * pi * j / rows;
            mesh.positions[i * rows + j] = Vec3f(oracle::torus(1, 0.4 + b(u, v), u, v).p);
        }
    return mesh;
}

} // namespace

TEST_SUITE("unit" * doctest::skip(without_cgal())) {
    TEST_CASE("audit: a cube bounds its volume, a turned one is inverted, and a needle through it is found") {
        const MeshAudit good = audited(cube());
        CHECK(good.closed);
        CHECK(good.outward);
        CHECK(good.bounds_volume);
        CHECK(good.self_intersections == 0);
        CHECK(good.volume == doctest::Approx(1));
        CHECK(good.components == 1);
        const MeshAudit inside_out = audited(turned(cube()));
        CHECK(inside_out.closed);
        CHECK_FALSE(inside_out.outward);
        CHECK(inside_out.inverted_components == 1);
        CHECK(inside_out.volume == doctest::Approx(-1));

        // It goes through the bottom and the top, each of two triangles, well off their diagonals.
        const Mesh needle =
            together(cube(), mesh_of({{0.4f, 0.7f, -1}, {0.42f, 0.7f, -1}, {0.4f, 0.7f, 2}}, {{0, 1, 2}}));
        const MeshAudit cut = audited(needle);
        CHECK(cut.self_intersections == 2);
        CHECK(cut.first_faces[0] == 0);
        CHECK(cut.first_faces[1] == 6);
        CHECK(cut.first_place.x == doctest::Approx(0.41).epsilon(0.05));
        CHECK(cut.first_place.y == doctest::Approx(0.7));
        CHECK(cut.first_place.z == doctest::Approx(0));
        CHECK_FALSE(cut.closed);
        CHECK(cut.components == 2);
        CHECK(cut.closed_components == 1);
        CHECK_FALSE(cut.bounds_volume);
    }

    TEST_CASE("audit: walls of hollows look inwards, shells in them outwards again") {
        const Mesh outer = cube();
        const Mesh wall = turned(moved(cube(), 0.5f, Vec3f(0.25f))), kernel = moved(cube(), 0.25f, Vec3f(0.375f));
        const MeshAudit hollow = audited(together(outer, wall));
        CHECK(hollow.bounds_volume);
        CHECK(hollow.nested_components == 1);
        CHECK(hollow.inverted_components == 0);
        CHECK(hollow.volume == doctest::Approx(1 - 0.125));
        CHECK(audited(together(together(outer, wall), kernel)).bounds_volume);
        const MeshAudit wrong = audited(together(outer, turned(wall)));
        CHECK_FALSE(wrong.outward);
        CHECK(wrong.inverted_components == 1);
        CHECK(wrong.self_intersections == 0);
        // Beside each other neither is in the other, though one box may hold the other's.
        const Mesh ring = oracle::torus_mesh(24, 12);
        const MeshAudit apart = audited(together(ring, moved(cube(), 0.2f, Vec3f(-0.1f))));
        CHECK(apart.nested_components == 0);
        CHECK(apart.bounds_volume);
    }

    TEST_CASE("audit: meeting in shared points and edges is no intersection, meeting elsewhere is") {
        const auto count = [](std::vector<Vec3f> p, const std::vector<std::vector<std::uint32_t>>& f) {
            return audited(mesh_of(std::move(p), f)).self_intersections;
        };
        const std::vector<std::vector<std::uint32_t>> fan = {{0, 1, 2}, {0, 3, 4}}, hinge = {{0, 1, 2}, {1, 0, 3}};
        CHECK(count({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}, fan) == 0);
        CHECK(count({{0, 0, 0}, {2, -1, 0}, {2, 1, 0}, {3, 0, 1}, {3, 0, 2}}, fan) == 0);  // above, edge-on
        CHECK(count({{0, 0, 0}, {2, -1, 0}, {2, 1, 0}, {3, 0, -1}, {3, 0, 1}}, fan) == 1); // through its far edge
        CHECK(count({{0, 0, 0}, {2, -1, 0}, {2, 1, 0}, {1, 0, -1}, {1, 0, 1}}, fan) == 1); // through its inside
        CHECK(count({{0, 0, 0}, {2, -1, 0}, {2, 1, 0}, {1, 0, 0}, {3, 4, 0}}, fan) == 1);  // in its plane
        CHECK(count({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}}, hinge) == 0);           // flat
        CHECK(count({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 1, 1e-30f}}, hinge) == 0);       // all but folded
        CHECK(count({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, hinge) == 1);            // folded onto itself
        CHECK(count({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {1, 2, 0}}) == 1);      // twice the same
        // Positions equal to the bit are the same point, whatever their numbers.
        CHECK(count({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {-1, 0, 0}, {0, -1, 0}}, {{0, 1, 2}, {3, 4, 5}}) == 0);
        CHECK(count({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1e-30f}, {-1, 0, 0}, {0, -1, 0}},
                    {{0, 1, 2}, {3, 4, 5}}) == 0);
    }

    TEST_CASE("audit: a vertex at which a sphere touches itself has two fans, and the sphere is not closed") {
        Mesh pinched = unit_sphere(12, 8);
        pinched.positions.front() = pinched.positions.back(); // both poles are one point
        const MeshAudit result = audited(pinched);
        CHECK(result.components == 1);
        CHECK(result.closed_components == 0);
        CHECK_FALSE(result.closed);
    }

    TEST_CASE("audit: the number of shells around a shell, with corners above corners and edges above edges") {
        // Cubes around cubes, all with corners on the same vertical lines and diagonals; every other one is a wall.
        Mesh cubes = cube();
        for (int k = 1; k < 7; ++k) {
            const float size = 1 - float(k) / 8;
            const Mesh next = moved(cube(), size, Vec3f(0.5f - size / 2));
            cubes = together(cubes, k % 2 ? turned(next) : next);
        }
        const MeshAudit nested = audited(cubes);
        CHECK(nested.self_intersections == 0);
        CHECK(nested.components == 7);
        CHECK(nested.nested_components == 3);
        CHECK(nested.inverted_components == 0);
        CHECK(nested.bounds_volume);
        // One below the other, with the same corners seen from above; and one in the hole of a torus.
        CHECK(audited(together(cube(), moved(cube(), 1, {0, 0, 2}))).nested_components == 0);
        // It hangs from a corner of the outer cube: its other corners decide.
        const MeshAudit hung = audited(together(cube(), turned(moved(cube(), 0.5f, Vec3f(0)))));
        CHECK(hung.closed_components == 2);
    }

    TEST_CASE("audit: orientation where the highest point is an edge, a face or the tip of a fold") {
        const auto outward = [](const Mesh& mesh) {
            const bool out = audited(mesh).outward;
            CHECK(out != audited(turned(mesh)).outward);
            return out;
        };
        // Turned about the x axis, so that an edge, a vertex or a face is highest.
        for (const double angle : {0.0, pi / 4, 0.3, pi / 2, 2.0, pi, 4.0})
            for (const Mesh& shape : {cube(), unit_sphere(8, 4)}) {
                Mesh mesh = shape;
                const double c = std::cos(angle), s = std::sin(angle);
                for (Vec3f& p : mesh.positions) p = Vec3f(Vec3d(p.x, c * p.y - s * p.z, s * p.y + c * p.z));
                CHECK(outward(mesh));
            }
        // The highest vertex is reentrant: both faces at its flattest edge lie on the same side of it.
        CHECK(outward(
            mesh_of({{0, 0, 0}, {2, 0, 0}, {1, 3, 0}, {1, 5, 4}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}})));
    }

    TEST_CASE("audit: the same for 1, 2 and 7 threads") {
        const Mesh mesh = random_soup(3000, 5);
        const auto run = [&](int threads) {
            const ThreadLimit limit(threads);
            return audited(mesh);
        };
        const MeshAudit one = run(1);
        CHECK(one.self_intersections > 100);
        for (const int threads : {2, 7}) {
            const MeshAudit more = run(threads);
            CHECK(more.self_intersections == one.self_intersections);
            CHECK(more.first_faces == one.first_faces);
            CHECK(more.first_place == one.first_place);
        }
    }
}

TEST_SUITE("oracle" * doctest::skip(without_cgal())) {
    TEST_CASE("audit: an everted sphere cuts itself nowhere, cutting spheres look outwards everywhere") {
        // Displaced by -1.5 R: every point through the centre, so the inside is out.
        const MeshAudit everted = audited(moved(unit_sphere(32, 16), -0.5f, Vec3f(0)));
        CHECK(everted.self_intersections == 0);
        CHECK(everted.closed);
        CHECK_FALSE(everted.outward);
        CHECK(everted.volume < 0);
        // A torus by -2 r: the tube turns through itself, and the faces with it. It is the same torus again, and only
        // the local test, which knows where points came from, can tell.
        CHECK(audited(displaced_torus(48, 24, [](double, double) { return -0.8; })).bounds_volume);

        // Grown into each other: nowhere does b reach a focal point, so no local test sees it.
        const MeshAudit grown =
            audited(together(unit_sphere(32, 16), moved(unit_sphere(32, 16), 1, {1.5f, 0.1f, 0.05f})));
        CHECK(grown.self_intersections > 20);
        CHECK(grown.outward);
        CHECK_FALSE(grown.bounds_volume);

        const MeshAudit fine =
            audited(displaced_torus(48, 24, [](double u, double v) { return 0.05 * sin(4 * u) * sin(3 * v); }));
        CHECK(fine.bounds_volume);
    }

    TEST_CASE("audit: n strips across m strips cut each other n m times") {
        Mesh mesh;
        const auto strip = [&](const Vec3f& a, const Vec3f& b, const Vec3f& c) {
            for (const Vec3f& p : {a, b, c}) {
                mesh.corner_position.push_back(std::uint32_t(mesh.positions.size()));
                mesh.positions.push_back(p);
            }
            mesh.face_begin.push_back(std::uint32_t(mesh.corners()));
        };
        for (int i = 0; i < 40; ++i) {
            const float x = float(i) + 0.3f;
            strip({x, -1, 0}, {x + 0.4f, -1, 0}, {x + 0.2f, 60, 0}); // in the plane z = 0
        }
        for (int j = 0; j < 50; ++j) {
            const float y = float(j) + 0.25f;
            strip({-1, y, -1}, {-1, y, 1}, {200, y, 0.1f}); // upright, still through z = 0 at x = 41
        }
        CHECK(audited(mesh).self_intersections == 40 * 50);
    }

    TEST_CASE("audit: the volume of a torus of n segments tends to 2 pi^2 R r^2 by order 2") {
        const double exact = 2 * pi * pi * 0.4 * 0.4;
        const double coarse = exact - audited(oracle::torus_mesh(32, 16)).volume;
        const double fine = exact - audited(oracle::torus_mesh(64, 32)).volume;
        CHECK(fine > 0);
        CHECK(coarse / fine == doctest::Approx(4).epsilon(0.02)); // the next order is (pi / 16)^2 / 4 of it
    }
}

TEST_SUITE("stability" * doctest::skip(without_cgal())) {
    TEST_CASE("audit: non-manifold, flat and repeated faces are audited, not refused") {
        const MeshAudit book = audited(mesh_of({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}},
                                               {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}})); // three pages
        CHECK(book.self_intersections == 0);
        CHECK_FALSE(book.closed);
        CHECK(book.components == 1);
        CHECK(book.closed_components == 0);
        // Two cubes that touch in a corner: each is closed, and they bound a volume together.
        const MeshAudit touching = audited(together(cube(), moved(cube(), 1, Vec3f(1))));
        CHECK(touching.components == 2);
        CHECK(touching.closed);
        CHECK(touching.bounds_volume);
        CHECK(touching.volume == doctest::Approx(2));
        // Two that share an edge: four faces meet there, and no half-edge structure holds it.
        const MeshAudit on_edge = audited(together(cube(), moved(cube(), 1, {1, 1, 0})));
        CHECK(on_edge.self_intersections == 0);
        CHECK(on_edge.components == 1);
        CHECK_FALSE(on_edge.closed);
        const MeshAudit flat = audited(mesh_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}, {0, 0, 1}}));
        CHECK(flat.self_intersections == 0);
        CHECK_FALSE(flat.closed);
        CHECK(audited(random_soup(200, 3)).available);
    }
}

TEST_SUITE("real" * doctest::skip(without_cgal() || test::no_shared_data())) {
    TEST_CASE("audit: what is known of real meshes") {
        const auto data = test::shared_data();
        const auto load = [&](const char* name) { return audited(read_mesh((data / "meshes" / name).string())); };
        // Counts as by CGAL's own box sweep over all pairs.
        CHECK(load("leeperrysmith/LeePerrySmith.obj").self_intersections == 260);
        CHECK(load("gltf/armor.obj").self_intersections == 1962);
        const MeshAudit gears = load("trimesh/cycloidal.ply");
        CHECK(gears.self_intersections == 54960);
        CHECK(gears.closed_components == 107);
        CHECK(gears.inverted_components == 0);
        CHECK(load("spot/spot_triangulated.obj").bounds_volume);
        CHECK(load("trimesh/quadknot.obj").bounds_volume);
    }
}
