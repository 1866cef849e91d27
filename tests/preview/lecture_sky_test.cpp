// The systems of docs/lecture.md that reflect a sky, through the tracer. The figures that are printed stand there.
#include "bake/preview/capture.h"
#include "preview/lecture.h"
#include "preview/sky_of.h"
#include <algorithm>
#include <doctest/doctest.h>
#include <iterator>

using namespace bake;
using namespace bake::test;

namespace {

/// A sky whose radiance is a smooth function of the world direction.
double smooth_sky(const Vec3d& d) { return 1 + 0.4 * d.x + 0.3 * d.y - 0.2 * d.z + 0.25 * d.x * d.y; }

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("lecture, cubemap reflection: a mirror sphere shows an analytic sky, pixel by pixel") {
        Scene scene = one_mesh(sphere_mesh(1024, 512), mirror());
        scene.sky.cube = sky_of(256, smooth_sky);
        build(scene);
        // Within a texel of an edge of the cube, bilinear interpolation joins two charts, and is of first order.
        double worst = 0, at_edges = 0, squares = 0;
        int count = 0;
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x) {
                const Ray ray = ray_at(scene, x + .5, y + .5, 64);
                Vec3d p;
                const Vec3d d = glm::normalize(Vec3d(ray.direction));
                if (!on_sphere(ray, 1, p) || glm::dot(-d, p) < 0.5) continue;
                const Vec3d r = d - 2 * glm::dot(d, p) * p;
                double sizes[] = {std::abs(r.x), std::abs(r.y), std::abs(r.z)};
                std::sort(std::begin(sizes), std::end(sizes));
                const double error = std::abs(double(seen_at(scene, x + .5, y + .5).x) - smooth_sky(r));
                double& most = sizes[1] > sizes[2] * (1 - 2 / 256.) ? at_edges : worst;
                most = std::max(most, error), squares += error * error, ++count;
            }
        MESSAGE("largest difference " << worst << ", at edges of the cube " << at_edges << ", rms "
                                      << std::sqrt(squares / count) << " of " << count);
        CHECK(count > 800);
        CHECK(worst < 1e-4);
        CHECK(at_edges < 1e-3);
    }

    TEST_CASE("lecture, captured environment: the smaller a mirror ball, the better it shows what was captured in its "
              "place") {
        Material walls; // shine by themselves
        walls.reflectance.ambient = walls.reflectance.diffuse = Vec3f(0), walls.reflectance.emission = Vec3f(1);
        const auto ball_in_room = [&](float radius) {
            Scene scene = one_mesh(plane_mesh(), walls);
            scene.instances.clear();
            // Four walls of different brightness, 2 units from the origin.
            for (int i = 0; i < 4; ++i) {
                scene.materials.push_back(std::make_unique<Material>(walls));
                scene.materials.back()->reflectance.emission = Vec3f(0.25f * float(i + 1));
                add_instance(scene, *scene.shapes[0], *scene.materials.back(),
                             {.translate = Vec3f(i == 0   ? 2
                                                 : i == 1 ? -2
                                                          : 0,
                                                 0,
                                                 i == 2   ? 2
                                                 : i == 3 ? -2
                                                          : 0),
                              .rotate_deg = {0, i < 2 ? 90.f : 0.f, 0},
                              .scale = Vec3f(2)});
            }
            scene.shapes.push_back(make_shape(sphere_mesh(128, 64)));
            scene.materials.push_back(std::make_unique<Material>(mirror()));
            if (radius > 0) add_instance(scene, *scene.shapes[1], *scene.materials.back(), {.scale = Vec3f(radius)});
            scene.sky.background = Vec3f(2);
            scene.settings.spp = 1, scene.settings.bounces = 1;
            build(scene);
            return scene;
        };
        const auto difference = [&](float radius) {
            Scene traced = ball_in_room(radius);
            Scene shown = one_mesh(sphere_mesh(128, 64), mirror());
            shown.instances.clear();
            add_instance(shown, *shown.shapes[0], *shown.materials[0], {.scale = Vec3f(radius)});
            shown.sky.cube = capture(ball_in_room(0), Vec3f(0), 128);
            build(shown);
            traced.camera.position = shown.camera.position = Vec3f(0.2f, 0.3f, 1) * 1.8f;
            traced.camera.target = shown.camera.target = Vec3f(0);
            traced.camera.fov_deg = shown.camera.fov_deg = 60 * radius;
            double sum = 0;
            int hits = 0;
            for (int y = 0; y < 96; ++y)
                for (int x = 0; x < 96; ++x) {
                    if (!shown.bvh->intersect(ray_at(shown, x + .5, y + .5, 96))) continue;
                    sum +=
                        std::abs(double(seen_at(traced, x + .5, y + .5, 96).x - seen_at(shown, x + .5, y + .5, 96).x));
                    ++hits;
                }
            REQUIRE(hits > 3000);
            return sum / hits;
        };
        const double large = difference(0.8f), half = difference(0.4f), small = difference(0.05f);
        MESSAGE("mean difference at radius 0.8: " << large << ", 0.4: " << half << ", 0.05: " << small);
        CHECK(large > 0.02);
        CHECK(large / half == doctest::Approx(2).epsilon(0.3)); // walls shift in proportion to the radius
        CHECK(small < 0.01);
    }

} // TEST_SUITE
