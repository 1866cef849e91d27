#include "stability/coarse.h"

using namespace stability;

TEST_SUITE("stability") {

    TEST_CASE(
        "sweep method_warning: the error that the note tells is within a factor of 2 of the one measured, and the "
        "note comes when it is larger than one step of 8 bits") {
        for (const Row& row : coarse("method_warning", 4)) {
            CAPTURE(row.series);
            CAPTURE(row.x);
            CHECK((row.program == "no note") == (*row.predicted <= 0.318));
            if (row.measured < 0.05) continue; // where the errors of mesh and filter have a part
            CHECK(row.measured / *row.predicted > 0.5);
            CHECK(row.measured / *row.predicted < 2);
        }
    }
}
