#include "stability/coarse.h"

using namespace stability;

TEST_SUITE("stability") {

    TEST_CASE("sweep silhouette: the contour of bump is off by the projected height, that of displacement is right") {
        for (const Row& row : coarse("silhouette", 3)) {
            CAPTURE(row.series);
            CAPTURE(row.x);
            CHECK(std::abs(row.measured - *row.predicted) <
                  0.03 + 0.003 * *row.predicted); // pixels; chords of the mesh
        }
    }

    TEST_CASE("sweep self_shadow: displaced waves shadow as the closed form says, bump is dark where it faces away") {
        for (const Row& row : coarse("self_shadow", 6)) {
            CAPTURE(row.series);
            CAPTURE(row.x);
            CHECK(std::abs(row.measured - *row.predicted) < 0.005);
        }
    }

    TEST_CASE("sweep facet_shadow: facets cast no shadows on the lit side, however coarse") {
        for (const Row& row : coarse("facet_shadow", 3)) CHECK(row.measured == 0);
    }
}
