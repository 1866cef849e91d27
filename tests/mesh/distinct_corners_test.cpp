#include "bake/mesh/distinct_corners.h"
#include <doctest/doctest.h>
#include <random>

using namespace bake;

namespace {

/// Corners with a position and a kind; two are the same if both are equal.
struct Kinds {
    std::vector<std::uint32_t> position, kind;
    std::size_t positions;

    Kinds(int corners, int count, int kinds) : positions(std::size_t(count)) {
        std::mt19937 random(2);
        for (int i = 0; i < corners; ++i) {
            position.push_back(std::uint32_t(random()) % std::uint32_t(count));
            kind.push_back(std::uint32_t(random()) % std::uint32_t(kinds));
        }
    }
    /// `key` need not tell all kinds apart.
    DistinctCorners numbered(std::uint32_t keys) const {
        return distinct_corners(
            position.size(), positions, [&](std::uint32_t c) { return position[c]; },
            [&](std::uint32_t c) { return std::uint64_t(kind[c] % keys); },
            [&](std::uint32_t a, std::uint32_t b) { return kind[a] == kind[b]; });
    }
};

} // namespace

TEST_SUITE("oracle") {
    TEST_CASE("distinct_corners: numbers ascend by position, then by first appearance, as found one by one") {
        // The last has more corners at one position than are compared all with all, and keys that several kinds share.
        for (const auto& [corners, positions, kinds] : {std::tuple(2000, 300, 1), {2000, 300, 3}, {3000, 5, 200}}) {
            const Kinds k(corners, positions, kinds);
            std::vector<std::uint32_t> number(k.position.size()), first;
            for (std::uint32_t p = 0; p < k.positions; ++p) {
                const std::size_t before = first.size();
                for (std::uint32_t c = 0; c < k.position.size(); ++c) {
                    if (k.position[c] != p) continue;
                    std::size_t i = before;
                    while (i < first.size() && k.kind[first[i]] != k.kind[c]) ++i;
                    if (i == first.size()) first.push_back(c);
                    number[c] = std::uint32_t(i);
                }
            }
            for (const std::uint32_t keys : {1u, 7u, 1000u}) {
                const DistinctCorners found = k.numbered(keys);
                CHECK(found.corner == number);
                CHECK(found.first == first);
            }
        }
    }
}

TEST_SUITE("stability") {
    TEST_CASE("distinct_corners: no corners, unused positions, and the same for any number of threads") {
        CHECK(Kinds(0, 4, 1).numbered(1).first.empty());
        const Kinds k(300000, 40000, 3);
        const auto with = [&](int threads) {
            const ThreadLimit limit(threads);
            return k.numbered(2);
        };
        const DistinctCorners one = with(1);
        for (const int threads : {2, 7}) {
            const DistinctCorners many = with(threads);
            CHECK(many.corner == one.corner);
            CHECK(many.first == one.first);
        }
    }
}
