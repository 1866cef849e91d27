#include "bake/relief/height/slope_filter.h"
#include <cmath>
#include <cstring>
#include <doctest/doctest.h>
#include <random>

using namespace bake;

namespace {

template <class T> Image<T> noise(int width, int height) {
    std::mt19937 random(11);
    std::uniform_real_distribution<T> value(0, 1);
    Image<T> image(width, height, 1);
    for (std::size_t i = 0; i < image.size(); ++i) image.data()[i] = value(random);
    return image;
}

/// Slopes m of m[i-1] + 4 m[i] + m[i+1] = 3 (h[i+1] - h[i-1]) on a ring, by Gauss and Seidel.
std::vector<double> solved(const std::vector<double>& h) {
    const std::size_t n = h.size();
    std::vector<double> m(n, 0);
    for (int sweep = 0; sweep < 60; ++sweep)
        for (std::size_t i = 0; i < n; ++i) {
            const std::size_t before = (i + n - 1) % n, after = (i + 1) % n;
            m[i] = (3 * (h[after] - h[before]) - m[before] - m[after]) / 4;
        }
    return m;
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("spline_slope: along and across rows the slopes solve the spline's system, to each type's precision") {
        const int width = 41, height = 67;
        const auto check = [&]<class T>(T, double tolerance) {
            const Image<T> image = noise<T>(width, height);
            const SlopeFilter<T> filter(image, Filter::c2, Wrap::repeat, Wrap::repeat);
            typename SlopeFilter<T>::Scratch scratch;
            std::vector<T> pairs(std::size_t(2) * width * height);
            for (int y = 0; y < height; ++y) filter.row(y, 1, 1, &pairs[std::size_t(2) * y * width], scratch);
            double worst = 0;
            for (int y = 0; y < height; ++y) {
                std::vector<double> row(image.row(y), image.row(y) + width);
                const std::vector<double> want = solved(row);
                for (int x = 0; x < width; ++x)
                    worst = std::max(worst, std::abs(pairs[2 * (std::size_t(y) * width + x)] - want[x]));
            }
            for (int x = 0; x < width; ++x) {
                std::vector<double> column(height);
                for (int y = 0; y < height; ++y) column[y] = image.at(x, y);
                const std::vector<double> want = solved(column);
                for (int y = 0; y < height; ++y)
                    worst = std::max(worst, std::abs(pairs[2 * (std::size_t(y) * width + x) + 1] + want[y]));
            }
            CHECK(worst < tolerance);
        };
        check(float(0), 5e-7);
        check(double(0), 1e-14);
    }
}

TEST_SUITE("unit") {

    TEST_CASE("spline_slope: a row has the same bytes in whatever order rows are asked for") {
        const Image<float> image = noise<float>(50, 70);
        const SlopeFilter<float> filter(image, Filter::c2, Wrap::clamp, Wrap::mirror);
        SlopeFilter<float>::Scratch in_order;
        for (int y = 0; y < 70; ++y) {
            std::vector<float> one(100), other(100);
            SlopeFilter<float>::Scratch fresh;
            filter.row(y, 2, 3, one.data(), in_order);
            filter.row(y, 2, 3, other.data(), fresh);
            CHECK(std::memcmp(one.data(), other.data(), 400) == 0);
        }
    }

    TEST_CASE("spline_slope: one room serves filters in turn") {
        const Image<float> a = noise<float>(30, 20);
        Image<float> b(30, 20, 1);
        for (std::size_t i = 0; i < b.size(); ++i) b.data()[i] = 1 - a.data()[i];
        SlopeFilter<float>::Scratch shared;
        for (const Filter other : {Filter::c2, Filter::order4, Filter::sobel})
            for (int y = 0; y < 20; ++y) {
                std::vector<float> of_a(60), of_b(60), plain(60);
                SlopeFilter<float>(a, Filter::c2, Wrap::repeat, Wrap::repeat).row(y, 1, 1, of_a.data(), shared);
                SlopeFilter<float>(b, other, Wrap::repeat, Wrap::repeat).row(y, 1, 1, plain.data(), shared);
                SlopeFilter<float>(b, Filter::c2, Wrap::repeat, Wrap::repeat).row(y, 1, 1, of_b.data(), shared);
                for (int i = 0; i < 60; ++i) CHECK(of_a[i] == doctest::Approx(-of_b[i]).epsilon(1e-4));
            }
    }

    TEST_CASE("spline_slope: a flat height has no slope at all, and single texels are as good as rows") {
        Image<float> flat(40, 40, 1);
        std::fill_n(flat.data(), flat.size(), 0.7f);
        const SlopeFilter<float> none(flat, Filter::c2, Wrap::repeat, Wrap::mirror);
        const Image<float> image = noise<float>(40, 40);
        for (const Wrap wrap : {Wrap::repeat, Wrap::clamp, Wrap::mirror}) {
            const SlopeFilter<float> filter(image, Filter::c2, wrap, wrap);
            SlopeFilter<float>::Scratch scratch, of_none;
            std::vector<float> pairs(80);
            for (int y = 0; y < 40; ++y) {
                none.row(y, 100, 100, pairs.data(), of_none);
                for (const float slope : pairs) CHECK(slope == 0);
                filter.row(y, 1, 1, pairs.data(), scratch);
                for (int x = 0; x < 40; ++x) {
                    const auto [u, v] = filter.at(x, y, 1, 1);
                    CHECK(std::abs(pairs[2 * x] - u) < 1e-4);
                    CHECK(std::abs(pairs[2 * x + 1] - v) < 1e-4);
                }
            }
        }
    }
}
