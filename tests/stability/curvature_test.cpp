#include "stability/coarse.h"

using namespace stability;

TEST_SUITE("stability") {

    TEST_CASE(
        "sweep blinn_curvature: the worst angle of blinn is that of the closed form, for every kind of curvature") {
        for (const Row& row : coarse("blinn_curvature", 6)) {
            CAPTURE(row.x);
            CHECK(row.measured == doctest::Approx(*row.predicted).epsilon(0.005));
        }
    }

    TEST_CASE("sweep focal_radius: a step shrinks by 1 + b a, and is counted as folded from 0 on, past two focal radii "
              "too") {
        for (const Row& row : coarse("focal_radius", 6)) {
            CAPTURE(row.series);
            CAPTURE(row.x);
            CHECK(std::abs(row.measured - *row.predicted) < 1e-5);
            CHECK((row.program.find("folded") != std::string::npos) == (row.x > 1));
        }
    }

    TEST_CASE("sweep height_offset: blinn keeps the slope that the base surface gives it, exact does not") {
        for (const Row& row : coarse("height_offset", 5))
            CHECK(row.measured == doctest::Approx(*row.predicted).epsilon(1e-9));
    }
}
