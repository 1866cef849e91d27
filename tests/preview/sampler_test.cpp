#include "bake/preview/sampler.h"
#include <cmath>
#include <doctest/doctest.h>
#include <set>

using namespace bake;

namespace {

Vec2d at(int pixel, int i, int spp) {
    Sampler sampler(pixel, 7, i);
    return pixel_sample(spp, sampler);
}

/// Mean of a function over the first `count` samples' pair number `pair`.
template <class Function> double mean(int pair, int count, std::uint32_t seed, const Function& function) {
    double sum = 0;
    for (int i = 0; i < count; ++i) {
        Sampler sampler(5, 9, i, seed);
        for (int k = 0; k < pair; ++k) sampler.next2();
        sum += function(sampler.next2());
    }
    return sum / count;
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("sampler: samples are distributed over the rows and columns of a pixel, differently in every pixel") {
        CHECK(at(3, 0, 1) == Vec2d(0.5));
        std::set<double> offsets;
        for (int pixel = 0; pixel < 50; ++pixel) {
            std::set<int> columns, rows;
            for (int i = 0; i < 16; ++i) {
                const Vec2d p = at(pixel, i, 16);
                REQUIRE((p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1));
                columns.insert(int(p.x * 16));
                rows.insert(int(p.y * 16));
            }
            CHECK(columns.size() == 16);
            CHECK(rows.size() == 16);
            offsets.insert(at(pixel, 0, 16).x);
        }
        CHECK(offsets.size() == 50);
    }

    TEST_CASE("sampler: every elementary interval of area 1/256 has one of the first 256 points of every pair") {
        for (const int pair : {0, 1, 7})
            for (int log_columns = 0; log_columns <= 8; ++log_columns) {
                const int columns = 1 << log_columns, rows = 256 / columns;
                std::set<int> cells;
                mean(pair, 256, 3, [&](const Vec2f& u) {
                    cells.insert(int(u.y * float(rows)) * columns + int(u.x * float(columns)));
                    return 0.0;
                });
                CHECK(cells.size() == 256);
            }
    }

    TEST_CASE("sampler: the error of a smooth mean falls faster than with random numbers; seeds are independent") {
        // The integral of sin(pi x) sin(pi y) is 4 / pi^2. The error of n random numbers is .28 / sqrt(n).
        const auto f = [](const Vec2f& u) { return std::sin(pi * u.x) * std::sin(pi * u.y); };
        double squares = 0, product = 0;
        for (std::uint32_t seed = 0; seed < 64; seed += 2) {
            const double a = mean(2, 256, seed, f) - 4 / (pi * pi), b = mean(2, 256, seed + 1, f) - 4 / (pi * pi);
            squares += a * a + b * b, product += a * b;
        }
        CHECK(std::sqrt(squares / 64) < 0.28 / 16 / 8);
        // The mean of 32 products of independent errors.
        CHECK(std::abs(product / 32) < 4 * (squares / 64) / std::sqrt(32.0));
    }

    TEST_CASE("sampler: pairs are independent of each other") {
        double sum = 0;
        const int count = 4096;
        for (int i = 0; i < count; ++i) {
            Sampler sampler(1, 2, i);
            const Vec2f a = sampler.next2(), b = sampler.next2();
            sum += (a.x - 0.5) * (b.x - 0.5);
        }
        CHECK(std::abs(sum / count) < 4.0 / 12 / std::sqrt(double(count)));
    }

    TEST_CASE("sampler: a branch is independent of its stem and of other branches, and leaves the stem alone") {
        double with_stem = 0, with_other = 0, with_nested = 0;
        const int count = 4096;
        for (int i = 0; i < count; ++i) {
            Sampler stem(1, 2, i), untouched(1, 2, i);
            Sampler first = stem.branch(), nested = first.branch();
            const float a = stem.next(), b = first.next(), d = nested.next();
            const float c = stem.branch().next();
            CHECK(a == untouched.next());
            CHECK(stem.next() == untouched.next());
            with_stem += (a - 0.5) * (b - 0.5), with_other += (b - 0.5) * (c - 0.5),
                with_nested += (b - 0.5) * (d - 0.5);
        }
        for (const double sum : {with_stem, with_other, with_nested})
            CHECK(std::abs(sum / count) < 4.0 / 12 / std::sqrt(double(count)));
    }

    TEST_CASE("sampler: a branch has one point in every elementary interval, as its stem has") {
        for (const int columns : {1, 16, 256}) {
            std::set<int> cells;
            for (int i = 0; i < 256; ++i) {
                Sampler stem(5, 9, i, 3);
                stem.next2();
                const Vec2f u = stem.branch().next2();
                cells.insert(int(u.y * float(256 / columns)) * columns + int(u.x * float(columns)));
            }
            CHECK(cells.size() == 256);
        }
    }

    TEST_CASE("sampler: seeds of second halves differ from their own and from each other") {
        std::set<std::uint32_t> seeds;
        for (std::uint32_t seed = 0; seed < 1000; ++seed) seeds.insert({seed, second_seed(seed)});
        CHECK(seeds.size() == 2000);
    }

} // TEST_SUITE
