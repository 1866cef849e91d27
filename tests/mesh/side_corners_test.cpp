#include "bake/mesh/side_corners.h"
#include "bake/mesh/weld.h"
#include "relief/displace/displace_meshes.h"

using namespace bake;
using namespace bake::test;

TEST_SUITE("unit") {

    TEST_CASE("side_corners: every half-edge runs between its corners, whichever corners a face repeats") {
        using Corners = std::vector<std::array<std::uint32_t, 2>>;
        const std::vector<Vec3f> positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}};
        const auto of = [&](const std::vector<std::vector<std::uint32_t>>& faces) {
            const Mesh mesh = polygons(positions, faces);
            const std::vector<std::uint32_t> vertex = first_equal(mesh.positions);
            const HalfEdges half_edges = make_half_edges(mesh, vertex);
            const Corners ends = side_corners(mesh, vertex, half_edges);
            REQUIRE(ends.size() == half_edges.size());
            for (std::uint32_t h = 0; h < half_edges.size(); ++h) {
                CHECK(vertex[mesh.corner_position[ends[h][0]]] == half_edges.origin[h]);
                CHECK(vertex[mesh.corner_position[ends[h][1]]] == half_edges.target(h));
            }
            return ends;
        };
        const Corners after = {{4, 5}, {5, 6}, {6, 4}}; // of a triangle that follows
        const auto with = [&](Corners first) {
            first.insert(first.end(), after.begin(), after.end());
            return first;
        };
        const std::vector<std::uint32_t> triangle = {1, 2, 3};
        CHECK((of({{0, 1, 2, 3}, triangle}) == with({{0, 1}, {1, 2}, {2, 3}, {3, 0}})));
        CHECK((of({{0, 4, 1, 2}, triangle}) == with({{1, 2}, {2, 3}, {3, 0}})));
        CHECK((of({{1, 0, 4, 2}, triangle}) == with({{0, 1}, {2, 3}, {3, 0}})));
        CHECK((of({{0, 1, 2, 4}, triangle}) == with({{0, 1}, {1, 2}, {2, 3}})));
        CHECK((of({{0, 4, 0, 1}, triangle}) == after)); // two vertices
        CHECK(of({{0, 4, 0, 1}}).empty());
    }

} // TEST_SUITE
