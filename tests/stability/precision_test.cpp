#include "stability/coarse.h"

using namespace stability;

TEST_SUITE("stability") {

    TEST_CASE("sweeps float_lookup, float_light, float_ray: floats are off from double by their rounding, within a "
              "factor of 4") {
        for (const char* name : {"float_lookup", "float_light", "float_ray"})
            for (const Row& row : coarse(name, 4)) {
                CAPTURE(name);
                CAPTURE(row.x);
                CHECK(row.measured < 4 * *row.predicted + 1e-6);
            }
    }
}
