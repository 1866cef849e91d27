#include "stability/coarse.h"

using namespace stability;

TEST_SUITE("stability") {

    TEST_CASE(
        "sweep minified_highlight: moments keep the brightness of waves along both axes, means of slopes do not") {
        for (const Row& row : coarse("minified_highlight", 4)) {
            CAPTURE(row.series);
            CAPTURE(row.x);
            if (row.series == "moments, both axes") CHECK(row.measured < 0.06);
            if (row.series == "moments, one axis" && row.x >= 100) CHECK(row.measured > 0.1); // not isotropic
            if (row.x >= 100 && row.predicted) CHECK(row.measured == doctest::Approx(*row.predicted).epsilon(0.01));
        }
    }

    TEST_CASE("sweep minified_variance: mean and variance of slopes are their second moment at every width") {
        for (const Row& row : coarse("minified_variance", 9)) {
            CAPTURE(row.x);
            if (row.series == "mean and variance together") CHECK(std::abs(row.measured - 1) < 0.05);
            else CHECK(row.measured < *row.predicted + 0.01); // no wider than a box
        }
    }
}
