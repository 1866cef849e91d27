// A plan as text and as JSON.
#include "bake/verdict/plan/texture_form.h"
#include "verdict/plan/hand_made_plan.h"
#include <doctest/doctest.h>
#include <limits>
#include <nlohmann/json.hpp>

using namespace bake;
using namespace bake::test;

namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("plan text: the model, its error with the interval, the budget, the neighbours, what it saves and why") {
        const std::string text = to_text(small_plan());
        // 0.008 sqrt(1 -+ 0.2)
        for (const char* part :
             {"1 object within rmse 0.0100 (normal)", "front, top; the worst one counts",
              "  ring             bump                   0.0080  0.0072 to 0.0088       0.0100       2000     0.008",
              "    why          bump is enough\n", "    worst view   front, 500 pixels; mean flip 0.0160\n",
              "    cheaper      roughness: skipped; 2000 triangles, 0.008 MB of textures, 0.25 ms; a reason\n",
              "    dearer       displace:4: rmse 0.0020 (0.0018 to 0.0022); 32000 triangles",
              "against displace:64: 8.19 M triangles, 899.600 MB in all, 5 ms; against an RGB8 normal map: 0.002 MB",
              "each sample clamped to [0, 1]"})
            CHECK_MESSAGE(has(text, part), std::string(part) << "\n" << text);
        CHECK_FALSE(has(text, "not settled"));
        CHECK_FALSE(has(text, "OVER"));
    }

    TEST_CASE("plan text: what is not settled is marked, and a bound is told from a probe") {
        ScenePlan plan = small_plan();
        plan.objects[0].rungs[2].known = Known::not_settled;
        CHECK(has(to_text(plan), "    not settled  "));
        plan.objects[0].rungs[3].known = Known::not_settled;
        CHECK(has(to_text(plan), "displace:4: rmse 0.0020 (0.0018 to 0.0022), not settled;"));
        plan.objects[0].rungs[2].known = Known::bound;
        plan.objects[0].rungs[2].bound = 0.0031;
        CHECK(has(to_text(plan), "<=0.0031  at most 0.0031"));
    }

    TEST_CASE("plan text: without a choice it is the reference, and the last rung is the cheaper one") {
        ScenePlan plan = small_plan();
        plan.objects[0].chosen = -1;
        const std::string text = to_text(plan);
        CHECK(has(text, "  ring             displace:64                 0  the reference"));
        CHECK(has(text, "cheaper      displace:8: not tried"));
        CHECK_FALSE(has(text, "dearer"));
        plan.objects[0].rungs.clear();
        CHECK_FALSE(has(to_text(plan), "cheaper"));
    }

    TEST_CASE("plan text: names are printed as one line") {
        ScenePlan plan = small_plan();
        plan.objects[0].object = "a\x1b[2J\nb";
        plan.notes = {"c\nd"};
        CHECK(has(to_text(plan), "a\\x1b[2J\\nb"));
        CHECK(has(to_text(plan), "c\\nd"));
    }

    TEST_CASE("plan text: verification, textures, sky and lights") {
        ScenePlan plan = small_plan();
        plan.verified.push_back({.camera = "top", .object = "", .predicted = {}, .measured = {.square = 1e-4}});
        plan.textures.push_back(
            {.file = "a.png", .kind = "normal", .width = 64, .height = 32, .channels = 2, .why = "w"});
        plan.textures[0].bits = bc5_bits, plan.textures[0].source_channels = 3, plan.textures[0].source_bits = 8;
        plan.sky = SkyPlan{.model = "faces", .face = 32, .levels = 3, .why = "s"};
        plan.lights.push_back({.light = 1, .keep = true, .shadows = false});
        plan.over_budget = true;
        const std::string text = to_text(plan);
        for (const char* part :
             {"(whole picture)", "0.0100 (0.0100 to 0.0100)", "OVER the budget", "a.png, normal: 64 x 32, BC5, ",
              "3 channels of 8 bits, ", "faces: faces of 32, 3 levels", "light 2", "stays, without shadows",
              "over the budget"})
            CHECK_MESSAGE(has(text, part), std::string(part) << "\n" << text);
    }

    TEST_CASE("plan JSON: the same numbers, and no infinite ones") {
        ScenePlan plan = small_plan();
        plan.textures.push_back({.bits = bc5_bits, .rgb8_rmse = 0.25}), plan.textures.push_back({.bits = 8});
        plan.budget.value = plan.objects[0].budget = std::numeric_limits<double>::infinity();
        const auto json = nlohmann::json::parse(to_json(plan, "s.toml"));
        CHECK(json["scene"] == "s.toml");
        CHECK(json["budget"]["value"] == "inf");
        CHECK(json["textures"][0]["bc5"] == true);
        CHECK(json["textures"][0]["rgb8_rmse"] == 0.25);
        CHECK(json["textures"][1]["bc5"] == false);
        CHECK(json["textures"][1]["rgb8_rmse"].is_null());
        const auto& object = json["objects"][0];
        CHECK(object["model"] == "bump");
        CHECK(object["chosen"] == 2);
        CHECK(object["settled"] == true);
        REQUIRE(object["rungs"].size() == 5);
        CHECK(object["rungs"][2]["error"]["rmse"] == doctest::Approx(0.008));
        CHECK(object["rungs"][2]["error"]["low"] == doctest::Approx(0.008 * std::sqrt(0.8)));
        CHECK(object["rungs"][1]["known"] == "skipped");
        CHECK_FALSE(object["rungs"][1].contains("error"));
        CHECK_FALSE(object["rungs"][4].contains("error"));
        CHECK(object["saved"]["triangles"] == 8190000);
        CHECK(object["saved"]["bytes_against_rgb8"] == 2000);
        plan.objects[0].chosen = -1;
        const auto without = nlohmann::json::parse(to_json(plan, "s.toml"))["objects"][0];
        CHECK(without["model"] == "displace:64");
        CHECK(without["chosen"].is_null());
        CHECK(without["saved"]["triangles"] == 0);
    }
}
