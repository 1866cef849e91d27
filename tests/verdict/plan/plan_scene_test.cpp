#include "bake/base/error.h"
#include "bake/base/parallel.h"
#include "bake/verdict/plan/plan.h"
#include "verdict/compare/relief_scene.h"
#include <algorithm>
#include <doctest/doctest.h>
#include <limits>

using namespace bake;
using test::relief_scene;

namespace {

PlanOptions with_budget(double value) {
    PlanOptions options;
    options.budget.value = value;
    options.neighbours = false;
    return options;
}

ObjectPlan plan_one(const SceneEntries& entries, double budget) {
    const ScenePlan plan = plan_scene(entries, with_budget(budget));
    REQUIRE(plan.objects.size() == 1);
    return plan.objects.front();
}

const Rung& chosen(const ObjectPlan& plan) {
    REQUIRE(plan.chosen >= 0);
    return plan.rungs[std::size_t(plan.chosen)];
}

/// Moves the heights by a constant.
void raise_heights(SceneEntries& entries, float by) {
    auto waves = std::make_shared<LoadedPicture>();
    const LoadedPicture& old = *entries.pictures.at("waves.exr");
    waves->image = copied(old.image), waves->info = old.info;
    for (std::size_t i = 0; i < waves->image.size(); ++i) waves->image.data()[i] += by;
    entries.pictures["waves.exr"] = waves;
}

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("plan_scene: what is chosen holds the budget in whole pictures, and what is cheaper does not") {
        const SceneEntries entries = relief_scene("sphere:R=1", 0.1f);
        PlanOptions options = with_budget(0.01);
        options.verify = true, options.neighbours = true;
        const ScenePlan plan = plan_scene(entries, options);
        REQUIRE(plan.objects.size() == 1);
        const ObjectPlan& object = plan.objects[0];
        CHECK(object.object == "ball");
        CHECK(object.material == "waves");
        CHECK(object.meshes == std::vector<int>{0});
        // Cheapest first.
        for (std::size_t i = 1; i < object.rungs.size(); ++i)
            CHECK(object.rungs[i - 1].cost.total(options.weights) <= object.rungs[i].cost.total(options.weights));
        const Rung& rung = chosen(object);
        CHECK(object.chosen > 0);
        CHECK(rung.error.rmse() <= 1.1 * 0.01);
        for (int i = 0; i < object.chosen; ++i)
            if (object.rungs[std::size_t(i)].known == Known::probe)
                CHECK(object.rungs[std::size_t(i)].error.high() > 0.9 * 0.01);
        CHECK(rung.flip > 0);
        CHECK_FALSE(plan.over_budget);
        REQUIRE(plan.verified.size() == 2);
        const Verification& seen = plan.verified[0];
        CHECK(seen.object == "ball");
        CHECK(seen.measured.rmse() < 1.1 * 0.01);
        CHECK(std::abs(seen.measured.square - seen.predicted.square) <
              4 * (seen.measured.error + seen.predicted.error) + 1e-6);
        CHECK(plan.verified[1].object.empty());
        CHECK(plan.verified[1].measured.rmse() < seen.measured.rmse());
        // As planned, the scene shows the chosen method.
        const SceneEntries planned = planned_entries(entries, plan);
        const MaterialEntry& material = planned.materials[std::size_t(planned.meshes[0].material)];
        REQUIRE(material.relief.shade);
        CHECK(name(*material.relief.shade) == name(rung.method));
    }

    TEST_CASE("plan_scene: the cheapest method too is verified against what was predicted of it") {
        PlanOptions options = with_budget(0.5);
        options.verify = true;
        const ScenePlan plan = plan_scene(relief_scene("sphere:R=1", 0.1f), options);
        REQUIRE(plan.objects.at(0).chosen == 0);
        REQUIRE(plan.verified.size() == 2);
        const Verification &object = plan.verified[0], &frame = plan.verified[1];
        CHECK(object.predicted.square == chosen(plan.objects[0]).error.square);
        CHECK(object.predicted.square > 0);
        CHECK(std::abs(object.measured.square - object.predicted.square) <
              4 * (object.measured.error + object.predicted.error) + 1e-6);
        CHECK(frame.predicted.pixels == 24 * 24);
        CHECK(frame.predicted.square * 24 * 24 ==
              doctest::Approx(object.predicted.square * double(object.measured.pixels)));
    }

