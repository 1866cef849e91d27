#include "bake/environment/sky/environment.h"
#include "environment/skies.h"
#include <doctest/doctest.h>

using namespace bake;

TEST_SUITE("unit") {

    TEST_CASE(
        "sample: the samples of an edge-sampled cube are found in their directions, up to its edges and corners") {
        for (const int n : {2, 3, 8}) {
            Environment sky{.cube = make_cube(n, 3), .edge_samples = true};
            const auto direction = [n](int face, int x, int y) {
                return test::face_direction(face, 2.0 * x / (n - 1) - 1, 2.0 * y / (n - 1) - 1);
            };
            for (int face = 0; face < 6; ++face)
                for (int y = 0; y < n; ++y)
                    for (int x = 0; x < n; ++x)
                        for (int c = 0; c < 3; ++c)
                            sky.cube.faces[face].at(x, y, c) = float(test::smooth_radiance(direction(face, x, y), c));
            for (int face = 0; face < 6; ++face)
                for (int y = 0; y < n; ++y)
                    for (int x = 0; x < n; ++x) {
                        const Vec3d d = direction(face, x, y);
                        float value[3];
                        sample(sky, &d, 1, value);
                        for (int c = 0; c < 3; ++c)
                            CHECK(value[c] == doctest::Approx(sky.cube.faces[face].at(x, y, c)).epsilon(1e-6));
                    }
        }
    }

} // TEST_SUITE
