#include "stability/coarse.h"

using namespace stability;

TEST_SUITE("stability") {

    TEST_CASE("sweep facing_away: a shading normal faces away from the slope cot(angle) on; the picture stays finite") {
        for (const Row& row : coarse("facing_away", 4)) {
            CAPTURE(row.x);
            CHECK(row.measured == doctest::Approx(*row.predicted).epsilon(1e-4));
            CHECK(row.program.starts_with("finite"));
        }
    }

    TEST_CASE("sweep mirror_below: the mirror direction is below the surface from the slope of the closed form on") {
        for (const Row& row : coarse("mirror_below", 4)) {
            CAPTURE(row.series);
            CAPTURE(row.x);
            CHECK(row.measured == doctest::Approx(*row.predicted).epsilon(1e-3));
            CHECK(row.program.starts_with("finite"));
        }
    }

    TEST_CASE("sweep horizon_step: light on a tilted normal ends in a step at the horizon, unless estevez or chiang "
              "fade it") {
        for (const Row& row : coarse("horizon_step", 5)) {
            CAPTURE(row.series);
            CAPTURE(row.x);
            CHECK(std::abs(row.measured - *row.predicted) < 0.02);
        }
    }
}
