// Light of the sky on meshes, against closed forms.
#include "preview/little_scenes.h"
#include "preview/sky_of.h"
#include <doctest/doctest.h>

using namespace bake;
using namespace bake::test;

namespace {

/// Of low order in the direction, with closed-form irradiance: Ramamoorthi and Hanrahan's factors pi, 2 pi / 3, pi / 4.
double smooth_sky(const Vec3d& d) { return 1 + 0.5 * d.y + 0.3 * (1.5 * d.x * d.x - 0.5); }
double smooth_irradiance(const Vec3d& n) {
    return pi * 1 + 2 * pi / 3 * 0.5 * n.y + pi / 4 * 0.3 * (1.5 * n.x * n.x - 0.5);
}

/// Mean over `spp` samples of the pixel's centre.
double seen(const Scene& scene, double x, double y, int spp) {
    double sum = 0;
    const Ray ray = primary_ray(camera_frame(scene.camera), x, y, 64, 64);
    for (int i = 0; i < spp; ++i) {
        const Sampler sampler(int(x), int(y), i, scene.settings.seed);
        sum += trace_one(scene, ray, scene.settings.bounces, sampler).radiance.total().y;
    }
    return sum / spp;
}

Material lambert(float albedo) {
    Material material;
    material.reflectance.diffuse = Vec3f(albedo);
    return material;
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("sky light: a Lambert sphere has albedo * irradiance / pi, with an error that falls as it should") {
        Scene scene = one_mesh(sphere_mesh(256, 128), lambert(0.8f));
        scene.sky.cube = sky_of(64, smooth_sky);
        build(scene);
        const auto rms = [&](int spp) {
            double squares = 0;
            int count = 0;
            for (int y = 14; y < 50; y += 3)
                for (int x = 14; x < 50; x += 3) {
                    const Ray ray = primary_ray(camera_frame(scene.camera), x + .5, y + .5, 64, 64);
                    const Hit hit = scene.bvh->intersect(ray);
                    if (!hit) continue;
                    const double expected =
                        0.8 / pi * smooth_irradiance(glm::normalize(Vec3d(scene.bvh->point(hit).p)));
                    const double error = seen(scene, x + .5, y + .5, spp) / expected - 1;
                    squares += error * error, ++count;
                }
            REQUIRE(count > 100);
            return std::sqrt(squares / count);
        };
        const double coarse = rms(16), fine = rms(256);
        CHECK(fine < 1e-3);
        CHECK(fine < coarse / 4); // as fast as random numbers, at least
    }

    TEST_CASE("sky light: in an even sky a white surface cannot be told from the sky") {
        for (const bool flat : {false, true}) {
            Scene scene = one_mesh(sphere_mesh(64, 32), lambert(1), flat);
            scene.sky.cube = constant_cube(Vec3f(0.7f));
            build(scene);
            for (int i = 24; i < 40; i += 4)
                CHECK(seen(scene, i + .5, 52.5 - i, 256) == doctest::Approx(0.7).epsilon(3e-3));
        }
    }

    TEST_CASE(
        "sky light: above a plane that fills half the sky a facing surface has half its light, with bounces all") {
        // A small plane that faces +Z, and above it at z = 1 one that covers x > 0: half of the directions by cosine.
        for (const int bounces : {0, 3}) {
            Scene scene = one_mesh(plane_mesh(), lambert(1));
            scene.materials.push_back(std::make_unique<Material>(lambert(0)));
            scene.materials[1]->reflectance.ambient = Vec3f(0), scene.materials[1]->reflectance.emission = Vec3f(1);
            add_instance(scene, *scene.shapes[0], *scene.materials[1],
                         {.translate = {1e4f, 0, 1}, .scale = {1e4f, 1e4f, 1}});
            scene.camera.position = {-1, 0, 0.5f}, scene.camera.target = {0, 0, 0};
            scene.sky.cube = constant_cube(Vec3f(1));
            scene.settings.diffuse_bounces = bounces;
            build(scene);
            CHECK(seen(scene, 32, 32, 1024) == doctest::Approx(bounces ? 1 : 0.5).epsilon(6e-3));
        }
    }

    TEST_CASE("sky light: inside a closed room of half mirrors the light is the same for any number of bounces") {
        // A sphere seen from inside: every surface reflects half by diffusion and half by mirroring, and shines with 1/2.
        // The radiance L = 1/2 + L/4 + L/4 after infinitely many bounces; the sky is not seen.
        const auto mean = [](int bounces) {
            Material material = lambert(0.25f);
            material.reflect = Vec3f(0.25f);
            material.reflectance.ambient = Vec3f(0), material.reflectance.emission = Vec3f(0.5f);
            Scene scene = one_mesh(sphere_mesh(32, 16), material);
            scene.camera.position = {0.2f, 0.1f, 0}, scene.camera.target = {1, 0, 0};
            scene.sky.cube = constant_cube(Vec3f(1));
            scene.settings.bounces = scene.settings.diffuse_bounces = bounces;
            build(scene);
            return seen(scene, 32, 32, 2048);
        };
        CHECK(mean(12) == doctest::Approx(1).epsilon(0.02));
        CHECK(mean(2) < 0.99); // mirror rays that have no bounce left see the sky, diffuse ones nothing
    }

} // TEST_SUITE

TEST_SUITE("unit") {

    TEST_CASE(
        "sky light: off, the sky is seen and mirrored but does not light; without shadows nothing is in its way") {
        Scene scene = one_mesh(plane_mesh(), lambert(0.5f));
        add_instance(scene, *scene.shapes[0], *scene.materials[0], {.translate = {3, 0, 1}, .scale = Vec3f(3)});
        scene.camera.position = {-1, 0, 1}, scene.camera.target = {0.5f, 0, 0};
        scene.sky.cube = constant_cube(Vec3f(1));
        scene.settings.sky_light = SkyLighting::off;
        build(scene);
        CHECK(seen(scene, 32, 32, 16) == 0);
        scene.settings.sky_light = SkyLighting::sampled;
        const double shadowed = seen(scene, 32, 32, 256);
        CHECK(shadowed < 0.45);
        CHECK(shadowed > 0.1);
        scene.settings.shadows = false;
        CHECK(seen(scene, 32, 32, 256) == doctest::Approx(0.5).epsilon(5e-3));
    }

    TEST_CASE("sky light: a sun of one texel costs no more noise than a light") {
        Scene scene = one_mesh(plane_mesh(), lambert(1));
        scene.sky.cube = constant_cube(Vec3f(0), 128);
        // Ahead is +Z; the texel is 45 degrees up.
        for (int c = 0; c < 3; ++c) scene.sky.cube[CubeFace::pz].at(64, 30, c) = 1e5f;
        build(scene);
        const double many = seen(scene, 32, 32, 4096);
        double worst = 0;
        for (std::uint32_t seed = 1; seed < 20; ++seed) {
            scene.settings.seed = seed;
            worst = std::max(worst, std::abs(seen(scene, 32, 32, 64) / many - 1));
        }
        CHECK(many > 1);
        CHECK(worst < 0.15);
    }

} // TEST_SUITE
