#include "bake/light/light.h"
#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <initializer_list>
#include <limits>
#include <utility>

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

    TEST_CASE("light: a quad's samples add up to the closed form of its irradiance") {
        // A square of half edge 1.5 at height 2 above the point, parallel to the surface: four corner rectangles
        // (Howell, A Catalog of Radiation Heat Transfer Configuration Factors, B-3).
        Light<double> light;
        light.kind = LightKind::quad;
        light.position = {1, 4, 7}, light.colour = {1, 2, 4};
        light.edge_u = {0, 0, 3}, light.edge_v = {3, 0, 0}; // shines towards +y: away from the point
        const Vec3d p(1, 2, 7), n(0, 1, 0);
        const auto irradiance = [&] {
            Vec3d sum(0);
            const int k = 200;
            for (int j = 0; j < k; ++j)
                for (int i = 0; i < k; ++i) {
                    const LightSample<double> s = sample(light, p, Vec2d((i + 0.5) / k, (j + 0.5) / k));
                    sum += s.radiance * std::max(0.0, glm::dot(s.l, n));
                }
            return sum / double(k * k);
        };
        CHECK(irradiance() == Vec3d(0));
        std::swap(light.edge_u, light.edge_v);
        const double x = 1.5 / 2, root = std::sqrt(1 + x * x);
        const double factor = 4 * 2 * x / root * std::atan(x / root) / (2 * pi);
        CHECK(glm::length(irradiance() - factor * light.colour) < 2e-5);
    }

    TEST_CASE("light: a spot light shines fully in its inner cone, falls to 0 at the outer one") {
        Light<double> light;
        light.kind = LightKind::spot;
        light.from = {0, 1, 0}; // shines down
        light.position = {0, 1, 0};
        light.cos_inner = std::cos(0.2), light.cos_outer = std::cos(0.6);
        light.falloff = {0, 0, 2};
        const auto at = [&](double angle) {
            return sample(light, Vec3d(std::sin(angle), 1 - std::cos(angle), 0)).radiance.x;
        };
        CHECK(at(0) == doctest::Approx(0.5));
        CHECK(at(0.199) == doctest::Approx(0.5));
        CHECK(at(0.601) == 0);
        CHECK(at(2) == 0);
        const double part = (std::cos(0.4) - std::cos(0.6)) / (std::cos(0.2) - std::cos(0.6));
        CHECK(at(0.4) == doctest::Approx(0.5 * part * part));
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
