// Displaced shapes against closed forms.
#include "relief/displace/displace_meshes.h"
#include "relief/map/torus_relief.h"

using namespace bake;
using namespace bake::test;
using oracle::angle_deg;

namespace {

/// A shape's closed form in the coordinates of the product: y up, uv in [0,1]^2.
struct Form {
    const char* shape;
    double diagonal;
    std::function<Jet<double>(double, double)> jet;
};

Jet<double> y_up(Jet<double> s, double du, double dv) {
    const auto turn = [](const Vec3d& v) { return Vec3d(v.x, v.z, -v.y); };
    s.p = turn(s.p), s.n = turn(s.n);
    s.p_u = du * turn(s.p_u), s.p_v = dv * turn(s.p_v), s.n_u = du * turn(s.n_u), s.n_v = dv * turn(s.n_v);
    return s;
}

const Form forms[] = {
    {"torus:R=1,r=0.4", std::sqrt(2.8 * 2.8 * 2 + 0.8 * 0.8),
     [](double u, double v) { return y_up(oracle::torus(1, 0.4, 2 * pi * u, 2 * pi * v), 2 * pi, 2 * pi); }},
    {"sphere:R=1", std::sqrt(12.0),
     [](double u, double v) { return y_up(oracle::sphere(1, 2 * pi * u, pi * (v - 0.5)), 2 * pi, pi); }},
    {"cylinder:R=1,h=2", std::sqrt(12.0),
     [](double u, double v) { return y_up(oracle::cylinder(1, 2 * pi * u, 2 * v - 1), 2 * pi, 2); }},
};

struct Errors {
    double position = 0, normal_deg = 0;
};

/// Against the displaced closed form, at each corner's own uv.
Errors errors(const Form& form, const oracle::TorusRelief& r, const Mesh& mesh, std::size_t stride = 1) {
    Errors worst;
    for (std::size_t c = 0; c < mesh.corners(); c += stride) {
        const Vec2f uv = mesh.uvs[mesh.corner_uv[c]];
        if (uv.y <= 0 || uv.y >= 1) continue; // poles: their uv is that of a face
        const Jet<double> s = form.jet(uv.x, uv.y);
        const Height<double> h = oracle::relief(r, uv.x, uv.y);
        worst.position =
            std::max(worst.position, glm::length(Vec3d(mesh.positions[mesh.corner_position[c]]) - s.p - h.b * s.n));
        const Vec3d N = glm::cross(s.p_u + h.b_u * s.n + h.b * s.n_u, s.p_v + h.b_v * s.n + h.b * s.n_v);
        worst.normal_deg = std::max(worst.normal_deg, angle_deg(Vec3d(mesh.normals[mesh.corner_normal[c]]), N));
    }
    return worst;
}

/// Vertex normals from the faces alone, by Max's weights.
std::vector<Vec3d> geometric_normals(const Mesh& mesh) {
    std::vector<Vec3d> n(mesh.positions.size(), Vec3d(0));
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
        const std::uint32_t first = mesh.face_begin[f], count = mesh.face_begin[f + 1] - first;
        for (std::uint32_t k = 0; k < count; ++k) {
            const auto at = [&](std::uint32_t i) {
                return Vec3d(mesh.positions[mesh.corner_position[first + i % count]]);
            };
            const Vec3d a = at(k + 1) - at(k), b = at(k + count - 1) - at(k);
            n[mesh.corner_position[first + k]] += glm::cross(a, b) / (glm::dot(a, a) * glm::dot(b, b));
        }
    }
    return n;
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("displace: torus, sphere and cylinder of a million faces against closed forms") {
        for (const Form& form : forms) {
            CAPTURE(form.shape);
            // Waves of 1024 / 12 texels: the spline is nearer to them than floats are.
            const oracle::TorusRelief r{0.01, 12, 12};
            Relief height = relief(oracle::relief_texture(r, 1024).values, 2 * r.A);
            // The sphere's and cylinder's v has ends: beyond them the same waves go on.
            const BaseSurface base(ParametricSurface(form.shape), 32, 32);
            const Displaced out = displace(base, height, levels(5));
            CHECK(out.mesh.faces() == 1 << 20);
            const Errors e = errors(form, r, out.mesh, 3);
            CHECK(e.position < 1e-6 * form.diagonal);
            CHECK(e.normal_deg < 0.01);
            CHECK(out.report.folded == 0);
            CHECK(out.report.height_max == doctest::Approx(r.A).epsilon(1e-4));
            // u = 0 and 1 meet in the same height.
            CHECK(out.report.seam_mismatch < 1e-6);
        }
    }

    TEST_CASE("displace: normals of the displaced faces converge to the exact ones with order 2") {
        const Form& form = forms[0];
        const oracle::TorusRelief r{0.02, 4, 3};
        const Relief height = relief(oracle::relief_texture(r, 512).values, 2 * r.A);
        const BaseSurface base(ParametricSurface(form.shape), 16, 8);
        double before = 0;
        for (int level = 2; level <= 5; ++level) {
            const Displaced out = displace(base, height, levels(level));
            const std::vector<Vec3d> n = geometric_normals(out.mesh);
            double worst = 0;
            for (std::size_t c = 0; c < out.mesh.corners(); ++c)
                worst = std::max(worst, angle_deg(n[out.mesh.corner_position[c]],
                                                  Vec3d(out.mesh.normals[out.mesh.corner_normal[c]])));
            if (level > 2) CHECK(std::log2(before / worst) == doctest::Approx(2).epsilon(0.1));
            before = worst;
        }
    }

} // TEST_SUITE
