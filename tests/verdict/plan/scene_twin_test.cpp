// A twin shows what its scene shows, and changes of the twin stay there.
#include "bake/verdict/plan/scene_twin.h"
#include "preview/little_scenes.h"
#include "preview/sky_of.h"
#include <cstring>
#include <doctest/doctest.h>

using namespace bake;
using namespace bake::test;

namespace {

bool same(const Image<float>& a, const Image<float>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

Scene ball(SkyLighting light, const Vec3f& at = Vec3f(0)) {
    Scene scene;
    Material material;
    material.reflectance.specular = Vec3f(0.3f);
    material.albedo = texture(8, 8, 3, [](float u, float v, float* t) { t[0] = u, t[1] = v, t[2] = 0.5f; });
    scene.shapes.push_back(make_shape(sphere_mesh(24, 12)));
    scene.materials.push_back(std::make_unique<Material>(std::move(material)));
    add_instance(scene, *scene.shapes[0], *scene.materials[0], {.translate = at});
    scene.camera.position = at + Vec3f(0, 0, 4), scene.camera.target = at;
    scene.sky.cube = sky_of(8, [](const Vec3d& d) { return 0.5 + 0.4 * d.y; });
    scene.lights = {directional({1, 1, 1})};
    scene.settings.width = scene.settings.height = 16;
    scene.settings.sky_light = light;
    build(scene);
    return scene;
}

Image<float> picture(const Scene& scene) { return render(scene, scene.settings); }

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("scene twin: renders the same picture") {
        for (const SkyLighting light : {SkyLighting::off, SkyLighting::sampled, SkyLighting::irradiance}) {
            const Scene scene = ball(light);
            CHECK(same(picture(twin_of(scene)), picture(scene)));
        }
        const Scene far = ball(SkyLighting::sampled, Vec3f(1e4f, 0, 0));
        CHECK(far.origin != Vec3f(0));
        CHECK(same(picture(twin_of(far)), picture(far)));
    }

    TEST_CASE("scene twin: changes stay in the twin") {
        const Scene scene = ball(SkyLighting::sampled);
        const Image<float> before = picture(scene);
        Scene twin = twin_of(scene);
        set_sky(twin, constant_cube(Vec3f(0.2f)));
        const int all[] = {0};
        Image<float> grey(1, 1, 3);
        std::fill_n(grey.data(), 3, 0.5f);
        set_texture(twin, all, TextureUse::albedo, std::move(grey));
        CHECK(!same(picture(twin), before));
        CHECK(same(picture(scene), before));
        CHECK(twin.sky.halvings.size() == 2);
    }

    TEST_CASE("scene twin: another sky gives its own light") {
        Scene scene = ball(SkyLighting::sampled);
        scene.lights.clear();
        Scene own = ball(SkyLighting::sampled);
        own.lights.clear();
        const auto sun_below = [](const Vec3d& d) { return d.y < -0.5 ? 1.0 : 0.1; };
        own.sky.cube = sky_of(8, sun_below);
        build(own);
        Scene twin = twin_of(scene);
        set_sky(twin, sky_of(8, sun_below));
        CHECK(same(picture(twin), picture(own)));
    }
}
