#include "bake/environment/sky/frame.h"
#include "environment/skies.h"
#include <doctest/doctest.h>

using namespace bake;

TEST_SUITE("unit") {
    TEST_CASE("framed: the face in the middle, its neighbours around it, and means at the corners") {
        for (const int n : {1, 2, 5}) {
            const Cube sky = test::rough_sky(n, 2);
            for (const CubeFace face : all_cube_faces) {
                const Image<float> wide = framed(sky, face);
                REQUIRE(wide.width() == n + 2);
                for (int i = 0; i < n; ++i) {
                    CHECK(wide.at(i + 1, 1, 1) == sky[face].at(i, 0, 1));
                    const CubeTexel left = texel_across(n, face, -1, i), above = texel_across(n, face, i, -1);
                    CHECK(wide.at(0, i + 1, 1) == sky[left.face].at(left.x, left.y, 1));
                    CHECK(wide.at(i + 1, 0, 0) == sky[above.face].at(above.x, above.y, 0));
                }
                CHECK(wide.at(n + 1, 0) ==
                      doctest::Approx((wide.at(n, 1) + wide.at(n, 0) + wide.at(n + 1, 1)) / 3).epsilon(1e-6));
            }
        }
    }
}
