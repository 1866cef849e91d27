#include "bake/base/edit_distance.h"
#include <doctest/doctest.h>

using namespace bake;

TEST_SUITE("unit") {

    TEST_CASE("edit_distance: counts letters inserted, deleted, replaced and swapped; it is symmetric") {
        CHECK(edit_distance("", "") == 0);
        CHECK(edit_distance("", "abc") == 3);
        CHECK(edit_distance("torus", "torus") == 0);
        CHECK(edit_distance("tours", "torus") == 1); // swapped, not replaced twice
        CHECK(edit_distance("kitten", "sitting") == 3);
        CHECK(edit_distance("ca", "abc") == 3); // a letter that was swapped is not changed again
        CHECK(edit_distance("sphere", "shpeer") == edit_distance("shpeer", "sphere"));
    }

} // TEST_SUITE
