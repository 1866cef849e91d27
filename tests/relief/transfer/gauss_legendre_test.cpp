#include "bake/relief/transfer/gauss_legendre.h"
#include <cmath>
#include <doctest/doctest.h>

using namespace bake;

namespace {

/// The rule's integral of x^degree over (0, 1), less the true one.
double error(int count, int degree) {
    double sum = -1.0 / (degree + 1);
    for (const QuadraturePoint& point : gauss_legendre(count)) sum += point.weight * std::pow(point.at, degree);
    return std::abs(sum);
}

double factorial(int n) { return n < 2 ? 1 : n * factorial(n - 1); }

} // namespace

TEST_SUITE("unit") {

    TEST_CASE(
        "gauss_legendre: points ascend within (0, 1), in pairs about the middle, with positive weights of sum 1") {
        for (int count = 1; count <= 16; ++count) {
            CAPTURE(count);
            const std::vector<QuadraturePoint> rule = gauss_legendre(count);
            REQUIRE(rule.size() == std::size_t(count));
            double sum = 0, before = 0;
            for (std::size_t i = 0; i < rule.size(); ++i) {
                const QuadraturePoint &point = rule[i], &mirrored = rule[rule.size() - 1 - i];
                CHECK(point.at > before);
                CHECK(point.weight > 0);
                CHECK(std::abs(point.at + mirrored.at - 1) < 1e-14);
                CHECK(std::abs(point.weight - mirrored.weight) < 1e-13);
                sum += point.weight, before = point.at;
            }
            CHECK(before < 1);
            CHECK(std::abs(sum - 1) < 1e-13);
        }
    }

    TEST_CASE("gauss_legendre: no points for no count") {
        CHECK(gauss_legendre(0).empty());
        CHECK(gauss_legendre(-3).empty());
    }

} // TEST_SUITE

TEST_SUITE("oracle") {

    TEST_CASE("gauss_legendre: exact up to the degree 2 n - 1, and off by n!^4 / ((2n+1) (2n)!^2) at 2 n") {
        for (int count = 1; count <= 16; ++count) {
            CAPTURE(count);
            for (int degree = 0; degree < 2 * count; ++degree) CHECK(error(count, degree) < 1e-14);
        }
        // The remainder of the rule on (0, 1) times the constant derivative (2n)! of x^(2n).
        for (int n = 1; n <= 5; ++n) {
            const double remainder = std::pow(factorial(n), 4) / ((2 * n + 1) * std::pow(factorial(2 * n), 2));
            CHECK(error(n, 2 * n) == doctest::Approx(remainder).epsilon(1e-6));
        }
    }

} // TEST_SUITE
