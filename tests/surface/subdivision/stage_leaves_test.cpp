#include "bake/surface/subdivision/stage.h"
#include <doctest/doctest.h>

using namespace bake;

TEST_SUITE("unit") {

    TEST_CASE("is_complete: a tree is covered if each of its nodes has four children that are, named twice or not") {
        const auto leaf = [](std::int32_t k) { return ~k; };
        LimitPatches limit;
        limit.nodes = {leaf(0), leaf(1), leaf(2), leaf(3)};
        CHECK(is_complete(limit, 0));
        CHECK(is_complete(limit, leaf(5)));
        CHECK_FALSE(is_complete(limit, missing_leaf));
        limit.nodes = {leaf(0), leaf(1), leaf(0), leaf(1)};
        CHECK(is_complete(limit, 0));
        for (std::size_t missing = 0; missing < 4; ++missing) {
            limit.nodes = {leaf(0), leaf(1), leaf(2), leaf(3), leaf(4), leaf(5), leaf(6), leaf(7)};
            limit.nodes[3 - missing] = 1;
            CHECK(is_complete(limit, 0));
            limit.nodes[4 + missing] = missing_leaf;
            CHECK_FALSE(is_complete(limit, 0));
        }
    }

} // TEST_SUITE
