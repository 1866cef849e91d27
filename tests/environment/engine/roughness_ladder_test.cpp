// The ladders that engines agree on, and the numbers that they take beside the levels.
#include "bake/base/error.h"
#include "bake/base/vec.h"
#include "bake/environment/engine/dfg.h"
#include "bake/environment/engine/roughness_ladder.h"
#include "bake/environment/engine/sh_text.h"
#include "bake/light/ggx.h"
#include <cmath>
#include <doctest/doctest.h>

using namespace bake;

namespace {

/// A sky whose radiance is a function of the direction in the world.
template <class Radiance> Cube sky_of(int size, Radiance&& radiance) {
    Cube sky = make_cube(size, 3);
    for (const CubeFace face : all_cube_faces)
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                const CubePoint<double> at{face, (x + 0.5) / size, (y + 0.5) / size};
                const Vec3d d = world_to_cube(glm::normalize(cube_direction(at)));
                for (int c = 0; c < 3; ++c) sky[face].at(x, y, c) = float((c + 1) * radiance(d));
            }
    return sky;
}

double polynomial(const ShCoefficients& s, int c, const Vec3d& n) {
    const auto k = [&](int i) { return s.values[std::size_t(3 * i + c)]; };
    return k(0) + k(1) * n.y + k(2) * n.z + k(3) * n.x + k(4) * n.x * n.y + k(5) * n.y * n.z +
           k(6) * (3 * n.z * n.z - 1) + k(7) * n.x * n.z + k(8) * (n.x * n.x - n.y * n.y);
}

} // namespace

TEST_SUITE("oracle") {
    TEST_CASE("roughness_ladder: the levels of each engine's own documents") {
        // three.js r187: PMREMGenerator.lodToRoughness( lod, maxLod ), squared.
        const std::vector<double> three = roughness_ladder(Consumer::three, 512);
        REQUIRE(three.size() == 7);
        for (int l = 0; l <= 6; ++l)
            CHECK(three[std::size_t(l)] == doctest::Approx(std::pow(1 - std::sqrt(1 - l / 6.0), 2)));
        CHECK(three.back() == 1);
        // cmgen 1.9.25 prints "roughness(lin)" 0, .018, .086, .25, 1 for 256 texels.
        const std::vector<double> filament = roughness_ladder(Consumer::filament, 256);
        REQUIRE(filament.size() == 5);
        CHECK(filament[1] == doctest::Approx(0.018).epsilon(0.01));
        CHECK(filament[2] == doctest::Approx(0.0858).epsilon(0.01));
        CHECK(filament[3] == doctest::Approx(0.25));
        // bevy reads level perceptual_roughness (n - 1).
        CHECK(roughness_ladder(Consumer::bevy, 256) == std::vector<double>{0, 1 / 16.0, 1 / 4.0, 9 / 16.0, 1});
        // Babylon.js reads level 0.8 log2(alpha size).
        const std::vector<double> babylon = roughness_ladder(Consumer::babylon, 256);
        REQUIRE(babylon.size() == 9);
        CHECK(0.8 * std::log2(babylon[4] * 256) == doctest::Approx(4));
        CHECK(babylon[8] == 1);
        CHECK(roughness_ladder(Consumer::godot, 256).empty());
    }

    TEST_CASE("roughness_ladder: refuses sizes that do not halve") {
        for (const int edge : {0, 8, 500, 100}) CHECK_THROWS_AS(roughness_ladder(Consumer::three, edge), Error);
        CHECK_NOTHROW(roughness_ladder(Consumer::three, 16));
    }

    TEST_CASE("engine_sh: a sky that grows towards an axis of the world") {
        // L = 1 + a . d has the irradiance pi + 2 pi / 3 a . n.
        const Vec3d a(0.3, -0.5, 0.7);
        const Cube sky = sky_of(64, [&](const Vec3d& d) { return 1 + glm::dot(a, d); });
        const ShCoefficients series = engine_sh(sky, 3, ShForm::filament);
        for (const Vec3d& n : {Vec3d(1, 0, 0), Vec3d(0, 1, 0), Vec3d(0, 0, -1), glm::normalize(Vec3d(1, 2, 3))})
            for (int c = 0; c < 3; ++c)
                CHECK(polynomial(series, c, n) ==
                      doctest::Approx((c + 1) * (1 + 2.0 / 3 * glm::dot(a, n))).epsilon(2e-4));
        // The same in the other two forms.
        const double y00 = 1 / (2 * std::sqrt(pi)), y11 = std::sqrt(3 / (4 * pi));
        const ShCoefficients light = engine_sh(sky, 3, ShForm::radiance),
                             cosine = engine_sh(sky, 3, ShForm::irradiance);
        CHECK(light.values[0] * y00 == doctest::Approx(1).epsilon(1e-5));
        CHECK(light.values[9] * y11 == doctest::Approx(a.x).epsilon(2e-4)); // (1, 1), of x
        CHECK(cosine.values[9] == doctest::Approx(2 * pi / 3 * light.values[9]));
    }

    TEST_CASE("engine_sh: the second band in the world") {
        const Cube sky = sky_of(64, [&](const Vec3d& d) { return 1 + d.x * d.y + 0.5 * d.x * d.z + 0.2 * d.y * d.z; });
        const ShCoefficients series = engine_sh(sky, 3, ShForm::filament);
        const Vec3d n = glm::normalize(Vec3d(0.2, 0.5, -0.6));
        CHECK(polynomial(series, 0, n) ==
              doctest::Approx(1 + 0.25 * (n.x * n.y + 0.5 * n.x * n.z + 0.2 * n.y * n.z)).epsilon(2e-4));
        CHECK(to_text(series).find('\n') != std::string::npos);
    }

    TEST_CASE("dfg_table: integrals over directions of light by another quadrature") {
        const Image<float> table = dfg_table(16);
        for (const int y : {5, 10, 15})
            for (const int x : {1, 8, 15}) {
                CAPTURE(x);
                CAPTURE(y);
                const double r = (y + 0.5) / 16, alpha = r * r, mu = (x + 0.5) / 16, v_x = std::sqrt(1 - mu * mu);
                constexpr int size = 600;
                double scale = 0, bias = 0;
                for (int i = 0; i < size; ++i)
                    for (int j = 0; j < size; ++j) {
                        const double t = (i + 0.5) / size, l_z = t * t, s = std::sqrt(1 - l_z * l_z);
                        const Vec3d l(s * std::cos(pi * (j + 0.5) / size), s * std::sin(pi * (j + 0.5) / size), l_z);
                        const Vec3d h = glm::normalize(l + Vec3d(v_x, 0, mu));
                        const double f = double(ggx_distribution(float(alpha), float(1 - h.z * h.z))) *
                                         double(ggx_visibility(float(alpha), float(l_z), float(mu)));
                        const double share = f * l_z * 2 * t / size * 2 * pi / size;
                        const double schlick = std::pow(1 - (v_x * h.x + mu * h.z), 5);
                        scale += share * (1 - schlick), bias += share * schlick;
                    }
                CHECK(double(table.at(x, y, 0)) == doctest::Approx(scale).epsilon(3e-3));
                CHECK(std::abs(double(table.at(x, y, 1)) - bias) < 5e-4);
            }
    }
}
