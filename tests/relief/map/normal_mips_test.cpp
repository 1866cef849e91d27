#include "bake/base/parallel.h"
#include "bake/relief/map/normal_code.h"
#include "bake/relief/map/normal_mips.h"
#include <cstring>
#include <doctest/doctest.h>
#include <functional>

using namespace bake;

namespace {

Image<float> map_of(int width, int height, const std::function<Vec2d(double u, double v)>& slopes) {
    Image<float> map(width, height, 3);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const Vec2d s = slopes((x + 0.5) / width, 1 - (y + 0.5) / height);
            const Vec3f rgb = encode_normal(Vec3f(glm::normalize(Vec3d(-s.x, -s.y, 1))), false);
            for (int c = 0; c < 3; ++c) map.at(x, y, c) = rgb[c];
        }
    return map;
}

/// Slopes without any period.
Vec2d grain(double u, double v) {
    return {0.8 * std::sin(41 * u + 17 * v * v), 0.5 * std::cos(29 * v - 13 * u * u) + 0.2};
}

} // namespace

TEST_SUITE("oracle") {
    TEST_CASE("normal_mips: the roughness of a ridge is its closed form at every level coarser than its waves") {
        // h = A sin(2 pi k u): the slope along u has the variance S^2 / 2 with S = 2 pi k A, that along v none.
        const int size = 256, waves = 32; // of 8 texels
        for (const double S : {0.05, 0.3, 0.6})
            for (const double roughness : {0.1, 0.5}) {
                CAPTURE(S);
                CAPTURE(roughness);
                const auto levels = normal_mips(
                    map_of(size, size, [&](double u, double) { return Vec2d(S * std::cos(2 * pi * waves * u), 0); }));
                REQUIRE(levels.size() == 9);
                const double alpha = roughness * roughness, truth = std::pow(alpha * alpha + S * S / 2, 0.25);
                for (std::size_t level = 3; level < levels.size(); ++level) {
                    CAPTURE(level);
                    const float* m = levels[level].moments.data();
                    CHECK(double(slope_variance(m)) == doctest::Approx(S * S / 4).epsilon(0.02));
                    CHECK(double(m[2] - m[0] * m[0]) == doctest::Approx(S * S / 2).epsilon(0.02));
                    const Image<float> map = roughness_map(levels[level], float(roughness));
                    for (std::size_t i = 0; i < map.size(); ++i)
                        CHECK(double(map.data()[i]) == doctest::Approx(truth).epsilon(0.005));
                }
                for (const float r : {roughness_map(levels[0], float(roughness)).at(5, 7)})
                    CHECK(double(r) == doctest::Approx(roughness).epsilon(1e-4)); // nothing is lost yet
            }
    }
    TEST_CASE("normal_mips: slopes of a Beckmann distribution of alpha add up to it") {
        // Normally distributed slopes of variance alpha^2 / 2 per axis, by the inverse of their distribution.
        const double alpha = 0.3;
        const int size = 128;
        const auto levels = normal_mips(map_of(size, size, [&](double u, double v) {
            const double radius = alpha * std::sqrt(-std::log(u)), angle = 2 * pi * v;
            return Vec2d(radius * std::cos(angle), radius * std::sin(angle));
        }));
        CHECK(double(roughness_map(levels.back(), 0).at(0, 0)) == doctest::Approx(std::sqrt(alpha)).epsilon(0.005));
    }
}

