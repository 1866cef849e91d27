#include "bake/relief/map/bake_target.h"
#include "relief/displace/displace_meshes.h"

using namespace bake;

namespace {

/// A rectangle under the whole unit square of uv.
ConstantScale<float> scale_of(float width, float height) {
    const Mesh mesh = test::polygons({{0, 0, 0}, {width, 0, 0}, {width, height, 0}, {0, height, 0}}, {{0, 1, 2, 3}},
                                     {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
    return mean_scale(make_mesh_surface(mesh));
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("mean_scale: the lengths of u and v on the surface, or 1 for both where one of them is nothing") {
        CHECK(scale_of(2, 3).u == doctest::Approx(2));
        CHECK(scale_of(2, 3).v == doctest::Approx(3));
        for (const auto& [width, height] : {std::pair(0.0f, 3.0f), {2.0f, 0.0f}, {0.0f, 0.0f}}) {
            CAPTURE(width);
            CHECK(scale_of(width, height).u == 1);
            CHECK(scale_of(width, height).v == 1);
        }
    }

} // TEST_SUITE
