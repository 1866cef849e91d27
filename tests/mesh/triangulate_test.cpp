#include "bake/base/parallel.h"
#include "bake/mesh/triangulate.h"
#include "mesh/file/mesh_files.h"
#include <cmath>
#include <random>

namespace {
using namespace bake;
using namespace bake_tests;
using Corners = std::vector<std::array<std::uint32_t, 3>>;

Corners corners_of(const Mesh& mesh) {
    Corners out;
    for (const Triangle& t : triangulate(mesh)) out.push_back(t.corner);
    return out;
}

/// One face with these corners, in the plane of x and y turned by `turn`.
Mesh polygon(const std::vector<Vec2d>& points, double turn = 0) {
    Mesh mesh;
    for (const Vec2d& p : points) {
        mesh.corner_position.push_back(std::uint32_t(mesh.positions.size()));
        mesh.positions.emplace_back(p.x * std::cos(turn), p.y, p.x * std::sin(turn));
    }
    mesh.face_begin.push_back(std::uint32_t(points.size()));
    return mesh;
}

Vec3d point(const Mesh& mesh, std::uint32_t corner) { return Vec3d(mesh.positions[mesh.corner_position[corner]]); }

/// Twice the vector area of the face.
Vec3d face_area(const Mesh& mesh, std::uint32_t f) {
    Vec3d sum(0);
    const std::uint32_t begin = mesh.face_begin[f], end = mesh.face_begin[f + 1];
    for (std::uint32_t c = begin; c < end; ++c)
        sum += glm::cross(point(mesh, c), point(mesh, c + 1 < end ? c + 1 : begin));
    return sum;
}

/// Sum of the triangles' areas without sign over the area of face 0: 1 where nothing is covered twice or turned over.
/// Also checks that the face has n - 2 triangles of its own corners.
double cover(const Mesh& mesh) {
    double sum = 0;
    const auto triangles = triangulate(mesh);
    CHECK(triangles.size() == mesh.corners() - 2);
    for (const Triangle& t : triangles) {
        CHECK(t.face == 0);
        for (const std::uint32_t c : t.corner) CHECK(c < mesh.corners());
        sum += glm::length(glm::cross(point(mesh, t.corner[1]) - point(mesh, t.corner[0]),
                                      point(mesh, t.corner[2]) - point(mesh, t.corner[0])));
    }
    return sum / glm::length(face_area(mesh, 0));
}
} // namespace

