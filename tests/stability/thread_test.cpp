#include "stability/coarse.h"

using namespace stability;

TEST_SUITE("stability") {

    TEST_CASE("sweep thread_counts: every verb writes the same bytes with 1, 2 and 7 threads") {
        for (const Row& row : coarse("thread_counts", 2)) {
            CAPTURE(row.series);
            CAPTURE(row.x);
            CHECK(row.measured == 0);
        }
    }
}
