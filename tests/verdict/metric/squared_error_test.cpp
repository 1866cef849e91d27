#include "bake/base/parallel.h"
#include "bake/verdict/metric/squared_error.h"
#include "verdict/metric/pictures.h"
#include <cmath>
#include <doctest/doctest.h>
#include <limits>

using namespace bake;
using namespace bake::test;

TEST_SUITE("unit") {
    TEST_CASE("squared_error: an offset is the RMSE, and its square at each pixel") {
        const Image<float> a = picture(37, 23, 3, [](int x, int y, int c) { return (x * 5 + y * 3 + c) % 64 / 64.0; });
        const Image<float> b = picture(37, 23, 3, [&](int x, int y, int c) { return a.at(x, y, c) + 0.25; });
        const SquaredErrors errors = squared_errors(a, b);
        CHECK(rmse(errors) == 0.25);
        CHECK(psnr(errors) == doctest::Approx(20 * std::log10(4.0)));
        CHECK(psnr(errors, 255) == doctest::Approx(20 * std::log10(255 / 0.25)));
        for (std::size_t i = 0; i < errors.picture.size(); ++i) REQUIRE(errors.picture.data()[i] == 0.0625f);
    }

    TEST_CASE("squared_error: an offset of one channel counts a third") {
        const Image<float> a = picture(8, 8, 3, [](int, int, int) { return 0.0; });
        const Image<float> b = picture(8, 8, 3, [](int, int, int c) { return c == 1 ? 0.5 : 0.0; });
        CHECK(squared_errors(a, b).mean == doctest::Approx(0.25 / 3).epsilon(1e-14));
        CHECK(squared_errors(a, b).picture.at(3, 3) == doctest::Approx(0.25 / 3));
    }

    TEST_CASE("squared_error: equal pictures give exactly 0 and infinity; the order of the two does not matter") {
        const Image<float> a = noisy(50, 40, 1), b = noisy(50, 40, 2);
        CHECK(rmse(squared_errors(a, a)) == 0);
        CHECK(psnr(squared_errors(a, a)) == std::numeric_limits<double>::infinity());
        CHECK(squared_errors(a, b).mean == squared_errors(b, a).mean);
        // The mean of (x - y)^2 of two even distributions over [0, 1] is 1/6.
        CHECK(squared_errors(a, b).mean == doctest::Approx(1 / 6.0).epsilon(0.05));
    }

    TEST_CASE("squared_error: the largest floats give no Inf in the picture") {
        const Image<float> a = picture(2, 2, 1, [](int, int, int) { return 3e38; });
        const Image<float> b = picture(2, 2, 1, [](int, int, int) { return -3e38; });
        CHECK(std::isfinite(squared_errors(a, b).picture.at(0, 0)));
        CHECK(rmse(squared_errors(a, b)) == doctest::Approx(6e38));
    }

    TEST_CASE("squared_error: any number of threads gives the same bits") {
        const Image<float> a = noisy(61, 97, 1), b = noisy(61, 97, 2);
        const double all = squared_errors(a, b).mean;
        const ThreadLimit limit(1);
        CHECK(squared_errors(a, b).mean == all);
    }
}
