#include "bake/environment/filter/spherical_harmonics.h"
#include "bake/preview/sampler.h"
#include "bake/preview/sky.h"
#include "preview/little_scenes.h"
#include <doctest/doctest.h>
#include <vector>

using namespace bake;
using namespace bake::test;

namespace {

/// Dark but for a bright disc about a world-space direction.
Sky sky_with_sun(const Vec3f& sun, int n) {
    Sky sky;
    sky.cube = constant_cube(Vec3f(0.1f), n);
    for (const CubeFace face : all_cube_faces)
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x) {
                const Vec3d d = glm::normalize(cube_direction(CubePoint<double>{face, (x + .5) / n, (y + .5) / n}));
                if (glm::dot(Vec3d(sun), world_to_cube(d)) < 0.995) continue;
                for (int c = 0; c < 3; ++c) sky.cube[face].at(x, y, c) = 50.0f * float(c + 1);
            }
    return sky;
}

Vec2f random_pair(int i, std::uint32_t seed) {
    Sampler sampler(0, 0, i, seed);
    return sampler.next2();
}

/// A direction distributed evenly over the sphere.
Vec3f even(const Vec2f& u) {
    const double z = 1 - 2 * u.x, r = std::sqrt(1 - z * z), a = 2 * pi * u.y;
    return {float(r * std::cos(a)), float(z), float(r * std::sin(a))};
}

/// Radiance integrated over all directions, by midpoints.
double total(const Sky& sky) {
    constexpr int n = 400;
    double sum = 0;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < 2 * n; ++i) sum += sky_radiance(sky, even({(j + .5f) / n, (i + .5f) / (2 * n)})).y;
    return sum * 4 * pi / (2.0 * n * n);
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE(
        "sky: with even directions for the dark part, the estimate of the sky's total radiance has little noise") {
        for (const float yaw : {0.0f, 70.0f})
            for (const int n : {16, 61}) {
                Sky sky = sky_with_sun(glm::normalize(Vec3f(0.3f, 0.8f, -0.5f)), n);
                sky.yaw = SkyYaw(yaw);
                const SkyLight light(sky);
                const auto share = [&](const Vec3f& l) {
                    return double(sky_radiance(sky, l).y) / (light.pdf(l) + 1 / (4 * pi));
                };
                double sum = 0, squares = 0;
                const int count = 1 << 14;
                for (int i = 0; i < count; ++i) {
                    const SkySample s = light.sample(random_pair(i, 2));
                    REQUIRE(s.pdf > 0);
                    CHECK(s.pdf == doctest::Approx(light.pdf(s.l)).epsilon(2e-3)); // a float at a texel's edge
                    const double value = share(s.l) + share(even(random_pair(i, 1)));
                    sum += value, squares += value * value;
                }
                sum /= count;
                CHECK(sum == doctest::Approx(total(sky)).epsilon(0.01));
                CHECK(std::sqrt(squares / count - sum * sum) < sum); // even directions alone: 4 times the mean
            }
    }

    TEST_CASE("sky: sampled directions are distributed as the density says (chi-square)") {
        Sky sky = sky_with_sun(glm::normalize(Vec3f(0.125f, 0.125f, 1)), 8);
        sky.yaw = SkyYaw(20);
        const SkyLight light(sky);
        // Cells of equal solid angle: 16 bands of height, 16 of angle. The expected share of each by 32 x 32 midpoints.
        constexpr int bands = 16, fine = 48, count = 200'000;
        std::vector<double> expected(bands * bands), seen(bands * bands);
        for (int j = 0; j < bands * fine; ++j)
            for (int i = 0; i < bands * fine; ++i) {
                const double y = 1 - 2 * (j + .5) / (bands * fine), a = 2 * pi * (i + .5) / (bands * fine) - pi;
                const double r = std::sqrt(1 - y * y);
                expected[(j / fine) * bands + i / fine] +=
                    count * 4 * pi / (bands * fine) / (bands * fine) *
                    light.pdf({float(r * std::sin(a)), float(y), float(r * std::cos(a))});
            }
        for (int i = 0; i < count; ++i) {
            const std::uint64_t bits = hash(std::uint64_t(i));
            const Vec3f l = light.sample({float(bits >> 40) * 0x1p-24f, float(bits & 0xffffff) * 0x1p-24f}).l;
            const int j = std::clamp(int((1 - l.y) / 2 * bands), 0, bands - 1);
            const int k = std::clamp(int((std::atan2(l.x, l.z) + pi) / (2 * pi) * bands), 0, bands - 1);
            seen[j * bands + k] += 1;
        }
        double statistic = 0;
        int cells = 0;
        for (int i = 0; i < bands * bands; ++i) {
            if (expected[i] < 5) {
                CHECK(seen[i] < 30);
                continue;
            }
            ++cells;
            // The midpoint rule has an error of its own, below 1 % here.
            const double error = seen[i] - expected[i], noise = expected[i] + 1e-4 * expected[i] * expected[i];
            statistic += error * error / noise;
        }
        REQUIRE(cells > 8);
        CHECK(statistic < cells + 4 * std::sqrt(2.0 * cells));
    }

} // TEST_SUITE

