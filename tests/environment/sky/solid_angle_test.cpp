#include "bake/base/vec.h"
#include "bake/environment/sky/solid_angle.h"
#include "environment/skies.h"
#include <doctest/doctest.h>

using namespace bake;

TEST_SUITE("oracle") {

    TEST_CASE("solid_angle: texels are two spherical triangles each, and six faces the sphere") {
        for (const int n : {1, 2, 5, 16, 100}) {
            const std::vector<double> omega = texel_solid_angles(n);
            double sum = 0, worst = 0;
            for (int y = 0; y < n; ++y)
                for (int x = 0; x < n; ++x) {
                    const double expected = test::texel_solid_angle(n, x, y);
                    sum += omega[std::size_t(y) * n + x];
                    worst = std::max(worst, std::abs(omega[std::size_t(y) * n + x] / expected - 1));
                }
            CHECK(6 * sum == doctest::Approx(4 * pi).epsilon(1e-14));
            // Differences of values about 1: 1e-16 over a texel of 2e-4.
            CHECK(worst < 1e-11);
        }
    }

    TEST_CASE("solid_angle: the texel in the centre tends to 3^1.5 times the one in the corner") {
        const auto ratio = [](int n) {
            const std::vector<double> omega = texel_solid_angles(n);
            return omega[std::size_t(n / 2) * n + n / 2] / omega[0];
        };
        const double limit = std::pow(3, 1.5);
        CHECK(ratio(1025) == doctest::Approx(limit).epsilon(3e-3));
        // First order in the texel: the corner's centre is half a texel inside.
        CHECK((limit - ratio(129)) / (limit - ratio(257)) == doctest::Approx(2).epsilon(0.05));
    }

} // TEST_SUITE

TEST_SUITE("unit") {

    TEST_CASE("solid_angle: uneven lines share out the same solid angle") {
        const std::vector<double> cells = cell_solid_angles({-1, -0.2, 0.7, 1});
        REQUIRE(cells.size() == 9);
        double sum = 0;
        for (const double cell : cells) sum += cell;
        CHECK(6 * sum == doctest::Approx(4 * pi).epsilon(1e-14));
        CHECK(cells[3] ==
              doctest::Approx(
                  test::triangle_solid_angle(test::face_direction(4, -1, -0.2), test::face_direction(4, -0.2, -0.2),
                                             test::face_direction(4, -0.2, 0.7)) +
                  test::triangle_solid_angle(test::face_direction(4, -1, -0.2), test::face_direction(4, -0.2, 0.7),
                                             test::face_direction(4, -1, 0.7)))
                  .epsilon(1e-14));
    }

} // TEST_SUITE
