// Means and moments over footprints, against closed forms and against many lookups at points.
#include "bake/preview/texture.h"
#include "preview/little_scenes.h"
#include <doctest/doctest.h>
#include <limits>
#include <random>

using namespace bake;
using namespace bake::test;

namespace {

/// Slopes of A sin(2 pi k u), along u.
Texture sine_slopes(int size, int k, double A) {
    return texture(size, size, 2, [&](float u, float, float* s) {
        s[0] = float(A * 2 * pi * k * std::cos(2 * pi * k * double(u)));
        s[1] = 0;
    });
}

Texture noise(int width, int height) {
    std::mt19937 random(7);
    std::normal_distribution<float> normal(0.1f, 0.4f);
    return texture(width, height, 2,
                   [&](float, float, float* s) { s[0] = normal(random), s[1] = 0.3f * s[0] + normal(random); });
}

SlopeMoments moments(const Texture& table, const Mips& mips, const Vec2f& uv, const Footprint& footprint) {
    return moments_over(mips, taps_of(mips, uv, footprint), [&](const Vec2f& at) { return lookup2(*table, at); });
}

Footprint square(float side) { return {{side, 0}, {0, side}}; }

/// Mean and covariance by n x n lookups, evenly over a square around uv.
SlopeMoments by_points(const Texture& table, const Vec2f& uv, float side, int n) {
    Vec2d mean(0);
    Vec3d square(0);
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const Vec2f at = uv + side * (Vec2f(float(i) + 0.5f, float(j) + 0.5f) / float(n) - 0.5f);
            const Vec2d s(lookup2(*table, at));
            mean += s, square += Vec3d(s.x * s.x, s.y * s.y, s.x * s.y);
        }
    mean /= double(n) * n, square /= double(n) * n;
    return {Vec2f(mean), Vec3f(square - Vec3d(mean.x * mean.x, mean.y * mean.y, mean.x * mean.y))};
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE(
        "texture_mips: a sine has mean slope 0 and half its squared amplitude, at every level and in every direction") {
        const double A = 0.01;
        const Texture table = sine_slopes(256, 16, A);
        const auto mips = slope_mips(*table);
        const double peak = A * 2 * pi * 16, wanted = peak * peak / 2;
        // What bilinear interpolation leaves of a sine of 16 texels per wave.
        const double w = 2 * pi / 16, kept = (2 + std::cos(w)) / 3;
        for (std::size_t level = 0; level < mips->levels.size(); ++level) {
            double mean = 0, second = 0;
            const Image<float>& image = mips->levels[level];
            for (std::size_t i = 0; i < image.size(); i += 5) mean += image.data()[i], second += image.data()[i + 2];
            const double texels = double(image.size()) / 5;
            CHECK(mean / texels == doctest::Approx(0).epsilon(1e-5));
            CHECK(second / texels == doctest::Approx(wanted * kept).epsilon(1e-3));
        }
        for (const float side : {0.25f, 0.5f, 1.0f, 3.0f}) {
            const SlopeMoments wide = moments(table, *mips, {0.3f, 0.4f}, square(side));
            CHECK(std::abs(wide.mean.x) < 1e-3 * peak);
            CHECK(wide.covariance.x == doctest::Approx(wanted * kept).epsilon(2e-3));
            CHECK(wide.covariance.y == 0);
        }
        // Along v nothing varies, so that a footprint along v loses nothing; one along u loses all.
        const float texel = 1.0f / 256;
        const SlopeMoments along_v = moments(table, *mips, {0.3f, 0.4f}, {{0, 4 * texel}, {0.5f * texel, 0}});
        CHECK(along_v.covariance.x < 0.01 * wanted);
        const SlopeMoments along_u = moments(table, *mips, {0.3f, 0.4f}, {{16 * texel, 0}, {0, 2 * texel}});
        CHECK(along_u.covariance.x == doctest::Approx(wanted).epsilon(0.1));
    }

    TEST_CASE(
        "texture_mips: moments of noise over the whole picture are those of bilinear lookups, also at odd sizes") {
        for (const auto& [width, height] : {std::pair(64, 64), std::pair(37, 21), std::pair(5, 64)}) {
            const Texture table = noise(width, height);
            const auto mips = slope_mips(*table);
            const SlopeMoments top = moments(table, *mips, {0.5f, 0.5f}, square(4));
            const SlopeMoments points = by_points(table, {0.5f, 0.5f}, 1, 12 * std::max(width, height));
            CHECK(top.mean.x == doctest::Approx(points.mean.x).epsilon(1e-3));
            CHECK(top.mean.y == doctest::Approx(points.mean.y).epsilon(1e-3));
            CHECK(top.covariance.x == doctest::Approx(points.covariance.x).epsilon(5e-3));
            CHECK(top.covariance.y == doctest::Approx(points.covariance.y).epsilon(5e-3));
            CHECK(top.covariance.z == doctest::Approx(points.covariance.z).epsilon(5e-3));
        }
    }

