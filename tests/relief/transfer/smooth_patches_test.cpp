#include "bake/mesh/weld.h"
#include "bake/relief/transfer/smooth_patches.h"
#include "relief/transfer/transfer_meshes.h"

using namespace bake;
using namespace bake::test;

TEST_SUITE("unit") {

    TEST_CASE("smooth_patches: the sides of a box, of which all are near each other, and its edges of 90 degrees") {
        const Mesh box = sharp_box();
        const MeshSurface surface = make_mesh_surface(box);
        const SmoothPatches patches(surface);
        REQUIRE(patches.count() == 6);
        CHECK(patches.edges().size() == 12);
        CHECK(patches.kept() == 0);
        for (const HardEdge& edge : patches.edges()) {
            CHECK(edge.convex);
            CHECK(edge.angle == doctest::Approx(pi / 2));
        }
        for (std::uint32_t a = 0; a < 6; ++a)
            for (std::uint32_t b = 0; b < 6; ++b)
                CHECK(patches.are_near(a, b) == (a != b)); // opposite sides share four
        const Mesh room = turned_over(box);
        const MeshSurface inward = make_mesh_surface(room);
        const SmoothPatches grooves(inward);
        CHECK(grooves.edges().size() == 12);
        for (const HardEdge& edge : grooves.edges()) CHECK_FALSE(edge.convex);
    }

    TEST_CASE("smooth_patches: boxes beside each other are not near; a smooth sphere is one patch without edges") {
        Mesh two = sharp_box();
        const std::size_t positions = two.positions.size(), corners = two.corners();
        for (std::size_t i = 0; i < positions; ++i) two.positions.push_back(two.positions[i] + Vec3f(2.5f, 0, 0));
        for (std::size_t c = 0; c < corners; ++c) {
            two.corner_position.push_back(two.corner_position[c] + std::uint32_t(positions));
            two.corner_normal.push_back(two.corner_normal[c]), two.corner_uv.push_back(two.corner_uv[c]);
            if (c % 4 == 3) two.face_begin.push_back(std::uint32_t(two.corners()));
        }
        const MeshSurface surface = make_mesh_surface(two);
        const SmoothPatches patches(surface);
        CHECK(patches.count() == 12);
        CHECK_FALSE(patches.are_near(patches.of_face(0), patches.of_face(6)));
        CHECK_FALSE(patches.are_near(patches.of_face(0), patches.of_face(9)));
        const Mesh sphere = lat_long_sphere(24, 12);
        const MeshSurface round = make_mesh_surface(sphere);
        const SmoothPatches one(round);
        CHECK(one.count() == 1);
        CHECK(one.edges().empty());
    }

    TEST_CASE("smooth_patches: normals stay as given, but where a mesh is shaded smooth over an edge of 90 degrees") {
        Mesh box = sharp_box();
        box.normals.clear(), box.corner_normal.clear();
        weld_positions(box);
        const MeshSurface surface = make_mesh_surface(box);
        const SmoothPatches patches(surface);
        CHECK(patches.count() == 6);
        for (std::size_t c = 0; c < box.corners(); ++c) {
            CHECK(glm::length(surface.n[c]) == doctest::Approx(1));
            CHECK(std::abs(surface.n[c].x) == doctest::Approx(1 / std::sqrt(3.0)));
            const Vec3f n = glm::abs(patches.normals()[c]);
            CHECK(std::max({n.x, n.y, n.z}) == doctest::Approx(1));
        }
        // Normals that are not those of the facets, but split.
        Mesh bent = sharp_box();
        for (Vec3f& n : bent.normals) n = glm::normalize(n + Vec3f(0.1f, 0.05f, 0));
        const MeshSurface leaning = make_mesh_surface(bent);
        CHECK((SmoothPatches(leaning).normals() == leaning.n));
    }

} // TEST_SUITE