TEST_SUITE("unit") {
    TEST_CASE("triangulate: triangles stay as they are, in the order of the faces") {
        Mesh mesh = polygon({{0, 0}, {1, 0}, {0, 1}, {0, 0}, {1, 1}, {0, 1}});
        mesh.face_begin = {0, 3, 6};
        CHECK(corners_of(mesh) == Corners{{0, 1, 2}, {3, 4, 5}});
        CHECK(triangulate(mesh)[1].face == 1);
    }

    TEST_CASE("triangulate: quads split along the shorter diagonal in uv, then in space, then the first") {
        const Corners first = {{0, 1, 2}, {0, 2, 3}}, second = {{0, 1, 3}, {1, 2, 3}};
        Mesh mesh = polygon({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
        CHECK(corners_of(mesh) == first);
        mesh.positions[2] = {2, 2, 0};
        CHECK(corners_of(mesh) == second);
        mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
        mesh.corner_uv = {0, 1, 2, 3};
        CHECK(corners_of(mesh) == second); // equal in uv: space decides
        mesh.uvs[2] = {0.5f, 0.5f};
        CHECK(corners_of(mesh) == first); // uv goes before space
        mesh.corner_uv[1] = no_index;
        CHECK(corners_of(mesh) == second); // a corner without uv: space decides
    }

    TEST_CASE("triangulate: concave polygons are covered once, in every plane") {
        const std::vector<Vec2d> star = {{0, 3},    {-0.7, 1}, {-3, 1},     {-1.2, -0.4}, {-2, -2.5},
                                         {0, -1.2}, {2, -2.5}, {1.2, -0.4}, {3, 1},       {0.7, 1}};
        const std::vector<Vec2d> comb = {{0, 0}, {9, 0}, {9, 5}, {8, 5}, {8, 1}, {6, 1}, {6, 5}, {5, 5},
                                         {5, 1}, {3, 1}, {3, 5}, {2, 5}, {2, 1}, {1, 1}, {1, 5}, {0, 5}};
        for (const double turn : {0.0, 0.3, 1.2, 1.5707963, 3.0}) {
            CHECK(cover(polygon(star, turn)) == doctest::Approx(1).epsilon(1e-6)); // float positions
            CHECK(cover(polygon(comb, turn)) == doctest::Approx(1).epsilon(1e-6));
            CHECK(cover(polygon({comb.rbegin(), comb.rend()}, turn)) == doctest::Approx(1).epsilon(1e-6));
        }
    }

    TEST_CASE("triangulate: random star-shaped polygons, concave at every other corner, are covered once") {
        std::mt19937 random(5);
        for (int repeat = 0; repeat < 200; ++repeat) {
            std::vector<Vec2d> points;
            const int n = 5 + int(random() % 60);
            for (int i = 0; i < n; ++i) {
                const double angle = 6.283185307179586 * i / n, radius = 0.2 + double(random() % 1000) / 1000;
                points.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
            }
            CHECK(cover(polygon(points, 0.1 * repeat)) == doctest::Approx(1).epsilon(1e-5));
        }
    }

    TEST_CASE("triangulate: corners on a line or on each other do no harm") {
        CHECK(cover(polygon({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}})) == doctest::Approx(1));
        CHECK(cover(polygon({{0, 0}, {0, 0}, {2, 0}, {2, 2}, {2, 2}, {2, 2}, {0, 2}})) == doctest::Approx(1));
        CHECK(cover(polygon({{0, 0}, {4, 0}, {4, 3}, {2, 1}, {0, 3}, {0, 3}, {0, 1.5}})) == doctest::Approx(1));
        // A whole side of points, and its opposite: no ear may swallow them.
        std::vector<Vec2d> side = {{0, 5}};
        for (int i = 0; i <= 20; ++i) side.emplace_back(0.3 * i, 0);
        CHECK(cover(polygon(side)) == doctest::Approx(1));
    }

    TEST_CASE("triangulate: a hole joined by a bridge stays a hole, also where it touches the border") {
        const auto path = source_folder() / "meshes/trouble/hole_on_a_bridge.obj";
        CHECK(cover(read_mesh(path.string())) == doctest::Approx(1));
        // A square hole whose corner lies on the middle of the lower side.
        CHECK(cover(polygon({{0, 0}, {2, 0}, {1, 1}, {2, 2}, {3, 1}, {2, 0}, {4, 0}, {4, 4}, {0, 4}})) ==
              doctest::Approx(1));
        // A hole that reaches into a convex corner and beyond its ear: that corner is none.
        CHECK(cover(polygon(
                  {{0, 0}, {4, 0}, {4, 4}, {3.7, 3.7}, {3.6, 1.2}, {0, 0}, {1.2, 3.6}, {3.7, 3.7}, {4, 4}, {0, 4}})) ==
              doctest::Approx(1));
        // A hole that hangs from a convex corner.
        CHECK(cover(polygon({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 2}, {2, 2}, {2, 1}})) == doctest::Approx(1));
    }

    TEST_CASE("triangulate: self-crossing and flat polygons still give n - 2 triangles, with the same area vector") {
        const std::vector<std::vector<Vec2d>> polygons = {
            {{0, 0}, {2, 2}, {2, 0}, {0, 2}, {-1, 1}},        {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}},
            {{1, 1}, {1, 1}, {1, 1}, {1, 1}, {1, 1}, {1, 1}}, {{0, 3}, {-2, -3}, {3, 1}, {-3, 1}, {2, -3}},
            {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 0}, {1, 1}},
        };
        for (const auto& points : polygons) {
            const Mesh mesh = polygon(points);
            const auto triangles = triangulate(mesh);
            REQUIRE(triangles.size() == points.size() - 2);
            Vec3d sum(0);
            for (const Triangle& t : triangles)
                sum += glm::cross(point(mesh, t.corner[1]) - point(mesh, t.corner[0]),
                                  point(mesh, t.corner[2]) - point(mesh, t.corner[0]));
            CHECK(glm::length(sum - face_area(mesh, 0)) < 1e-9);
        }
        CHECK(corners_of(polygon(polygons[1])) == Corners{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}); // flat: a fan
    }

    TEST_CASE("triangulate: the same triangles for any number of threads") {
        std::mt19937 random(6);
        Mesh mesh;
        for (std::uint32_t i = 0; i < 1000; ++i)
            mesh.positions.emplace_back(random() % 99, random() % 99, random() % 99);
        for (int f = 0; f < 40000; ++f) {
            for (std::uint32_t n = 3 + random() % 6; n > 0; --n) mesh.corner_position.push_back(random() % 1000);
            mesh.face_begin.push_back(std::uint32_t(mesh.corners()));
        }
        Corners expected;
        for (const int threads : {1, 2, 7}) {
            const ThreadLimit limit(threads);
            const Corners corners = corners_of(mesh);
            if (threads == 1) expected = corners;
            CHECK(corners == expected);
            CHECK(corners.size() == mesh.corners() - 2 * mesh.faces());
        }
    }
} // unit

TEST_SUITE("real" * doctest::skip(test::no_shared_data())) {
    TEST_CASE("triangulate: the concave 66-gon with a bridge is covered once") {
        const auto path = test::shared_data() / "bad/meshes/assimp_concave_polygon.obj";
        const Mesh mesh = read_mesh(path.string());
        REQUIRE(mesh.corners() == 66);
        CHECK(cover(mesh) == doctest::Approx(1).epsilon(1e-9));
    }

    TEST_CASE("triangulate: cages of larger polygons keep the area vector of every face") {
        const auto folder = test::shared_data() / "meshes";
        for (const char* name :
             {"spot/spot_control_mesh.obj", "opensubdiv/catmark_nonquads.obj", "opensubdiv/catmark_car.obj"}) {
            const Mesh mesh = read_mesh((folder / name).string());
            std::vector<Vec3d> sum(mesh.faces(), Vec3d(0));
            for (const Triangle& t : triangulate(mesh))
                sum[t.face] += glm::cross(point(mesh, t.corner[1]) - point(mesh, t.corner[0]),
                                          point(mesh, t.corner[2]) - point(mesh, t.corner[0]));
            for (std::uint32_t f = 0; f < mesh.faces(); ++f) CHECK(glm::length(sum[f] - face_area(mesh, f)) < 1e-9);
        }
    }
} // real
