// The sentence of a decision.
#include "bake/verdict/plan/relief_facts.h"
#include <doctest/doctest.h>

using namespace bake;

TEST_SUITE("unit") {

    TEST_CASE("why_enough: sizes, contour and light in a sentence") {
        const ReliefFacts facts{.height_px = 0.4, .sun_above_horizon_deg = 31.2, .in_view = true};
        CHECK(why_enough({Shade::bump}, facts) == "bump is enough: the relief is up to 0.4 px high, no relief lies "
                                                  "within 3 px of a contour, the lowest light "
                                                  "stands 31 deg above the horizon angle of the relief");
    }

    TEST_CASE("why_enough: only what matters is told") {
        ReliefFacts facts{.height_px = 12.3, .contour_px = 0.001, .most_bend = 0.02, .in_view = true};
        CHECK(why_enough({Shade::displace, 4}, facts) ==
              "displace:16 is enough: the relief is up to 12 px high, the outline "
              "moves by less than 0.01 px");
        facts.sun_above_horizon_deg = -5;
        const std::string bump = why_enough({Shade::bump}, facts), plain = why_enough({Shade::plain}, facts);
        CHECK(bump.find("stands 5 deg below the horizon angle of the relief, which casts shadows") !=
              std::string::npos);
        CHECK(bump.ends_with("max |height x curvature| is 0.02"));
        CHECK(plain.find("curvature") == std::string::npos);
        CHECK(why_enough({Shade::plain}, {}) == "plain is enough: no part of the object lies in the picture");
    }
}