    TEST_CASE("plan_scene: of cameras that contradict each other the worst counts; a larger budget costs less") {
        SceneEntries entries = relief_scene("sphere:R=1", 0.05f);
        entries.settings.exposure = 0;
        entries.cameras[0].name = "front";
        CameraEntry away = entries.cameras[0];
        away.name = "away", away.target = Vec3f(0, 1, 10);
        entries.cameras.push_back(away);
        const CostWeights weights;
        PlanOptions options = with_budget(0.01);
        const ObjectPlan both = plan_scene(entries, options).objects.at(0);
        options.cameras = {"front"};
        const ObjectPlan one = plan_scene(entries, options).objects.at(0);
        options.cameras = {"away"};
        const ObjectPlan other = plan_scene(entries, options).objects.at(0);
        CHECK(both.facts.size() == 2);
        CHECK(chosen(other).method.shade == Shade::plain);
        CHECK(chosen(other).cost.total(weights) < chosen(one).cost.total(weights));
        CHECK(name(chosen(both).method) == name(chosen(one).method));
        CHECK(chosen(both).camera == "front");
        options.cameras = {"front"}, options.budget.value = 0.2;
        CHECK(chosen(plan_scene(entries, options).objects.at(0)).cost.total(weights) < chosen(one).cost.total(weights));
    }

    TEST_CASE("plan_scene: the reference is fine where its error counts, and only there") {
        const SceneEntries entries = relief_scene("sphere:R=1", 1);
        constexpr double strict = 0.0015, loose = 0.05;
        const ObjectPlan shown = plan_one(entries, strict);
        CHECK(shown.reference_error <= 0.15 * strict);
        const ObjectPlan bumped = plan_one(entries, loose);
        CHECK(chosen(bumped).known == Known::probe);
        CHECK(chosen(bumped).error.high() + bumped.reference_error <= 1.1 * loose);
        CHECK(bumped.reference_error > 0.15 * strict);
        CHECK(bumped.reference.levels < shown.reference.levels);
    }

    TEST_CASE(
        "plan_scene: where no rung will do, the mesh of half the reference's segments is shown if that is enough") {
        const SceneEntries entries = relief_scene("sphere:R=1", 1);
        PlanOptions options = with_budget(0.0004);
        options.verify = true;
        const ScenePlan plan = plan_scene(entries, options);
        const ObjectPlan& object = plan.objects.at(0);
        const Rung& rung = chosen(object);
        CHECK(rung.method.shade == Shade::displace);
        CHECK(rung.method.levels == object.reference.levels - 1);
        CHECK(rung.cost.triangles * 4 == object.reference_cost.triangles);
        CHECK(rung.note.empty());
        CHECK_FALSE(plan.over_budget);
        CHECK(plan.verified.at(0).measured.rmse() > 0);
        CHECK(plan.verified.at(0).measured.rmse() <= 1.1 * options.budget.value);
        CHECK(plan_one(entries, 0.0001).chosen < 0);
    }

    TEST_CASE("plan_scene: the same plan for any number of threads") {
        const SceneEntries entries = relief_scene("sphere:R=1", 0.1f);
        const auto plan = [&](int threads) {
            const ThreadLimit limit(threads);
            return plan_one(entries, 0.02);
        };
        const ObjectPlan one = plan(1), two = plan(2);
        CHECK(one.chosen == two.chosen);
        CHECK(one.reference_error == two.reference_error);
        for (std::size_t i = 0; i < one.rungs.size(); ++i) {
            CHECK(one.rungs[i].error.square == two.rungs[i].error.square);
            CHECK(one.rungs[i].error.error == two.rungs[i].error.error);
        }
    }

