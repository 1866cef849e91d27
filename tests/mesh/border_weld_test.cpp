// Borders that touch but for rounding: found, and joined on demand.
#include "bake/mesh/border_weld.h"
#include "bake/mesh/check/mesh_check.h"
#include "bake/mesh/weld.h"
#include "growth.h"
#include "mesh/file/mesh_files.h"
#include <random>
#include <set>

using namespace bake;
using namespace bake_tests;

namespace {

/// Two strips of quads, [0, n] x [0, 1] and [0, n] x [1, 2], with separate positions; those of the second are moved by
/// `gap`, of alternating sign along the border if `zigzag`.
Mesh strips(int n, const Vec3f& gap, bool zigzag = false) {
    Mesh mesh;
    for (int strip = 0; strip < 2; ++strip)
        for (int j = 0; j < 2; ++j)
            for (int i = 0; i <= n; ++i)
                mesh.positions.push_back(Vec3f(i, strip + j, 0) + (strip ? (zigzag && i % 2 ? -gap : gap) : Vec3f(0)));
    for (int strip = 0; strip < 2; ++strip)
        for (int i = 0; i < n; ++i) {
            const auto at = std::uint32_t(strip * 2 * (n + 1) + i), up = at + std::uint32_t(n + 1);
            for (const std::uint32_t p : {at, at + 1, up + 1, up}) mesh.corner_position.push_back(p);
            mesh.face_begin.push_back(std::uint32_t(mesh.corners()));
        }
    return mesh;
}

std::size_t boundary_edges(const Mesh& mesh) { return check_mesh(mesh, triangulate(mesh)).topology.boundary_edges; }

BorderGaps gaps(const Mesh& mesh, double distance) {
    const HalfEdges he = make_half_edges(mesh, first_equal(mesh.positions));
    return find_border_gaps(mesh, he, make_edges(he), distance);
}

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("weld_borders: borders within the distance are joined, others are not") {
        for (const bool zigzag : {false, true}) {
            Mesh mesh = strips(5, Vec3f(3e-6f, -2e-6f, 1e-6f), zigzag);
            CHECK(boundary_edges(mesh) == 24);
            CHECK(gaps(mesh, 1e-5).edges == 10);
            CHECK(gaps(mesh, 1e-5).widest == doctest::Approx(3.7e-6).epsilon(0.1));
            CHECK(gaps(mesh, 1e-6).edges == 0);
            Mesh apart = mesh;
            CHECK(weld_borders(apart, 1e-6, "t.obj").edges == 0);
            CHECK(apart.corner_position == mesh.corner_position);
            CHECK(apart.notes.empty());
            const auto positions = mesh.positions;
            CHECK(weld_borders(mesh, 1e-5, "t.obj").edges == 10);
            CHECK(boundary_edges(mesh) == 14);
            CHECK(mesh.positions == positions); // corners move to the lower position
            CHECK(mesh.notes.size() == 1);
            CHECK(gaps(mesh, 1e-5).edges == 0);
        }
    }

    TEST_CASE("weld_borders: the order of faces does not matter") {
        Mesh mesh = strips(40, Vec3f(1e-5f, 2e-5f, 0));
        Mesh reversed = mesh;
        reversed.corner_position.clear();
        for (std::size_t f = mesh.faces(); f-- > 0;)
            for (int k = 0; k < 4; ++k)
                reversed.corner_position.push_back(mesh.corner_position[4 * f + std::size_t(k + 2) % 4]);
        weld_borders(mesh, 1e-4, "t.obj");
        weld_borders(reversed, 1e-4, "t.obj");
        for (std::size_t f = 0; f < mesh.faces(); ++f)
            for (std::size_t k = 0; k < 4; ++k)
                CHECK(reversed.corner_position[4 * (mesh.faces() - 1 - f) + k] ==
                      mesh.corner_position[4 * f + (k + 2) % 4]);
    }

