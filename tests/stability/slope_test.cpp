#include "stability/coarse.h"

using namespace stability;

namespace {

/// Every row of a sweep is its closed form, up to a relative and an absolute difference.
void check_closed_form(const std::string& name, int steps, double relative, double absolute = 1e-9) {
    for (const Row& row : coarse(name, steps)) {
        CAPTURE(name);
        CAPTURE(row.series);
        CAPTURE(row.x);
        CHECK(std::abs(row.measured - *row.predicted) <= relative * *row.predicted + absolute);
    }
}

} // namespace

TEST_SUITE("stability") {

    TEST_CASE(
        "sweep filter_frequency: the loss of every filter is that of its gain, up to Nyquist, where all is lost") {
        check_closed_form("filter_frequency", 5, 1e-6, 1e-8);
        for (const Row& row : coarse("filter_frequency", 2))
            if (row.x == 1) CHECK(row.measured == doctest::Approx(1));
    }

    TEST_CASE("sweep wrap_border: the error is that of the neighbour which the wrap mode supplies; a note tells of "
              "pictures that break off, if they repeat") {
        check_closed_form("wrap_border", 5, 1e-6);
        for (const Row& row : coarse("wrap_border", 3)) {
            const bool breaks = row.series == "repeat" && row.x == 4.5;
            CHECK((row.program != "no note") == breaks);
            if (row.series == "clamp") CHECK(row.measured < 0.1);
        }
    }

    TEST_CASE("sweep step_edge: the steepest slope of an edge is limited by the filter's taps") {
        check_closed_form("step_edge", 5, 1e-4, 1e-6);
    }

    TEST_CASE(
        "sweep height_levels: the tilt by levels is white noise under the filter, where relief crosses many of them") {
        for (const Row& row : coarse("height_levels", 5)) {
            CAPTURE(row.series);
            CAPTURE(row.x);
            if (row.x > 0.05) continue; // neighbours lie on one level: the noise is no longer white
            CHECK(row.measured == doctest::Approx(*row.predicted).epsilon(0.15));
        }
    }

    TEST_CASE("sweep half_heights: the tilt by the spacing of halves grows with the offset") {
        for (const Row& row : coarse("half_heights", 4))
            if (*row.predicted < 10) // from then on few levels are left of the relief
                CHECK(row.measured == doctest::Approx(*row.predicted).epsilon(0.3));
    }

    TEST_CASE("sweep texel_aspect: texels read as square are off by asin((a - 1) / (a + 1)), world units are right") {
        check_closed_form("texel_aspect", 5, 0.002, 2e-4);
    }

    TEST_CASE("sweep steep_slope: a normal map's error stays below that of its encoding, from flat to slopes of 1e4") {
        for (const Row& row : coarse("steep_slope", 7)) {
            CAPTURE(row.series);
            CAPTURE(row.x);
            CHECK(row.measured <= *row.predicted * 1.001);
            CHECK(row.measured >= *row.predicted / 50);
        }
    }
}
