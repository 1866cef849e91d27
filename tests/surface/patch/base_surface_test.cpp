#include "bake/base/error.h"
#include "bake/surface/chart/mesh_surface.h"
#include "oracle/surfaces.h"
#include "surface/patch/complexes.h"

using namespace bake;
using namespace bake::test;
using oracle::angle_deg;

namespace {

/// uvs that are x and y, so that there is a chart (and on the sides none).
Mesh with_chart(Mesh mesh) {
    for (const Vec3f& p : mesh.positions) mesh.uvs.emplace_back(p.x + 0.3f * p.z, p.y - 0.2f * p.z);
    mesh.corner_uv = mesh.corner_position;
    return mesh;
}

/// Largest error of p_u, p_v, n_u, n_v, uv_s and uv_t against central differences at inner points of the patches.
double jet_error(const BaseSurface& base) {
    const double h = 1e-5;
    double worst = 0;
    for (std::uint32_t i = 0; i < base.complex().patches.size(); ++i)
        for (const auto& [s, t] : {std::pair(0.3, 0.4), {0.55, 0.2}}) {
            const SurfacePoint point = at(base, i, s, t);
            const SurfacePoint right = at(base, i, s + h, t), left = at(base, i, s - h, t), up = at(base, i, s, t + h),
                               down = at(base, i, s, t - h);
            const auto off = [&](const auto& want, const auto& high, const auto& low) {
                worst = std::max(worst, glm::length((high - low) / (2 * h) - want));
            };
            off(point.jet.p_u, right.jet.p, left.jet.p), off(point.jet.p_v, up.jet.p, down.jet.p);
            off(point.jet.n_u, right.jet.n, left.jet.n), off(point.jet.n_v, up.jet.n, down.jet.n);
            off(point.uv_s, right.uv, left.uv), off(point.uv_t, up.uv, down.uv);
            worst =
                std::max(worst, glm::length(point.jet.n -
                                            point.jet.sigma * unit_or_zero(glm::cross(point.jet.p_u, point.jet.p_v))));
        }
    return worst;
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("base_surface: jets of limits and shapes are the numeric derivatives of their points, on whole patches "
              "and quarters") {
        // A house: with triangles among its faces, every quad is four patches.
        Mesh mixed = unit_cube();
        mixed.positions.emplace_back(0.5, 0.5, 1.4);
        mixed = polygons(mixed.positions, {{0, 3, 2, 1},
                                           {0, 1, 5, 4},
                                           {1, 2, 6, 5},
                                           {2, 3, 7, 6},
                                           {3, 0, 4, 7},
                                           {4, 5, 8},
                                           {5, 6, 8},
                                           {6, 7, 8},
                                           {7, 4, 8}});
        const Mesh quads = with_chart(unit_cube());
        mixed = with_chart(std::move(mixed));
        Mesh triangles = with_chart(
            polygons({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                     {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}));
        // Central differences over 2e-5: third derivatives of order 100 times 1e-10 (more in the pieces of an octahedron), and rounding of
        // 1e-16 over 1e-5.
        CHECK(jet_error(BaseSurface(quads, {})) < 1e-7);
        CHECK(jet_error(BaseSurface(mixed, {})) < 1e-7);
        CHECK(jet_error(BaseSurface(triangles, {.scheme = Scheme::loop})) < 1e-6);
        CHECK(jet_error(BaseSurface(ParametricSurface("torus"), 12, 8)) < 1e-7);
        CHECK(jet_error(BaseSurface(ParametricSurface("saddle"), 2, 3)) < 1e-7);
    }

    TEST_CASE("base_surface: a shape's points are the shape's, patch by patch") {
        const ParametricSurface shape("torus:R=2,r=0.7");
        const BaseSurface base(shape, 12, 8);
        for (std::uint32_t i = 0; i < 96; i += 7) {
            const SurfacePoint point = at(base, i, 0.25, 0.75);
            const Jet<double> want = shape.jet(point.uv.x, point.uv.y);
            CHECK(glm::length(point.jet.p - want.p) < 1e-15);
            CHECK(glm::length(point.jet.n_u * 12.0 - want.n_u) < 1e-12);
            CHECK(std::abs(point.jet.p.y) <= 0.7 + 1e-12);
            const auto& face = base.complex().patches[i].face;
            const Vec3d corner(base.mesh().positions[base.mesh().corner_position[base.mesh().face_begin[face]]]);
            CHECK(glm::length(at(base, i, 0, 0).jet.p - corner) < 1e-6); // the mesh has floats
        }
    }
}

TEST_SUITE("unit") {

    TEST_CASE("base_surface: a triangle's jet is jet_at's") {
        const Mesh mesh = oracle::torus_mesh(16, 12);
        const MeshSurface surface = make_mesh_surface(mesh);
        const BaseSurface base(mesh);
        REQUIRE(base.complex().patches.size() == surface.triangles.size());
        double worst = 0;
        for (std::uint32_t i = 0; i < surface.triangles.size(); ++i)
            for (const auto& [s, t] : {std::pair(1 / 3.0, 1 / 3.0), {0.1, 0.2}, {0.5, 0.0}, {0.0, 1.0}}) {
                const Jet<double> want = jet_at<double>(surface, i, s, t), got = at(base, i, s, t).jet;
                CHECK(got.sigma == want.sigma);
                for (const auto& part : {&Jet<double>::p, &Jet<double>::n, &Jet<double>::p_u, &Jet<double>::p_v,
                                         &Jet<double>::n_u, &Jet<double>::n_v})
                    worst = std::max(worst, glm::length(got.*part - want.*part));
            }
        CHECK(worst < 1e-12); // derivatives up to 6, divided by an area in uv of 0.005 of float coordinates
    }

    TEST_CASE("base_surface: a quad is bilinear, and its n_u, n_v are the numeric derivatives of n along the chart") {
        const BaseSurface base(oracle::torus_mesh(12, 8, true));
        const double h = 1e-6;
        for (std::uint32_t i = 0; i < base.complex().patches.size(); i += 5) {
            const SurfacePoint point = at(base, i, 0.3, 0.6);
            const auto slope = [&](auto&& value) { // along s and t by central differences
                return std::pair((value(at(base, i, 0.3 + h, 0.6)) - value(at(base, i, 0.3 - h, 0.6))) / (2 * h),
                                 (value(at(base, i, 0.3, 0.6 + h)) - value(at(base, i, 0.3, 0.6 - h))) / (2 * h));
            };
            const auto [n_s, n_t] = slope([](const SurfacePoint& x) { return x.jet.n; });
            const auto [uv_s, uv_t] = slope([](const SurfacePoint& x) { return x.uv; });
            CHECK(glm::length(point.jet.n_u * uv_s.x + point.jet.n_v * uv_s.y - n_s) < 1e-9);
            CHECK(glm::length(point.jet.n_u * uv_t.x + point.jet.n_v * uv_t.y - n_t) < 1e-9);
            const Vec3d mean = 0.25 * (at(base, i, 0, 0).jet.p + at(base, i, 1, 0).jet.p + at(base, i, 1, 1).jet.p +
                                       at(base, i, 0, 1).jet.p);
            CHECK(glm::length(at(base, i, 0.5, 0.5).jet.p - mean) < 1e-15);
        }
    }

    TEST_CASE(
        "base_surface: p_u and p_v are perpendicular to n with sigma on the right side, so a flat height keeps n") {
        for (const bool mirrored : {false, true}) {
            Mesh mesh = oracle::torus_mesh(16, 12, true);
            if (mirrored)
                for (Vec2f& uv : mesh.uvs) uv.x = -uv.x;
            const BaseSurface base(mesh);
            for (std::uint32_t i = 0; i < base.complex().patches.size(); ++i) {
                const Jet<double> jet = at(base, i, 0.2, 0.7).jet;
                CHECK(jet.sigma == (mirrored ? -1 : 1));
                CHECK(angle_deg(jet.sigma * glm::cross(jet.p_u, jet.p_v), jet.n) < 1e-9);
            }
        }
    }

    TEST_CASE("base_surface: without a chart the jet runs along the patch, and says how") {
        const BaseSurface base(unit_cube());
        const SurfacePoint point = at(base, 1, 0.5, 0.5);
        CHECK(glm::length(point.jet.n - Vec3d(0, 0, 1)) < 1e-15);
        CHECK(glm::length(point.jet.p_u - Vec3d(1, 0, 0)) < 1e-15);
        CHECK(glm::length(point.jet.p_v - Vec3d(0, 1, 0)) < 1e-15);
        CHECK(point.jet.sigma == 1);
        CHECK(point.uv_s == Vec2d(0));
    }

    TEST_CASE("base_surface: a pole keeps its limit normal, and the tip of a cone one per meridian") {
        const BaseSurface sphere(ParametricSurface("sphere"), 12, 8);
        int poles = 0;
        for (std::uint32_t i = 0; i < sphere.complex().patches.size(); ++i)
            for (const Vec2d& st : {Vec2d(0, 0), Vec2d(0.3, 1)}) {
                const SurfacePoint point = at(sphere, i, st.x, st.y);
                CHECK(glm::length(point.jet.n) == doctest::Approx(1));
                CHECK(angle_deg(point.jet.n, point.jet.p) < 1e-6);
                if (point.jet.sigma != 0) continue;
                ++poles;
                CHECK(std::abs(point.jet.n.y) == doctest::Approx(1));
            }
        CHECK(poles == 24);
        const BaseSurface cone(ParametricSurface("cone"), 12, 3);
        CHECK(std::count(cone.complex().sharp_vertex.begin(), cone.complex().sharp_vertex.end(), true) >= 1);
    }

    TEST_CASE("base_surface: the lattice is evaluate() at its places, row by row") {
        Mesh mesh = unit_cube();
        mesh.corner_position.insert(mesh.corner_position.end(), {0, 1, 5});
        mesh.face_begin.push_back(std::uint32_t(mesh.corners()));
        const BaseSurface bases[] = {BaseSurface(mesh), BaseSurface(unit_cube(), {}),
                                     BaseSurface(ParametricSurface("torus"), 6, 5)};
        for (const auto& [which, patch, rate] :
             {std::tuple(0, 0u, 3), {0, 6u, 11}, {1, 2u, 8}, {1, 3u, 40}, {2, 7u, 9}}) {
            const BaseSurface& base = bases[which];
            const int sides = base.complex().patches[patch].sides();
            std::vector<Vec2d> st;
            for (int j = 0; j <= rate; ++j)
                for (int i = 0; i <= (sides == 3 ? rate - j : rate); ++i)
                    st.emplace_back(double(i) / rate, double(j) / rate);
            std::vector<SurfacePoint> want(st.size()), got(st.size());
            base.evaluate(patch, st, want);
            base.evaluate_lattice(patch, rate, got);
            for (std::size_t i = 0; i < st.size(); ++i) {
                CHECK(got[i].jet.p == want[i].jet.p);
                CHECK(got[i].jet.n_u == want[i].jet.n_u);
            }
        }
    }
}

TEST_SUITE("stability") {
    TEST_CASE("base_surface: a cage of which no face has a limit surface is refused, and faces left out are counted") {
        const auto reason = [](Mesh cage, Scheme scheme) -> std::string {
            try {
                BaseSurface(std::move(cage), {.scheme = scheme}, "cage.obj");
            } catch (const Error& error) {
                CHECK(error.refusal == Refusal::unsuitable);
                return error.what();
            }
            return "";
        };
        const auto grid = [](int n) {
            std::vector<Vec3f> positions;
            std::vector<std::vector<std::uint32_t>> faces;
            for (int i = 0; i < (n + 1) * (n + 1); ++i) positions.emplace_back(i % (n + 1), i / (n + 1), 0);
            for (int i = 0; i < n * n; ++i) {
                const auto p = std::uint32_t(i % n + i / n * (n + 1)), up = std::uint32_t(n + 1);
                faces.push_back({p, p + 1, p + up + 1, p + up});
            }
            return polygons(positions, faces);
        };
        CHECK(reason(Mesh(), Scheme::catmark).find("cage.obj: the cage has no faces; ") == 0);
        Mesh triangle = polygons({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
        const Mesh pentagon = polygons({{0, 0, 0}, {1, 0, 0}, {2, 1, 0}, {1, 2, 0}, {0, 1, 0}}, {{0, 1, 2, 3, 4}});
        for (Mesh cage : {grid(1), grid(2), triangle, pentagon}) {
            CHECK(reason(cage, Scheme::catmark) == "");
            cage.tags.boundary = SubdivisionTags::Boundary::none;
            CHECK(reason(cage, Scheme::catmark).find("cage.obj: its boundary rule, interpolateboundary 0, ") == 0);
        }
        CHECK(reason(triangle, Scheme::loop) == "");
        triangle.tags.boundary = SubdivisionTags::Boundary::none;
        CHECK(reason(triangle, Scheme::loop).find("interpolateboundary 0") != std::string::npos);

        Mesh sheet = grid(3);
        CHECK(BaseSurface(sheet, SubdivisionOptions()).mesh().notes.empty());
        sheet.tags.boundary = SubdivisionTags::Boundary::none;
        const BaseSurface middle(sheet, SubdivisionOptions());
        CHECK(middle.complex().patches.size() == 1);
        REQUIRE(middle.mesh().notes.size() == 1);
        CHECK(middle.mesh().notes[0].find("left out: 8 of 9 faces") == 0);
    }

    TEST_CASE("base_surface: a quad folded over in uv still has a jet on the outward side") {
        Mesh mesh = polygons({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 3}});
        mesh.uvs = {{0, 0}, {1, 0}, {0, 1}, {1, 1}}; // a bow tie
        mesh.corner_uv = {0, 1, 2, 3};
        const BaseSurface base(mesh);
        for (const double s : {0.0, 0.3, 0.5, 0.9})
            for (const double t : {0.0, 0.5, 1.0}) {
                const Jet<double> jet = at(base, 0, s, t).jet;
                CHECK(angle_deg(jet.sigma * glm::cross(jet.p_u, jet.p_v), jet.n) < 1e-6);
            }
    }
}
