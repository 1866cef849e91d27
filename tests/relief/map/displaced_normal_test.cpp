#include "bake/relief/map/displaced_normal.h"
#include "oracle/surfaces.h"
#include <doctest/doctest.h>
#include <random>

using namespace bake;
using oracle::angle_deg;
using oracle::waves;

namespace {

Vec3d unit_normal(const Jet<double>& s, const Height<double>& h, NormalMethod method) {
    return glm::normalize(displaced_normal(s, h, method));
}

void check_vector(const Vec3d& got, const Vec3d& want, double tolerance) {
    CHECK(std::abs(got.x - want.x) <= tolerance);
    CHECK(std::abs(got.y - want.y) <= tolerance);
    CHECK(std::abs(got.z - want.z) <= tolerance);
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("displaced_normal: golden vectors of torus and sphere") {
        struct Golden {
            Jet<double> s;
            double u, v, c;
            Vec3d blinn, exact;
        };
        const Golden golden[] = {
            {oracle::torus(2, 0.7, 0.3, 0.7),
             0.3,
             0.7,
             0.03,
             {.598420915123, .198626474318, .776170040676},
             {.584563710342, .194554941530, .787676103025}},
            {oracle::torus(2, 0.7, 1.1, 3),
             1.1,
             3,
             0.03,
             {-.247063525505, -.966491356484, -.069671171990},
             {-.251678138924, -.964613914088, -.078600961409}},
            {oracle::sphere(2, 0.3, 0.7),
             0.3,
             0.7,
             0.03,
             {.681432174769, .233539653103, .693620517010},
             {.679751622643, .233767748585, .695190888344}},
        };
        const double angles[] = {1.058032410, .585879806, .132430757};
        for (int i = 0; i < 3; ++i) {
            CAPTURE(i);
            const Height<double> h = waves(0.1, 5, 4, golden[i].c, golden[i].u, golden[i].v);
            const Vec3d blinn = unit_normal(golden[i].s, h, NormalMethod::blinn),
                        exact = unit_normal(golden[i].s, h, NormalMethod::exact);
            check_vector(blinn, golden[i].blinn, 1e-9);
            check_vector(exact, golden[i].exact, 1e-9);
            CHECK(std::abs(angle_deg(blinn, exact) - angles[i]) < 1e-8);
            check_vector(unit_normal(golden[i].s, h, NormalMethod::surface_gradient), golden[i].blinn, 1e-9);
        }
    }

    TEST_CASE("displaced_normal: closed forms on plane, sphere, cylinder and torus to 1e-9") {
        std::mt19937 random(7);
        std::uniform_real_distribution<double> number(-1, 1);
        for (int i = 0; i < 500; ++i) {
            const double u = pi * number(random), v = 1.4 * number(random), R = 2, r = 0.7;
            const Height<double> h = waves(0.05, 5, 4, 0.1 * number(random), u, v);
            const Vec3d east(-sin(u), cos(u), 0), north(-sin(v) * cos(u), -sin(v) * sin(u), cos(v));
            const auto check = [&](const Jet<double>& s, const Vec3d& e_u, const Vec3d& e_v, double length_u,
                                   double length_v) {
                check_vector(unit_normal(s, h, NormalMethod::exact),
                             glm::normalize(s.n - h.b_u / length_u * e_u - h.b_v / length_v * e_v), 1e-9);
            };
            check(oracle::sphere(R, u, v), east, north, (R + h.b) * cos(v), R + h.b);
            check(oracle::cylinder(R, u, v), east, {0, 0, 1}, R + h.b, 1);
            check(oracle::torus(R, r, u, v), east, north, R + (r + h.b) * cos(v), r + h.b);
            Jet<double> plane{};
            plane.p_u = {3, 0, 0}, plane.p_v = {0, 2, 0}, plane.n = {0, 0, 1};
            check(plane, {1, 0, 0}, {0, 1, 0}, 3, 2);
            check_vector(unit_normal(plane, h, NormalMethod::blinn), unit_normal(plane, h, NormalMethod::exact), 1e-12);
        }
    }

    TEST_CASE("displaced_normal: worst angle of blinn on a sphere is asin(x / (2 + x)), x = b / R") {
        const struct { double x, deg; } worst[] = {{0.01, 0.285}, {0.1, 2.729}, {0.5, 11.54}, {-0.5, 19.47}};
        for (const auto& [x, deg] : worst) {
            CAPTURE(x);
            double largest = 0;
            // The worst slope is one over the geometric mean of the two factors; a fine sweep finds it.
            for (double slope = 0.01; slope < 20; slope *= 1.001) {
                const Jet<double> s = oracle::sphere(1, 0.2, 0);
                const Height<double> h{x, 0, slope};
                largest = std::max(largest, angle_deg(displaced_normal(s, h, NormalMethod::blinn),
                                                      displaced_normal(s, h, NormalMethod::exact)));
            }
            CHECK(largest == doctest::Approx(deg).epsilon(2e-3));
            CHECK(largest == doctest::Approx(glm::degrees(std::asin(std::abs(x) / (2 + x)))).epsilon(1e-5));
        }
    }

    TEST_CASE(
        "displaced_normal: constant-scale on a lat-long sphere, scaled at the equator, is off by asin(tan^2(lat / 2)) "
        "at worst") {
        const struct { double latitude, deg; } worst[] = {{30, 4.12}, {45, 9.88}, {60, 19.47}, {80, 44.76}};
        for (const auto& [latitude, deg] : worst) {
            CAPTURE(latitude);
            const Jet<double> s = oracle::sphere(1, 0.4, glm::radians(latitude));
            double largest = 0;
            for (double slope = 0.001; slope < 20; slope *= 1.002)
                for (double turn = 0; turn < pi; turn += 0.01) {
                    const Height<double> h{0, slope * cos(turn), slope * sin(turn)};
                    largest = std::max(largest, angle_deg(displaced_normal(s, h, NormalMethod::constant_scale,
                                                                           ConstantScale<double>{1, 1}),
                                                          displaced_normal(s, h, NormalMethod::exact)));
                }
            CHECK(largest == doctest::Approx(deg).epsilon(5e-3));
        }
    }

    TEST_CASE("displaced_normal: float agrees with double to float's own precision") {
        for (int i = 0; i < 200; ++i) {
            const double u = 0.031 * i, v = 0.017 * i;
            const Jet<double> s = oracle::torus(2, 0.7, u, v);
            const Height<double> h = waves(0.1, 5, 4, 0.03, u, v);
            Jet<float> f{Vec3f(s.p), Vec3f(s.p_u), Vec3f(s.p_v), Vec3f(s.n), Vec3f(s.n_u), Vec3f(s.n_v), 1};
            for (const NormalMethod method : all_normal_methods) {
                const Vec3f single = displaced_normal(f, Height<float>{float(h.b), float(h.b_u), float(h.b_v)}, method);
                CHECK(angle_deg(Vec3d(single), displaced_normal(s, h, method)) < 5e-5);
            }
        }
    }
}

TEST_SUITE("unit") {

    TEST_CASE("displaced_normal: a flat height gives n exactly, mirrored chart or not") {
        for (const double side : {1.0, -1.0}) {
            const Jet<double> s = oracle::rechart(oracle::torus(2, 0.7, 0.4, 0.9), side, 0, 0, 1);
            for (const NormalMethod method : all_normal_methods)
                check_vector(unit_normal(s, {0, 0, 0}, method), s.n, 1e-15);
        }
    }

    TEST_CASE("displaced_normal: exact, blinn and surface-gradient do not depend on the chart; relief rises outward on "
              "mirrored ones") {
        std::mt19937 random(3);
        std::uniform_real_distribution<double> number(-2, 2);
        for (int i = 0; i < 200; ++i) {
            const Jet<double> s = oracle::torus(2, 0.7, number(random), number(random));
            const Height<double> h = waves(0.1, 5, 4, 0.02, 0.3, 0.8);
            const double a = number(random), b = number(random), c = number(random), d = number(random);
            if (std::abs(a * d - b * c) < 0.05) continue;
            const Jet<double> turned = oracle::rechart(s, a, b, c, d);
            const Height<double> turned_h{h.b, a * h.b_u + c * h.b_v, b * h.b_u + d * h.b_v};
            for (const NormalMethod method : {NormalMethod::exact, NormalMethod::blinn, NormalMethod::surface_gradient})
                check_vector(unit_normal(turned, turned_h, method), unit_normal(s, h, method), 1e-10);
        }
    }

    TEST_CASE("displaced_normal: blinn's angle error is second order in the amplitude") {
        const auto error = [](double a) {
            const Jet<double> s = oracle::torus(2, 1, 0.31, 0.48);
            const Height<double> h = waves(a, 6, 6, 0, 0.31, 0.48);
            return angle_deg(displaced_normal(s, h, NormalMethod::blinn), displaced_normal(s, h, NormalMethod::exact));
        };
        // Halving the height quarters the angle: one factor from the height, one from the slope.
        CHECK(error(0.001) / error(0.0005) == doctest::Approx(4).epsilon(0.05));
    }

    TEST_CASE("displaced_normal: constant-scale equals blinn on an even, square chart") {
        Jet<double> plane{};
        plane.p_u = {3, 0, 0}, plane.p_v = {0, 3, 0}, plane.n = {0, 0, 1};
        const Height<double> h{0.3, 0.7, -1.1};
        check_vector(
            unit_normal(plane, h, NormalMethod::blinn),
            glm::normalize(displaced_normal(plane, h, NormalMethod::constant_scale, ConstantScale<double>{3, 3})),
            1e-15);
    }
}

TEST_SUITE("stability") {

    TEST_CASE("displaced_normal: at a pole, where p_u is zero, there is no normal and no NaN") {
        Jet<double> pole = oracle::sphere(1, 0.3, pi / 2);
        pole.p_u = Vec3d(0), pole.n_u = Vec3d(0);
        const Height<double> h{0, 0.5, 0.1};
        CHECK(displaced_normal(pole, h, NormalMethod::surface_gradient) == Vec3d(0));
        for (const NormalMethod method : all_normal_methods) {
            const Vec3d n = displaced_normal(pole, h, method);
            CHECK(n.x * 0 + n.y * 0 + n.z * 0 == 0);
        }
    }

    TEST_CASE("displaced_normal: beyond the radius of curvature exact turns inside out along one direction and stays "
              "outward along two") {
        const Jet<double> s = oracle::torus(2, 0.7, 0.2, 0.5);
        // Between the two radii one factor 1 + b a_i is negative: the cell's normal points inward.
        CHECK(glm::dot(displaced_normal(s, {-1.0, 0, 0}, NormalMethod::exact), s.n) < 0);
        // Below both the determinant is positive again although the surface is inside out: a sphere shows it.
        CHECK(glm::dot(displaced_normal(oracle::sphere(1, 0.2, 0.5), {-1.5, 0, 0}, NormalMethod::exact),
                       oracle::sphere(1, 0.2, 0.5).n) > 0);
    }

    TEST_CASE(
        "folds: the torus folds at b = -r, and at b = r - R where v = pi; a sphere displaced by -1.5 R is inside out") {
        const double R = 2, r = 0.7;
        for (const double side : {1.0, -1.0}) { // mirrored charts too
            const auto torus = [&](double v) { return oracle::rechart(oracle::torus(R, r, 0.3, v), side, 0, 0, 1); };
            CHECK_FALSE(folds(torus(0.4), -0.99 * r));
            CHECK(folds(torus(0.4), -1.01 * r));
            CHECK_FALSE(folds(torus(pi), 0.99 * (R - r)));
            CHECK(folds(torus(pi), 1.01 * (R - r)));
            CHECK_FALSE(folds(torus(0), 100.0));
        }
        CHECK(folds(oracle::sphere(1, 0.2, 0.5), -1.5));
        CHECK_FALSE(folds(oracle::sphere(1, 0.2, 0.5), -0.5));
        CHECK_FALSE(folds(Jet<double>{}, 1.0));
    }
}
