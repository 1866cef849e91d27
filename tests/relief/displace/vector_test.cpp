// Displacement by vectors.
#include "relief/displace/displace_meshes.h"

using namespace bake;
using namespace bake::test;

namespace {

/// Waves in three channels, as values around 0.5.
Vec3d field(double u, double v) {
    return {std::sin(2 * pi * u) * std::cos(4 * pi * v), std::cos(2 * pi * (u + v)), std::sin(4 * pi * u + 2 * pi * v)};
}

Relief vectors(double amplitude, VectorSpace space) {
    Relief r;
    r.values = Image<float>(512, 512, 3);
    for (int y = 0; y < 512; ++y)
        for (int x = 0; x < 512; ++x)
            for (int c = 0; c < 3; ++c)
                r.values.at(x, y, c) = float(0.5 + 0.5 * field((x + 0.5) / 512, 1 - (y + 0.5) / 512)[c]);
    r.height.amplitude = 2 * amplitude;
    r.vector = space;
    return r;
}

/// The torus of the product (y up) displaced in closed form.
Vec3d displaced_torus(double u, double v, double amplitude, VectorSpace space) {
    const Jet<double> s = oracle::torus(1, 0.4, 2 * pi * u, 2 * pi * v);
    const auto turn = [](const Vec3d& a) { return Vec3d(a.x, a.z, -a.y); };
    const Vec3d d = amplitude * field(u, v);
    if (space == VectorSpace::object) return turn(s.p) + d;
    const Vec3d T = glm::normalize(s.p_u), B = glm::cross(s.n, T);
    return turn(s.p + d.x * T + d.y * B + d.z * s.n);
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("displace: vectors in object and tangent space against the closed form of a torus") {
        const BaseSurface base(ParametricSurface("torus:R=1,r=0.4"), 16, 8);
        DisplaceOptions options;
        options.rates.levels = 3;
        for (const VectorSpace space : {VectorSpace::object, VectorSpace::tangent}) {
            CAPTURE(int(space));
            const Displaced out = displace(base, vectors(0.05, space), options);
            check_sound(out.mesh);
            double position = 0, normal = 0;
            for (std::size_t c = 0; c < out.mesh.corners(); ++c) {
                const Vec2d uv(out.mesh.uvs[out.mesh.corner_uv[c]]);
                const auto at = [&](double u, double v) { return displaced_torus(u, v, 0.05, space); };
                const double h = 1e-5;
                const Vec3d N =
                    glm::cross(at(uv.x + h, uv.y) - at(uv.x - h, uv.y), at(uv.x, uv.y + h) - at(uv.x, uv.y - h));
                position = std::max(
                    position, glm::length(at(uv.x, uv.y) - Vec3d(out.mesh.positions[out.mesh.corner_position[c]])));
                normal = std::max(normal, oracle::angle_deg(N, Vec3d(out.mesh.normals[out.mesh.corner_normal[c]])));
            }
            CHECK(position < 3e-6); // 1e-6 of the diagonal
            CHECK(normal < 0.01);
        }
    }

    TEST_CASE("displace: tangent vectors turn with the chart: its x runs along +u, also where the chart is mirrored") {
        const auto vectors_of = [](double amplitude) {
            Relief r;
            r.values = Image<float>(1, 1, 3);
            r.values.at(0, 0, 0) = 1, r.values.at(0, 0, 1) = 0.5f, r.values.at(0, 0, 2) = 0.25f;
            r.height = {.amplitude = amplitude, .midlevel = 0};
            r.vector = VectorSpace::tangent;
            return r;
        };
        for (const bool mirrored : {false, true}) {
            const float w = mirrored ? -1.0f : 1.0f;
            Mesh quad = polygons({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 3}},
                                 {{0, 0}, {w, 0}, {w, 1}, {0, 1}});
            quad.tags.boundary = SubdivisionTags::Boundary::edge_and_corner; // a limit with tangents at its corners
            // The jets of a mesh run along the chart, those of a limit surface along the patch.
            const BaseSurface mesh{Mesh(quad)}, limit(Mesh(quad), SubdivisionOptions{});
            for (const BaseSurface* base : {&mesh, &limit}) {
                CAPTURE(base == &limit);
                const Displaced out = displace(*base, vectors_of(1)), still = displace(*base, vectors_of(0));
                // +u is -x on the mirrored chart, +v is +y on both.
                const Vec3f expected(w, 0.5f, 0.25f);
                REQUIRE(out.mesh.positions.size() == still.mesh.positions.size());
                for (std::size_t i = 0; i < out.mesh.positions.size(); ++i)
                    CHECK(glm::length(out.mesh.positions[i] - still.mesh.positions[i] - expected) < 1e-6f);
                for (const Vec3f& n : out.mesh.normals) CHECK(n.z == doctest::Approx(1));
            }
        }
    }

} // TEST_SUITE

TEST_SUITE("stability") {

    TEST_CASE(
        "displace, vectors that fold: along the surface at 1 over their slope; heights on a plane and turns within "
        "it never do") {
        const BaseSurface base(
            polygons({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 3}}, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
        const auto report = [&](VectorSpace space, double amplitude, Wrap wrap, auto value) {
            Relief r;
            r.values = Image<float>(64, 64, 3);
            for (int y = 0; y < 64; ++y)
                for (int x = 0; x < 64; ++x)
                    for (int c = 0; c < 3; ++c)
                        r.values.at(x, y, c) = float(value((x + 0.5) / 64, 1 - (y + 0.5) / 64)[c]);
            r.height = {.amplitude = amplitude, .midlevel = 0, .wrap_u = wrap, .wrap_v = wrap};
            r.vector = space;
            DisplaceOptions options;
            options.rates.levels = 4, options.margin = true;
            const Displaced out = displace(base, r, options);
            CHECK(*std::min_element(out.margin.begin(), out.margin.end()) == doctest::Approx(out.report.fold_margin));
            return out.report;
        };
        const auto along = [](double u, double) { return Vec3d(std::sin(2 * pi * u), 0, 0); };
        const auto up = [](double u, double) { return Vec3d(0, 0, std::sin(2 * pi * u)); };
        for (const VectorSpace space : {VectorSpace::object, VectorSpace::tangent}) {
            CAPTURE(int(space));
            for (const double x : {0.5, 0.99, 1.01, 3.0}) { // amplitude times 2 pi
                const DisplaceReport r = report(space, x / (2 * pi), Wrap::repeat, along);
                CHECK(r.fold_margin == doctest::Approx(1 - x).epsilon(1e-3));
                CHECK((r.folded > 0) == (x > 1));
            }
            CHECK(report(space, 10, Wrap::repeat, up).fold_margin == doctest::Approx(1).epsilon(1e-6));
        }
        // p + d is p turned by 120 degrees about (.5, .5), and then point-reflected through it, which turns both axes round.
        const auto turned = [](double degrees) {
            return [angle = glm::radians(degrees)](double u, double v) {
                const double x = u - 0.5, y = v - 0.5;
                return Vec3d(std::cos(angle) * x - std::sin(angle) * y - x,
                             std::sin(angle) * x + std::cos(angle) * y - y, 0);
            };
        };
        CHECK(report(VectorSpace::object, 1, Wrap::clamp, turned(120)).folded == 0);
    }

} // TEST_SUITE
