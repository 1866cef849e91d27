#include "bake/base/error.h"
#include "bake/verdict/plan/plan_scenes.h"
#include "verdict/compare/relief_scene.h"
#include <doctest/doctest.h>

using namespace bake;
using test::relief_scene;

namespace {

/// What bake::load() shows and what is assembled are the same.
void check_equal(const Scene& a, const Scene& b) {
    REQUIRE(a.instances.size() == b.instances.size());
    for (std::size_t i = 0; i < a.instances.size(); ++i) {
        CHECK(a.instances[i].linear == b.instances[i].linear);
        CHECK(a.instances[i].shape->mesh.positions == b.instances[i].shape->mesh.positions);
        CHECK(bool(a.instances[i].material->bump_table) == bool(b.instances[i].material->bump_table));
        CHECK(bool(a.instances[i].material->bump_table.mips) == bool(b.instances[i].material->bump_table.mips));
        CHECK(a.instances[i].material->reflectance.shininess == b.instances[i].material->reflectance.shininess);
    }
    REQUIRE(a.lights.size() == b.lights.size());
    for (std::size_t i = 0; i < a.lights.size(); ++i) CHECK(a.lights[i].from == b.lights[i].from);
    CHECK(a.textured == b.textured);
    CHECK(a.origin == b.origin);
}

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("plan_scenes: an assembled scene is the one that a scene file with these methods shows") {
        SceneEntries entries = relief_scene("sphere:R=1", 0.1f);
        entries.materials[0].reflectance.shininess = 40;
        MeshEntry other = entries.meshes[0];
        other.name = "egg", other.shape = "sphere:R=0.5", other.placement.translate.x = 2;
        entries.meshes.push_back(other);
        PlanScenes scenes(entries, {});
        REQUIRE(scenes.objects().size() == 2);
        for (const ShadeMethod& method : {ShadeMethod{Shade::plain}, ShadeMethod{Shade::roughness},
                                          ShadeMethod{Shade::bump}, ShadeMethod{Shade::displace, 2}}) {
            SceneEntries shown = entries;
            shown.materials[0].relief.shade = method;
            const auto assembled = scenes.assemble({scenes.bake(0, method), scenes.bake(1, method)});
            check_equal(load(shown), assembled->scene);
        }
    }

    TEST_CASE("plan_scenes: equal meshes with one material are one object, and names are unique") {
        SceneEntries entries = relief_scene("sphere:R=1", 0.1f);
        MeshEntry same = entries.meshes[0];
        same.name = "twin", same.placement.translate.x = 3, same.placement.scale = Vec3f(0.5f);
        entries.meshes.push_back(same);
        MeshEntry other = entries.meshes[0];
        other.columns = 8; // of the same name
        entries.meshes.push_back(other);
        MeshEntry bare = entries.meshes[0];
        bare.material = -1;
        entries.meshes.push_back(bare);
        const PlanScenes scenes(entries, {});
        REQUIRE(scenes.objects().size() == 2);
        CHECK(scenes.objects()[0].name == "ball");
        CHECK(scenes.objects()[0].meshes == std::vector<int>{0, 1});
        CHECK(scenes.instances_of(0) == std::vector<std::uint8_t>{1, 1, 0, 0});
        CHECK(scenes.objects()[1].name == "ball 2");
        CHECK(scenes.objects()[1].material == "waves");
        CHECK(scenes.instances_of(1) == std::vector<std::uint8_t>{0, 0, 1, 0});
    }

    TEST_CASE("plan_scenes: every camera has the lights that a scene without lights has for it") {
        SceneEntries entries = relief_scene("sphere:R=1", 0.1f);
        entries.lights.clear(), entries.any_light = false;
        entries.cameras[0].name = "front";
        CameraEntry side;
        side.name = "side", side.position = Vec3f(4, 0, 0), side.target = Vec3f(0);
        entries.cameras.push_back(side);
        const PlanScenes scenes(entries, {});
        REQUIRE(scenes.cameras().size() == 2);
        for (std::size_t camera : {0, 1}) {
            entries.camera = camera;
            entries.materials[0].relief.shade = ShadeMethod{Shade::plain};
            const Scene scene = load(entries);
            REQUIRE(scenes.cameras()[camera].lights.size() == scene.lights.size());
            CHECK(scenes.cameras()[camera].lights[0].from == scene.lights[0].from);
            CHECK(scenes.cameras()[camera].camera.position == scene.camera.position);
        }
        CHECK(PlanScenes(entries, {"side"}).cameras()[0].name == "side");
        CHECK_THROWS_AS(PlanScenes(entries, {"top"}), Error);
    }

    TEST_CASE("plan_scenes: the ground lies below the displaced meshes, whatever is assembled") {
        SceneEntries entries = relief_scene("sphere:R=1", 0.3f);
        entries.ground.emplace();
        PlanScenes scenes(entries, {});
        const auto displaced = scenes.assemble({scenes.bake(0, {Shade::displace, 4})});
        const auto plain = scenes.assemble({nullptr});
        const float y = plain->scene.instances.back().translate.y;
        CHECK(displaced->scene.instances.back().translate.y == y);
        displaced->scene.instances.pop_back();
        CHECK(y <= bounds(displaced->scene).min.y + 2e-3);
        for (int levels = 0; levels <= 3; ++levels) { // up to those by which it was placed
            const auto coarse = scenes.assemble({scenes.bake(0, {Shade::displace, levels})});
            coarse->scene.instances.pop_back();
            CHECK(y < bounds(coarse->scene).min.y);
        }
        CHECK(y < -1);
    }
}
