// The worst of several objects and cameras counts.
#include "bake/verdict/plan/scene_twin.h"
#include "bake/verdict/plan/worst_probe.h"
#include "preview/little_scenes.h"
#include <doctest/doctest.h>

using namespace bake;
using namespace bake::test;

namespace {

/// Two squares side by side that emit light, each half as wide as the picture.
Scene two_squares() {
    Scene scene;
    scene.shapes.push_back(make_shape(plane_mesh()));
    for (const char* name : {"left", "right"}) {
        Material material;
        material.name = name;
        material.reflectance.emission = Vec3f(0.5f);
        scene.materials.push_back(std::make_unique<Material>(material));
        add_instance(scene, *scene.shapes[0], *scene.materials.back(),
                     {.translate = {scene.materials.size() == 1 ? -1.0f : 1.0f, 0, 0}});
    }
    scene.camera.orthographic = true, scene.camera.view_height = 4;
    scene.settings.width = scene.settings.height = 16;
    build(scene);
    return scene;
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("worst probe: the error over an object is that of its own pixels") {
        const Scene scene = two_squares();
        Scene twin = twin_of(scene);
        twin.materials[1]->reflectance.emission = Vec3f(0.6f);
        WorstProbe frame(scene, {{}}, {}), each(scene, frame_and_materials(scene), {});
        // The right square fills a quarter of the picture.
        CHECK(frame.measure(twin).error.rmse() == doctest::Approx(0.1 / 2).epsilon(1e-4));
        CHECK(each.measure(twin).error.rmse() == doctest::Approx(0.1).epsilon(1e-4));
        CHECK(frame.judge(twin, 0.06).within);
        CHECK(!each.judge(twin, 0.06).within);
        CHECK(each.judge(twin, 0.15).within);
        CHECK(each.judge(twin, 0.15).error.rmse() == doctest::Approx(0.1).epsilon(1e-4));
        CHECK(frame_and_materials(scene).size() == 3);
        CHECK(frame_and_materials(scene, 1).size() == 3);
        CHECK(frame_and_materials(scene, 0).size() == 2);
    }

    TEST_CASE("worst probe: the worst camera counts, and objects out of view do not") {
        const Scene scene = two_squares();
        Scene twin = twin_of(scene);
        twin.materials[1]->reflectance.emission = Vec3f(0.6f);
        PartOptions options;
        options.views = {{"left", scene.camera}, {"right", scene.camera}};
        options.views[0].camera.position.x = options.views[0].camera.target.x = -10;
        WorstProbe probe(scene, {{}, {0, 1}}, options);
        const WorstProbe::Result result = probe.judge(twin, 0.05);
        CHECK(!result.within);
        CHECK(result.camera == "right");
        options.views.pop_back();
        WorstProbe none(scene, {{0, 1}}, options);
        CHECK(!none.in_view());
        CHECK(none.judge(twin, 0).within);
    }
}
