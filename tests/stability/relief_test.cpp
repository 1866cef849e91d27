#include "stability/coarse.h"

using namespace stability;

TEST_SUITE("stability") {

    TEST_CASE("sweep not_a_number: no texel of them is let through, and all are counted") {
        for (const Row& row : coarse("not_a_number", 4)) {
            CHECK(row.measured == *row.predicted);
            CHECK((row.program.find("exit 4") == 0) == (row.x > 0));
        }
    }

    TEST_CASE("sweep vector_fold: vectors that fold the surface are counted from the fold on") {
        for (const Row& row : coarse("vector_fold", 4)) {
            CAPTURE(row.series);
            CAPTURE(row.x);
            CHECK(row.measured == doctest::Approx(*row.predicted).epsilon(0.01));
            CHECK((row.program != "exit 0, no note") == (row.x > 1));
        }
    }

    TEST_CASE("sweeps valence: limit points and normals keep the documented error from valence 3 to 50") {
        for (const char* name : {"valence_position", "valence_normal"})
            for (const Row& row : coarse(name, 3)) {
                CAPTURE(row.series);
                CAPTURE(row.x);
                CHECK(row.measured <= *row.predicted);
            }
    }

    TEST_CASE("sweep float_normal: float keeps the normal at slopes from 1e-3 to 1e6, but for the rounding of a cross "
              "product") {
        for (const Row& row : coarse("float_normal", 6)) {
            CAPTURE(row.series);
            CAPTURE(row.x);
            CHECK(row.measured <= *row.predicted);
        }
    }

    TEST_CASE("sweep float_offset: slopes lose what floats round off an offset") {
        for (const Row& row : coarse("float_offset", 4)) {
            CAPTURE(row.series);
            CAPTURE(row.x);
            if (row.predicted) CHECK(row.measured == doctest::Approx(*row.predicted).epsilon(0.3));
        }
    }
}
