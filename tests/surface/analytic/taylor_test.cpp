#include "bake/base/vec.h"
#include "bake/surface/analytic/taylor.h"
#include <cmath>
#include <doctest/doctest.h>

using namespace bake;

namespace {

/// Every operation in one formula, with first and second derivatives of both signs.
template <class Number, class Turned, class Power, class AbsPower>
Number formula(const Number& u, const Number& v, Turned turned, Power power, AbsPower abs_power) {
    const Number a = turned(0.3 * u + 0.2 * v), b = power(1.5 + u * v, 0.7), c = abs_power(u - 2.0 * v, 2.5);
    return a * b - c + 0.5 * (u * u) * v - b * c;
}

double value(double u, double v) {
    return formula<double>(
        u, v, [](double turns) { return std::cos(2 * pi * turns) * std::sin(2 * pi * turns); },
        [](double x, double n) { return std::pow(x, n); }, [](double x, double n) { return std::pow(std::abs(x), n); });
}

} // namespace

TEST_SUITE("oracle") {
    TEST_CASE("taylor: value and derivatives are those of the plain formula, by differences") {
        for (const auto& [u, v] : {std::pair(0.3, 0.4), {-0.7, 0.2}, {0.9, -0.1}}) {
            const Taylor t = formula<Taylor>(
                {u, 1, 0, 0, 0, 0}, {v, 0, 1, 0, 0, 0},
                [](const Taylor& turns) {
                    const double k = 2 * pi, c = std::cos(k * turns.f), s = std::sin(k * turns.f);
                    return chain(turns, c, -k * s, -k * k * c) * chain(turns, s, k * c, -k * k * s);
                },
                [](const Taylor& x, double n) { return power(x, n); },
                [](const Taylor& x, double n) { return abs_power(x, n); });
            const double h = 1e-4; // the errors are about h^2 and, of the second differences, 1e-16 / h^2
            const auto f = [u = u, v = v, h](int i, int j) { return value(u + i * h, v + j * h); };
            CHECK(t.f == doctest::Approx(f(0, 0)).epsilon(1e-13));
            CHECK(std::abs(t.u - (f(1, 0) - f(-1, 0)) / (2 * h)) < 2e-6);
            CHECK(std::abs(t.v - (f(0, 1) - f(0, -1)) / (2 * h)) < 2e-6);
            CHECK(std::abs(t.uu - (f(1, 0) - 2 * f(0, 0) + f(-1, 0)) / (h * h)) < 2e-5);
            CHECK(std::abs(t.vv - (f(0, 1) - 2 * f(0, 0) + f(0, -1)) / (h * h)) < 2e-5);
            CHECK(std::abs(t.uv - (f(1, 1) - f(1, -1) - f(-1, 1) + f(-1, -1)) / (4 * h * h)) < 2e-5);
        }
    }
}

TEST_SUITE("stability") {
    TEST_CASE("abs_power: both derivatives exist at 0") {
        for (const double n : {2.0, 2.5, 4.0}) {
            const Taylor t = abs_power({0, 1, -1, 0, 0, 0}, n);
            CHECK(t.f == 0);
            CHECK(t.u == 0);
            CHECK(t.uu == (n == 2 ? 2.0 : 0.0));
            CHECK(t.uv == (n == 2 ? -2.0 : 0.0));
        }
    }
}
