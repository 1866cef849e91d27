#include "bake/relief/map/relief_points.h"
#include "relief/displace/displace_meshes.h"

using namespace bake;

TEST_SUITE("unit") {

    TEST_CASE(
        "ReliefPoints: points stand for areas in proportion to those of their triangles, wherever the mesh lies") {
        // A triangle of area 1/2, and one of area 3 beside it.
        const Mesh mesh = test::polygons({{5, 7, -3}, {6, 7, -3}, {5, 8, -3}, {9, 7, -3}, {11, 7, -3}, {9, 7, 0}},
                                         {{0, 1, 2}, {3, 4, 5}}, {{0, 0}, {1, 0}, {0, 1}, {0, 0}, {1, 0}, {0, 1}});
        const MeshSurface surface = make_mesh_surface(mesh);
        HeightTexture height;
        height.values = test::noise(8);
        const ReliefPoints points(surface, height, Filter::central, {});
        double first = 0, all = 0;
        for (std::int64_t i = 0; i < points.count(); ++i) {
            const auto sample = points.at(i);
            REQUIRE(sample);
            all += points.area(i);
            if (sample->jet.p.x < 7) first += points.area(i);
        }
        CHECK(first / all == doctest::Approx(0.5 / 3.5));
    }

} // TEST_SUITE
