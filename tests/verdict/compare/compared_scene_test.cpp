#include "bake/base/error.h"
#include "bake/preview/render.h"
#include "bake/verdict/compare/compared_scene.h"
#include "verdict/compare/relief_scene.h"
#include <doctest/doctest.h>

using namespace bake;
using test::relief_scene;

TEST_SUITE("unit") {
    TEST_CASE("compared_scene: camera, light and ground stand where they do without relief, whatever the method") {
        SceneEntries entries = relief_scene("sphere:R=1", 0.3f);
        entries.cameras.clear();
        entries.lights.clear(), entries.any_light = false;
        entries.ground.emplace();
        const ComparedScene compared(entries, "");
        const MethodScene plain = compared.load({Shade::plain});
        for (const ShadeMethod& method : {ShadeMethod{Shade::bump}, ShadeMethod{Shade::displace, 3}}) {
            const MethodScene other = compared.load(method);
            CHECK(other.scene.camera.position == plain.scene.camera.position);
            CHECK(other.scene.camera.target == plain.scene.camera.target);
            REQUIRE(other.scene.lights.size() == plain.scene.lights.size());
            CHECK(other.scene.lights[0].from == plain.scene.lights[0].from);
            const Instance& ground = other.scene.instances.back();
            CHECK(ground.translate == plain.scene.instances.back().translate);
            CHECK(ground.linear == plain.scene.instances.back().linear);
            CHECK(ground.translate.y <= bounds(other.scene).min.y + 1e-3);
        }
        // Without relief nothing changes: the camera is that of the scene itself.
        SceneEntries own = entries;
        own.materials[0].relief.shade = ShadeMethod{Shade::plain};
        own.ground.reset();
        CHECK(load(own).camera.position == plain.scene.camera.position);
    }

    TEST_CASE("compared_scene: the object is the named mesh, its triangles and bytes are those of the method") {
        SceneEntries entries = relief_scene("sphere:R=1", 0.1f);
        MeshEntry other = entries.meshes[0];
        other.name = "other", other.placement.translate.x = 3;
        entries.meshes.push_back(other);
        const ComparedScene both(entries, ""), one(entries, "other");
        CHECK(both.object() == "ball, other");
        CHECK(one.object() == "other");
        CHECK(both.triangles() == 2 * one.triangles());
        const MethodScene displaced = one.load({Shade::displace, 2});
        CHECK(displaced.of_object == std::vector<std::uint8_t>{0, 1});
        CHECK(object_triangles(displaced) > 12 * one.triangles());
        CHECK(displaced.scene.instances[0].shape->mesh.positions.size() <
              displaced.scene.instances[1].shape->mesh.positions.size());
        CHECK(texture_bytes(displaced) == 0);
        const MethodScene plain = one.load({Shade::plain}), bump = one.load({Shade::bump});
        CHECK(object_bytes(displaced) > 10 * object_bytes(plain));
        CHECK(texture_bytes(plain) == 0);
        // Two slopes per texel, and the five moments of the smaller levels.
        CHECK(texture_bytes(bump) >= 32 * 32 * 2 * 4);
        CHECK(texture_bytes(bump) < 32 * 32 * (2 + 5) * 4);
        CHECK(object_bytes(bump) > texture_bytes(bump) + object_triangles(bump) * 86);
    }

    TEST_CASE("compared_scene: a scene without heights, and a name that is none of them, are refused") {
        SceneEntries entries = relief_scene("sphere:R=1", 0.1f);
        const auto refusal = [](const SceneEntries& scene, const std::string& object) {
            try {
                const ComparedScene compared(scene, object);
            } catch (const Error& error) {
                return error.refusal;
            }
            return Refusal::over_limit; // not refused
        };
        CHECK(refusal(entries, "bell") == Refusal::usage);
        entries.materials[0].relief.file.clear();
        CHECK(refusal(entries, "") == Refusal::unsuitable);
    }
}
