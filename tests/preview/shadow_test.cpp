// Shadows against convex solids, whose lit side is known.
#include "preview/little_scenes.h"
#include <doctest/doctest.h>

using namespace bake;
using namespace bake::test;

namespace {

struct Wrong {
    int false_shadows = 0, leaks = 0, lit = 0, dark = 0;
};

/// Hits of a grid of rays on a convex solid, lit by one light: those dark that face the light, and those lit that do not.
/// The solid is moved by its placement, or has its vertices where it is.
Wrong count_wrong(float radius, const Vec3f& centre, const Vec3f& from, bool placed = true) {
    Mesh mesh = sphere_mesh(24, 12);
    if (!placed)
        for (Vec3f& p : mesh.positions) p = centre + radius * p;
    Scene scene = one_mesh(std::move(mesh), Material{}, true);
    if (placed) {
        scene.instances.clear();
        add_instance(scene, *scene.shapes[0], *scene.materials[0], {.translate = centre, .scale = Vec3f(radius)});
    }
    scene.lights.push_back(directional(from));
    scene.camera.position = centre + radius * Vec3f(1, 0.5f, 4);
    scene.camera.target = centre;
    build(scene);
    Wrong wrong;
    const CameraFrame frame = camera_frame(scene);
    for (int y = 0; y < 96; ++y)
        for (int x = 0; x < 96; ++x) {
            const Ray ray = primary_ray(frame, x + 0.5, y + 0.5, 96, 96);
            const PrimaryHit traced = trace_one(scene, ray, 0, Sampler(x, y, 0));
            const FirstHit& first = traced.first;
            const Radiance& value = traced.radiance;
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
            for (const float centre : {0.0f, 100.0f})
                for (const Vec3f& from : {Vec3f(1, 0.3f, 0.2f), Vec3f(-0.2f, 1, 0.1f), Vec3f(0, 0.1f, -1)})
                    for (const bool placed : {true, false}) {
                        // Floats are 7.6e-6 apart at 100: vertices there are no convex solid of this size.
                        if (!placed && radius < 0.1f && centre > 0) continue;
                        CAPTURE(radius);
                        CAPTURE(centre);
                        CAPTURE(placed);
                        const Wrong wrong = count_wrong(radius, Vec3f(centre), from, placed);
                        CHECK(wrong.lit + wrong.dark > 800);
                        CHECK(wrong.dark > 100);
                        CHECK(wrong.false_shadows == 0);
                        CHECK(wrong.leaks == 0);
                    }
    }

} // TEST_SUITE