TEST_SUITE("unit") {

    TEST_CASE("sky: yaw moves what is ahead to the right, for the eye and for the light") {
        Sky sky = sky_with_sun({0, 0, 1}, 16);
        CHECK(sky_radiance(sky, {0, 0, 1}).x > 40);
        sky.yaw = SkyYaw(90);
        // The camera looks along +Z; its right is -X.
        CHECK(sky_radiance(sky, {-1, 0, 0}).x > 40);
        CHECK(sky_radiance(sky, {0, 0, 1}).x < 1);
        int towards = 0;
        const SkyLight light(sky);
        for (int i = 0; i < 256; ++i) towards += light.sample(random_pair(i, 0)).l.x < -0.95f;
        CHECK(towards > 240);
    }

    TEST_CASE("sky: black, empty and background skies do not light; a corner of the unit square is a direction") {
        Sky sky;
        sky.background = Vec3f(1);
        CHECK(SkyLight(sky).is_black());
        CHECK(SkyLight(sky).pdf({0, 1, 0}) == 0);
        sky.cube = constant_cube(Vec3f(0));
        CHECK(SkyLight(sky).is_black());
        sky.cube = constant_cube(Vec3f(1), 1);
        sky.scale = 0;
        CHECK(SkyLight(sky).is_black());
        sky.scale = 1;
        CHECK_FALSE(SkyLight(sky).is_black());
        CHECK(SkyLight(sky).sample(Vec2f(0.5f)).pdf == 0); // even: nothing is brighter than the rest
        for (int c = 0; c < 3; ++c) sky.cube[CubeFace::py].at(0, 0, c) = 9;
        const SkyLight light(sky);
        for (const Vec2f& u : {Vec2f(0), Vec2f(0.99999994f), Vec2f(0, 0.99999994f)}) {
            const SkySample s = light.sample(u);
            CHECK(glm::length(s.l) == doctest::Approx(1));
            CHECK(s.pdf > 0);
        }
    }

    TEST_CASE("sky: one bright texel in a sky of 2048 texels is never missed") {
        Sky sky;
        sky.cube = constant_cube(Vec3f(0), 2048);
        for (int c = 0; c < 3; ++c) sky.cube[CubeFace::py].at(700, 1200, c) = 1e6f;
        const SkyLight light(sky);
        const Vec3d d = world_to_cube(cube_direction(CubePoint<double>{CubeFace::py, 700.5 / 2048, 1200.5 / 2048}));
        const SkySample s = light.sample({0.3f, 0.6f});
        CHECK(glm::dot(Vec3d(s.l), glm::normalize(d)) > std::cos(8 * 2.0 / 512));
        CHECK(light.pdf(Vec3f(glm::normalize(d))) > 1000);
    }

} // TEST_SUITE
