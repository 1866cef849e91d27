#include "bake/relief/displace/curves.h"
#include <algorithm>
#include <doctest/doctest.h>

using namespace bake;

TEST_SUITE("unit") {

    TEST_CASE("rate_within: a straight curve is one segment, and one corner in the middle makes two") {
        const std::vector<Vec3d> line = {{0, 0, 0}, {1, 1, 0}, {2, 2, 0}, {3, 3, 0}, {4, 4, 0}};
        CHECK(rate_within(line, 1e-9, 100) == 1);
        const std::vector<Vec3d> roof = {{0, 0, 0}, {1, 1, 0}, {2, 2, 0}, {3, 1, 0}, {4, 0, 0}};
        CHECK(rate_within(roof, 1e-9, 100) == 2);
    }

    TEST_CASE("rate_within: a bend between the first samples, or between the last, is refined") {
        // Of the second differences only one is not 0. Its length is 1, so that a chord of 1/n of the four samples' parameter
        // is (4 / n)^2 / 8 off: within 0.01 from n = 4 / sqrt(0.08) = 14.1 on.
        std::vector<Vec3d> hook = {{0, 1, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}};
        CHECK(rate_within(hook, 0.01, 100) == 15);
        std::reverse(hook.begin(), hook.end());
        CHECK(rate_within(hook, 0.01, 100) == 15);
        CHECK(rate_within(hook, 0.01, 9) == 9);
    }
}