    TEST_CASE("weld_borders: points that touch without an edge, sides of the same direction and insides stay apart") {
        // Two quads that touch at one corner, and two quads one above the other.
        Mesh mesh = read_text("t.obj",
                              "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 1 1e-5\nv 2 1 0\nv 2 2 0\nv 1 2 0\n"
                              "v 0 0 1e-5\nv 1 0 1e-5\nv 1 1 1.1e-5\nv 0 1 1e-5\nf 1 2 3 4\nf 5 6 7 8\nf 9 10 11 12\n");
        const auto corners = mesh.corner_position;
        CHECK(weld_borders(mesh, 1e-4, "t.obj").edges == 0);
        CHECK(mesh.corner_position == corners);
    }

    TEST_CASE("weld_borders: four sheets that meet at a point are joined there, and equal positions always") {
        std::string text;
        for (int i = 0; i < 4; ++i) {
            const int x = i % 2, y = i / 2;
            for (const auto& [a, b] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}})
                text += "v " + std::to_string(x + a + i * 1e-5) + " " + std::to_string(y + b) + " 0\n";
            text += "f -4 -3 -2 -1\n";
        }
        Mesh mesh = read_text("t.obj", text);
        CHECK(boundary_edges(mesh) == 16);
        weld_borders(mesh, 1e-4, "t.obj");
        CHECK(boundary_edges(mesh) == 8);
        std::set<std::uint32_t> used(mesh.corner_position.begin(), mesh.corner_position.end());
        CHECK(used.size() == 9);
    }

    TEST_CASE("weld_borders: a distance that would join corners of a face is refused") {
        // Three triangles around a point over a narrow hole, whose two long sides lie on each other.
        const std::string text = "v 0 0 0\nv 1 0 0\nv 0 .001 0\nv .3 0 .5\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
        Mesh mesh = read_text("t.obj", text), open = mesh;
        CHECK_THROWS_WITH(
            weld_borders(mesh, 0.01, "t.obj"),
            "t.obj: a `weld` of 0.01 joins two corners of face 3; give a distance below the lengths of its edges");
        open.face_begin.pop_back(); // without the third triangle the hole is a slit, which closes
        open.corner_position.resize(6);
        CHECK(weld_borders(open, 0.01, "t.obj").edges == 4); // the sides of the hole and those of the two triangles
        CHECK(open.corner_position[4] == 0);
    }

    TEST_CASE("check_mesh: reports borders that nearly touch, relative to the diagonal and to the edges") {
        const auto found = [](const Mesh& mesh) { return check_mesh(mesh, triangulate(mesh)).gaps.edges; };
        CHECK(found(strips(5, Vec3f(0, 1e-5f, 0))) == 10);
        CHECK(found(strips(5, Vec3f(0))) == 0);           // equal: not welded, which is another finding
        CHECK(found(strips(5, Vec3f(0, 0.01f, 0))) == 0); // a gap that is visible
        Mesh tiny = strips(5, Vec3f(0, 0, 3e-5f));
        for (Vec3f& p : tiny.positions) p *= Vec3f(1e-4f, 1e-4f, 1); // gaps of a third of the edges: perhaps meant
        tiny.positions.emplace_back(10, 0, 0);
        CHECK(found(tiny) == 0);
    }
}

TEST_SUITE("stability") {
    TEST_CASE("find_border_gaps: many small borders in a large mesh are no pairs that are all compared") {
        const auto scattered = [](int n) {
            std::mt19937 random(8);
            Mesh mesh;
            const auto near_zero = [&] { return float(random() % 100000) * 1e-5f; };
            for (int i = 0; i < n; ++i) {
                const float x = near_zero(), y = near_zero(), z = near_zero();
                mesh.positions.insert(mesh.positions.end(), {{x, y, z}, {x + 0.01f, y, z}, {x, y + 0.01f, z}});
            }
            mesh.positions.insert(mesh.positions.end(), {{0, 0, 1e5f}, {1, 0, 1e5f}, {0, 1, 1e5f}});
            for (std::uint32_t c = 0; c < mesh.positions.size(); ++c) mesh.corner_position.push_back(c);
            for (int i = 0; i <= n; ++i) mesh.face_begin.push_back(std::uint32_t(mesh.face_begin.back() + 3));
            return mesh;
        };
        const auto find = [&](int n) { gaps(scattered(n), 10); };
        CHECK(test::growth(find, 5000) < test::most_growth);
    }
}
