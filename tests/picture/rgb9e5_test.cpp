#include "bake/picture/rgb9e5.h"
#include <cmath>
#include <doctest/doctest.h>
#include <initializer_list>
#include <limits>

using namespace bake;

TEST_SUITE("oracle") {
    TEST_CASE("rgb9e5: bits of the extension's own formula") {
        // 1 is 256 2^(16 - 24): the exponent 16 stands in the upper five bits.
        CHECK(rgb9e5_encode({1, 1, 1}) == (16u << 27 | 256u << 18 | 256u << 9 | 256u));
        CHECK(rgb9e5_encode({0, 0, 0}) == 0);
        CHECK(rgb9e5_encode({1, 0.5f, 0.25f}) == (16u << 27 | 64u << 18 | 128u << 9 | 256u));
        CHECK(rgb9e5_encode({65408, 0, 0}) == (31u << 27 | 511u));
        CHECK(rgb9e5_decode(31u << 27 | 511u)[0] == 65408);
        CHECK(rgb9e5_decode(1u)[0] == std::ldexp(1.0f, -24));
        // 511.6 of 512 steps rounds up to the next exponent.
        CHECK(rgb9e5_encode({511.6f / 256, 0, 0}) == (17u << 27 | 256u));
    }
}

TEST_SUITE("unit") {
    TEST_CASE("rgb9e5: what was decoded is encoded alike, and values are within half a step") {
        for (std::uint32_t i = 0; i < 4000; ++i) {
            const float v = std::exp2(float(i) / 4000 * 39 - 23), w = v * 0.37f;
            const auto [r, g, b] = rgb9e5_decode(rgb9e5_encode({v, w, 0}));
            const float step = std::max(v / 256, std::ldexp(1.0f, -24));
            CHECK(std::abs(r - v) <= step / 2);
            CHECK(std::abs(g - w) <= step / 2);
            CHECK(b == 0);
            CHECK(rgb9e5_decode(rgb9e5_encode({r, g, b}))[0] == r);
        }
    }

    TEST_CASE("rgb9e5: clamps what it cannot hold") {
        constexpr float infinity = std::numeric_limits<float>::infinity(),
                        nan = std::numeric_limits<float>::quiet_NaN();
        const auto [r, g, b] = rgb9e5_decode(rgb9e5_encode({infinity, nan, -5}));
        CHECK(r == rgb9e5_largest);
        CHECK(g == 0);
        CHECK(b == 0);
    }
}
