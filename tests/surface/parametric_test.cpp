#include "bake/surface/parametric.h"
#include "bake/base/error.h"
#include "oracle/surfaces.h"
#include "surface/shapes.h"
#include <doctest/doctest.h>
#include <map>

using namespace bake;
using bake_tests::Shapes;
using oracle::angle_deg;
using oracle::pi;

namespace {

/// Derivative of f at x: central differences at three steps, their h^2 and h^4 errors taken out (Richardson).
template <class F> Vec3d derivative(const F& f, double x) {
    const double h = 0.004;
    const auto d = [&](double step) { return (f(x + step) - f(x - step)) / (2 * step); };
    const Vec3d a = d(h), b = d(h / 2), c = d(h / 4);
    const Vec3d ab = (4.0 * b - a) / 3.0, bc = (4.0 * c - b) / 3.0;
    return (16.0 * bc - ab) / 15.0;
}

/// Largest first and second derivative: what a relative error is relative to.
struct Sizes {
    double first = 0, second = 0;
};

struct Manifold {
    std::size_t vertices = 0, edges = 0, faces = 0, boundary = 0, crowded = 0, against = 0;
    long euler() const { return long(vertices) - long(edges) + long(faces); }
};
Manifold manifold(const Mesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<int, int>> edges;
    std::vector<bool> used(mesh.positions.size());
    for (std::size_t f = 0; f < mesh.faces(); ++f)
        for (std::uint32_t begin = mesh.face_begin[f], end = mesh.face_begin[f + 1], c = begin; c < end; ++c) {
            const std::uint32_t a = mesh.corner_position[c], b = mesh.corner_position[c + 1 < end ? c + 1 : begin];
            used[a] = true;
            auto& [along, back] = edges[std::minmax(a, b)];
            ++(a < b ? along : back);
        }
    Manifold m{.edges = edges.size(), .faces = mesh.faces()};
    m.vertices = std::size_t(std::count(used.begin(), used.end(), true));
    for (const auto& [edge, sides] : edges) {
        m.boundary += sides.first + sides.second == 1;
        m.crowded += sides.first + sides.second > 2;
        m.against += sides.first == 2 || sides.second == 2;
    }
    return m;
}

double volume(const Mesh& mesh) {
    double sum = 0;
    for (std::size_t f = 0; f < mesh.faces(); ++f)
        for (std::uint32_t c = mesh.face_begin[f] + 1; c + 1 < mesh.face_begin[f + 1]; ++c) {
            const auto p = [&](std::uint32_t k) { return Vec3d(mesh.positions[mesh.corner_position[k]]); };
            sum += glm::dot(p(mesh.face_begin[f]), glm::cross(p(c), p(c + 1))) / 6;
        }
    return sum;
}

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
        // Not on knots of the splines, where the third derivative jumps; off the plane of the superellipsoid's |x|^n.
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
        // The issue's bound, and five times looser per order for the numeric side.
        CHECK(first <= 1e-7 * size.first);
        CHECK(second <= 5e-7 * std::max(size.second, size.first));
        CHECK(normal <= 5e-7);
    }
}