TEST_SUITE("unit") {
    TEST_CASE("normal_mips: every level is the box filter of the finest one, for any size") {
        for (const auto& [width, height] : {std::pair(64, 64), std::pair(37, 21), std::pair(10, 1), std::pair(1, 1)}) {
            CAPTURE(width);
            CAPTURE(height);
            const auto levels = normal_mips(map_of(width, height, grain));
            int w = width, h = height;
            for (std::size_t k = 0; k < levels.size(); ++k, w = std::max(1, w / 2), h = std::max(1, h / 2)) {
                const NormalLevel& level = levels[k];
                REQUIRE(level.normal.width() == w);
                REQUIRE(level.normal.height() == h);
                // The mean of everything, weighted by area, is the same at every level: texels of a level are alike.
                Vec3d mean(0), whole(0);
                double squares = 0, whole_squares = 0;
                for (int y = 0; y < h; ++y)
                    for (int x = 0; x < w; ++x) {
                        for (int c = 0; c < 3; ++c)
                            mean[c] += double(level.normal.at(x, y, c) * level.length.at(x, y)) / (w * h);
                        squares += double(level.moments.at(x, y, 2)) / (w * h);
                    }
                for (int y = 0; y < height; ++y)
                    for (int x = 0; x < width; ++x) {
                        for (int c = 0; c < 3; ++c) whole[c] += double(levels[0].normal.at(x, y, c)) / (width * height);
                        whole_squares += double(levels[0].moments.at(x, y, 2)) / (width * height);
                    }
                CHECK(glm::length(mean - whole) < 1e-6);
                CHECK(squares == doctest::Approx(whole_squares).epsilon(1e-5));
            }
            CHECK(w == 1);
            CHECK(h == 1);
        }
    }
    TEST_CASE("normal_mips: sizes that do not divide are still filtered from the finest level") {
        // 10 texels, then 5, then 2: the first of the two covers 5 texels of the finest level.
        const auto levels = normal_mips(map_of(10, 1, grain));
        REQUIRE(levels.size() == 4);
        for (int half = 0; half < 2; ++half) {
            Vec3d mean(0);
            for (int x = 0; x < 5; ++x)
                for (int c = 0; c < 3; ++c) mean[c] += double(levels[0].normal.at(5 * half + x, 0, c)) / 5;
            CHECK(double(levels[2].length.at(half, 0)) == doctest::Approx(glm::length(mean)).epsilon(1e-6));
            for (int c = 0; c < 3; ++c)
                CHECK(double(levels[2].normal.at(half, 0, c)) ==
                      doctest::Approx(mean[c] / glm::length(mean)).epsilon(1e-5));
        }
    }
    TEST_CASE("normal_mips: a flat map stays flat, opposite normals and zero vectors give no NaN, and roughness is at "
              "most 1") {
        Image<float> map(4, 2, 3);
        std::fill_n(map.data(), map.size(), 0.5f); // zero vectors
        for (const NormalLevel& level : normal_mips(map)) {
            CHECK(level.normal.at(0, 0, 2) == 1);
            CHECK(level.length.at(0, 0) == 1);
            CHECK(roughness_map(level, 0.25f).at(0, 0) == doctest::Approx(0.25));
        }
        for (int x = 0; x < 4; ++x)
            for (int y = 0; y < 2; ++y) map.at(x, y) = x % 2 ? 1.0f : 0.0f; // +x and -x
        const auto levels = normal_mips(map);
        CHECK(levels.back().normal.at(0, 0, 2) == 1);
        CHECK(levels.back().length.at(0, 0) == 0);
        CHECK(roughness_map(levels.back(), 0.25f).at(0, 0) == 1);
    }
    TEST_CASE("normal_mips: --directx turns the slope along v alone, and no thread changes a byte") {
        const Image<float> map = map_of(33, 18, grain);
        const auto up = normal_mips(map), down = normal_mips(map, true);
        const ThreadLimit one(1);
        const auto single = normal_mips(map);
        for (std::size_t k = 0; k < up.size(); ++k) {
            CHECK(down[k].moments.at(0, 0, 1) == -up[k].moments.at(0, 0, 1));
            CHECK(down[k].moments.at(0, 0, 0) == up[k].moments.at(0, 0, 0));
            CHECK(down[k].normal.at(0, 0, 1) == up[k].normal.at(0, 0, 1));
            CHECK(std::memcmp(single[k].moments.data(), up[k].moments.data(), up[k].moments.size() * sizeof(float)) ==
                  0);
            CHECK(std::memcmp(single[k].normal.data(), up[k].normal.data(), up[k].normal.size() * sizeof(float)) == 0);
        }
    }
}
