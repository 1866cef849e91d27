#include "bake/verdict/metric/separable.h"
#include "verdict/metric/pictures.h"
#include <cmath>
#include <doctest/doctest.h>

using namespace bake;
using bake::test::noise;

namespace {

Rows<double> noisy_rows(int width, int count, int pad) {
    Rows<double> rows(width, count, pad);
    for (int i = 0; i < count; ++i)
        for (int x = 0; x < width; ++x) rows[i][x] = noise(x, i, 0);
    repeat_ends(rows);
    return rows;
}

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("separable: Gaussian weights sum to 1, are even, and fall as the Gaussian") {
        const std::vector<double> w = gaussian_weights(1.5, 5);
        REQUIRE(w.size() == 11);
        double sum = 0;
        for (const double v : w) sum += v;
        CHECK(sum == doctest::Approx(1).epsilon(1e-14));
        for (int i = 0; i < 5; ++i) CHECK(w[i] == w[10 - i]);
        CHECK(w[8] / w[5] == doctest::Approx(std::exp(-9 / (2 * 2.25))));
    }

    TEST_CASE("separable: along rows and columns is the plain double sum") {
        const std::vector<double> w = {0.5, -1, 2}; // of no symmetry, so that a reversal is seen
        const Rows<double> in = noisy_rows(9, 8, 3);
        const Rows<double> rows = along_rows(in, w), out = along_columns(rows, w, 2);
        REQUIRE(rows.count() == 8);
        REQUIRE(out.count() == 4);
        for (int i = 0; i < 4; ++i)
            for (int x = 0; x < 9; ++x) {
                double sum = 0;
                for (int j = -1; j <= 1; ++j)
                    for (int k = -1; k <= 1; ++k) sum += w[j + 1] * w[k + 1] * in[i + 2 + j][x + k];
                CHECK(out[i][x] == doctest::Approx(sum).epsilon(1e-13));
            }
    }

    TEST_CASE("separable: the padding repeats the ends of each row") {
        const Rows<double> rows = noisy_rows(4, 2, 3);
        for (int i = 0; i < 2; ++i)
            for (int k = 1; k <= 3; ++k) {
                CHECK(rows[i][-k] == rows[i][0]);
                CHECK(rows[i][3 + k] == rows[i][3]);
            }
    }
}