TEST_CASE("parametric: jets of torus, sphere and cylinder are the closed forms turned to y up") {
    const auto up = [](const Vec3d& a) { return Vec3d(a.x, a.z, -a.y); };
    const ParametricSurface torus("torus:R=2,r=0.7"), sphere("sphere:R=1.5"), cylinder("cylinder:R=0.7,h=3");
    for (double u : {0.0, 0.2, 0.61, 0.9})
        for (double v : {0.05, 0.25, 0.5, 0.83}) {
            const auto same = [&](const Jet<double>& got, const Jet<double>& want, double per_u, double per_v, double shift) {
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

TEST_CASE("parametric: a superellipsoid lies on its implicit surface, and is the ellipsoid at exponents of 1") {
    const ParametricSurface box("superellipsoid:a=1,b=2,c=3,e1=0.3,e2=0.7"), round("superellipsoid:a=1,b=2,c=3,e1=1,e2=1"),
        ellipsoid("ellipsoid:a=1,b=2,c=3");
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
        CHECK(glm::length(before.p_v - after.p_v) < 1e-6); // second derivative times the step
        CHECK(glm::length(before.p_vv - after.p_vv) < 1e-5); // third derivative times the step
    }
    // A loop has no knot that could be told from the others.
    const ParametricSurface ring("revolution:profile=" + shapes.ring_file);
    const Jet2<double> start = ring.derivatives(0.2, 1e-9), end = ring.derivatives(0.2, 1 - 1e-9);
    CHECK(glm::length(start.p - end.p) < 1e-7);
    CHECK(glm::length(start.p_v - end.p_v) < 1e-6);
    CHECK(glm::length(start.p_vv - end.p_vv) < 1e-5);
    // A sphere's profile in 32 points: the spline's error is of fourth order in the step of 5.6 degrees.
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
    // x = u, z = -v, y = 1 + 2u - v + u^2 v^3: control values by the blossom of each power.
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

TEST_CASE("parametric: closures meet, twisted ones the other way round") {
    const Shapes shapes;
    for (const std::string& text : shapes.all()) {
        INFO(text);
        const ParametricSurface s(text);
        for (double t : {0.0, 0.125, 0.3, 0.5, 0.9}) {
            if (s.closure_u() == Closure::periodic) CHECK(s.derivatives(1, t).p == s.derivatives(0, t).p);
            if (s.closure_v() == Closure::periodic) CHECK(s.derivatives(t, 1).p == s.derivatives(t, 0).p);
            if (s.closure_u() == Closure::twisted) {
                CHECK(glm::length(s.derivatives(1, t).p - s.derivatives(0, 1 - t).p) < 1e-15);
                CHECK(glm::length(s.jet(1, t).n + s.jet(0, 1 - t).n) < 1e-14); // the other side
            }
        }
    }
}

TEST_CASE("parametric: tessellations of closed shapes are closed manifolds that face outward") {
    const Shapes shapes;
    for (const std::string& text : shapes.closed()) {
        INFO(text);
        const ParametricSurface s(text);
        CHECK(s.closed());
        CHECK(s.orientable());
        const Mesh mesh = tessellate(s, 12, 10);
        const Manifold m = manifold(without_repeats(mesh));
        CHECK(m.boundary == 0);
        CHECK(m.crowded == 0);
        CHECK(m.against == 0);
        CHECK(m.euler() == (s.closure_v() == Closure::periodic ? 0 : 2));
        CHECK(volume(mesh) > 0);
        for (std::size_t c = 0; c < mesh.corners(); ++c)
            CHECK(std::abs(glm::length(mesh.normals[mesh.corner_normal[c]]) - 1) < 1e-6f);
    }
}

TEST_CASE("parametric: tessellations of one-sided shapes have no crack, and one seam where faces run against each other") {
    const Manifold strip = manifold(tessellate(ParametricSurface("moebius"), 24, 4));
    CHECK(strip.euler() == 0);
    CHECK(strip.boundary == 2 * 24); // one border, twice round
    CHECK(strip.crowded == 0);
    CHECK(strip.against == 4);
    const Manifold bottle = manifold(tessellate(ParametricSurface("klein"), 24, 12));
    CHECK(bottle.euler() == 0);
    CHECK(bottle.boundary == 0);
    CHECK(bottle.crowded == 0);
    CHECK(bottle.against == 12);
    CHECK_FALSE(ParametricSurface("klein").orientable());
    CHECK_FALSE(ParametricSurface("klein").closed());
}

TEST_CASE("parametric: tessellations of open shapes have their borders and nothing else") {
    const Shapes shapes;
    const std::map<std::string, std::size_t> borders = {{"plane:w=2,d=3", 44}, {"disc:R=1.5", 12}, {"cylinder:R=0.7,h=3", 24},
                                                        {"cone:R=1,h=1.5", 12}, {"saddle:R=1,h=0.4", 44}};
    for (const auto& [text, border] : borders) {
        INFO(text);
        const Manifold m = manifold(without_repeats(tessellate(ParametricSurface(text), 12, 10)));
        CHECK(m.boundary == border);
        CHECK(m.crowded + m.against == 0);
    }
    CHECK_FALSE(ParametricSurface("revolution:profile=" + shapes.vase_file).closed());
}

TEST_CASE("parametric: the vertices of a tessellation are points of the surface at their uv, with its normals") {
    const Shapes shapes;
    for (const std::string& text : shapes.all()) {
        INFO(text);
        const ParametricSurface s(text);
        const Mesh mesh = tessellate(s, 7, 5);
        const std::size_t per_patch = mesh.faces() / std::size_t(s.patches());
        CHECK(per_patch == 35);
        double p_error = 0, n_error = 0;
        for (std::size_t f = 0; f < mesh.faces(); ++f)
            for (std::uint32_t c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c) {
                const Vec2d uv(mesh.uvs[mesh.corner_uv[c]]);
                const Jet<double> jet = s.jet(uv.x, uv.y, int(f / per_patch));
                p_error = std::max(p_error, glm::length(Vec3d(mesh.positions[mesh.corner_position[c]]) - jet.p));
                if (jet.sigma != 0) n_error = std::max(n_error, glm::length(Vec3d(mesh.normals[mesh.corner_normal[c]]) - jet.n));
            }
        CHECK(p_error < 2e-6); // float uvs, positions and slopes up to 20
        CHECK(n_error < 2e-5);
    }
}

TEST_CASE("parametric: faces come row by row, (i,j) (i+1,j) (i+1,j+1) (i,j+1)") {
    const Mesh mesh = tessellate(ParametricSurface("plane"), 3, 2);
    CHECK(mesh.faces() == 6);
    const auto uv = [&](std::uint32_t c) { return mesh.uvs[mesh.corner_uv[c]]; };
    CHECK(uv(4 * 4) == Vec2f(1.f / 3, 0.5f)); // face 4 = 1 * 3 + 1
    CHECK(uv(4 * 4 + 1) == Vec2f(2.f / 3, 0.5f));
    CHECK(uv(4 * 4 + 2) == Vec2f(2.f / 3, 1));
    CHECK(uv(4 * 4 + 3) == Vec2f(1.f / 3, 1));
}

TEST_CASE("parametric: patches with unequal cells share the borders that run alike") {
    const Shapes shapes;
    const ParametricSurface s("bezier:file=" + shapes.octants_file);
    CHECK(s.patches() == 8);
    for (const auto& [columns, rows] : {std::pair(1, 1), {1, 4}, {5, 3}, {4, 4}}) {
        const Manifold m = manifold(without_repeats(tessellate(s, columns, rows)));
        CHECK(m.boundary == 0);
        CHECK(m.euler() == 2);
    }
}

TEST_CASE("parametric: flip turns a patch inside out") {
    const Shapes shapes;
    const ParametricSurface s("bezier:file=" + shapes.octants_file), flipped("bezier:flip=1,file=" + shapes.octants_file);
    CHECK(volume(tessellate(s, 8, 8)) == doctest::Approx(4.19).epsilon(0.02));
    CHECK(volume(tessellate(flipped, 8, 8)) == doctest::Approx(-4.19).epsilon(0.02));
    CHECK(glm::length(s.jet(0.3, 0.4, 1).n + flipped.jet(0.7, 0.4, 1).n) < 1e-14);
}

TEST_CASE("parametric: patch files with indices, with degrees and with plain points give the same patches") {
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

TEST_CASE("parametric: a profile may run either way; its outside stays outside") {
    const Shapes shapes;
    const std::string down = "0 1.1\n0.5 0.7\n0.9 0\n0.8 -0.6\n0 -1\n";
    const ParametricSurface up("revolution:profile=" + shapes.drop_file),
        turned("revolution:profile=" + shapes.folder.write("down.txt", down));
    CHECK(up.derivatives(0.2, 0.3).p == turned.derivatives(0.2, 0.3).p);
    CHECK(volume(tessellate(turned, 16, 16)) > 0);
}

TEST_CASE("parametric: help names every shape with its keys") {
    const std::string help = parametric_shapes();
    for (const char* name : {"plane", "disc", "sphere", "ellipsoid", "cylinder", "cone", "torus", "helicoid", "saddle", "moebius",
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

TEST_CASE("parametric: poles of sphere, ellipsoid and superellipsoid have their limit normal") {
    for (const char* text : {"sphere:R=3", "ellipsoid:a=3,b=1,c=0.4", "superellipsoid:e1=0.1,e2=0.3", "superellipsoid:e1=1,e2=0.05"}) {
        const ParametricSurface s(text);
        INFO(text);
        for (double u : {0.0, 0.1, 0.25, 0.7, 1.0}) {
            CHECK(s.pole(u, 0) == Pole::with_normal);
            CHECK(s.pole(u, 1) == Pole::with_normal);
            CHECK(s.pole(u, 0.5) == Pole::none);
            const Jet<double> top = s.jet(u, 1), bottom = s.jet(u, 0);
            CHECK(top.sigma == 0);
            CHECK(top.n_u == Vec3d(0));
            CHECK(glm::length(top.n - Vec3d(0, 1, 0)) < 1e-12);
            CHECK(glm::length(bottom.n - Vec3d(0, -1, 0)) < 1e-12);
            CHECK(top.p == s.jet(0, 1).p);
        }
    }
}

TEST_CASE("parametric: a disc's centre has the disc's normal") {
    const ParametricSurface s("disc:R=2");
    CHECK(s.pole(0.3, 1) == Pole::with_normal);
    CHECK(glm::length(s.jet(0.3, 1).n - Vec3d(0, 1, 0)) < 1e-12);
    CHECK(s.pole(0.3, 0) == Pole::none);
}

TEST_CASE("parametric: a cone's apex has no normal, but each meridian tends to one") {
    const ParametricSurface s("cone:R=1,h=1");
    for (double u : {0.0, 0.2, 0.5}) {
        CHECK(s.pole(u, 1) == Pole::without_normal);
        CHECK(s.jet(u, 1).n == Vec3d(0));
        CHECK(s.jet(u, 1).sigma == 0);
        CHECK(glm::length(s.side_normal(u, 1) - s.jet(u, 0.5).n) < 1e-12);
    }
    CHECK(ParametricSurface("cone:R=1,h=1,r=0.5").pole(0, 1) == Pole::none);
    // One apex, as many normals as meridians; all of them unit.
    const Mesh mesh = tessellate(s, 8, 2);
    CHECK(manifold(without_repeats(mesh)).boundary == 8);
    for (const Vec3f& n : mesh.normals) CHECK(glm::length(n) == doctest::Approx(1));
}

TEST_CASE("parametric: a revolution's ends on the axis are smooth, or pointed when asked") {
    const Shapes shapes;
    const ParametricSurface s("revolution:profile=" + shapes.drop_file), point("revolution:pointed=1,profile=" + shapes.drop_file);
    CHECK(s.pole(0.2, 0) == Pole::with_normal);
    CHECK(glm::length(s.jet(0.2, 0).n - Vec3d(0, -1, 0)) < 1e-12);
    CHECK(glm::length(s.jet(0.2, 1).n - Vec3d(0, 1, 0)) < 1e-12);
    CHECK(point.pole(0.2, 0) == Pole::without_normal);
    CHECK(point.pole(0.2, 1) == Pole::without_normal);
    const ParametricSurface vase("revolution:profile=" + shapes.vase_file);
    CHECK(vase.pole(0.2, 0) == Pole::with_normal);
    CHECK(vase.pole(0.2, 1) == Pole::none);
}

TEST_CASE("parametric: a patch with a collapsed edge has its limit normal there") {
    const Shapes shapes;
    const ParametricSurface s("bezier:file=" + shapes.octants_file);
    for (int patch = 0; patch < 8; ++patch) {
        const double v = patch < 4 ? 1 : 0;
        for (double u : {0.0, 0.3, 1.0}) {
            CHECK(s.pole(u, v, patch) == Pole::with_normal);
            CHECK(glm::length(s.jet(u, v, patch).n - Vec3d(0, patch < 4 ? 1 : -1, 0)) < 1e-12);
            CHECK(s.pole(u, 1 - v, patch) == Pole::none);
        }
    }
}

TEST_CASE("parametric: a patch that is a pyramid's tip has none, a single point nowhere") {
    const Shapes shapes;
    std::string tip = "1\n", point = "1\n";
    for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i) {
            const double r = (3 - j) / 3.0, x = std::cos(pi * i / 6), z = std::sin(pi * i / 6);
            tip += format("%.17g %g %.17g\n", r * x, j / 3.0, -r * z);
            point += "1 2 3\n";
        }
    const ParametricSurface s("bezier:file=" + shapes.folder.write("tip.txt", tip));
    CHECK(s.pole(0.4, 1) == Pole::without_normal);
    CHECK(s.pole(0.4, 0) == Pole::none);
    const ParametricSurface dot("bezier:file=" + shapes.folder.write("dot.txt", point));
    for (double u : {0.0, 0.5, 1.0}) {
        CHECK(dot.pole(u, 0.5) == Pole::without_normal);
        CHECK(dot.jet(u, 0.5).n == Vec3d(0));
    }
    CHECK(without_repeats(tessellate(dot, 4, 4)).faces() < 16);
}

TEST_CASE("parametric: any finite parameter gives finite values, on all shapes") {
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

TEST_CASE("parametric: bad shapes are refused with the nearest name or the keys there are") {
    check_refused("tours:R=2", Refusal::usage, "did you mean torus?");
    check_refused("", Refusal::usage, "plane, disc, sphere");
    check_refused("qwertyuiop", Refusal::usage, "The shapes are");
    check_refused("torus:Q=2", Refusal::usage, "torus:R=1,r=0.4");
    check_refused("torus:R", Refusal::usage, "needs a number");
    check_refused("torus:R=two", Refusal::usage, "needs a number");
    check_refused("torus:R=2x", Refusal::usage, "needs a number");
    check_refused("torus:R=nan", Refusal::usage, "between");
    check_refused("torus:R=inf", Refusal::usage, "between");
    check_refused("torus:R=-1", Refusal::usage, "between");
    check_refused("torus:R=1,R=2", Refusal::usage, "twice");
    check_refused("torus:R=1,r=1", Refusal::usage, "less than R");
    check_refused("moebius:R=1,w=2", Refusal::usage, "less than 2 R");
    check_refused("klein:R=1,r=0.8", Refusal::usage, "less than 0.8 R");
    check_refused("superellipsoid:e1=1.5", Refusal::usage, "between");
    check_refused("revolution", Refusal::usage, "profile=FILE");
    check_refused("bezier:file=", Refusal::usage, "file=FILE");
    check_refused("plane:profile=x", Refusal::usage, "no key of plane");
}

TEST_CASE("parametric: bad profiles and patch files are refused with their line") {
    const Shapes shapes;
    const auto profile = [&](const std::string& text) { return "revolution:profile=" + shapes.folder.write("bad.txt", text); };
    const auto patches = [&](const std::string& text) { return "bezier:file=" + shapes.folder.write("bad.txt", text); };
    using enum Refusal;
    check_refused("revolution:profile=/nowhere/at/all", unreadable, "/nowhere/at/all");
    check_refused(profile(""), unreadable, "fewer than two points");
    check_refused(profile("1 0\n"), unreadable, "fewer than two points");
    check_refused(profile("1 0\n\n# comment\n1 2 3\n"), unreadable, "line 4");
    check_refused(profile("1 0\n-1 2\n"), unreadable, "line 2: a negative radius");
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
    check_refused(patches("1\n2 2\n0 0 0\n"), unreadable, "line 2: only bicubic");
    check_refused(patches("1\n1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 17\n1\n0 0 0\n"), unreadable, "line 2: an index");
    check_refused(patches(bake_tests::sheet() + "1 2 3\n"), unreadable, "more than the patches it names");
}

TEST_CASE("parametric: resolutions that cannot close a shape, or would fill any memory, are refused") {
    const auto refused = [](const char* shape, int columns, int rows) {
        try {
            tessellate(ParametricSurface(shape), columns, rows);
            return 0;
        } catch (const Error& error) {
            return int(error.refusal);
        }
    };
    CHECK(refused("plane", 0, 1) == 2);
    CHECK(refused("plane", 1, -1) == 2);
    CHECK(refused("sphere", 2, 5) == 2);
    CHECK(refused("torus", 3, 2) == 2);
    CHECK(refused("plane", 1 << 20, 1 << 20) == 2);
    CHECK(refused("torus", 3, 3) == 0);
    CHECK(refused("sphere", 3, 1) == 0);
    CHECK(refused("plane", 1, 1) == 0);
}
}
