#include "bake/base/error.h"
#include "bake/surface/analytic/parametric.h"
#include "oracle/surfaces.h"
#include "surface/analytic/shapes.h"
#include "surface/manifold.h"
#include <doctest/doctest.h>

using namespace bake;
using bake::test::volume;
using bake_tests::Shapes;
using oracle::angle_deg;

namespace {

/// Derivative of f at x by central differences with three steps; Richardson extrapolation removes the h^2 and h^4 errors.
template <class F> Vec3d derivative(const F& f, double x) {
    const double h = 0.004;
    const auto d = [&](double step) { return (f(x + step) - f(x - step)) / (2 * step); };
    const Vec3d a = d(h), b = d(h / 2), c = d(h / 4);
    const Vec3d ab = (4.0 * b - a) / 3.0, bc = (4.0 * c - b) / 3.0;
    return (16.0 * bc - ab) / 15.0;
}

/// Largest first and second derivative, the reference of relative errors.
struct Sizes {
    double first = 0, second = 0;
};

/// Code and message of the refusal of a shape.
std::pair<int, std::string> refusal(const std::string& text) {
    try {
        ParametricSurface surface(text);
        return {0, "taken"};
    } catch (const Error& error) {
        return {int(error.refusal), error.what()};
    }
}
void check_refused(const std::string& text, Refusal why, const std::string& named) {
    const auto [code, message] = refusal(text);
    INFO(message);
    CHECK(code == int(why));
    CHECK(message.find(named) != std::string::npos);
    CHECK(message.find(';') != std::string::npos);
    CHECK(message.find('\n') == std::string::npos);
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("parametric: every derivative of every shape agrees with numeric ones") {
        const Shapes shapes;
        for (const std::string& text : shapes.all()) {
            INFO(text);
            const ParametricSurface s(text);
            // Avoids the knots of splines, where the third derivative jumps, and the zeros of |x|^n of the superellipsoid.
            Sizes size;
            double first = 0, second = 0, normal = 0;
            for (int patch = 0; patch < s.patches(); ++patch)
                for (double u : {0.043, 0.13, 0.31, 0.52, 0.77, 0.94})
                    for (double v : {0.08, 0.19, 0.357, 0.41, 0.63, 0.86}) {
                        const Jet2<double> d = s.derivatives(u, v, patch);
                        const auto at = [&](double a, double b) { return s.derivatives(a, b, patch); };
                        const Vec3d p_u = derivative([&](double x) { return at(x, v).p; }, u),
                                    p_v = derivative([&](double x) { return at(u, x).p; }, v),
                                    p_uu = derivative([&](double x) { return at(x, v).p_u; }, u),
                                    p_uv = derivative([&](double x) { return at(x, v).p_v; }, u),
                                    p_vu = derivative([&](double x) { return at(u, x).p_u; }, v),
                                    p_vv = derivative([&](double x) { return at(u, x).p_v; }, v);
                        size.first = std::max({size.first, glm::length(p_u), glm::length(p_v)});
                        size.second = std::max({size.second, glm::length(p_uu), glm::length(p_uv), glm::length(p_vv)});
                        first = std::max({first, glm::length(d.p_u - p_u), glm::length(d.p_v - p_v)});
                        second = std::max({second, glm::length(d.p_uu - p_uu), glm::length(d.p_uv - p_uv),
                                           glm::length(d.p_uv - p_vu), glm::length(d.p_vv - p_vv)});
                        const Jet<double> jet = s.jet(u, v, patch);
                        const Vec3d n_u = derivative([&](double x) { return s.jet(x, v, patch).n; }, u),
                                    n_v = derivative([&](double x) { return s.jet(u, x, patch).n; }, v);
                        normal = std::max({normal, glm::length(jet.n_u - n_u) / (1 + glm::length(n_u)),
                                           glm::length(jet.n_v - n_v) / (1 + glm::length(n_v))});
                    }
            // The bound is five times larger per order, for the error of the numeric derivatives.
            CHECK(first <= 1e-7 * size.first);
            CHECK(second <= 5e-7 * std::max(size.second, size.first));
            CHECK(normal <= 5e-7);
        }
    }

    TEST_CASE("parametric: jets of torus, sphere and cylinder agree with the closed forms, rotated to y up") {
        const auto up = [](const Vec3d& a) { return Vec3d(a.x, a.z, -a.y); };
        const ParametricSurface torus("torus:R=2,r=0.7"), sphere("sphere:R=1.5"), cylinder("cylinder:R=0.7,h=3");
        for (double u : {0.0, 0.2, 0.61, 0.9})
            for (double v : {0.05, 0.25, 0.5, 0.83}) {
                const auto same = [&](const Jet<double>& got, const Jet<double>& want, double per_u, double per_v,
                                      double shift) {
                    CHECK(glm::length(got.p - up(want.p) + Vec3d(0, shift, 0)) < 1e-14);
                    CHECK(glm::length(got.p_u - per_u * up(want.p_u)) < 1e-13);
                    CHECK(glm::length(got.p_v - per_v * up(want.p_v)) < 1e-13);
                    CHECK(glm::length(got.n - up(want.n)) < 1e-14);
                    CHECK(glm::length(got.n_u - per_u * up(want.n_u)) < 1e-13);
                    CHECK(glm::length(got.n_v - per_v * up(want.n_v)) < 1e-13);
                    CHECK(got.sigma == 1);
                };
                same(torus.jet(u, v), oracle::torus(2, 0.7, 2 * pi * u, 2 * pi * v), 2 * pi, 2 * pi, 0);
                same(sphere.jet(u, v), oracle::sphere(1.5, 2 * pi * u, pi * (v - 0.5)), 2 * pi, pi, 0);
                same(cylinder.jet(u, v), oracle::cylinder(0.7, 2 * pi * u, 3 * v), 2 * pi, 3, 1.5);
            }
    }

    TEST_CASE("parametric: a superellipsoid satisfies its implicit equation, and is an ellipsoid for exponents of 1") {
        const ParametricSurface box("superellipsoid:a=1,b=2,c=3,e1=0.3,e2=0.7"),
            round("superellipsoid:a=1,b=2,c=3,e1=1,e2=1"), ellipsoid("ellipsoid:a=1,b=2,c=3");
        for (double u : {0.0, 0.11, 0.25, 0.4, 0.7})
            for (double v : {0.0, 0.1, 0.45, 0.5, 0.8}) {
                const Vec3d p = glm::abs(box.derivatives(u, v).p) / Vec3d(1, 2, 3);
                const double ring = std::pow(p.x, 2 / 0.7) + std::pow(p.z, 2 / 0.7);
                CHECK(std::pow(ring, 0.7 / 0.3) + std::pow(p.y, 2 / 0.3) == doctest::Approx(1).epsilon(1e-12));
                CHECK(glm::length(round.derivatives(u, v).p - ellipsoid.derivatives(u, v).p) < 1e-14);
                CHECK(glm::length(round.derivatives(u, v).p_uv - ellipsoid.derivatives(u, v).p_uv) < 1e-12);
            }
    }

    TEST_CASE("parametric: a revolution passes through its points and is smooth at its knots and its axis") {
        const Shapes shapes;
        const ParametricSurface s("revolution:profile=" + shapes.drop_file);
        const Vec2d points[] = {{0, -1}, {0.8, -0.6}, {0.9, 0}, {0.5, 0.7}, {0, 1.1}};
        double length = 0, t = 0;
        for (int i = 1; i < 5; ++i) length += glm::length(points[i] - points[i - 1]);
        for (int i = 0; i < 5; ++i) {
            if (i) t += glm::length(points[i] - points[i - 1]) / length;
            const double v = i == 4 ? 1 : t;
            CHECK(glm::length(s.derivatives(0, v).p - Vec3d(points[i].x, points[i].y, 0)) < 1e-14);
            if (i == 0 || i == 4) continue;
            const Jet2<double> before = s.derivatives(0.2, t - 1e-9), after = s.derivatives(0.2, t + 1e-9);
            CHECK(glm::length(before.p_v - after.p_v) < 1e-6);   // second derivative times the step
            CHECK(glm::length(before.p_vv - after.p_vv) < 1e-5); // third derivative times the step
        }
        // A loop is as smooth at its first knot as at the others.
        const ParametricSurface ring("revolution:profile=" + shapes.ring_file);
        const Jet2<double> start = ring.derivatives(0.2, 1e-9), end = ring.derivatives(0.2, 1 - 1e-9);
        CHECK(glm::length(start.p - end.p) < 1e-7);
        CHECK(glm::length(start.p_v - end.p_v) < 1e-6);
        CHECK(glm::length(start.p_vv - end.p_vv) < 1e-5);
        // The profile of a sphere in 32 points: the error of the spline is of fourth order in the step of 5.6 degrees.
        std::string half;
        for (int i = 0; i <= 32; ++i)
            half += format("%.17g %.17g\n", i % 32 == 0 ? 0 : std::sin(pi * i / 32), -std::cos(pi * i / 32));
        const ParametricSurface ball("revolution:profile=" + shapes.folder.write("ball.txt", half));
        for (double v : {0.0, 0.01, 0.2, 0.456, 0.7, 1.0}) {
            const Jet<double> jet = ball.jet(0.3, v);
            CHECK(std::abs(glm::length(jet.p) - 1) < 2e-6);
            CHECK(angle_deg(jet.n, jet.p) < 0.01);
        }
    }

    TEST_CASE("parametric: a bicubic patch of a cubic is that cubic") {
        // x = u, z = -v, y = 1 + 2u - v + u^2 v^3. The control values are the blossoms of the powers.
        std::string text = "1\n";
        for (int j = 0; j < 4; ++j)
            for (int i = 0; i < 4; ++i) {
                const double u = i / 3.0, v = j / 3.0, uu = i * (i - 1) / 6.0, vvv = j == 3;
                text += format("%.17g %.17g %.17g\n", u, 1 + 2 * u - v + uu * vvv, -v);
            }
        const Shapes shapes;
        const ParametricSurface s("bezier:file=" + shapes.folder.write("cubic.txt", text));
        const double u = 0.3, v = 0.7;
        const Jet2<double> d = s.derivatives(u, v);
        CHECK(glm::length(d.p - Vec3d(u, 1 + 2 * u - v + u * u * v * v * v, -v)) < 1e-14);
        CHECK(glm::length(d.p_u - Vec3d(1, 2 + 2 * u * v * v * v, 0)) < 1e-14);
        CHECK(glm::length(d.p_v - Vec3d(0, -1 + 3 * u * u * v * v, -1)) < 1e-14);
        CHECK(glm::length(d.p_uu - Vec3d(0, 2 * v * v * v, 0)) < 1e-14);
        CHECK(glm::length(d.p_uv - Vec3d(0, 6 * u * v * v, 0)) < 1e-14);
        CHECK(glm::length(d.p_vv - Vec3d(0, 6 * u * u * v, 0)) < 1e-14);
    }
}

TEST_SUITE("unit") {

    TEST_CASE("parametric: opposite edges are equal at periodic closures, and reversed at twisted ones") {
        const Shapes shapes;
        for (const std::string& text : shapes.all()) {
            INFO(text);
            const ParametricSurface s(text);
            for (double t : {0.0, 0.125, 0.3, 0.5, 0.9}) {
                if (s.closure_u() == Closure::periodic) CHECK(s.derivatives(1, t).p == s.derivatives(0, t).p);
                if (s.closure_v() == Closure::periodic) CHECK(s.derivatives(t, 1).p == s.derivatives(t, 0).p);
                if (s.closure_u() == Closure::twisted) {
                    CHECK(glm::length(s.derivatives(1, t).p - s.derivatives(0, 1 - t).p) < 1e-15);
                    CHECK(glm::length(s.jet(1, t).n + s.jet(0, 1 - t).n) < 1e-14); // opposite normals
                }
            }
        }
    }

    TEST_CASE("parametric: patch files with indices, with degrees and with plain points yield the same patches") {
        const Shapes shapes;
        const std::string plain = bake_tests::sheet();
        std::string points = plain.substr(2), indexed = "1\n1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16\n16\n" + points,
                    from_zero = "1\n0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15\n16\n" + points, bpt = "1\n3 3\n" + points;
        const ParametricSurface want("bezier:file=" + shapes.sheet_file);
        for (const std::string& text : {indexed, from_zero, bpt}) {
            const ParametricSurface got("bezier:file=" + shapes.folder.write("other.txt", text));
            CHECK(got.derivatives(0.3, 0.6).p == want.derivatives(0.3, 0.6).p);
            CHECK(got.derivatives(0.3, 0.6).p_uv == want.derivatives(0.3, 0.6).p_uv);
        }
    }

    TEST_CASE("parametric: normals point outward for both orders of a profile's points") {
        const Shapes shapes;
        const std::string down = "0 1.1\n0.5 0.7\n0.9 0\n0.8 -0.6\n0 -1\n";
        const ParametricSurface up("revolution:profile=" + shapes.drop_file),
            turned("revolution:profile=" + shapes.folder.write("down.txt", down));
        CHECK(up.derivatives(0.2, 0.3).p == turned.derivatives(0.2, 0.3).p);
        CHECK(volume(tessellate(turned, 16, 16)) > 0);
    }

    TEST_CASE("parametric: the help lists every shape with its keys") {
        const std::string help = parametric_shapes();
        for (const char* name :
             {"plane", "disc", "sphere", "ellipsoid", "cylinder", "cone", "torus", "helicoid", "saddle", "moebius",
              "klein", "superellipsoid", "revolution:profile=FILE", "bezier:file=FILE"})
            CHECK(help.find(name) != std::string::npos);
        CHECK(ParametricSurface("torus:R=2").help().find("R=2 (radius of the ring)") != std::string::npos);
        CHECK(ParametricSurface("torus:R=2").name() == "torus");
        const Shapes shapes;
        for (const std::string& text : shapes.all()) {
            const auto [columns, rows] = ParametricSurface(text).default_resolution();
            CHECK(tessellate(ParametricSurface(text), columns, rows).faces() > 0);
        }
    }
}

TEST_SUITE("stability") {

    TEST_CASE("parametric: all shapes have finite values at every finite parameter") {
        const Shapes shapes;
        for (const std::string& text : shapes.all()) {
            const ParametricSurface s(text);
            INFO(text);
            for (double u : {-3.7, -1e-20, 0.0, 0.5, 1.0, 7.25})
                for (double v : {-0.5, 0.0, 1e-300, 0.25, 0.5, 0.75, 1.0, 1.5}) {
                    const Jet2<double> d = s.derivatives(u, v);
                    const Jet<double> jet = s.jet(u, v);
                    for (const Vec3d& x : {d.p, d.p_u, d.p_v, d.p_uu, d.p_uv, d.p_vv, jet.n, jet.n_u, jet.n_v})
                        CHECK(glm::dot(x, Vec3d(0)) == 0); // neither NaN nor infinite
                    CHECK((std::abs(glm::length(jet.n) - 1) < 1e-12 || jet.sigma == 0));
                }
        }
    }

    TEST_CASE("parametric: bad shapes are refused with the nearest name or the valid keys") {
        check_refused("tours:R=2", Refusal::usage, "did you mean torus?");
        check_refused("", Refusal::usage, "plane, disc, sphere");
        check_refused("qwertyuiop", Refusal::usage, "the shapes are");
        check_refused("torus:Q=2", Refusal::usage, "torus:R=1,r=0.4");
        check_refused("torus:R", Refusal::usage, "needs a number");
        check_refused("torus:R=two", Refusal::usage, "needs a number");
        check_refused("torus:R=2x", Refusal::usage, "needs a number");
        for (const char* bad : {"nan", "inf", "-inf", "1e999", "0x10", ""})
            check_refused(std::string("torus:R=") + bad, Refusal::usage, "R needs a number");
        check_refused("torus:R=-1", Refusal::usage, "between");
        check_refused("torus:R=1,R=2", Refusal::usage, "twice");
        check_refused("torus:R=1,r=1", Refusal::usage, "less than R");
        check_refused("moebius:R=1,w=2", Refusal::usage, "less than 2 R");
        check_refused("klein:R=1,r=0.8", Refusal::usage, "less than 0.8 R");
        check_refused("superellipsoid:e1=1.5", Refusal::usage, "between");
        check_refused("revolution", Refusal::usage, "profile=FILE");
        check_refused("bezier:file=", Refusal::usage, "file=FILE");
        check_refused("plane:profile=x", Refusal::usage, "not a key of plane");
    }

    TEST_CASE("parametric: bad profiles and patch files are refused with their line") {
        const Shapes shapes;
        const auto profile = [&](const std::string& text) {
            return "revolution:profile=" + shapes.folder.write("bad.txt", text);
        };
        const auto patches = [&](const std::string& text) {
            return "bezier:file=" + shapes.folder.write("bad.txt", text);
        };
        using enum Refusal;
        check_refused("revolution:profile=/nowhere/at/all", unreadable, "/nowhere/at/all");
        check_refused(profile(""), unreadable, "fewer than two points");
        check_refused(profile("1 0\n"), unreadable, "fewer than two points");
        check_refused(profile("1 0\n\n# comment\n1 2 3\n"), unreadable, "line 4");
        check_refused(profile("1 0\n-1 2\n"), unreadable, "line 2: negative radius");
        check_refused(profile("1 0\n1 0\n2 1\n"), unreadable, "line 2");
        check_refused(profile("1 0\n2 one\n"), unreadable, "'one' is not a number");
        check_refused(profile("1 0\n2 nan\n"), unreadable, "'nan'");
        check_refused(profile("1 0\n2 1e999\n"), unreadable, "'1e999'");
        check_refused(profile("1 0\n2 1\n1 0\n"), unreadable, "three different points");
        check_refused(profile("2 0\n0.05 1\n0.05 2\n2 3\n"), unreadable, "crosses the axis between lines");
        check_refused(patches(""), unreadable, "no numbers");
        check_refused(patches("0\n"), unreadable, "line 1");
        check_refused(patches("1.5\n"), unreadable, "line 1");
        check_refused(patches("1e30\n1 2 3\n"), unreadable, "line 1");
        check_refused(patches("1\n"), unreadable, "ends too soon");
        check_refused(patches("1\n1 2 3\n"), unreadable, "ends too soon");
        check_refused(patches("1\n1 2 3 4 5\n"), unreadable, "line 2");
        check_refused(patches("1\n2 2\n0 0 0\n"), unreadable, "line 2: not a bicubic");
        check_refused(patches("1\n1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 17\n1\n0 0 0\n"), unreadable, "line 2: an index");
        check_refused(patches(bake_tests::sheet() + "1 2 3\n"), unreadable, "more lines than the given number");
    }
}
