#include "stability/coarse.h"

using namespace stability;

TEST_SUITE("stability") {

    TEST_CASE("sweep texel_solid_angles: the sum is 4 pi; one texel loses digits by cancellation, no more") {
        for (const Row& row : coarse("texel_solid_angles", 4)) {
            CAPTURE(row.x);
            CHECK(row.measured <= 20 * *row.predicted + 1e-13);
        }
    }

    TEST_CASE("sweep cube_seams: lookups do not jump across edges and corners") {
        for (const Row& row : coarse("cube_seams", 4)) {
            CAPTURE(row.series);
            CAPTURE(row.x);
            CHECK(row.measured < 0.05);
        }
    }

    TEST_CASE(
        "sweep short_directions: a direction has its point at any length, down to the digits that denormals have") {
        for (const Row& row : coarse("short_directions", 12)) {
            CAPTURE(row.series);
            CAPTURE(row.x);
            CHECK(row.measured <= 4 * *row.predicted);
        }
    }

    TEST_CASE("sweep sun_flux: a sun of one texel keeps its flux in every mip, wherever it is") {
        for (const Row& row : coarse("sun_flux", 4)) {
            CAPTURE(row.series);
            CAPTURE(row.x);
            CHECK(row.measured < 3e-6);
        }
    }

    TEST_CASE("sweep sun_bands: few bands are off by the tail of the series, the direct sum is not") {
        for (const Row& row : coarse("sun_bands", 4)) {
            CAPTURE(row.series);
            CAPTURE(row.x);
            CHECK(std::abs(row.measured - *row.predicted) < 2e-3);
        }
    }

    TEST_CASE("sweep latlong_pole: directions come back to 1e-8, and values agree at the pole") {
        for (const Row& row : coarse("latlong_pole", 7)) {
            CAPTURE(row.series);
            CAPTURE(row.x);
            CHECK(row.measured < 3 * *row.predicted + 1e-7);
        }
    }
}
