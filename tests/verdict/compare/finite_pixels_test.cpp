#include "bake/base/error.h"
#include "bake/verdict/compare/finite_pixels.h"
#include "verdict/metric/pictures.h"
#include <doctest/doctest.h>
#include <limits>

using namespace bake;

namespace {

template <class Call> std::string refusal(const Call& call) {
    try {
        call();
    } catch (const Error& error) {
        CHECK(error.refusal == Refusal::unsuitable);
        return error.what();
    }
    return "";
}

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("finite_pixels: pixels are counted, not values, and the first is the one nearest to the top") {
        Image<float> image = test::noisy(6, 5, 1);
        const auto said = [&](int channels) {
            return refusal([&] { require_finite_pixels(image, channels, "a.exr"); });
        };
        CHECK(said(3).empty());
        image.at(4, 1, 0) = image.at(4, 1, 2) = std::numeric_limits<float>::quiet_NaN();
        CHECK(said(3) == "a.exr: 1 pixel is NaN or Inf, the first at column 4, row 1; give it a finite value");
        image.at(0, 3, 2) = -std::numeric_limits<float>::infinity();
        CHECK(said(3) == "a.exr: 2 pixels are NaN or Inf, the first at column 4, row 1; give them finite values");
        image.at(4, 1, 0) = 0;
        CHECK(said(2).empty()); // channels that are not compared do not count
    }

    TEST_CASE("finite_pixels: another size is refused with both sizes") {
        const Image<float> a(4, 3, 1), b(4, 2, 1);
        CHECK(refusal([&] { require_one_size(a, "a", a, "a"); }).empty());
        CHECK(refusal([&] { require_one_size(a, "a", b, "b"); }) ==
              "b: is 4 x 2, where a is 4 x 3; bring both to one size");
    }
}
