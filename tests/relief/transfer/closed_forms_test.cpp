#include "relief/transfer/closed_forms.h"
#include <doctest/doctest.h>
#include <functional>
#include <random>

using namespace oracle;

namespace {

/// The same sums over directions of a hemisphere, ray by ray, by the midpoint rule in the squared sine and the azimuth.
Sky summed(const std::function<bool(const Vec3d&)>& open) {
    constexpr int rings = 1500, turns = 1500;
    Sky sky{};
    double all = 0;
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j < turns; ++j) {
            const double sine = std::sqrt((i + 0.5) / rings), turn = 2 * pi * (j + 0.5) / turns;
            const Vec3d w(sine * cos(turn), sine * sin(turn), std::sqrt(1 - sine * sine));
            const double without = 1 / w.z; // the rule's weight is the cosine
            all += without;
            if (!open(w)) continue;
            sky.visible += 1.0 / rings / turns, sky.solid_angle += without;
            sky.bent += w, sky.bent_unweighted += without * w;
        }
    sky.solid_angle /= all;
    sky.bent = glm::normalize(sky.bent), sky.bent_unweighted = glm::normalize(sky.bent_unweighted);
    return sky;
}

void check_equal(const Sky& exact, const std::function<bool(const Vec3d&)>& open) {
    const Sky sky = summed(open);
    CHECK(exact.visible == doctest::Approx(sky.visible).epsilon(0.002));
    CHECK(exact.solid_angle == doctest::Approx(sky.solid_angle).epsilon(0.02)); // the weight is without bound
    CHECK(angle_deg(exact.bent, sky.bent) < 0.1);
    CHECK(angle_deg(exact.bent_unweighted, sky.bent_unweighted) < 1);
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("groove_sky: what rays from a wall of a groove meet") {
        for (const double opening : {0.6, pi / 2, 2.4})
            for (const double s : {0.2, 0.9}) {
                CAPTURE(opening);
                CAPTURE(s);
                const double depth = 1.3;
                check_equal(groove_sky(opening, depth, s), [&](const Vec3d& w) {
                    // (s, 0) + t (w.x, w.z) = a (cos, sin): the other wall for a in [0, depth] and t > 0.
                    const double det = w.x * sin(opening) - w.z * cos(opening);
                    const double a = -s * w.z / det, t = -s * sin(opening) / det;
                    return !(t > 0 && a >= 0 && a <= depth);
                });
            }
        CHECK(groove_sky(1, 1, 0).visible == doctest::Approx((1 - cos(1)) / 2));
        CHECK(groove_sky(1, 1e9, 1).visible == doctest::Approx((1 - cos(1)) / 2));
        CHECK(groove_sky(pi, 1, 0.5).visible == doctest::Approx(1));
        const double s = 0.4, root = std::sqrt(1.3 * 1.3 - 2 * 1.3 * s * cos(1.1) + s * s);
        CHECK(groove_sky(1.1, 1.3, s).visible == doctest::Approx((1 - (1.3 * cos(1.1) - s) / root) / 2));
    }

    TEST_CASE("wall_sky, overhang_sky: what rays from a plane meet") {
        for (const double distance : {0.1, 1.0, 3.0}) {
            CAPTURE(distance);
            check_equal(wall_sky(distance, 0.7),
                        [&](const Vec3d& w) { return !(w.x < 0 && -distance / w.x * w.z <= 0.7); });
            CHECK(wall_sky(distance, 0.7).visible == doctest::Approx((1 + distance / std::hypot(distance, 0.7)) / 2));
        }
        CHECK(wall_sky(1, 1e9).visible == doctest::Approx(0.5));
        CHECK(wall_sky(1, 0).bent.z == doctest::Approx(1));
        for (const double edge : {-0.8, 0.0, 0.5}) {
            CAPTURE(edge);
            check_equal(overhang_sky(edge, 0.6), [&](const Vec3d& w) { return !(0.6 / w.z * w.x < edge); });
            CHECK(overhang_sky(edge, 0.6).visible == doctest::Approx((1 - edge / std::hypot(edge, 0.6)) / 2));
        }
    }

    TEST_CASE("shell_thickness: the way to the first exit, and its mean over the hemisphere") {
        const double outer = 1.5;
        for (const double inner : {0.0, 0.4, 1.3}) {
            CAPTURE(inner);
            CHECK(shell_thickness(outer, inner, 1) == doctest::Approx(inner > 0 ? outer - inner : 2 * outer));
            double sum = 0;
            constexpr int rays = 20000;
            for (int i = 0; i < rays; ++i) {
                const double cosine = std::sqrt(1 - (i + 0.5) / rays), way = shell_thickness(outer, inner, cosine);
                sum += way / rays;
                const Vec3d end = Vec3d(0, 0, outer) + way * Vec3d(std::sqrt(1 - cosine * cosine), 0, -cosine);
                const Vec3d middle = Vec3d(0, 0, outer) + way / 2 * Vec3d(std::sqrt(1 - cosine * cosine), 0, -cosine);
                // It ends on one of the spheres, and is inside the shell until then.
                const double at = glm::length(end);
                CHECK_MESSAGE(std::min(std::abs(at - outer), std::abs(at - inner)) < 1e-7, cosine);
                CHECK_MESSAGE((glm::length(middle) > inner && glm::length(middle) < outer), cosine);
            }
            CHECK(mean_shell_thickness(outer, inner) == doctest::Approx(sum).epsilon(1e-4));
        }
        CHECK(mean_shell_thickness(1, 0) == doctest::Approx(4.0 / 3));
        CHECK(mean_shell_thickness(1, 1) == doctest::Approx(0));
    }

    TEST_CASE("mean curvatures: how the normal turns along two perpendicular directions") {
        // n_u = A p_u, and the directions of u and v are principal ones.
        const auto mean = [](const Jet<double>& s) {
            return (glm::dot(s.n_u, s.p_u) / glm::dot(s.p_u, s.p_u) + glm::dot(s.n_v, s.p_v) / glm::dot(s.p_v, s.p_v)) /
                   2;
        };
        for (const double v : {0.0, 1.0, 2.5, pi}) {
            CHECK(torus_mean_curvature(1, 0.4, v) == doctest::Approx(mean(torus(1, 0.4, 0.3, v))));
            CHECK(sphere_mean_curvature(1.7) == doctest::Approx(mean(sphere(1.7, 0.3, v / 3))));
        }
        // Steiner: an offset by d changes the area by 2 H d to first order.
        const double d = 1e-6, v = 2.2;
        const auto area = [&](double r) {
            const Jet<double> s = torus(1, r, 0, v);
            return glm::length(glm::cross(s.p_u, s.p_v));
        };
        CHECK(torus_mean_curvature(1, 0.4, v) ==
              doctest::Approx((area(0.4 + d) / area(0.4) - 1) / (2 * d)).epsilon(1e-5));
    }

    TEST_CASE("RoundedBox: distance, nearest point and normal agree, and a ray from above meets it first there") {
        const RoundedBox box{{1, 0.7, 0.5}, 0.2};
        std::mt19937 random(7);
        std::uniform_real_distribution<double> in(-1.4, 1.4);
        int outside = 0, met = 0;
        for (int i = 0; i < 2000; ++i) {
            const Vec3d p(in(random), in(random), in(random));
            const double far = box.distance(p);
            if (far <= 0) continue;
            ++outside;
            const RoundedBox::Point q = box.nearest(p);
            CHECK(std::abs(box.distance(q.p)) < 1e-12);
            CHECK(glm::distance(p, q.p) == doctest::Approx(far));
            CHECK(glm::length(q.p + far * q.n - p) < 1e-12);
            for (int axis = 0; axis < 3; ++axis) {
                Vec3d step(0);
                step[axis] = 1e-6;
                CHECK(std::abs((box.distance(p + step) - box.distance(p - step)) / 2e-6 - q.n[axis]) < 1e-4);
            }
            const RoundedBox::Point hit = box.below(p.x, p.y);
            if (hit.n == Vec3d(0)) {
                CHECK(box.distance(Vec3d(p.x, p.y, 0)) > 0);
                continue;
            }
            ++met;
            CHECK(std::abs(box.distance(hit.p)) < 1e-12);
            CHECK(glm::distance(box.nearest(hit.p + hit.n).n, hit.n) < 1e-9);
            CHECK(hit.n.z >= 0);
        }
        CHECK(outside > 1000);
        CHECK(met > 400);
    }
}
