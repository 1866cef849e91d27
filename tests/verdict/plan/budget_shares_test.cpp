#include "bake/verdict/plan/budget_shares.h"
#include <doctest/doctest.h>

using namespace bake;

TEST_SUITE("unit") {
    TEST_CASE("share_budget: an object takes a cheaper model if the others leave enough of the frame's budget") {
        // B^2 = 1. The first object needs nothing, the second one would be 1.5 with its cheaper model.
        std::vector<SharingObject> objects(2);
        objects[0] = {{100}, {{10, 0}}};
        objects[1] = {{100}, {{1000, 0.5}, {100, 1.5}}};
        CHECK(share_budget(objects, 1) == std::vector<int>{0, 1});
        // As much smaller as the first one is, the frame would be over its budget.
        objects[0].area = {49};
        CHECK(share_budget(objects, 1) == std::vector<int>{0, 0});
        objects[0].area = {51};
        CHECK(share_budget(objects, 1) == std::vector<int>{0, 1});
        // In the picture of a second camera only the second object is seen.
        objects[0].area = {51, 0}, objects[1].area = {100, 100};
        CHECK(share_budget(objects, 1) == std::vector<int>{0, 0});
    }

    TEST_CASE("share_budget: no object takes more than twice its part") {
        std::vector<SharingObject> objects(2);
        objects[0] = {{1e6}, {{10, 0}}};
        objects[1] = {{1}, {{1000, 0.5}, {100, 1.9}, {50, 2.1}}};
        CHECK(share_budget(objects, 1) == std::vector<int>{0, 1});
    }

    TEST_CASE("share_budget: what saves most per error comes first") {
        std::vector<SharingObject> objects(2);
        // Both steps fit alone, and together they do not.
        objects[0] = {{100}, {{1000, 0.5}, {900, 1.4}}};
        objects[1] = {{100}, {{1000, 0.5}, {100, 1.4}}};
        CHECK(share_budget(objects, 1) == std::vector<int>{0, 1});
        // A dearer option with less error than the choice is no step.
        objects[0] = {{100}, {{1000, 0.5}, {1100, 0.1}}};
        CHECK(share_budget(objects, 1)[0] == 0);
    }
}
