#include "bake/surface/analytic/parametric.h"
#include "bake/surface/point/curvature.h"
#include "oracle/surfaces.h"
#include "surface/analytic/shapes.h"
#include <doctest/doctest.h>
#include <sstream>

using namespace bake;
using doctest::Approx;

namespace {

/// A generic point: its derivatives are neither orthogonal nor of unit length.
const Jet2<double> skew = {{1, 2, 3},        {1, 0.2, -0.3},   {0.4, 1.7, 0.5},
                           {0.3, -0.2, 0.9}, {-0.4, 0.1, 0.6}, {0.2, 0.5, -0.8}};

/// First form p_i . p_j and second form n_i . p_j = -n . p_ij, positive where the surface bends away from n.
struct Forms {
    double E = 0, F = 0, G = 0, L = 0, M = 0, N = 0;
};
Forms forms(const Jet<double>& s) {
    return {glm::dot(s.p_u, s.p_u), glm::dot(s.p_u, s.p_v), glm::dot(s.p_v, s.p_v),
            glm::dot(s.n_u, s.p_u), glm::dot(s.n_u, s.p_v), glm::dot(s.n_v, s.p_v)};
}

/// Curvatures as quotients of the forms (do Carmo, section 3.3, with the signs for outward n).
std::pair<double, double> mean_and_gauss(const Forms& f) {
    const double area = f.E * f.G - f.F * f.F;
    return {(f.L * f.G - 2 * f.M * f.F + f.N * f.E) / (2 * area), (f.L * f.N - f.M * f.M) / area};
}

/// Gauss's rule with two points per cell over [0, 1], graded towards the `breaks` where the integrand is not smooth: the
/// curvature of superellipsoids varies as |x|^(n-2) at the quarters, and that of a spline has a kink at each knot.
struct Sample {
    double at, weight;
};
std::vector<Sample> graded(const std::vector<double>& breaks, int cells) {
    std::vector<Sample> samples;
    const int parts = int(breaks.size()) - 1, each = cells / parts / 2 * 2; // points come in pairs
    for (int part = 0; part < parts; ++part)
        for (int k = 0; k < each; ++k) {
            const double t = (k + 0.5 + (k % 2 == 0 ? -1 : 1) * (std::sqrt(1 / 3.0) - 0.5)) / each,
                         width = breaks[part + 1] - breaks[part];
            samples.push_back({breaks[part] + width * t * t * (3 - 2 * t), width * 6 * t * (1 - t) / each});
        }
    return samples;
}

/// The knots of a profile: chord-length parametrisation.
std::vector<double> knots(const std::string& profile) {
    std::istringstream text(profile);
    std::vector<double> at;
    for (Vec2d p(0), before(0); text >> p.x >> p.y; before = p)
        at.push_back(at.empty() ? 0 : at.back() + glm::length(p - before));
    for (double& t : at) t /= at.back();
    return at;
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("curvature: the eigenvalues of A agree with the quotients of the fundamental forms") {
        for (const double outward : {1.0, -1.0}) {
            const Jet<double> jet = jet_of(skew, outward);
            const Curvature<double> c = curvature(jet);
            const auto [mean, gauss] = mean_and_gauss(forms(jet));
            CHECK(c.mean == Approx(mean).epsilon(1e-12));
            CHECK(c.gauss == Approx(gauss).epsilon(1e-12));
            CHECK(c.a1 >= c.a2);
            CHECK(c.a1 * c.a2 == Approx(c.gauss).epsilon(1e-12));
        }
    }

    TEST_CASE("curvature: principal directions are eigenvectors of A, with e2 = n x e1") {
        const Jet<double> jet = jet_of(skew);
        const Curvature<double> c = curvature(jet);
        // The derivative of n along a tangent vector w = x p_u + y p_v.
        const auto normal_derivative = [&](const Vec3d& w) {
            const Forms f = forms(jet);
            const double a = glm::dot(w, jet.p_u), b = glm::dot(w, jet.p_v), area = f.E * f.G - f.F * f.F;
            return (a * f.G - b * f.F) / area * jet.n_u + (b * f.E - a * f.F) / area * jet.n_v;
        };
        CHECK(glm::length(normal_derivative(c.e1) - c.a1 * c.e1) < 1e-12);
        CHECK(glm::length(normal_derivative(c.e2) - c.a2 * c.e2) < 1e-12);
        CHECK(glm::length(c.e2 - glm::cross(jet.n, c.e1)) < 1e-15);
    }

    TEST_CASE("curvature: the second form is -n . p_ij") {
        for (const double outward : {1.0, -1.0}) {
            const Jet<double> jet = jet_of(skew, outward);
            const Forms f = forms(jet);
            CHECK(f.L == Approx(-glm::dot(jet.n, skew.p_uu)).epsilon(1e-13));
            CHECK(f.M == Approx(-glm::dot(jet.n, skew.p_uv)).epsilon(1e-13));
            CHECK(f.M == Approx(glm::dot(jet.n_v, jet.p_u)).epsilon(1e-13));
            CHECK(f.N == Approx(-glm::dot(jet.n, skew.p_vv)).epsilon(1e-13));
        }
    }

    TEST_CASE("curvature: the opposite normal changes the signs of a1 and a2, another chart changes nothing") {
        const Curvature<double> c = curvature(jet_of(skew)), inside = curvature(jet_of(skew, -1.0));
        CHECK(inside.a1 == Approx(-c.a2).epsilon(1e-13));
        CHECK(inside.gauss == Approx(c.gauss).epsilon(1e-13));
        const Curvature<double> rechart = curvature(oracle::rechart(jet_of(skew), 0.3, -2, 1.1, 0.7));
        CHECK(rechart.a1 == Approx(c.a1).epsilon(1e-12));
        CHECK(rechart.a2 == Approx(c.a2).epsilon(1e-12));
        // A mirrored chart has the same outside and sigma -1.
        Jet<double> mirrored = oracle::rechart(jet_of(skew), 0, 1, 1, 0);
        CHECK(mirrored.sigma == -1);
        CHECK(curvature(mirrored).a1 == Approx(c.a1).epsilon(1e-12));
    }

    TEST_CASE("curvature: at an umbilic e1 is parallel to p_u") {
        const Jet<double> jet = oracle::sphere(2, 0.3, 0.4);
        const Curvature<double> c = curvature(jet);
        CHECK(c.a1 == Approx(0.5));
        CHECK(c.a2 == Approx(0.5));
        const Curvature<double> plane = curvature(Jet<double>{{}, {2, 0, 0}, {1, 1, 0}, {0, 0, 1}, {}, {}, 1});
        CHECK(plane.e1 == Vec3d(1, 0, 0));
        CHECK(plane.a1 == 0);
    }

    TEST_CASE("curvature: float follows double") {
        Jet2<float> narrow;
        narrow = {Vec3f(skew.p),    Vec3f(skew.p_u),  Vec3f(skew.p_v),
                  Vec3f(skew.p_uu), Vec3f(skew.p_uv), Vec3f(skew.p_vv)};
        const Curvature<float> f = curvature(jet_of(narrow));
        const Curvature<double> d = curvature(jet_of(skew));
        CHECK(f.mean == Approx(d.mean).epsilon(1e-5));
        CHECK(f.gauss == Approx(d.gauss).epsilon(1e-5));
    }
}

TEST_SUITE("stability") {

    TEST_CASE("curvature: zero or parallel derivatives give zeros, never NaN") {
        for (const auto& [p_u, p_v] : {std::pair(Vec3d(0), Vec3d(1, 0, 0)),
                                       {Vec3d(1, 0, 0), Vec3d(0)},
                                       {Vec3d(0), Vec3d(0)},
                                       {Vec3d(0.1, 0.7, 0.3), 3.0 * Vec3d(0.1, 0.7, 0.3)}}) {
            Jet2<double> s = skew;
            s.p_u = p_u, s.p_v = p_v;
            const Jet<double> jet = jet_of(s);
            CHECK(jet.sigma == 0);
            CHECK(jet.n == Vec3d(0));
            CHECK(jet.n_u == Vec3d(0));
            CHECK(jet.p == s.p);
            const Curvature<double> c = curvature(jet);
            CHECK(c.a1 == 0);
            CHECK(c.gauss == 0);
            CHECK(c.e1 == Vec3d(0));
        }
    }

    TEST_CASE("curvature: scaling by 1e-9 and 1e16 divides the curvature by the scale") {
        const Curvature<double> c = curvature(jet_of(skew));
        for (const double k : {1e-9, 1e16}) {
            Jet2<double> s = skew;
            for (Vec3d* d : {&s.p, &s.p_u, &s.p_v, &s.p_uu, &s.p_uv, &s.p_vv}) *d *= k;
            CHECK(curvature(jet_of(s)).a1 * k == Approx(c.a1).epsilon(1e-12));
        }
    }
}

TEST_SUITE("oracle") {

    TEST_CASE("curvature: closed forms of torus and saddle") {
        const double R = 2, r = 0.7;
        const ParametricSurface torus("torus:R=2,r=0.7");
        for (double v : {0.0, 0.1, 0.37, 0.5, 0.81}) {
            const Curvature<double> c = curvature(torus.jet(0.23, v));
            const double ring = std::cos(2 * pi * v) / (R + r * std::cos(2 * pi * v));
            CHECK(c.a1 == Approx(1 / r).epsilon(1e-12));
            CHECK(c.a2 == Approx(ring).epsilon(1e-12).scale(1));
            CHECK(c.gauss == Approx(ring / r).epsilon(1e-12).scale(1));
        }
        // y = h (x^2 - z^2) at the origin: the principal curvatures are -2h along x and 2h along z.
        const Curvature<double> c = curvature(ParametricSurface("saddle:R=1,h=0.4").jet(0.5, 0.5));
        CHECK(c.a1 == Approx(0.8));
        CHECK(c.a2 == Approx(-0.8));
        CHECK(std::abs(c.e1.z) == Approx(1)); // the surface bends away from n along z
    }

    TEST_CASE("curvature: spheres have 1/R, cylinders 1/R and 0, minimal surfaces mean 0") {
        for (double u : {0.0, 0.3, 0.77})
            for (double v : {0.01, 0.3, 0.5, 0.9}) {
                const Curvature<double> sphere = curvature(ParametricSurface("sphere:R=2.5").jet(u, v));
                CHECK(sphere.a1 == Approx(0.4).epsilon(1e-11));
                CHECK(sphere.a2 == Approx(0.4).epsilon(1e-11));
                const Curvature<double> cylinder = curvature(ParametricSurface("cylinder:R=0.5").jet(u, v));
                CHECK(cylinder.a1 == Approx(2).epsilon(1e-13));
                CHECK(std::abs(cylinder.a2) < 1e-13);
                const Curvature<double> screw = curvature(ParametricSurface("helicoid:R=1,h=2,turns=3").jet(u, v));
                CHECK(std::abs(screw.mean) < 1e-12 * screw.a1);
                // K = -c^2 / (c^2 + rho^2)^2 with pitch c per radian.
                const double c = 2 / (6 * pi), rho = 2 * v - 1;
                CHECK(screw.gauss == Approx(-c * c / std::pow(c * c + rho * rho, 2)).epsilon(1e-12));
            }
    }

    TEST_CASE("curvature: the total curvature of closed shapes is 2 pi times Euler's number (Gauss and Bonnet)") {
        const bake_tests::Shapes shapes;
        for (const std::string& text : shapes.closed()) {
            const ParametricSurface surface(text);
            const bool ring = surface.closure_v() == Closure::periodic;
            const int cells = surface.patches() > 1 ? 64 : 256;
            const std::vector<double> quarters = {0, 0.25, 0.5, 0.75, 1};
            const bool profile = text.find("profile") != std::string::npos;
            const auto across = graded(quarters, cells),
                       up = graded(profile ? knots(ring ? bake_tests::ring : bake_tests::drop) : quarters, cells);
            double total = 0;
            for (int patch = 0; patch < surface.patches(); ++patch)
                for (const Sample& v : up)
                    for (const Sample& u : across) {
                        const Jet<double> jet = surface.jet(u.at, v.at, patch);
                        total += curvature(jet).gauss * glm::length(glm::cross(jet.p_u, jet.p_v)) * u.weight * v.weight;
                    }
            INFO(text);
            CHECK(std::abs(total - (ring ? 0 : 4 * pi)) < 5e-5); // 1.3e-5 on the octants at 64 x 64, 1e-6 on the others
        }
    }
}
