#include "bake/relief/displace/memory.h"
#include "relief/displace/displace_meshes.h"

using namespace bake;

TEST_SUITE("unit") {

    TEST_CASE("within_indices: neither the points nor the corners may be more than a mesh can count") {
        const std::uint64_t most = no_index - 1;
        CHECK(within_indices({.points = most, .corners = most}));
        CHECK_FALSE(within_indices({.points = most, .corners = most + 1})); // four corners to a point are usual
        CHECK_FALSE(within_indices({.points = most + 1, .corners = most}));
    }

    TEST_CASE("search_bytes: a search holds the cells of its split and those of half of it, whatever the patches") {
        const BaseSurface base(test::cube());
        const Relief flat = test::relief(Image<float>(1, 1, 1), 1);
        const DisplaceOptions options;
        const DisplaceMemory memory(base, flat, options);
        const auto added = [&](std::uint32_t from, std::uint32_t to) {
            return memory.search_bytes(to) - memory.search_bytes(from);
        };
        // 1, 4 + 1, 16 + 4, 64 + 16 cells to a patch.
        CHECK(added(1, 2) > 0);
        CHECK(added(2, 4) * 4 == added(1, 2) * 15);
        CHECK(added(4, 8) == added(2, 4) * 4);
    }
}