    TEST_CASE("plan_scene: budgets of FLIP and of degrees are held in their own metric") {
        const SceneEntries entries = relief_scene("sphere:R=1", 0.1f);
        PlanOptions options = with_budget(3);
        options.budget.metric = Budget::Metric::degrees;
        options.verify = true;
        const ScenePlan degrees = plan_scene(entries, options);
        CHECK(chosen(degrees.objects.at(0)).error.rmse() <= 1.1 * 3);
        CHECK(chosen(degrees.objects.at(0)).error.rmse() > 0.01);
        CHECK_FALSE(degrees.over_budget);
        options.budget.metric = Budget::Metric::flip, options.budget.value = 0.05;
        options.verify = false;
        const ScenePlan flip = plan_scene(entries, options);
        CHECK(chosen(flip.objects.at(0)).error.rmse() <= 1.1 * 0.05);
        CHECK(flip.objects.at(0).rungs[0].error.rmse() > 0.05);
    }
}

TEST_SUITE("stability") {
    TEST_CASE("plan_scene: an infinite budget takes the cheapest model, a budget of 0 the reference") {
        const SceneEntries entries = relief_scene("sphere:R=1", 0.1f);
        const ObjectPlan all = plan_one(entries, std::numeric_limits<double>::infinity());
        CHECK(all.chosen == 0);
        CHECK(chosen(all).known == Known::bound);
        const ObjectPlan none = plan_one(entries, 0);
        CHECK(none.chosen == -1);
        CHECK(displaces(none.reference.shade));
        CHECK(!none.why.empty());
    }

    TEST_CASE("plan_scene: a flat height needs no relief, even with a budget of 0") {
        const ObjectPlan plan = plan_one(relief_scene("plane:w=2,d=2", 0), 0);
        CHECK(chosen(plan).method.shade == Shade::plain);
    }

    TEST_CASE("plan_scene: a height that is not 0 in the mean moves the surface, which no map shows") {
        SceneEntries entries = relief_scene("sphere:R=1", 0.2f);
        auto flat = std::make_shared<LoadedPicture>();
        flat->image = Image<float>(32, 32, 1), flat->info = entries.pictures.at("waves.exr")->info;
        std::fill_n(flat->image.data(), flat->image.size(), 1.5f);
        entries.pictures["waves.exr"] = flat;
        const ObjectPlan plan = plan_one(entries, 0.02);
        CHECK(displaces(chosen(plan).method.shade));
    }

    TEST_CASE("plan_scene: an object that is not in view, or behind the camera, is shown plainly") {
        for (const Vec3f& target : {Vec3f(0, 1, 10), Vec3f(10, 1, 4)}) {
            SceneEntries entries = relief_scene("sphere:R=1", 0.1f);
            entries.cameras[0].target = target;
            const ObjectPlan plan = plan_one(entries, 0.005);
            CHECK(chosen(plan).method.shade == Shade::plain);
            CHECK(plan.why == "not in view");
            CHECK(chosen(plan).error.rmse() == 0);
        }
    }

    TEST_CASE("plan_scene: of an object that is half outside, or of one pixel, the pixels that there are count") {
        SceneEntries entries = relief_scene("sphere:R=1", 0.1f);
        entries.cameras[0].target = Vec3f(1.5f, 0, 0);
        const ObjectPlan half = plan_one(entries, 0.02);
        CHECK(chosen(half).error.pixels > 0);
        entries.cameras[0].target = Vec3f(0), entries.cameras[0].position = Vec3f(0, 0, 80);
        const ObjectPlan tiny = plan_one(entries, 0.01);
        const Rung& rung = tiny.rungs.front();
        CHECK(rung.known != Known::not_tried);
        CHECK(rung.error.all);
        CHECK(rung.error.pixels > 0);
        CHECK(rung.error.pixels < 32);
    }

    TEST_CASE("plan_scene: a light below the horizon is no trouble") {
        SceneEntries entries = relief_scene("plane:w=2,d=2", 0.1f);
        entries.lights[0].from = glm::normalize(Vec3f(1, -0.5f, 0));
        entries.ambient = Vec3f(0.3f);
        const ObjectPlan plan = plan_one(entries, 0.01);
        CHECK((plan.chosen >= 0 || displaces(plan.reference.shade)));
    }

    TEST_CASE("plan_scene: an empty scene is refused, one without heights has nothing to decide") {
        SceneEntries empty;
        empty.file = "scene.toml";
        CHECK_THROWS_AS(plan_scene(empty, {}), Error);
        SceneEntries bare = relief_scene("sphere:R=1", 0.1f);
        bare.materials[0].relief.file.clear();
        const ScenePlan plan = plan_scene(bare, {});
        CHECK(plan.objects.empty());
        REQUIRE(!plan.notes.empty());
        CHECK(plan.notes.back().find("height") != std::string::npos);
    }

    TEST_CASE("plan_scene: heights that are not numbers are refused") {
        SceneEntries entries = relief_scene("sphere:R=1", 0.1f);
        raise_heights(entries, std::numeric_limits<float>::quiet_NaN());
        try {
            plan_scene(entries, {});
            FAIL("not refused");
        } catch (const Error& error) {
            CHECK(error.refusal == Refusal::unsuitable);
        }
    }

    TEST_CASE("plan_scene: pictures of each camera, in full, as planned and bumped, if they are wanted") {
        SceneEntries entries = relief_scene("sphere:R=1", 0.1f);
        entries.cameras.push_back(entries.cameras[0]);
        entries.cameras[0].name = "front", entries.cameras[1].name = "top";
        entries.cameras[1].position = Vec3f(0, 4, 0.1f);
        PlanOptions options = with_budget(0.01);
        CHECK(plan_scene(entries, options).pictures.empty());
        options.pictures = true;
        const ScenePlan plan = plan_scene(entries, options);
        REQUIRE(plan.pictures.size() == 6);
        for (std::size_t i = 0; i < 6; ++i) {
            CHECK(plan.pictures[i].camera == i / 3);
            CHECK(int(plan.pictures[i].shows) == int(i % 3));
        }
        for (std::size_t k = 0; k < 6; k += 3) {
            const Halves& full = plan.pictures[k].halves;
            const double planned = mean_square_difference(full, plan.pictures[k + 1].halves);
            const double bumped = mean_square_difference(full, plan.pictures[k + 2].halves);
            CHECK(std::sqrt(std::max(0.0, planned)) < 0.011);
            CHECK(bumped > 4 * planned);
        }
        CHECK(mean_square_difference(plan.pictures[0].halves, plan.pictures[3].halves) > 1e-4); // other cameras
        // A height that does not repeat has no bump table.
        entries.cameras.pop_back();
        entries.materials[0].relief.wrap = Wrap::clamp;
        CHECK(plan_scene(entries, options).pictures.size() == 2);
    }

    TEST_CASE("plan_scene: if sky and lights alone are decided, they are pictured beside the scene as it is") {
        SceneEntries entries = relief_scene("sphere:R=1", 0.1f);
        PlanOptions options = with_budget(0.05);
        options.pictures = true, options.decide_objects = false;
        CHECK(plan_scene(entries, options).pictures.empty());
        options.decide_lights = true;
        const ScenePlan plan = plan_scene(entries, options);
        REQUIRE(plan.pictures.size() == 2);
        CHECK(plan.pictures[1].shows == PlanPicture::Shows::planned);
        // The light is needed, and its shadows are too small to be told.
        CHECK(mean_square_difference(plan.pictures[0].halves, plan.pictures[1].halves) < 0.05 * 0.05);
    }
}
