#include "bake/verdict/chart/axis.h"
#include <cmath>
#include <doctest/doctest.h>
#include <limits>

using namespace bake;

namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

std::string numbers(const std::vector<double>& values, bool logarithmic, int wanted) {
    Axis axis = axis_of(values, logarithmic);
    lay_axis(axis, 0, 1000, 0);
    std::string out;
    for (const Tick& tick : ticks(axis, wanted))
        if (!tick.text.empty()) out += tick.text + " ";
    return out;
}

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("axis: a value stands at its share of the logarithm, or of the length") {
        Axis axis = axis_of({1, 100}, true);
        lay_axis(axis, 0, 1120, 0); // 6 % before and after the two decades
        CHECK(place_px(axis, 1) == doctest::Approx(60));
        CHECK(place_px(axis, 10) == doctest::Approx(560));
        CHECK(place_px(axis, 100) == doctest::Approx(1060));
        axis = axis_of({-5, 5}, false);
        lay_axis(axis, 1120, 0, 0); // as axes upwards are
        CHECK(place_px(axis, -5) == doctest::Approx(1060));
        CHECK(place_px(axis, 0) == doctest::Approx(560));
        CHECK(place_px(axis, 2.5) == doctest::Approx(310));
    }

    TEST_CASE("axis: values up to zero stand in a strip before the start of a logarithmic axis") {
        Axis axis = axis_of({0, 1, 100, -3}, true);
        REQUIRE(axis.strip);
        lay_axis(axis, 400, 0, 30);
        CHECK(axis.start_px == 370);
        CHECK(place_px(axis, 0) == 385);
        CHECK(place_px(axis, -3) == 385);
        CHECK(place_px(axis, 1) < 370);
        CHECK_FALSE(axis_of({0, 1, 100}, false).strip);
    }

    TEST_CASE("axis: ticks are 1, 2, 5, or powers of ten, or even steps, as the span asks") {
        CHECK(numbers({1, 100}, true, 8) == "1 2 5 10 20 50 100 ");
        CHECK(numbers({0.001, 10}, true, 8) == "0.001 0.01 0.1 1 10 ");
        CHECK(numbers({1e-7, 1e-4}, true, 8) == "1e-7 1e-6 1e-5 1e-4 ");
        CHECK(numbers({1e-12, 1e12}, true, 5) == "1e-12 1e-6 1 1e6 1e12 ");
        CHECK(numbers({2, 4}, true, 5) == "2 2.5 3 3.5 4 ");
        CHECK(numbers({0, 10}, false, 5) == "0 2 4 6 8 10 ");
        CHECK(numbers({-1, 1}, false, 5) == "-1 -0.5 0 0.5 1 ");
    }

    TEST_CASE("axis: one value, none, and values that cannot be drawn") {
        CHECK_FALSE(numbers({3}, true, 5).empty());
        CHECK_FALSE(numbers({3}, false, 5).empty());
        CHECK_FALSE(numbers({0, 0}, false, 5).empty());
        CHECK(numbers({0}, true, 5).empty());
        CHECK(numbers({}, true, 5).empty());
        CHECK(numbers({inf, -inf, std::nan("")}, false, 5).empty());
        CHECK_FALSE(is_drawable(inf));
        CHECK_FALSE(is_drawable(std::nan("")));
    }

    TEST_CASE("axis: for any span between 1e-300 and 1e300 every value lies on it, and there are 2 to 60 ticks, no two "
              "at one "
              "place") {
        for (int low = -300; low < 300; low += 37)
            for (double span : {1e-9, 0.1, 0.5, 1.0, 2.0, 7.0, 60.0, 299.0}) {
                if (low + span > 300) continue;
                for (const bool logarithmic : {true, false}) {
                    const double a = std::pow(10, low), b = std::pow(10, low + span);
                    Axis axis = axis_of({a, b}, logarithmic);
                    lay_axis(axis, 0, 500, 0);
                    CAPTURE(a);
                    CAPTURE(b);
                    CHECK(place_px(axis, a) > 0);
                    CHECK(place_px(axis, b) < 500);
                    const std::vector<Tick> all = ticks(axis, 6);
                    CHECK(all.size() >= 2);
                    CHECK(all.size() <= 60);
                    for (std::size_t i = 1; i < all.size(); ++i) CHECK(all[i].at > all[i - 1].at + 1);
                }
            }
    }
}
