#include "bake/relief/transfer/hard_edges.h"
#include "relief/transfer/transfer_meshes.h"

using namespace bake;
using namespace bake::test;

namespace {

HardEdges edges_of(const Mesh& mesh) {
    const std::vector<Triangle> triangles = triangulate(mesh);
    return hard_edges(mesh, triangles, corner_normals(mesh, triangles));
}

/// Two unit squares that meet at x = 0 with this angle between their normals, which are those of the vertices or of the
/// facets. The second one counts its corners from another one on, and clockwise if `turned`.
Mesh roof(double bend_deg, bool smooth, bool turned = false) {
    const double half = glm::radians(bend_deg / 2), x = std::cos(half), z = -std::sin(half);
    const std::vector<Vec3f> positions = {{-x, 0, z}, {0, 0, 0}, {0, 1, 0}, {-x, 1, z}, {x, 0, z}, {x, 1, z}};
    const Vec3f left(z, 0, x), right(-z, 0, x), top(0, 0, 1);
    const Vec3f a = smooth ? top : left, b = smooth ? top : right;
    if (turned) return polygons(positions, {{0, 1, 2, 3}, {1, 2, 5, 4}}, {}, {a, a, a, a, b, b, b, b});
    return polygons(positions, {{0, 1, 2, 3}, {5, 2, 1, 4}}, {}, {a, a, a, a, b, b, b, b});
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE(
        "hard_edges: the twelve edges of a box, with normals of its sides or shaded smooth, and none of a sphere") {
        CHECK(edges_of(cube(true)).ends.size() == 12);
        CHECK(edges_of(cube(false)).ends.size() == 12);
        CHECK(edges_of(sharp_box()).ends.size() == 12); // positions that are equal by value alone
        const Mesh sphere = lat_long_sphere(64, 32);
        const HardEdges none = edges_of(sphere);
        CHECK(none.ends.empty());
        CHECK((none.averaged == none.own));
        CHECK((none.own == corner_normals(sphere, triangulate(sphere))));
        // A cone: triangles that repeat the tip as quads do, smooth but for its rim with the disc below.
        Mesh cone;
        add_patch(cone, 24, 1, [](double s, double t) {
            const double east = 2 * pi * (s < 1 ? s : 0);
            return PatchPoint{{(1 - t) * std::cos(east), (1 - t) * std::sin(east), t},
                              glm::normalize(Vec3d(std::cos(east), std::sin(east), 1)),
                              {s, t}};
        });
        for (std::size_t i = 25; i < 50; ++i) cone.normals[i] = {0, 0, 1};
        add_patch(cone, 24, 1, [](double s, double t) {
            const double east = 2 * pi * (s < 1 ? s : 0);
            return PatchPoint{{t * std::cos(east), t * std::sin(east), 0}, {0, 0, -1}, {s, t}};
        });
        const HardEdges rim = edges_of(cone);
        CHECK(rim.ends.size() == 24);
        for (const auto& [a, b] : rim.ends) CHECK((cone.positions[a].z == 0 && cone.positions[b].z == 0));
    }

    TEST_CASE("hard_edges: a border is not hard") {
        CHECK(edges_of(unit_plane()).ends.empty());
        CHECK(edges_of(unit_plane(0, 4)).ends.empty());
    }

    TEST_CASE("hard_edges: facets more than 50 degrees apart, or normals of two sides") {
        CHECK(edges_of(roof(49, true)).ends.empty());
        CHECK(edges_of(roof(51, true)).ends.size() == 1);
        CHECK(edges_of(roof(5, false)).ends.size() == 1);
        CHECK(edges_of(roof(0.5, false)).ends.empty()); // within what a file's digits may round
    }

    TEST_CASE("hard_edges: normals that differ at the far end of the edge alone make it hard") {
        for (const std::uint32_t corner : {5u, 6u}) {
            Mesh mesh = roof(10, true);
            mesh.normals[corner] = glm::normalize(Vec3f(1, 0, 1));
            CHECK(edges_of(mesh).ends.size() == 1);
        }
    }

    TEST_CASE("hard_edges: a face whose corners run the other way is compared at the right ends") {
        Mesh mesh = roof(4, true, true);
        // Equal across the edge, different along it: not hard, though the ends differ from each other.
        const Vec3f a(0, 0, 1), b = glm::normalize(Vec3f(0, 0.2f, 1));
        mesh.normals[1] = mesh.normals[4] = a;
        mesh.normals[2] = mesh.normals[5] = b;
        // The facets' own normals are opposite in such a mesh, so that the bend makes the edge hard in any case.
        CHECK(edges_of(mesh).ends.size() == 1);
        // With corners in order the same normals do not.
        Mesh ordered = roof(4, true);
        ordered.normals[1] = ordered.normals[6] = a;
        ordered.normals[2] = ordered.normals[5] = b;
        CHECK(edges_of(ordered).ends.empty());
    }

    TEST_CASE("hard_edges: at a box's corner the averaged normal is the diagonal and a side's own is the side's") {
        for (const bool flat : {true, false}) {
            const Mesh mesh = cube(flat);
            const HardEdges edges = edges_of(mesh);
            for (std::uint32_t c = 0; c < mesh.corners(); ++c) {
                const Vec3d p(mesh.positions[mesh.corner_position[c]]);
                CHECK(oracle::angle_deg(Vec3d(edges.averaged[c]), p) < 1e-4);
                const std::uint32_t first = c / 4 * 4;
                const auto at = [&](std::uint32_t k) { return Vec3d(mesh.positions[mesh.corner_position[first + k]]); };
                CHECK(oracle::angle_deg(Vec3d(edges.own[c]), glm::cross(at(1) - at(0), at(2) - at(0))) < 1e-4);
            }
        }
    }

    TEST_CASE("hard_edges: beside a hard edge, faces that no hard edge parts share their own normal") {
        // A roof of two slopes; the left one is of two squares with a bend of 20 degrees and smooth normals.
        const float c20 = std::cos(glm::radians(20.0f)), s20 = std::sin(glm::radians(20.0f));
        // Three squares around the origin's vertex 0: A and B are nearly coplanar, C is vertical.
        const Mesh mesh = polygons(
            {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {-c20, 0, -s20}, {-c20, 1, -s20}, {0, 0, -1}, {1, 0, -1}},
            {{0, 1, 2, 3}, {4, 0, 3, 5}, {6, 7, 1, 0}});
        const HardEdges edges = edges_of(mesh);
        CHECK(edges.ends.size() == 1);
        const Vec3f a = edges.own[0], b = edges.own[5], c = edges.own[11];
        CHECK(oracle::angle_deg(Vec3d(a), Vec3d(b)) < 1e-4);
        CHECK(oracle::angle_deg(Vec3d(a), Vec3d(-std::sin(glm::radians(10.0)), 0, std::cos(glm::radians(10.0)))) < 0.1);
        CHECK(oracle::angle_deg(Vec3d(c), Vec3d(0, -1, 0)) < 1e-4);
        CHECK((edges.averaged[0] == edges.averaged[5]));
        CHECK((edges.averaged[0] == edges.averaged[11]));
    }

    TEST_CASE("hard_edges: normals away from hard edges stay as given") {
        Mesh mesh = roof(60, true);
        for (const std::uint32_t c : {0u, 3u, 4u, 7u}) mesh.normals[c] = Vec3f(0, 1, 0);
        const HardEdges edges = edges_of(mesh);
        CHECK(edges.ends.size() == 1);
        for (const std::uint32_t c : {0u, 3u, 4u, 7u})
            CHECK((edges.averaged[c] == Vec3f(0, 1, 0) && edges.own[c] == Vec3f(0, 1, 0)));
    }

    TEST_CASE("hard_edges: corners of a face that are one vertex have one normal of their own") {
        // A triangle given as a quad, and a vertical face at its edge 0-2.
        const Mesh mesh = polygons({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}}, {{0, 0, 1, 2}, {2, 3, 0}});
        const HardEdges edges = edges_of(mesh);
        CHECK(edges.ends.size() == 1);
        for (std::uint32_t c = 0; c < 7; ++c)
            CHECK(oracle::angle_deg(Vec3d(edges.own[c]), c < 4 ? Vec3d(0, 0, 1) : Vec3d(-1, 0, 0)) < 1e-4);
        CHECK((edges.averaged[0] == edges.averaged[1]));
    }

} // TEST_SUITE

TEST_SUITE("stability") {

    TEST_CASE("hard_edges: facets without area and an empty mesh give no NaN") {
        CHECK(edges_of(Mesh{}).ends.empty());
        Mesh mesh = cube(false);
        mesh.positions[6] = mesh.positions[5]; // four sides lose a corner
        mesh.positions[2] = mesh.positions[1];
        HardEdges edges = edges_of(mesh);
        for (const std::vector<Vec3f>* normals : {&edges.averaged, &edges.own})
            for (const Vec3f& n : *normals) CHECK((std::abs(glm::length(n) - 1) < 1e-5f || n == Vec3f(0)));
        // Both sides of a folded sheet: the mean is nothing, and each side keeps its own.
        edges = edges_of(polygons({{0, 0, 0}, {1, 0, 0}, {0.5f, 1, 0}, {0.5f, 1, 0}}, {{0, 1, 2}, {1, 0, 3}}));
        CHECK(edges.ends.size() == 3);
        for (std::uint32_t c = 0; c < 6; ++c) CHECK((edges.averaged[c] == Vec3f(0, 0, c < 3 ? 1 : -1)));
    }

} // TEST_SUITE
