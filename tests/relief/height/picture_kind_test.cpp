#include "bake/relief/height/picture_kind.h"
#include <cmath>
#include <doctest/doctest.h>

using namespace bake;

namespace {

/// What a map of unit normals looks like whose mean leans by `x` and `y`.
Looks leaning(double x, double y) {
    Image<float> image(32, 32, 3);
    for (int j = 0; j < 32; ++j)
        for (int i = 0; i < 32; ++i) {
            const double s = x + (i % 2 ? 0.3 : -0.3), t = y + (j % 2 ? 0.3 : -0.3);
            const double n[3] = {s, t, std::sqrt(1 - s * s - t * t)};
            for (int c = 0; c < 3; ++c) image.at(i, j, c) = float(0.5 + 0.5 * n[c]);
        }
    ImageInfo info;
    info.type = SampleType::u8;
    info.bits = 8;
    return guess_kind(image, info).looks;
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("guess_kind: a map of normals may lean as a whole by 0.15, along x and along y") {
        for (const double lean : {-0.145, 0.0, 0.145}) {
            CHECK(leaning(lean, 0) == Looks::normal_map);
            CHECK(leaning(0, lean) == Looks::normal_map);
        }
        for (const double lean : {-0.155, 0.155}) {
            CHECK(leaning(lean, 0) == Looks::colour);
            CHECK(leaning(0, lean) == Looks::colour);
        }
    }
}
