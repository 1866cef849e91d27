#include "stability/coarse.h"

using namespace stability;

TEST_SUITE("stability") {

    TEST_CASE("sweeps constant_scale: latitude, stretch and shear cost what the closed forms say") {
        for (const char* name : {"constant_scale_latitude", "constant_scale_stretch", "constant_scale_shear"})
            for (const Row& row : coarse(name, 6)) {
                CAPTURE(std::string(name));
                CAPTURE(row.x);
                CHECK(std::abs(row.measured - *row.predicted) <= 0.005 * *row.predicted + 1e-6);
            }
    }

    TEST_CASE("sweep pole: one 8-bit level tilts by 76.5 degrees in the last row") {
        const std::vector<Row> rows = coarse("pole", 6);
        for (const Row& row : rows) CHECK(row.measured == doctest::Approx(*row.predicted).epsilon(1e-3));
        CHECK(rows.back().measured == doctest::Approx(76.5).epsilon(0.001));
    }

    TEST_CASE(
        "sweep narrow_chart: relief is right on charts down to what floats resolve, mirrored or not, and narrower ones "
        "are told") {
        for (const Row& row : coarse("narrow_chart", 10)) {
            CAPTURE(row.series);
            CAPTURE(row.x);
            CHECK(row.measured <= 1.3 * *row.predicted + 1e-4);
            CHECK((row.program.find("no area") != std::string::npos) == (row.x < 3e-8));
        }
    }

    TEST_CASE("sweep uv_overlap: every texel of two faces is counted") {
        for (const Row& row : coarse("uv_overlap", 5)) CHECK(std::abs(row.measured - *row.predicted) < 0.01);
    }

    TEST_CASE("sweep uv_missing: every triangle without uvs is counted, and a mesh without any is refused") {
        for (const Row& row : coarse("uv_missing", 5)) {
            CHECK(row.measured == doctest::Approx(*row.predicted));
            CHECK((row.program.find("exit 4") == 0) == (row.x == 1));
        }
    }

    TEST_CASE("sweep seam_step: half the difference per edge by average, all of it by owner, less by blend") {
        for (const Row& row : coarse("seam_step", 4)) {
            CAPTURE(row.series);
            CAPTURE(row.x);
            if (row.predicted) CHECK(row.measured == doctest::Approx(*row.predicted).epsilon(0.01));
            else CHECK(row.measured < row.x / 6);
            CHECK((row.program.find("a note") != std::string::npos) == (row.series != "blend" && row.x > 3));
        }
    }
}
