#include "bake/mesh/file/mesh_io.h"
#include "bake/surface/chart/mesh_surface.h"
#include "bake/surface/patch/base_surface.h"
#include "cli/command.h"
#include "oracle/surfaces.h"
#include <doctest/doctest.h>
#include <map>
#include <optional>

using namespace bake;
using oracle::angle_deg;

namespace {

/// Faces over the given positions.
Mesh polygons(std::vector<Vec3f> positions, const std::vector<std::vector<std::uint32_t>>& faces) {
    Mesh mesh;
    mesh.positions = std::move(positions);
    for (const auto& face : faces) {
        mesh.corner_position.insert(mesh.corner_position.end(), face.begin(), face.end());
        mesh.face_begin.push_back(std::uint32_t(mesh.corner_position.size()));
    }
    return mesh;
}

Mesh cube() {
    return polygons({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}},
                    {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}});
}

/// A Moebius strip of `count` quads, wound along itself: at its closing edge the faces run the same way.
Mesh moebius(int count) {
    std::vector<Vec3f> positions;
    std::vector<std::vector<std::uint32_t>> faces;
    for (int i = 0; i < count; ++i) {
        const double u = 2 * pi * i / count;
        for (const double side : {-0.3, 0.3}) {
            const double ring = 1 + side * std::cos(u / 2);
            positions.emplace_back(ring * std::cos(u), ring * std::sin(u), side * std::sin(u / 2));
        }
        const auto a = std::uint32_t(2 * i), b = std::uint32_t(2 * ((i + 1) % count));
        if (i + 1 < count) faces.push_back({a, b, b + 1, a + 1});
        else faces.push_back({a, 1, 0, a + 1});
    }
    return polygons(positions, faces);
}

/// Every side leads from its edge's one end to the other, as `reversed` says; every number is used.
void check_consistent(const PatchComplex& complex) {
    std::vector<std::array<std::uint32_t, 2>> ends(complex.edges, {no_index, no_index});
    std::vector<bool> vertex_used(complex.vertices, false);
    bool well = true;
    for (const auto& patch : complex.patches)
        for (int k = 0; k < patch.sides(); ++k) {
            const std::uint32_t from = patch.vertex[k], to = patch.vertex[(k + 1) % patch.sides()];
            REQUIRE(from < complex.vertices);
            REQUIRE(patch.edge[k] < complex.edges);
            vertex_used[from] = true;
            const std::array<std::uint32_t, 2> run = patch.reversed[k] ? std::array{to, from} : std::array{from, to};
            auto& known = ends[patch.edge[k]];
            if (known[0] == no_index) known = run;
            well &= known == run;
        }
    CHECK(well);
    CHECK(std::count(vertex_used.begin(), vertex_used.end(), false) == 0);
    for (const auto& e : ends) well &= e[0] != no_index;
    CHECK(well);
    CHECK(complex.seam.size() == complex.edges);
    CHECK(complex.crease.size() == complex.edges);
    CHECK(complex.sharp_vertex.size() == complex.vertices);
    // No two edges join the same two vertices, those without length aside.
    std::map<std::array<std::uint32_t, 2>, int> joined;
    for (const auto& e : ends)
        if (e[0] != e[1]) well &= ++joined[e] == 1;
    CHECK(well);
}

/// Faces and vertices less edges; an edge without length takes the face's corner with it.
int euler(const PatchComplex& complex) {
    int poles = 0;
    for (const auto& patch : complex.patches)
        for (int k = 0; k < patch.sides(); ++k) poles += patch.vertex[k] == patch.vertex[(k + 1) % patch.sides()];
    return int(complex.patches.size()) + int(complex.vertices) - (int(complex.edges) - poles);
}

int boundary_edges(const PatchComplex& complex) {
    std::vector<int> count(complex.edges, 0);
    for (const auto& patch : complex.patches)
        for (int k = 0; k < patch.sides(); ++k) ++count[patch.edge[k]];
    return int(std::count(count.begin(), count.end(), 1));
}

SurfacePoint at(const BaseSurface& base, std::uint32_t patch, double s, double t) {
    SurfacePoint point;
    const Vec2d st(s, t);
    base.evaluate(patch, {&st, 1}, {&point, 1});
    return point;
}

