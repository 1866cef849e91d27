// Plans of meshes with a high-poly mesh.
#include "bake/base/error.h"
#include "bake/verdict/plan/manifest.h"
#include "bake/verdict/plan/plan_scenes.h"
#include "bake/verdict/plan/planned_scene.h"
#include "preview/bumpy_square.h"
#include "verdict/plan/planned_round.h"

using namespace bake;
using namespace bake::test;

namespace {

struct Square : Round {
    explicit Square(const std::string& scene) : Round(scene) {
        write_bumpy_square(folder);
        options.budget.value = 0.015;
    }
    ObjectPlan decide() {
        plan = plan_scene(entries, options);
        REQUIRE(plan.objects.size() == 1);
        return plan.objects[0];
    }
    PlanOptions options;
};

std::string model(const ObjectPlan& plan) {
    return name(plan.chosen < 0 ? plan.reference : plan.rungs[std::size_t(plan.chosen)].method);
}

} // namespace

TEST_SUITE("unit") {
    TEST_CASE(
        "plan_scene: from afar the low-poly mesh is enough, nearer its normal map, at a grazing angle nothing but "
        "the high-poly mesh") {
        const std::pair<const char*, const char*> views[] = {
            {from_afar, "plain"}, {from_near, "normal"}, {at_a_grazing_angle, "high"}};
        for (const auto& [camera, expected] : views) {
            Square square(bumpy_scene(camera));
            square.options.verify = true;
            const ObjectPlan object = square.decide();
            CHECK(model(object) == expected);
            CHECK(object.high == square.folder / "high.obj");
            CHECK(object.why.find(std::string(expected) + " is ") == 0);
            CHECK(name(object.reference) == "high");
            CHECK(object.reference_error == 0);
            CHECK(object.reference_cost.triangles == 2048);
            for (const Verification& line : square.plan.verified) CHECK(line.within);
            REQUIRE(object.rungs.size() == 3);
            CHECK(object.rungs[0].cost.triangles == 2);
            CHECK(object.rungs[1].cost.triangles == 2);
            CHECK(object.rungs[1].cost.texture_bytes == 3 * 5461); // 64 x 64 and its halvings
            CHECK(object.rungs[2].bound == 0);
        }
    }

    TEST_CASE("plan_scene: no bound settles a mesh without its detail") {
        // Without a height, bounds take the relief for one of 0.
        Square square(bumpy_scene(from_near));
        square.options.budget.value = 0.001;
        const ObjectPlan object = square.decide();
        CHECK(model(object) == "high");
        CHECK(object.rungs[0].known == Known::probe);
        square.options.budget.value = 0;
        CHECK(model(square.decide()) == "high");
        square.options.budget.value = INFINITY;
        CHECK(model(square.decide()) == "plain");
    }

    TEST_CASE("plan_scene: a normal map that costs more than the high-poly mesh is no candidate") {
        Square square(bumpy_scene(from_near, "low.obj", 1024));
        const ObjectPlan object = square.decide();
        CHECK(model(object) == "high");
        CHECK(object.rungs.size() == 2);
        REQUIRE(square.plan.notes.size() == 1);
        CHECK(has(square.plan.notes[0], "\"normal\" costs more than the high-poly mesh"));
    }

    TEST_CASE("plan_scene: without uvs there is no normal map, and its place tells why") {
        Square square(bumpy_scene(from_near, "bare.obj"));
        const ObjectPlan object = square.decide();
        CHECK(model(object) == "high");
        CHECK(object.rungs[1].known == Known::skipped);
        CHECK_MESSAGE(has(object.rungs[1].note, "uvs"), object.rungs[1].note);
    }

    TEST_CASE("plan_scene: a high-poly mesh that reaches into the picture is seen where the low-poly one is not") {
        Square square(bumpy_scene("[0, 0, 3]")); // the quad is edge-on
        CHECK(model(square.decide()) == "high");
        Square behind(bumpy_scene("[0, 9, 9]"));
        behind.entries.cameras[0].target = Vec3f(0, 18, 18);
        const ObjectPlan object = behind.decide();
        CHECK(model(object) == "plain");
        CHECK(object.why == "not in view");
    }

    TEST_CASE("plan_scenes: models of a high-poly mesh are those that a scene file shows") {
        Square square(bumpy_scene(from_near));
        PlanScenes scenes(square.entries, {});
        for (const Shade shade : {Shade::plain, Shade::normal, Shade::high}) {
            square.entries.meshes[0].high.shade = shade;
            const auto assembled = scenes.assemble({scenes.bake(0, {shade})});
            Scene& scene = assembled->scene;
            scene.settings = square.entries.settings;
            CHECK(largest_difference(picture_of(load(square.entries)), picture_of(scene)) == 0);
        }
        CHECK_THROWS_AS(scenes.bake(0, {Shade::bump}), Error);
        CHECK_THROWS_AS(scenes.bake(0, {Shade::displace, 2}), Error);
    }

    TEST_CASE("planned_scene: names the model of the mesh and of its instances, and the form of their maps") {
        Square square("[[material]]\nname = \"dark\"\ndiffuse = 0.2\n" + bumpy_scene(from_near) +
                      "[[instance]]\nmesh = \"square\"\nmaterial = \"dark\"\n");
        for (const int mesh : {0, 1}) {
            ObjectPlan object = shown_by("square", mesh == 0 ? "normal" : "plain", {mesh});
            object.high = "high.obj";
            square.plan.objects.push_back(object);
        }
        TexturePlan map{.file = "square", .kind = "normal", .width = 16, .height = 16, .bits = 8};
        map.source_width = map.source_height = 64, map.meshes = {0};
        square.plan.textures = {map};
        fs::create_directory(square.folder / "sub");
        CHECK(has(square.planned("sub/p.toml"), "high = \"../high.obj\" # 2048 triangles\nshade = \"normal\"\n"));
        square.planned();
        CHECK(square.read.meshes[0].high.shade == Shade::normal);
        CHECK(square.read.meshes[0].high.size == 16);
        CHECK(square.read.meshes[1].high.shade == Shade::plain);
        CHECK(square.read.meshes[1].high.size == 64);
        check_same_picture(square);
        const Manifest manifest = plan_manifest(square.entries, square.plan, square.folder / "bakes.toml");
        REQUIRE(manifest.bakes.size() == 1);
        CHECK(command_of(manifest.bakes[0]) == std::vector<std::string>{"normal-map", "low.obj", "--high=high.obj",
                                                                        "--size=16", "--rays=16", "--depth=8",
                                                                        "--out=square_normal.png"});
        CHECK(manifest.bakes[0].use == "normal");
    }

    TEST_CASE("plan_manifest: the high-poly mesh and the low-poly one need no bake; BC5 is a .ktx2") {
        Square square(bumpy_scene(from_near));
        square.plan.objects = {shown_by("square", "normal", {0})};
        square.entries.meshes[0].high.normal_bc5 = true;
        const Manifest manifest = plan_manifest(square.entries, square.plan, square.folder / "bakes.toml");
        REQUIRE(manifest.bakes.size() == 1);
        CHECK(manifest.bakes[0].outputs.front().second == "square_normal.ktx2");
        for (const Shade shade : {Shade::plain, Shade::high}) {
            square.plan.objects[0].rungs[0].method = {shade};
            CHECK(plan_manifest(square.entries, square.plan, square.folder / "bakes.toml").bakes.empty());
        }
    }

    TEST_CASE("plan_scene: sizes and formats of a map from a high-poly mesh are decided, and hold in whole pictures") {
        Square square(bumpy_scene(from_near, "low.obj", 128));
        square.options.decide_textures = square.options.decide_formats = square.options.verify = true;
        CHECK(model(square.decide()) == "normal");
        REQUIRE(square.plan.textures.size() == 1);
        CHECK(square.plan.textures[0].meshes == std::vector<int>{0});
        CHECK(square.plan.textures[0].width < 128);
        for (const Verification& line : square.plan.verified) CHECK(line.within);
        square.planned();
        CHECK(square.read.meshes[0].high.size == square.plan.textures[0].width);
        check_same_picture(square);
    }
}
