#include "bake/base/interruption.h"
#include "bake/base/progress.h"
#include "bake/verdict/plan/plan.h"
#include "verdict/compare/relief_scene.h"
#include <csignal>
#include <doctest/doctest.h>

using namespace bake;
using test::relief_scene;

namespace {

/// So many balls in a row, each with a mesh of its own.
SceneEntries row_of_balls(int count, float amplitude) {
    SceneEntries entries = relief_scene("sphere:R=1", amplitude);
    const MeshEntry ball = entries.meshes[0];
    entries.meshes.clear();
    for (int i = 0; i < count; ++i) {
        MeshEntry mesh = ball;
        mesh.name = "ball " + std::to_string(i);
        mesh.shape = "sphere:R=" + std::to_string(1 + 1e-4 * i);
        mesh.placement.translate = Vec3f(2.2f * (float(i) - 0.5f * float(count - 1)), 0, 0);
        entries.meshes.push_back(mesh);
    }
    entries.cameras[0].position = Vec3f(0, 1, 4 + 1.5f * float(count));
    return entries;
}

const Rung& chosen(const ObjectPlan& plan) {
    REQUIRE(plan.chosen >= 0);
    return plan.rungs[std::size_t(plan.chosen)];
}

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("plan_scene: objects are decided together, and each holds its budget in the picture of all") {
        SceneEntries entries = row_of_balls(2, 0.1f);
        MaterialEntry calm = entries.materials[0];
        calm.name = "calm", calm.relief.amplitude = 1e-4f;
        entries.materials.push_back(calm);
        entries.meshes[1].material = 1;
        entries.ground.emplace();
        PlanOptions options;
        options.neighbours = false, options.verify = true;
        options.budget.value = 0.02;
        const ScenePlan plan = plan_scene(entries, options);
        REQUIRE(plan.objects.size() == 2);
        CHECK(chosen(plan.objects[1]).method.shade == Shade::plain);
        CHECK(chosen(plan.objects[0]).method.shade != Shade::plain);
        CHECK_FALSE(plan.over_budget);
        CHECK(plan.verified.size() == 3);
        // Two materials where there was one, because the methods differ.
        const SceneEntries planned = planned_entries(entries, plan);
        CHECK(planned.meshes[0].material != planned.meshes[1].material);
    }

    TEST_CASE("plan_scene: what is decided when the user stops it is kept") {
        SceneEntries entries = row_of_balls(3, 0.0f);
        PlanOptions options;
        options.neighbours = false;
        int told = 0;
        catch_interrupts();
        options.told = [&](const std::string&) {
            if (++told == 2) std::raise(SIGINT);
        };
        const ScenePlan plan = plan_scene(entries, options);
        CHECK(plan.interrupted);
        REQUIRE(plan.objects.size() == 2);
        CHECK(plan.objects[1].object == "ball 1");
        CHECK_FALSE(interrupted()); // files can be written
    }
}

TEST_SUITE("stability") {
    TEST_CASE("plan_scene: many objects are judged in groups") {
        SceneEntries entries = row_of_balls(12, 0.1f);
        for (MeshEntry& mesh : entries.meshes) mesh.columns = mesh.rows = 4;
        entries.settings.exposure = 0;
        PlanOptions options;
        options.neighbours = false;
        options.budget.value = 0.1;
        const ScenePlan plan = plan_scene(entries, options);
        REQUIRE(plan.objects.size() == 12);
        for (const ObjectPlan& object : plan.objects) CHECK(object.chosen >= 0);
    }
}