/// Parameters of a place `along` side k of a patch.
Vec2d on_side(const PatchComplex::Patch& patch, int k, double along) {
    static const Vec2d quad[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, triangle[] = {{0, 0}, {1, 0}, {0, 1}};
    const Vec2d* corner = patch.sides() == 4 ? quad : triangle;
    return (1 - along) * corner[k] + along * corner[(k + 1) % patch.sides()];
}

/// The largest distance of what the patches at an edge say of its points; of normals and uvs too where nothing splits them.
struct Disagreement {
    double p = 0, n = 0, uv = 0;
};
Disagreement edge_disagreement(const BaseSurface& base, std::initializer_list<double> places = {0.0, 0.25, 0.5, 1.0}) {
    const PatchComplex& complex = base.complex();
    Disagreement worst;
    for (const double place : places) {
        std::vector<std::optional<SurfacePoint>> first(complex.edges);
        for (std::uint32_t i = 0; i < complex.patches.size(); ++i)
            for (int k = 0; k < complex.patches[i].sides(); ++k) {
                const auto& patch = complex.patches[i];
                const Vec2d st = on_side(patch, k, patch.reversed[k] ? 1 - place : place);
                const SurfacePoint point = at(base, i, st.x, st.y);
                auto& other = first[patch.edge[k]];
                if (!other) other = point;
                worst.p = std::max(worst.p, glm::length(point.jet.p - other->jet.p));
                if (!complex.crease[patch.edge[k]] && point.jet.n != Vec3d(0) && other->jet.n != Vec3d(0))
                    worst.n = std::max(worst.n, glm::length(point.jet.n - other->jet.n));
                if (!complex.seam[patch.edge[k]]) worst.uv = std::max(worst.uv, glm::length(point.uv - other->uv));
            }
    }
    return worst;
}

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
        Mesh mixed = cube();
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
        const Mesh quads = with_chart(cube());
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

    TEST_CASE("base_surface: a cube's complex has 8 vertices, 12 edges of two patches, and no crease between averaged "
              "normals") {
        const BaseSurface base(cube());
        check_consistent(base.complex());
        CHECK(base.complex().vertices == 8);
        CHECK(base.complex().edges == 12);
        CHECK(euler(base.complex()) == 2);
        CHECK(boundary_edges(base.complex()) == 0);
        for (std::uint32_t e = 0; e < 12; ++e) {
            CHECK(!base.complex().crease[e]);
            CHECK(!base.complex().seam[e]);
        }
    }

    TEST_CASE("base_surface: normals split in the file are creases, at edges and vertices") {
        Mesh mesh = cube();
        mesh.normals = {{0, 0, -1}, {0, 0, 1}, {0, -1, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}};
        for (std::uint32_t c = 0; c < mesh.corners(); ++c) mesh.corner_normal.push_back(c / 4);
        const BaseSurface base(mesh);
        for (std::uint32_t e = 0; e < 12; ++e) CHECK(base.complex().crease[e]);
        for (std::uint32_t v = 0; v < 8; ++v) CHECK(base.complex().sharp_vertex[v]);
        CHECK(glm::length(at(base, 0, 0.3, 0.8).jet.n - Vec3d(0, 0, -1)) == 0);
    }

    TEST_CASE("base_surface: a torus mesh closes, with seams where its uvs jump and nowhere else") {
        const BaseSurface base(oracle::torus_mesh(16, 12, true));
        const PatchComplex& complex = base.complex();
        check_consistent(complex);
        CHECK(euler(complex) == 0);
        CHECK(boundary_edges(complex) == 0);
        CHECK(std::count(complex.seam.begin(), complex.seam.end(), true) == 16 + 12);
        CHECK(std::count(complex.crease.begin(), complex.crease.end(), true) == 0);
        const Disagreement d = edge_disagreement(base);
        CHECK(d.p < 1e-15); // two roundings of numbers near 1
        CHECK(d.n < 1e-15);
        CHECK(d.uv < 1e-15);
    }

    TEST_CASE("base_surface: a Moebius strip's faces meet the same way round at one edge") {
        const BaseSurface base(moebius(24));
        check_consistent(base.complex());
        CHECK(euler(base.complex()) == 0);
        CHECK(boundary_edges(base.complex()) == 48);
        CHECK(edge_disagreement(base).p < 1e-15);
    }

    TEST_CASE("base_surface: positions that are bit-equal are one vertex, -0 and 0 too") {
        Mesh mesh = polygons(
            {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, -0.0f, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {7, 7, 7}},
            {{0, 1, 2, 3}, {4, 5, 6, 7}});
        const BaseSurface base(mesh);
        check_consistent(base.complex());
        CHECK(base.complex().vertices == 6);
        CHECK(base.complex().edges == 7);
    }

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
        const BaseSurface base(cube());
        const SurfacePoint point = at(base, 1, 0.5, 0.5);
        CHECK(glm::length(point.jet.n - Vec3d(0, 0, 1)) < 1e-15);
        CHECK(glm::length(point.jet.p_u - Vec3d(1, 0, 0)) < 1e-15);
        CHECK(glm::length(point.jet.p_v - Vec3d(0, 1, 0)) < 1e-15);
        CHECK(point.jet.sigma == 1);
        CHECK(point.uv_s == Vec2d(0));
    }

    TEST_CASE("base_surface: a cage's limit has the cage's complex; with other faces than quads, its corners'") {
        const BaseSurface whole(cube(), {});
        check_consistent(whole.complex());
        CHECK(whole.complex().patches.size() == 6);
        CHECK(whole.complex().edges == 12);
        CHECK(euler(whole.complex()) == 2);
        Mesh prism = polygons({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}},
                              {{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}});
        const BaseSurface corners(prism, {});
        check_consistent(corners.complex());
        CHECK(corners.complex().patches.size() == 18);
        CHECK(corners.complex().vertices == 6 + 9 + 5);
        CHECK(euler(corners.complex()) == 2);
        CHECK(boundary_edges(corners.complex()) == 0);
        for (const BaseSurface* base : {&whole, &corners}) {
            const Disagreement d = edge_disagreement(*base);
            CHECK(d.p < 1e-12);
            CHECK(d.n < 1e-5); // the limit evaluator promises 0.01 deg
        }
        // The limit of a cage pushed apart has its faces where the patches say.
        for (std::uint32_t i = 0; i < 18; ++i) {
            const std::uint32_t face = corners.complex().patches[i].face;
            CHECK((at(corners, i, 0.5, 0.5).jet.n.z < -0.5) == (face == 0));
            CHECK((at(corners, i, 0.5, 0.5).jet.n.z > 0.5) == (face == 1));
        }
    }

    TEST_CASE("base_surface: infinitely sharp edges of a cage are creases, semi-sharp ones are not") {
        for (const float sharpness : {0.0f, 2.0f, 10.0f}) {
            Mesh mesh = cube();
            for (const auto& [a, b] : {std::pair(4u, 5u), {5u, 6u}, {6u, 7u}, {7u, 4u}})
                mesh.tags.creases.push_back({a, b, sharpness});
            const BaseSurface base(mesh, {});
            CHECK(std::count(base.complex().crease.begin(), base.complex().crease.end(), true) ==
                  (sharpness == 10 ? 4 : 0));
            CHECK(std::count(base.complex().sharp_vertex.begin(), base.complex().sharp_vertex.end(), true) ==
                  (sharpness == 10 ? 4 : 0));
            // The top's sides are one smooth curve at its corners: no tangents there, but a normal.
            if (sharpness == 10)
                CHECK(angle_deg(at(base, 1, 1, 0).jet.n, {0, 0, 1}) < 0.2); // by second derivatives at the vertex
        }
    }

    TEST_CASE("base_surface: shapes close where they should, with seams at the borders of the chart") {
        const auto seams = [](const BaseSurface& base) {
            return std::count(base.complex().seam.begin(), base.complex().seam.end(), true);
        };
        const BaseSurface torus(ParametricSurface("torus"), 12, 8);
        check_consistent(torus.complex());
        CHECK(euler(torus.complex()) == 0);
        CHECK(boundary_edges(torus.complex()) == 0);
        CHECK(seams(torus) == 12 + 8);
        const BaseSurface sphere(ParametricSurface("sphere"), 12, 8);
        check_consistent(sphere.complex());
        CHECK(euler(sphere.complex()) == 2);
        CHECK(boundary_edges(sphere.complex()) == 24); // the poles' edges, which have no length
        CHECK(seams(sphere) == 8);
        CHECK(edge_disagreement(sphere).p < 1e-14);
        const BaseSurface strip(ParametricSurface("moebius"), 12, 4);
        check_consistent(strip.complex());
        CHECK(euler(strip.complex()) == 0);
        CHECK(boundary_edges(strip.complex()) == 24);
        CHECK(std::count(strip.complex().crease.begin(), strip.complex().crease.end(), true) ==
              4); // n turns over there
        CHECK(edge_disagreement(strip).p < 1e-14);
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
        Mesh mesh = cube();
        mesh.corner_position.insert(mesh.corner_position.end(), {0, 1, 5});
        mesh.face_begin.push_back(std::uint32_t(mesh.corners()));
        const BaseSurface bases[] = {BaseSurface(mesh), BaseSurface(cube(), {}),
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

    TEST_CASE(
        "base_surface: faces that repeat a position or have no area leave the complex and their neighbours whole") {
        Mesh mesh = cube();
        const auto add = [&](std::initializer_list<std::uint32_t> face) {
            mesh.corner_position.insert(mesh.corner_position.end(), face);
            mesh.face_begin.push_back(std::uint32_t(mesh.corners()));
        };
        add({0, 1, 0}), add({2, 2, 2}), add({4, 4, 5, 5}), add({0, 1, 1, 2});
        const BaseSurface base(mesh);
        check_consistent(base.complex());
        for (std::uint32_t i = 6; i < 10; ++i)
            for (const auto& [s, t] : {std::pair(0.0, 0.0), {0.3, 0.3}, {1.0, 0.0}}) {
                const SurfacePoint point = at(base, i, s, t);
                CHECK(
                    std::isfinite(glm::length(point.jet.p_u) + glm::length(point.jet.n_u) + glm::length(point.jet.n)));
            }
        CHECK(at(base, 7, 0.2, 0.2).jet.sigma == 0);
        CHECK(glm::length(at(base, 7, 0.2, 0.2).jet.n) == doctest::Approx(1)); // the limit normal, so that it can move
        CHECK(angle_deg(at(base, 1, 0.5, 0.5).jet.n, {0, 0, 1}) < 1e-6);
    }

    TEST_CASE("base_surface: an edge of three faces is one edge") {
        const BaseSurface base(read_mesh(test::own_meshes() / "trouble/nonmanifold_edge.obj"));
        check_consistent(base.complex());
        std::vector<int> count(base.complex().edges, 0);
        for (const auto& patch : base.complex().patches)
            for (int k = 0; k < patch.sides(); ++k) ++count[patch.edge[k]];
        CHECK(*std::max_element(count.begin(), count.end()) >= 3);
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

TEST_SUITE("real" * doctest::skip(test::no_shared_data())) {

    TEST_CASE("base_surface: Spot is a closed complex of genus 0, cage and triangles; its edges agree") {
        for (const char* name : {"spot_control_mesh.obj", "spot_quadrangulated.obj", "spot_triangulated.obj"}) {
            const BaseSurface base(read_mesh(test::shared_data() / "meshes/spot" / name));
            check_consistent(base.complex());
            CHECK(euler(base.complex()) == 2);
            CHECK(boundary_edges(base.complex()) == 0);
            const Disagreement d = edge_disagreement(base, {0.5});
            CHECK(d.p < 1e-15);
            CHECK(d.n < 1e-12);
        }
    }

    TEST_CASE("base_surface: Spot's cage and mixed cages have closed limits whose patches agree at their edges") {
        const BaseSurface spot(read_mesh(test::shared_data() / "meshes/spot/spot_control_mesh.obj"), {});
        check_consistent(spot.complex());
        CHECK(euler(spot.complex()) == 2);
        CHECK(boundary_edges(spot.complex()) == 0);
        const Disagreement d = edge_disagreement(spot, {0.0, 0.5});
        CHECK(d.p < 1e-14);
        CHECK(d.n < 1e-6);
        CHECK(d.uv < 1e-7);
        const BaseSurface mixed(read_mesh(test::shared_data() / "meshes/opensubdiv/catmark_nonquads.obj"), {});
        check_consistent(mixed.complex());
        CHECK(edge_disagreement(mixed, {0.0, 0.5}).p < 1e-12);
    }

    TEST_CASE("base_surface: the teapot is a consistent complex") {
        const BaseSurface base(read_mesh(test::shared_data() / "meshes/materialx/teapot.obj"));
        check_consistent(base.complex());
        CHECK(edge_disagreement(base, {0.5}).p < 1e-14);
    }
}
