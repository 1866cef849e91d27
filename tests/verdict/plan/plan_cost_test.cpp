#include "bake/verdict/plan/plan_cost.h"
#include <doctest/doctest.h>

using namespace bake;

TEST_SUITE("unit") {
    TEST_CASE("plan_cost: map_bytes is the sum over all smaller levels") {
        CHECK(map_bytes(1, 1, 3) == 3);
        CHECK(map_bytes(2, 1, 3) == 9);
        CHECK(map_bytes(4, 4, 2) == 2 * (16 + 4 + 1));
        CHECK(map_bytes(8, 2, 1) == 16 + 4 + 2 + 1);
        // A third more than the picture itself.
        CHECK(double(map_bytes(1024, 1024, 3)) == doctest::Approx(4.0 * 1024 * 1024).epsilon(1e-5));
    }

    TEST_CASE("plan_cost: a level more is four times the triangles, meshes share bytes and not triangles") {
        const CostInput one{100, 1, 64, 64}, three{100, 3, 64, 64};
        const ShadeMethod coarse{Shade::displace, 2}, fine{Shade::displace, 3}, mapped{Shade::displace_normal, 3};
        CHECK(model_cost(one, coarse).triangles == 1600);
        CHECK(model_cost(one, fine).triangles == 6400);
        CHECK(model_cost(three, fine).triangles == 3 * 6400);
        CHECK(model_cost(three, fine).object_bytes == model_cost(one, fine).object_bytes);
        CHECK(model_cost(one, fine).texture_bytes == 0);
        CHECK(model_cost(one, mapped).texture_bytes == map_bytes(64, 64, 3));
        CHECK(model_cost(one, mapped).object_bytes ==
              model_cost(one, fine).object_bytes + model_cost(one, mapped).texture_bytes);
        CHECK(model_cost(one, {Shade::bump}).texture_bytes == map_bytes(64, 64, 2));
        CHECK(model_cost(one, {Shade::plain}).texture_bytes == 0);
        CHECK(model_cost(one, {Shade::plain}).ms < model_cost(one, {Shade::bump}).ms);
        CHECK(model_cost(one, {Shade::bump}).ms < model_cost(one, fine).ms);
    }

    TEST_CASE("plan_rungs: all models without displacement, and grids from coarse to fine within limits") {
        for (const std::int64_t triangles : {1, 2, 12, 480, 70'000, 600'000}) {
            const std::vector<ShadeMethod> rungs = plan_rungs(triangles);
            REQUIRE(rungs.size() > 6);
            CHECK(rungs[0].shade == Shade::plain);
            CHECK_FALSE(displaces(rungs[4].shade));
            for (std::size_t i = 5; i < rungs.size(); i += 2) {
                CHECK(rungs[i].shade == Shade::displace);
                CHECK(rungs[i + 1].shade == Shade::displace_normal);
                CHECK(rungs[i].levels == rungs[i + 1].levels);
                CHECK((triangles << (2 * rungs[i].levels)) >= 400);
                CHECK((triangles << (2 * rungs[i].levels)) <= 600'000);
                // The reference can be four times finer per edge.
                CHECK(rungs[i].levels + 2 <= 10);
            }
        }
        // As it is, however fine it is.
        CHECK(plan_rungs(3'000'000).size() == 7);
        CHECK(plan_rungs(3'000'000).back().levels == 0);
    }
}
