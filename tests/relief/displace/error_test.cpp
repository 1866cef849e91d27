#include "bake/relief/displace/error.h"
#include <doctest/doctest.h>

using namespace bake;

TEST_SUITE("oracle") {

    TEST_CASE(
        "distance_to_triangle: that of the face, an edge or a corner, whichever is nearest, at any size and place") {
        struct Known {
            Vec3d p;
            double distance;
        };
        // Over the right triangle of sides 3, 4 and 5: inside, beside each edge, beyond each corner, and on it.
        const Known known[] = {
            {{1, 1, 7}, 7},   {{1, 1, -2}, 2},       {{1, -3, 4}, 5},          {{2, -5, 0}, 5},
            {{-3, 1, 4}, 5},  {{-6, 2, 0}, 6},       {{2 + 3, 1.5 + 4, 0}, 5}, {{2 + 0.6, 1.5 + 0.8, 0}, 1},
            {{-3, -4, 0}, 5}, {{4 + 3, -4, 12}, 13}, {{-4, 3 + 3, 12}, 13},    {{0, 0, 0}, 0},
            {{4, 0, 0}, 0},   {{0, 3, 0}, 0},        {{2, 1.5, 0}, 0},         {{1, 0, 0}, 0}};
        const Vec3d corner[3] = {{0, 0, 0}, {4, 0, 0}, {0, 3, 0}};
        for (const double size : {1e-3, 1.0, 1e3})
            for (int first = 0; first < 3; ++first)
                for (const bool turned : {false, true}) {
                    const auto at = [&](const Vec3d& p) { return size * (p + Vec3d(5, -2, 1)); };
                    const Vec3d a = at(corner[first]), b = at(corner[(first + (turned ? 2 : 1)) % 3]),
                                c = at(corner[(first + (turned ? 1 : 2)) % 3]);
                    for (const Known& k : known)
                        CHECK(std::abs(distance_to_triangle(at(k.p), a, b, c) - size * k.distance) < 1e-12 * size);
                }
    }
}
