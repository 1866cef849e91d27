#include "bake/verdict/plan/plan_pictures.h"
#include "verdict/plan/hand_made_plan.h"
#include <doctest/doctest.h>

using namespace bake;
using namespace bake::test;

namespace {

ObjectDecision decision_of(const char* chosen, const char* reference, std::int64_t triangles) {
    ObjectDecision decision;
    decision.plan = shown_by("ball", chosen, {0});
    decision.plan.reference = *parse_shade(reference);
    decision.plan.reference_cost.triangles = triangles;
    return decision;
}

std::vector<std::string> fitting(const std::vector<ObjectDecision>& decisions, double most) {
    std::vector<std::string> names;
    for (const ShadeMethod& method : fitting_references(decisions, most)) names.push_back(name(method));
    return names;
}

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("fitting_references: the largest become coarser until all fit, but not coarser than what is planned") {
        std::vector<ObjectDecision> decisions;
        decisions.push_back(decision_of("bump", "displace:64", 4'000'000));
        decisions.push_back(decision_of("displace:16", "displace:32", 8'000'000));
        using Names = std::vector<std::string>;
        CHECK(fitting(decisions, 12e6) == Names{"displace:64", "displace:32"});
        CHECK(fitting(decisions, 11e6) == Names{"displace:64", "displace:16"}); // 4 M and 2 M
        CHECK(fitting(decisions, 5e6) == Names{"displace:32", "displace:16"});  // 1 M and 2 M
        CHECK(fitting(decisions, 1) == Names{"displace:1", "displace:16"});
        // The reference itself is planned.
        decisions[1].plan.chosen = -1;
        CHECK(fitting(decisions, 9e6) == Names{"displace:32", "displace:32"});
        CHECK(fitting({}, 1).empty());
    }
}
