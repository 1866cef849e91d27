#include "bake/verdict/metric/false_colour.h"
#include "verdict/metric/pictures.h"
#include <doctest/doctest.h>

using namespace bake;

namespace {

float luma(const Vec3f& c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; }

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("false_colour: colours number 0, 100, 128, 200 and 255 of the published table, to three levels") {
        struct Known {
            int number;
            Vec3f levels;
        };
        const Known known[] = {{0, {0, 0, 4}},
                               {100, {137, 40, 129}},
                               {128, {183, 55, 121}},
                               {200, {253, 152, 105}},
                               {255, {252, 253, 191}}};
        for (const Known& k : known) {
            const Vec3f difference = 255.0f * magma(float(k.number) / 255) - k.levels;
            for (int c = 0; c < 3; ++c) CHECK(std::abs(difference[c]) <= 3);
        }
    }

    TEST_CASE("false_colour: it grows lighter all the way, without a jump, and clamps") {
        for (int i = 0; i < 1000; ++i) {
            CHECK(luma(magma((i + 1) / 1000.0f)) > luma(magma(i / 1000.0f)));
            CHECK(glm::length(magma((i + 1) / 1000.0f) - magma(i / 1000.0f)) < 0.01f);
        }
        CHECK(magma(-1) == magma(0));
        CHECK(magma(2) == magma(1));
        CHECK(glm::length(magma(1) - Vec3f(252, 253, 191) / 255.0f) < 1e-6f);
    }

    TEST_CASE("false_colour: a picture has the colour of each error over the largest") {
        const Image<float> errors = test::picture(5, 3, 1, [](int x, int y, int) { return x + 0.5 * y; });
        const Image<float> shown = false_colour(errors, 4);
        REQUIRE(shown.channels() == 3);
        for (int y = 0; y < 3; ++y)
            for (int x = 0; x < 5; ++x)
                for (int c = 0; c < 3; ++c) CHECK(shown.at(x, y, c) == magma((x + 0.5f * y) / 4)[c]);
    }
}
