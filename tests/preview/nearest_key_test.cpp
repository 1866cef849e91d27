#include "bake/preview/nearest_key.h"
#include <doctest/doctest.h>

using namespace bake;

TEST_SUITE("unit") {

    TEST_CASE("nearest_key: one letter wrong, missing, doubled or swapped is near; another word is not") {
        const std::vector<std::string> keys = {"position", "target", "up", "fov-deg"};
        for (const char* word : {"pozition", "postion", "possition", "psoition", "Position", "pos"})
            CHECK_MESSAGE(nearest_key(word, keys) == "position", word);
        CHECK(nearest_key("fov_deg", keys) == "fov-deg");
        CHECK(nearest_key("fov", keys) == "fov-deg");
        for (const char* word : {"colour", "x", "", "exposure"}) CHECK_MESSAGE(nearest_key(word, keys).empty(), word);
        CHECK(nearest_key("pu", keys) == "up"); // swapped letters are one mistake
        CHECK(nearest_key("up", {}).empty());
    }

    TEST_CASE("nearest_key: the nearest of several near words") {
        CHECK(nearest_key("stones", {"stone", "store", "shores"}) == "stone");
        CHECK(nearest_key("shores1", {"stone", "store", "shores"}) == "shores");
    }

    TEST_CASE("did_you_mean: a question, or nothing") {
        CHECK(did_you_mean("golt", {"gold", "silver"}) == "did you mean \"gold\"?");
        CHECK(did_you_mean("bronze", {"gold", "silver"}).empty());
    }

} // TEST_SUITE
