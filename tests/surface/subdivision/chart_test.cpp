#include "bake/surface/subdivision/subdivision.h"
#include "mesh/file/mesh_files.h"
#include "oracle/surfaces.h"
#include "surface/subdivision/cages.h"

using namespace bake;
using namespace bake_tests;

namespace {

// p = (x, y, x^2 y + y^2) over a bent chart u = x + x y / 4, v = y - x^2 / 8, as a limit point at s = x, t = y.
LimitPoint bent(double x, double y) {
    LimitPoint q{};
    q.p = {x, y, x * x * y + y * y};
    q.p_s = {1, 0, 2 * x * y};
    q.p_t = {0, 1, x * x + 2 * y};
    q.p_ss = {0, 0, 2 * y};
    q.p_st = {0, 0, 2 * x};
    q.p_tt = {0, 0, 2};
    q.uv = {x + x * y / 4, y - x * x / 8};
    q.uv_s = {1 + y / 4, -x / 4};
    q.uv_t = {x / 4, 1};
    q.uv_ss = {0, -0.25};
    q.uv_st = {0.25, 0};
    return q;
}

// x and y where the chart is (u, v), by Newton.
Vec2d unbend(const Vec2d& uv) {
    Vec2d x = uv;
    for (int i = 0; i < 30; ++i) {
        const LimitPoint q = bent(x.x, x.y);
        const Vec2d r = uv - q.uv;
        const double det = q.uv_s.x * q.uv_t.y - q.uv_s.y * q.uv_t.x;
        x += Vec2d(r.x * q.uv_t.y - r.y * q.uv_t.x, q.uv_s.x * r.y - q.uv_s.y * r.x) / det;
    }
    return x;
}

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("chart_derivatives: a bent chart's derivatives agree with differences along the chart") {
        const double h = 1e-4;
        const LimitPoint q = bent(0.3, -0.4);
        const Jet2<double> jet = chart_derivatives(q);
        const auto at = [&](double du, double dv) {
            const Vec2d x = unbend(q.uv + Vec2d(du, dv));
            return bent(x.x, x.y).p;
        };
        CHECK(glm::distance(jet.p_u, (at(h, 0) - at(-h, 0)) / (2 * h)) < 1e-7);
        CHECK(glm::distance(jet.p_v, (at(0, h) - at(0, -h)) / (2 * h)) < 1e-7);
        CHECK(glm::distance(jet.p_uu, (at(h, 0) - 2.0 * q.p + at(-h, 0)) / (h * h)) < 1e-6);
        CHECK(glm::distance(jet.p_vv, (at(0, h) - 2.0 * q.p + at(0, -h)) / (h * h)) < 1e-6);
        CHECK(glm::distance(jet.p_uv, (at(h, h) - at(h, -h) - at(-h, h) + at(-h, -h)) / (4 * h * h)) < 1e-6);
    }

    TEST_CASE("chart_jet: n_u and n_v are the turn of the unit normal along the chart") {
        const double h = 1e-5;
        const LimitPoint q = bent(0.3, -0.4);
        const Jet<double> jet = chart_jet(q);
        const auto normal = [&](double du, double dv) {
            const Vec2d x = unbend(q.uv + Vec2d(du, dv));
            const LimitPoint r = bent(x.x, x.y);
            return glm::normalize(glm::cross(r.p_s, r.p_t));
        };
        CHECK(jet.sigma == 1);
        CHECK(glm::distance(jet.n, normal(0, 0)) < 1e-15);
        CHECK(glm::distance(jet.n_u, (normal(h, 0) - normal(-h, 0)) / (2 * h)) < 1e-8);
        CHECK(glm::distance(jet.n_v, (normal(0, h) - normal(0, -h)) / (2 * h)) < 1e-8);
        CHECK(glm::distance(jet.p_u, chart_derivatives(q).p_u) == 0);
    }
}

TEST_SUITE("stability") {
    TEST_CASE("chart_jet: a mirrored chart has sigma -1, and its normal stays outside") {
        LimitPoint q = bent(0.3, -0.4);
        const Jet<double> before = chart_jet(q);
        for (Vec2d* uv : {&q.uv, &q.uv_s, &q.uv_t, &q.uv_ss, &q.uv_st, &q.uv_tt}) uv->x = -uv->x;
        const Jet<double> jet = chart_jet(q);
        CHECK(jet.sigma == -1);
        CHECK(jet.n == before.n);
        CHECK(glm::distance(jet.p_u, -before.p_u) < 1e-15);
        CHECK(glm::distance(jet.n_u, -before.n_u) < 1e-15);
        CHECK(glm::distance(jet.n_v, before.n_v) < 1e-15);
    }

    TEST_CASE("chart_jet: a chart without area, or a point without normal, gives zeros") {
        LimitPoint q = bent(0.3, -0.4);
        q.uv_t = 3.0 * q.uv_s; // equal but for rounding
        const Jet<double> flat = chart_jet(q);
        CHECK((flat.sigma == 0 && flat.p_u == Vec3d(0) && flat.n_v == Vec3d(0)));
        CHECK(glm::length(flat.n) == doctest::Approx(1));
        CHECK((chart_derivatives(q).p_v == Vec3d(0) && chart_derivatives(q).p_uv == Vec3d(0)));
        q = bent(0.3, -0.4);
        q.p_t = 2.0 * q.p_s;
        const Jet<double> creased = chart_jet(q);
        CHECK((creased.n == Vec3d(0) && creased.n_u == Vec3d(0) && creased.sigma == 1));
        CHECK(glm::length(creased.p_u) > 0);
        CHECK(chart_jet(LimitPoint{}).sigma == 0);
    }

    TEST_CASE("chart_jet: zero-area uvs of a cage are zeros everywhere, not noise") {
        Mesh cage = box();
        give_each_face_a_chart(cage);
        for (std::uint32_t c = 0; c < 4; ++c) cage.uvs[c].y = 0.3f * cage.uvs[c].x; // the first face's chart is a line
        const SubdivisionSurface surface(cage);
        std::vector<LimitPoint> points(81);
        for (const std::uint32_t patch : {0u, 1u}) {
            surface.evaluate_lattice(patch, 8, Derivatives::second, points);
            for (const LimitPoint& p : points) CHECK((chart_jet(p).sigma == 0) == (patch == 0));
        }
    }
}
