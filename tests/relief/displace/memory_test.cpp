#include "bake/relief/displace/memory.h"
#include <doctest/doctest.h>

using namespace bake;

TEST_SUITE("unit") {

    TEST_CASE("within_indices: neither the points nor the corners may be more than a mesh can count") {
        const std::uint64_t most = no_index - 1;
        CHECK(within_indices({.points = most, .corners = most}));
        CHECK_FALSE(within_indices({.points = most, .corners = most + 1})); // four corners to a point are usual
        CHECK_FALSE(within_indices({.points = most + 1, .corners = most}));
    }
}
