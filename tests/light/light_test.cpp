#include "bake/light/light.h"
#include <doctest/doctest.h>
#include <initializer_list>
#include <limits>

using namespace bake;

TEST_SUITE("oracle") {

    TEST_CASE("light: attenuation is 1 / (s_c + s_l r + s_q r^2)") {
        CHECK(attenuation(Attenuation<double>{2, 3, 5}, 4.0) == doctest::Approx(1.0 / (2 + 12 + 80)).epsilon(1e-14));
        CHECK(attenuation(Attenuation<double>{0, 0, 1}, 0.5) == doctest::Approx(4).epsilon(1e-14));
        CHECK(attenuation(Attenuation<double>{}, 1e9) == 1);
    }

    TEST_CASE("light: the radiance of a point light decreases with distance, and its direction is towards the light") {
        Light<double> light;
        light.kind = LightKind::point;
        light.position = {1, 2, 3};
        light.colour = {10, 20, 30};
        light.falloff = {0.5, 0.25, 2};
        const LightSample<double> s = sample(light, Vec3d(1, 2, 5)); // distance 2, direction -z
        CHECK(glm::length(s.l - Vec3d(0, 0, -1)) < 1e-15);
        CHECK(glm::length(s.radiance - light.colour / 9.0) < 1e-12);
    }

    TEST_CASE("light: a directional light is the same everywhere") {
        Light<float> light;
        light.from = {0, 0.6f, 0.8f};
        light.falloff = {5, 5, 5};
        const LightSample<float> s = sample(light, Vec3f(1e6f, -3, 7));
        CHECK(s.l == light.from);
        CHECK(s.radiance == light.colour);
    }

} // TEST_SUITE
TEST_SUITE("stability") {

    TEST_CASE("light: at the light, or without a valid falloff, the radiance is 0, not infinite") {
        Light<float> light;
        light.kind = LightKind::point;
        light.falloff = {0, 0, 1};
        const LightSample<float> s = sample(light, Vec3f(0));
        CHECK(s.l == Vec3f(0));
        CHECK(s.radiance == Vec3f(0));
        const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
        for (const float bad : {nan, inf, -1.0f, 0.0f, 1e-40f})
            CHECK(attenuation(Attenuation<float>{bad, 0, 0}, 1.0f) == 0);
    }

} // TEST_SUITE