    TEST_CASE("texture_mips: a normal map has the moments of the table of its slopes") {
        const Texture table = noise(32, 32);
        const Texture normals = texture(32, 32, 3, [&](float u, float v, float* t) {
            const Vec2f s = lookup2(*table, {u, v});
            const Vec3f n = glm::normalize(Vec3f(-s.x, -s.y, 1));
            t[0] = n.x, t[1] = n.y, t[2] = n.z;
        });
        const auto of_table = slope_mips(*table), of_map = normal_mips(*normals);
        REQUIRE(of_table->levels.size() == of_map->levels.size());
        for (std::size_t i = 0; i < of_table->levels[0].size(); ++i)
            CHECK(of_map->levels[0].data()[i] == doctest::Approx(of_table->levels[0].data()[i]).epsilon(1e-4));
        CHECK(slopes_of({3, 4, 0}) == Vec2f(-7.5f, -10));
        CHECK(slopes_of({0, 0, -1}) == Vec2f(0));
    }

} // TEST_SUITE

TEST_SUITE("unit") {

    TEST_CASE("texture_mips: without extent a lookup is the picture's own value, and no slope is lost") {
        const Texture table = noise(32, 16);
        const auto mips = slope_mips(*table);
        for (const float side : {0.0f, 0.4f / 32}) {
            const SlopeMoments point = moments(table, *mips, {0.123f, 0.77f}, square(side));
            CHECK(point.mean == lookup2(*table, {0.123f, 0.77f}));
            CHECK(point.covariance.x <= 1e-7f);
        }
        Texture colour = texture(8, 8, 3, [](float u, float v, float* c) { c[0] = u, c[1] = v, c[2] = u * v; });
        CHECK(lookup3(colour, {0.3f, 0.6f}, square(1)) == lookup3(*colour, {0.3f, 0.6f})); // no mips
        colour.mips = colour_mips(*colour);
        CHECK(lookup3(colour, {0.3f, 0.6f}, {}) == lookup3(*colour, {0.3f, 0.6f}));
        const Vec3f mean = lookup3(colour, {0.3f, 0.6f}, square(1));
        CHECK(mean.x == doctest::Approx(0.5));
        CHECK(mean.z == doctest::Approx(0.25));
    }

    TEST_CASE("texture_mips: equal slopes lose nothing at any width, and the mean keeps them") {
        const Texture table = texture(48, 20, 2, [](float, float, float* s) { s[0] = 0.3f, s[1] = -0.7f; });
        for (const bool repeats : {true, false}) {
            const auto mips = slope_mips(*table, repeats);
            for (const float side : {0.01f, 0.04f, 0.1f, 0.7f, 50.0f}) {
                const SlopeMoments m = moments(table, *mips, {0.9f, 0.05f}, square(side));
                CHECK(glm::length(m.mean - Vec2f(0.3f, -0.7f)) < 1e-5f);
                CHECK(glm::length(m.covariance) < 1e-5f);
            }
        }
    }

    TEST_CASE("texture_mips: taps follow the long axis, at most eight of them, and each is as wide as the short axis") {
        Mips mips{.levels = {}, .width = 256, .height = 256};
        for (int size = 128; size >= 1; size /= 2) mips.levels.emplace_back(size, size, 2);
        const float texel = 1.0f / 256;
        const Taps four = taps_of(mips, {0.5f, 0.5f}, {{0, 16 * texel}, {4 * texel, 0}});
        CHECK(four.count == 4);
        CHECK(four.level == 1); // of a quarter of the resolution
        CHECK(four.next == doctest::Approx(0));
        CHECK(four.step.y == doctest::Approx(4 * texel));
        CHECK(four.first.y == doctest::Approx(0.5 - 6 * texel));
        const Taps many = taps_of(mips, {0.5f, 0.5f}, {{0, 64 * texel}, {texel, 0}});
        CHECK(many.count == Taps::most);
        CHECK(many.level == 2); // 8 texels wide
        CHECK(taps_of(mips, {0.5f, 0.5f}, square(100)).level == 7);
        CHECK(taps_of(mips, {0.5f, 0.5f}, square(0.5f * texel)).is_point());
        const Taps between = taps_of(mips, {0.5f, 0.5f}, square(texel));
        CHECK(between.level == -1);
        CHECK(between.next == doctest::Approx(0.2));
    }

} // TEST_SUITE

TEST_SUITE("stability") {

    TEST_CASE("texture_mips: the covariance is one, and lookups are finite, wherever and however wide") {
        const Texture table = noise(9, 7);
        const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
        for (const bool repeats : {true, false}) {
            const auto mips = slope_mips(*table, repeats);
            std::mt19937 random(3);
            std::uniform_real_distribution<float> uniform(-2, 2);
            for (int i = 0; i < 2000; ++i) {
                const float scale = std::exp2(4 * uniform(random));
                const Footprint print{scale * Vec2f(uniform(random), uniform(random)),
                                      scale * 0.2f * Vec2f(uniform(random), uniform(random))};
                const SlopeMoments m = moments(table, *mips, {uniform(random), uniform(random)}, print);
                CHECK(m.covariance.x * m.covariance.y >= 0.9999f * m.covariance.z * m.covariance.z);
                CHECK(m.covariance.x >= 0);
            }
            for (const float bad : {nan, inf, 1e30f}) {
                CHECK(std::isfinite(moments(table, *mips, {bad, 0.5f}, square(0.1f)).mean.x));
                CHECK(std::isfinite(moments(table, *mips, {0.5f, 0.5f}, square(bad)).mean.x));
            }
        }
        const Texture one = texture(1, 1, 2, [](float, float, float* s) { s[0] = 1, s[1] = 2; });
        CHECK(moments(one, *slope_mips(*one), {0.2f, 0.2f}, square(3)).mean == Vec2f(1, 2));
    }

} // TEST_SUITE
