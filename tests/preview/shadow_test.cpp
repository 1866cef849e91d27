// Shadows against convex solids, whose lit side is known, and pictures of random scenes with extreme values.
#include "bake/base/error.h"
#include "bake/preview/render.h"
#include "preview/little_scenes.h"
#include <doctest/doctest.h>
#include <random>

using namespace bake;
using namespace bake::test;

namespace {

struct Wrong {
    int false_shadows = 0, leaks = 0, lit = 0, dark = 0;
};

/// Hits of a grid of rays on a convex solid, lit by one light: those dark that face the light, and those lit that do not.
Wrong count_wrong(float radius, const Vec3f& centre, const Vec3f& from) {
    Scene scene = one_mesh(sphere_mesh(24, 12), Material{}, true);
    scene.instances.clear();
    add_instance(scene, *scene.shapes[0], *scene.materials[0], {.translate = centre, .scale = Vec3f(radius)});
    scene.lights.push_back(directional(from));
    scene.camera.position = centre + radius * Vec3f(1, 0.5f, 4);
    scene.camera.target = centre;
    build(scene);
    Wrong wrong;
    const CameraFrame frame = camera_frame(scene.camera);
    for (int y = 0; y < 96; ++y)
        for (int x = 0; x < 96; ++x) {
            const Ray ray = primary_ray(frame, x + 0.5, y + 0.5, 96, 96);
            Sampler sampler(x, y, 0);
            RenderStats stats;
            FirstHit first;
            const Radiance value = radiance(scene, ray, 0, sampler, stats, &first);
            if (!first.hit) continue;
            const double facing = glm::dot(Vec3d(first.facet), Vec3d(scene.lights[0].from));
            if (std::abs(facing) < 1e-3) continue; // along the facet: either answer is right
            const bool lit = value.diffuse.x > 0;
            (facing > 0 ? wrong.lit : wrong.dark) += 1;
            wrong.false_shadows += facing > 0 && !lit;
            wrong.leaks += facing < 0 && lit;
        }
    return wrong;
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("shadow: a convex solid casts none on its lit side and lets none of the light through, at any size") {
        for (const float radius : {1e-3f, 1.0f, 1000.0f})
            for (const Vec3f& centre :
                 {Vec3f(0), Vec3f(radius < 0.1f ? 0.01f : 100)}) // offsets grow with the distance from zero
                for (const Vec3f& from : {Vec3f(1, 0.3f, 0.2f), Vec3f(-0.2f, 1, 0.1f), Vec3f(0, 0.1f, -1)}) {
                    CAPTURE(radius);
                    CAPTURE(centre.x);
                    const Wrong wrong = count_wrong(radius, centre, from);
                    CHECK(wrong.lit + wrong.dark > 800);
                    CHECK(wrong.dark > 100);
                    CHECK(wrong.false_shadows == 0);
                    CHECK(wrong.leaks == 0);
                }
    }

} // TEST_SUITE

TEST_SUITE("stability") {

    TEST_CASE("render: random scenes with extreme values have finite pixels, or are refused") {
        std::mt19937 random(7);
        const auto pick = [&](std::initializer_list<float> values) {
            return values.begin()[std::uniform_int_distribution<std::size_t>(0, values.size() - 1)(random)];
        };
        const auto any = [&] { return pick({0, 1, -1, 0.5f, 1e-20f, 1e-6f, 1e6f, -1e12f, 1e15f}); };
        const auto colour = [&] {
            return Vec3f(pick({0, 1, 0.5f, 1e-20f, 1e15f}), pick({0, 1, 1e6f}), pick({0, 0.3f}));
        };
        const auto vector = [&] { return Vec3f(any(), any(), any()); };
        const std::array<Mesh, 3> meshes = {plane_mesh(), sphere_mesh(6, 4), plane_mesh(2)};
        int rendered = 0;
        for (int i = 0; i < 2000; ++i) {
            Material material;
            material.reflectance.model = Reflectance::Model(i % 6);
            material.reflectance.diffuse = colour(), material.reflectance.specular = colour();
            material.reflectance.shininess = pick({0, 1, 50, 1e6f, 1e15f});
            material.reflectance.roughness = pick({0, 0.01f, 0.5f, 1});
            material.reflectance.metallic = pick({0, 0.5f, 1});
            material.reflectance.ior = pick({1, 1.5f, 10});
            material.reflect = colour();
            if (i % 3 == 0)
                material.bump_table = texture(4, 4, 2, [&](float, float, float* t) { t[0] = any(), t[1] = any(); });
            Scene scene = one_mesh(Mesh(meshes[std::size_t(i) % 3]), material, i % 2 == 0);
            Light<float> light = directional({0.1f, 0.2f, 1});
            light.kind = LightKind(i / 3 % 4);
            light.position = vector(), light.colour = colour();
            light.falloff = {pick({0, 1, 1e-30f}), pick({0, 1}), pick({0, 1, 1e15f})};
            light.edge_u = vector(), light.edge_v = vector();
            scene.lights.push_back(light);
            scene.sky.cube = constant_cube(colour(), 2);
            scene.sky.scale = pick({0, 1, 1e15f});
            scene.ambient = colour();
            scene.settings.terminator = Terminator(i % 5);
            scene.settings.bounces = 2, scene.settings.diffuse_bounces = i % 2;
            scene.settings.width = scene.settings.height = 3, scene.settings.spp = 2;
            scene.camera.position = i % 4 ? Vec3f(0, 0, 4) : vector();
            try {
                build(scene);
                const Image<float> picture = render(scene, scene.settings);
                bool finite = true;
                for (std::size_t k = 0; k < picture.size(); ++k) finite &= std::isfinite(picture.data()[k]);
                CHECK(finite);
                ++rendered;
            } catch (const Error& error) {
                CHECK(error.refusal == Refusal::unsuitable);
            }
        }
        CHECK(rendered > 1000);
    }

} // TEST_SUITE
