#include "bake/base/vec.h"
#include "bake/verdict/pair_check.h"
#include <cmath>
#include <doctest/doctest.h>

using namespace bake;

namespace {

struct Wave {
    double at(double u, double v) const {
        return 0.5 + 0.2 * std::sin(2 * pi * (2 * u + v)) + 0.15 * std::cos(2 * pi * (3 * v - u));
    }
    double u(double u_, double v) const {
        return 0.8 * pi * std::cos(2 * pi * (2 * u_ + v)) + 0.3 * pi * std::sin(2 * pi * (3 * v - u_));
    }
    double v(double u_, double v_) const {
        return 0.4 * pi * std::cos(2 * pi * (2 * u_ + v_)) - 0.9 * pi * std::sin(2 * pi * (3 * v_ - u_));
    }
};

Image<float> wave_height(int size, double sign = 1) {
    Image<float> image(size, size, 1);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            image.at(x, y) = float(0.5 + sign * (Wave{}.at((x + 0.5) / size, 1 - (y + 0.5) / size) - 0.5));
    return image;
}

// Decoded OpenGL normals of the wave: `scale` is the slope per unit of height and texel at this size.
Image<float> wave_normals(int size, double scale, bool directx = false, double length = 1) {
    Image<float> image(size, size, 3);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const double u = (x + 0.5) / size, v = 1 - (y + 0.5) / size;
            const double s = -scale * Wave{}.u(u, v) / size, t = -scale * Wave{}.v(u, v) / size,
                         z = length / std::sqrt(s * s + t * t + 1);
            image.at(x, y, 0) = float(s * z);
            image.at(x, y, 1) = float(directx ? -t * z : t * z);
            image.at(x, y, 2) = float(z);
        }
    return image;
}

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("check_pair: agreement, scale, and each convention separately") {
        const PairCheck good = check_pair(wave_height(128), wave_normals(128, 10));
        CHECK(good.corr_x > 0.999);
        CHECK(good.corr_y > 0.999);
        CHECK(good.scale ==
              doctest::Approx(10).epsilon(0.01)); // central differences are 1 % too small for a wave of 42 texels
        CHECK_FALSE(good.inverted);
        CHECK_FALSE(good.directx);
        CHECK(good.normal_length == doctest::Approx(1));
        CHECK(good.not_unit == 0);

        const PairCheck directx = check_pair(wave_height(128), wave_normals(128, 10, true));
        CHECK(directx.directx);
        CHECK_FALSE(directx.inverted);
        const PairCheck inverted = check_pair(wave_height(128, -1), wave_normals(128, 10));
        CHECK(inverted.inverted);
        CHECK_FALSE(inverted.directx);
        const PairCheck both = check_pair(wave_height(128, -1), wave_normals(128, 10, true));
        CHECK(both.inverted);
        CHECK(both.directx);
    }

    TEST_CASE("check_pair: normals that are too short have the right slopes, and are reported") {
        const PairCheck c = check_pair(wave_height(96), wave_normals(96, 10, false, 0.61));
        CHECK(c.normal_length == doctest::Approx(0.61));
        CHECK(c.not_unit == 1);
        CHECK(c.scale == doctest::Approx(10).epsilon(0.01));
    }

    TEST_CASE("check_pair: the larger image is box-filtered to the smaller one, for integer and other factors") {
        const PairCheck finer_normals = check_pair(wave_height(96), wave_normals(192, 20));
        CHECK(finer_normals.width == 96);
        CHECK(finer_normals.corr_x > 0.999);
        CHECK(finer_normals.scale == doctest::Approx(10).epsilon(0.02)); // the texel is twice as wide
        const PairCheck finer_height = check_pair(wave_height(160), wave_normals(96, 10));
        CHECK(finer_height.corr_y > 0.999);
        CHECK(finer_height.scale == doctest::Approx(10).epsilon(0.02));
    }

    TEST_CASE("check_pair: relief along one axis decides what this axis tells, and noise along the other nothing") {
        // Planks: relief along `axis`, and independent noise of a hundredth of it everywhere.
        const auto planks = [](int axis, double sign, std::uint32_t seed) {
            Image<float> image(128, 128, 1);
            for (int y = 0; y < 128; ++y)
                for (int x = 0; x < 128; ++x) {
                    seed = seed * 1664525u + 1013904223u;
                    const double noise = double(seed >> 8) / (1 << 24) - 0.5;
                    image.at(x, y) =
                        float(0.5 + sign * 0.3 * std::sin(2 * pi * 5 * (axis ? y : x) / 128) + 0.01 * noise);
                }
            return image;
        };
        // OpenGL normals of slope 4 times the central difference.
        const auto normals_of = [](const Image<float>& h, double green) {
            Image<float> image(128, 128, 3);
            for (int y = 0; y < 128; ++y)
                for (int x = 0; x < 128; ++x) {
                    const Vec3d n =
                        glm::normalize(Vec3d(-2 * (h.at((x + 1) % 128, y) - h.at((x + 127) % 128, y)),
                                             -2 * green * (h.at(x, (y + 127) % 128) - h.at(x, (y + 1) % 128)), 1));
                    for (int c = 0; c < 3; ++c) image.at(x, y, c) = float(n[c]);
                }
            return image;
        };
        const PairCheck along_y = check_pair(planks(1, 1, 1), normals_of(planks(1, 1, 2), 1));
        CHECK(along_y.corr > 0.99);
        CHECK_FALSE(along_y.height_decided);
        CHECK_FALSE(along_y.green_decided);
        CHECK_FALSE(along_y.inverted);
        CHECK_FALSE(along_y.directx);
        CHECK(along_y.scale == doctest::Approx(4).epsilon(0.02));
        CHECK_FALSE(pair_recipe(along_y, 1)->directx);
        // The height is inverted, or green points down: baking with either gives the map.
        const PairCheck turned = check_pair(planks(1, 1, 1), normals_of(planks(1, -1, 2), 1));
        CHECK_FALSE(turned.height_decided);
        CHECK(pair_recipe(turned, 1)->directx);
        const PairCheck along_x = check_pair(planks(0, 1, 1), normals_of(planks(0, -1, 2), -1));
        CHECK(along_x.height_decided);
        CHECK(along_x.inverted);
        CHECK_FALSE(along_x.green_decided);
        CHECK_FALSE(along_x.directx);
    }

    TEST_CASE("pair_recipe: the amplitude and the extent that reproduce the map, nothing for another relief") {
        const PairCheck square = check_pair(wave_height(128), wave_normals(128, 10, true));
        const auto recipe = pair_recipe(square, 1);
        REQUIRE(recipe);
        CHECK(recipe->amplitude == doctest::Approx(10.0 / 128).epsilon(0.02));
        CHECK(recipe->extent_v == 0);
        CHECK(recipe->directx);
        CHECK_FALSE(recipe->invert);
        // Slopes along v are half as steep: the picture is twice as high as it is wide.
        Image<float> normals = wave_normals(128, 10);
        for (std::size_t i = 0; i < normals.size(); i += 3) {
            const Vec3d n =
                glm::normalize(Vec3d(normals.data()[i], 0.5 * normals.data()[i + 1], normals.data()[i + 2]));
            for (int c = 0; c < 3; ++c) normals.data()[i + c] = float(n[c]);
        }
        const auto tall = pair_recipe(check_pair(wave_height(128), normals), 1);
        REQUIRE(tall);
        CHECK(tall->amplitude == doctest::Approx(10.0 / 128).epsilon(0.02));
        CHECK(tall->extent_v == doctest::Approx(2).epsilon(0.02));
        Image<float> flat(64, 64, 1);
        std::fill_n(flat.data(), flat.size(), 0.25f);
        CHECK_FALSE(pair_recipe(check_pair(flat, wave_normals(64, 10)), 1));
    }

    TEST_CASE("check_pair: relief along one axis alone is not flat") {
        for (const bool upright : {false, true}) {
            Image<float> height(64, 64, 1), normals(64, 64, 3);
            for (int y = 0; y < 64; ++y)
                for (int x = 0; x < 64; ++x) {
                    const double phase = 2 * pi * 3 * ((upright ? y : x) + 0.5) / 64;
                    height.at(x, y) = float(0.5 + 0.2 * std::sin(phase));
                    // Rows run downwards, and green points up.
                    const double slope = 10 * 0.2 * 2 * pi * 3 / 64 * std::cos(phase), z = 1 / std::hypot(slope, 1);
                    normals.at(x, y, upright ? 1 : 0) = float((upright ? slope : -slope) * z);
                    normals.at(x, y, 2) = float(z);
                }
            const PairCheck c = check_pair(height, normals);
            CHECK_FALSE(c.flat);
            CHECK(c.corr_x == doctest::Approx(upright ? 0 : 1).epsilon(1e-3));
            CHECK(c.corr_y == doctest::Approx(upright ? 1 : 0).epsilon(1e-3));
            CHECK_FALSE(c.inverted);
            CHECK_FALSE(c.green_decided);
            CHECK(c.scale == doctest::Approx(10).epsilon(0.02));
        }
    }

    TEST_CASE("check_pair: other relief does not agree, flat images are flat, one texel is accepted") {
        Image<float> other(128, 128, 1);
        for (int y = 0; y < 128; ++y)
            for (int x = 0; x < 128; ++x)
                other.at(x, y) = float(0.5 + 0.5 * std::sin(2 * pi * 5 * x / 128) * std::sin(2 * pi * 7 * y / 128));
        const PairCheck c = check_pair(other, wave_normals(128, 10));
        CHECK(std::abs(c.corr_x) < pair_tells);
        Image<float> flat(64, 64, 1);
        std::fill_n(flat.data(), flat.size(), 0.25f);
        CHECK(check_pair(flat, wave_normals(64, 10)).flat);
        Image<float> one(1, 1, 1), blue(1, 1, 3);
        one.at(0, 0) = 1;
        std::fill_n(blue.data(), 3, -1.0f);
        CHECK(check_pair(one, blue).flat);
        CHECK(check_pair(one, blue).inward == 1);
    }

    TEST_CASE("check_normals: the first map takes the place of the height") {
        const Image<float> a = wave_normals(96, 10);
        const PairCheck same = check_normals(a, a);
        CHECK(same.corr_x == doctest::Approx(1));
        CHECK(same.scale == doctest::Approx(1));
        CHECK(same.green_decided);
        CHECK_FALSE(same.directx);
        CHECK_FALSE(same.inverted);
        CHECK(check_normals(a, wave_normals(96, 10, true)).directx);
        CHECK(check_normals(wave_normals(96, 10, true), a).directx);
        CHECK_FALSE(check_normals(wave_normals(96, 10, true), wave_normals(96, 10, true)).directx);
        const PairCheck inverted = check_normals(a, wave_normals(96, -10));
        CHECK(inverted.inverted);
        CHECK_FALSE(inverted.directx);
        CHECK(check_normals(a, wave_normals(96, 20)).scale == doctest::Approx(2));
        CHECK(check_normals(a, wave_normals(96, 0)).flat);
    }
}
