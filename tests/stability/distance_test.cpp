#include "stability/coarse.h"

using namespace stability;

TEST_SUITE("stability") {

    TEST_CASE(
        "sweep far_positions: half a step of the stored floats, and a note where that is above 1e-6 of the size") {
        for (const Row& row : coarse("far_positions", 7)) {
            CAPTURE(row.series);
            CAPTURE(row.x);
            CHECK(row.measured < 4 * *row.predicted);
            if (row.series == "32-bit positions" && row.measured > 1e-5) CHECK(row.program.starts_with("a note"));
        }
    }

    TEST_CASE(
        "sweep far_verbs: up to 1e8 the verbs make of a far mesh what they make of a near one; a scene says when not") {
        for (const Row& row : coarse("far_verbs", 3)) { // 1, 1e8, 1e16
            CAPTURE(row.series);
            CAPTURE(row.x);
            if (row.series != "render" && row.x < 1e9) CHECK(row.measured < 1e-3);
            // A pixel at the contour may change with the last digit.
            if (row.series == "render" && row.measured > 0.1) CHECK(row.program.starts_with("a note"));
            if (row.series == "render" && row.x < 1e3) CHECK(row.program == "exit 0");
        }
    }

    TEST_CASE(
        "sweeps large_objects, small_objects: pictures are the same from 1e-30 to 1e18, with relief from 1e-12 on, "
        "else it is told") {
        for (const char* name : {"large_objects", "small_objects"})
            for (const Row& row : coarse(name, 11)) {
                CAPTURE(row.series);
                CAPTURE(row.x);
                if (row.measured > 0.01) CHECK(row.program != "exit 0");
                if (row.x > 1e-10 && row.x < 9e17) CHECK(row.measured < 0.01);
            }
    }

    TEST_CASE("sweep needles: no ray gets through, and the normal turns by no more than rounding does") {
        for (const Row& row : coarse("needles", 10)) {
            CAPTURE(row.x);
            if (row.series == "share of rays lost") CHECK(row.measured == 0);
            else CHECK(row.measured <= 4 * *row.predicted + 1e-5);
        }
    }
}
