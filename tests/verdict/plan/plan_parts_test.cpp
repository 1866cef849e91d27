// Textures, sky and lights of a scene from entries, decided together.
#include "bake/verdict/plan/plan_parts.h"
#include "bake/verdict/plan/texture_plan.h"
#include "verdict/compare/relief_scene.h"
#include <doctest/doctest.h>

using namespace bake;
using namespace bake::test;

namespace {

/// A square with a baked map, a light before it and one behind it.
SceneEntries lit_square(Shade shade) {
    SceneEntries entries = relief_scene("plane", 0.01f);
    entries.materials[0].relief.shade = ShadeMethod{shade};
    entries.meshes[0].columns = entries.meshes[0].rows = 1;
    Light<float> below;
    below.from = Vec3f(0, -1, 0);
    entries.lights.push_back(below);
    entries.cameras[0].position = Vec3f(0, 1, 0.1f);
    entries.cameras[0].name = "top";
    entries.settings.exposure = 0;
    return entries;
}

PlanOptions everything() {
    PlanOptions options;
    options.decide_textures = options.decide_formats = options.decide_sky = options.decide_lights = true;
    return options;
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("plan parts: what was decided together is within the budget") {
        const SceneEntries entries = lit_square(Shade::normal);
        const PlanOptions options = everything();
        ScenePlan plan;
        plan_parts(entries, options, plan);
        CHECK(plan.exposure == 0);
        REQUIRE(plan.textures.size() == 1);
        CHECK(plan.textures[0].file == "ball");
        CHECK(plan.textures[0].kind == "normal");
        CHECK(plan.textures[0].bytes < plan.textures[0].source_bytes);
        CHECK(!plan.sky);
        REQUIRE(plan.lights.size() == 2);
        CHECK(plan.lights[0].keep);
        CHECK(!plan.lights[1].keep);
        CHECK(!plan.lights[0].shadows);
        // Of all decisions in one scene, with other random numbers.
        const Scene scene = load(entries);
        const SceneEntries decided = planned_entries(entries, plan);
        Scene planned = load(decided);
        round_textures(decided, plan, planned);
        CHECK(planned.lights.size() == 1);
        CHECK(!planned.settings.shadows);
        PartOptions other;
        other.seed = 5;
        WorstProbe probe(scene, frame_and_materials(scene), other);
        const double error = probe.measure(planned, 1 << 20).error.rmse();
        CHECK(error <= options.budget.value);
        CHECK(error > 0);
    }

    TEST_CASE("plan parts: the automatic exposure is that of the picture, of wide and of high ones") {
        for (const auto& [width, height] : {std::pair(24, 24), {300, 90}, {90, 300}}) {
            SceneEntries entries = relief_scene("sphere:R=1", 0.01f);
            entries.settings.exposure.reset();
            entries.settings.width = width, entries.settings.height = height, entries.settings.spp = 4;
            ScenePlan plan;
            PlanOptions options;
            options.decide_lights = true;
            plan_parts(entries, options, plan);
            const Scene scene = load(entries);
            CHECK(std::abs(plan.exposure - automatic_exposure(render(scene, scene.settings))) < 0.5);
        }
    }

    TEST_CASE("plan parts: sizes and formats are decided apart") {
        const SceneEntries entries = lit_square(Shade::bump);
        PlanOptions options;
        options.budget = {Budget::Metric::rmse, 1, "rmse=1"}; // everything is enough
        options.decide_textures = true;
        ScenePlan sizes, formats;
        plan_parts(entries, options, sizes);
        options.decide_textures = false, options.decide_formats = true;
        plan_parts(entries, options, formats);
        REQUIRE(sizes.textures.size() == 1);
        REQUIRE(formats.textures.size() == 1);
        CHECK(sizes.textures[0].width == 1);
        CHECK(sizes.textures[0].bits == 16);
        CHECK(!sizes.textures[0].half);
        CHECK(formats.textures[0].width == 32);
        CHECK(sizes.lights.empty());
    }

    TEST_CASE("plan parts: they share what the objects leave of the budget") {
        PlanOptions options = everything();
        options.budget.value = 0.05;
        ScenePlan plan;
        CHECK(part_budget(options, plan) == doctest::Approx(0.05 / std::sqrt(3.0)));
        plan.objects.emplace_back().rungs.emplace_back().error.square = 0.03 * 0.03;
        CHECK(part_budget(options, plan) == doctest::Approx(0.05 / std::sqrt(3.0))); // the reference was taken
        plan.objects[0].chosen = 0;
        options.decide_sky = options.decide_lights = false;
        CHECK(part_budget(options, plan) == doctest::Approx(0.04));
        plan.objects[0].rungs[0].error.square = 1;
        CHECK(part_budget(options, plan) == 0);
        options.budget = {Budget::Metric::flip, 0.02, "flip=.02"};
        plan.objects.clear();
        CHECK(part_budget(options, plan) == 0.01);
    }
}
