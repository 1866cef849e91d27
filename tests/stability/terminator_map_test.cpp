#include "stability/terminator_map.h"
#include <doctest/doctest.h>

using namespace bake::test;

TEST_SUITE("stability") {

    TEST_CASE("terminator map: rules differ where relief is steep and the sun is low, as against true displacement") {
        TerminatorMapOptions few;
        few.cases = {"plane 30 lambert", "sphere lambert"}, few.slopes = {0.125, 2}, few.heights_deg = {5, 60};
        few.edge = 24, few.spp = 4, few.azimuths = 2, few.segments = 64;
        const std::vector<TerminatorRow> rows = terminator_map(few);
        REQUIRE(rows.size() == 8);
        const auto at = [&](const char* name, double slope, double height) {
            for (const TerminatorRow& row : rows)
                if (row.name == name && row.slope == slope && row.height_deg == height) return row;
            return TerminatorRow{};
        };
        const TerminatorRow gentle = at("plane 30 lambert", 0.125, 60), steep = at("plane 30 lambert", 2, 5);
        // Little relief under a high sun: nothing needs mending, and all rules are right.
        for (const double rmse : gentle.rmse) CHECK(rmse < 0.01 * gentle.truth);
        // Steep relief under a low sun: the shadows that bump does not cast are what estevez and chiang stand for.
        CHECK(steep.rmse[0] > steep.truth);
        CHECK(steep.rmse[3] < 0.7 * steep.rmse[0]);
        CHECK(steep.rmse[4] < 0.7 * steep.rmse[0]);
        CHECK(steep.best() >= 3);
        // At the rim of a sphere normals face away: turning them helps, whatever the sun.
        const TerminatorRow rim = at("sphere lambert", 0.125, 60);
        CHECK(rim.rmse[2] < rim.rmse[0]);
    }
}
