#include "bake/surface/chart/mesh_surface.h"
#include "oracle/surfaces.h"
#include <doctest/doctest.h>

using namespace bake;
using oracle::angle_deg;

namespace {

/// One square of two triangles in the xy plane, its uv turned by a 2 x 2 matrix.
Mesh square(double a = 1, double b = 0, double c = 0, double d = 1) {
    Mesh mesh;
    mesh.face_begin = {0, 3, 6};
    mesh.positions = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
    for (const Vec2d& st : {Vec2d(0, 0), Vec2d(1, 0), Vec2d(1, 1), Vec2d(0, 1)})
        mesh.uvs.emplace_back(a * st.x + b * st.y, c * st.x + d * st.y);
    mesh.corner_position = mesh.corner_uv = {0, 1, 2, 0, 2, 3};
    return mesh;
}

/// Angle errors of p_u, p_v, n of a mesh of the reference torus against the closed form, at inner points.
oracle::Spread jet_errors(int columns, int rows, const char* what) {
    const Mesh mesh = oracle::torus_mesh(columns, rows);
    const MeshSurface surface = make_mesh_surface(mesh);
    std::vector<double> errors;
    for (std::uint32_t t = 0; t < surface.triangles.size(); t += 3)
        for (const auto& [b1, b2] : {std::pair(1 / 3.0, 1 / 3.0), {0.1, 0.2}, {0.5, 0.0}}) {
            const auto& corner = surface.triangles[t].corner;
            const auto uv = [&](int k) { return Vec2d(mesh.uvs[mesh.corner_uv[corner[k]]]); };
            const Vec2d at = (1 - b1 - b2) * uv(0) + b1 * uv(1) + b2 * uv(2);
            const Jet<double> want = oracle::torus(1, 0.4, 2 * pi * at.x, 2 * pi * at.y),
                              got = jet_at<double>(surface, t, b1, b2);
            const bool normal = *what == 'n';
            errors.push_back(normal ? angle_deg(got.n, want.n)
                                    : glm::length(got.p_u / (2 * pi) - want.p_u) / glm::length(want.p_u));
        }
    return oracle::spread(errors);
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("mesh_surface: normals and derivatives of a torus mesh converge with order 2") {
        const oracle::Spread coarse = jet_errors(64, 32, "n"), fine = jet_errors(128, 64, "n");
        CHECK(coarse.mean < 0.1);
        CHECK(coarse.mean / fine.mean > 3.5);
        const oracle::Spread coarse_u = jet_errors(64, 32, "p_u"), fine_u = jet_errors(128, 64, "p_u");
        CHECK(coarse_u.mean < 0.01);
        CHECK(coarse_u.mean / fine_u.mean > 3.5);
    }

    TEST_CASE("mesh_surface: curvature of a fine torus mesh is the torus's") {
        const Mesh mesh = oracle::torus_mesh(512, 256);
        const MeshSurface surface = make_mesh_surface(mesh);
        for (std::uint32_t t = 0; t < surface.triangles.size(); t += 997) {
            const auto uv = (Vec2d(mesh.uvs[mesh.corner_uv[surface.triangles[t].corner[0]]]) +
                             Vec2d(mesh.uvs[mesh.corner_uv[surface.triangles[t].corner[1]]]) +
                             Vec2d(mesh.uvs[mesh.corner_uv[surface.triangles[t].corner[2]]])) /
                            3.0;
            const Jet<double> want = oracle::torus(1, 0.4, 2 * pi * uv.x, 2 * pi * uv.y),
                              got = jet_at<double>(surface, t, 1 / 3.0, 1 / 3.0);
            CHECK(glm::length(got.n_u / (2 * pi) - want.n_u) < 0.02);
            CHECK(glm::length(got.n_v / (2 * pi) - want.n_v) < 0.02);
        }
    }
}

TEST_SUITE("unit") {

    TEST_CASE("mesh_surface: a flat square's jet is its chart's, mirrored or turned") {
        for (const auto& [a, b, c, d] :
             {std::array{1.0, 0.0, 0.0, 1.0}, {-1.0, 0.0, 0.0, 1.0}, {0.0, -1.0, 1.0, 0.0}, {0.5, 0.1, 0.0, 0.25}}) {
            const Mesh mesh = square(a, b, c, d);
            const MeshSurface surface = make_mesh_surface(mesh);
            const double det = a * d - b * c;
            for (std::uint32_t t = 0; t < 2; ++t) {
                const Jet<double> jet = jet_at<double>(surface, t, 0.2, 0.3);
                CHECK(jet.n == Vec3d(0, 0, 1));
                CHECK(jet.sigma == (det > 0 ? 1 : -1));
                CHECK(glm::length(jet.p_u - 2.0 * Vec3d(d, -c, 0) / det) < 1e-6);
                CHECK(glm::length(jet.p_v - 2.0 * Vec3d(-b, a, 0) / det) < 1e-6);
                CHECK(glm::length(jet.n_u) + glm::length(jet.n_v) == 0);
            }
        }
    }

    TEST_CASE("mesh_surface: derivatives that are added later are those of the whole surface") {
        const Mesh mesh = oracle::torus_mesh(24, 12);
        const MeshSurface whole = make_mesh_surface(mesh);
        MeshSurface surface = make_mesh_surface(mesh, {.derivatives = false});
        CHECK(surface.n == whole.n);
        CHECK(surface.p_u.empty());
        CHECK(surface.sigma.empty());
        for (int twice = 0; twice < 2; ++twice) {
            add_derivatives(surface);
            CHECK(surface.p_u == whole.p_u);
            CHECK(surface.p_v == whole.p_v);
            CHECK(surface.sigma == whole.sigma);
        }
    }

    TEST_CASE("mesh_surface: p_u and p_v are perpendicular to n, so a flat height keeps n exactly") {
        const Mesh mesh = oracle::torus_mesh(16, 8);
        const MeshSurface surface = make_mesh_surface(mesh);
        for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
            const Jet<double> jet = jet_at<double>(surface, t, 0.3, 0.5);
            CHECK(std::abs(glm::dot(jet.p_u, jet.n)) < 1e-12);
            CHECK(std::abs(glm::dot(jet.p_v, jet.n)) < 1e-12);
            CHECK(angle_deg(jet.sigma * glm::cross(jet.p_u, jet.p_v), jet.n) < 1e-9);
        }
    }

    TEST_CASE("mesh_surface: missing normals are the angle-weighted mean, the same however quads are split") {
        Mesh mesh = oracle::torus_mesh(64, 32, true);
        mesh.normals.clear();
        mesh.corner_normal.clear();
        const MeshSurface surface = make_mesh_surface(mesh);
        double worst = 0;
        for (std::size_t c = 0; c < mesh.corners(); ++c) {
            const Vec2d uv(mesh.uvs[mesh.corner_uv[c]]);
            worst =
                std::max(worst, angle_deg(Vec3d(surface.n[c]), oracle::torus(1, 0.4, 2 * pi * uv.x, 2 * pi * uv.y).n));
        }
        CHECK(worst < 0.7);
    }

    TEST_CASE("mesh_surface: flat shading uses the facet's own normal and tangents") {
        const Mesh mesh = oracle::torus_mesh(16, 8);
        const MeshSurface surface = make_mesh_surface(mesh, {.flat = true});
        const auto& corner = surface.triangles[5].corner;
        const auto p = [&](int k) { return Vec3d(mesh.positions[mesh.corner_position[corner[k]]]); };
        const Jet<double> jet = jet_at<double>(surface, 5, 0.2, 0.2);
        CHECK(angle_deg(jet.n, glm::cross(p(1) - p(0), p(2) - p(0))) < 1e-6);
        CHECK(jet.n_u == Vec3d(0));
    }
}

TEST_SUITE("stability") {

    TEST_CASE("mesh_surface: a triangle without area in uv gives a zero jet, and spoils no neighbour") {
        Mesh mesh = square();
        mesh.positions.push_back({2, 2, 1});
        mesh.uvs.push_back({1, 1});
        mesh.face_begin.push_back(9);
        for (const std::uint32_t p : {1u, 2u, 4u}) { // two corners at one place of the chart
            mesh.corner_position.push_back(p);
            mesh.corner_uv.push_back(p);
        }
        const MeshSurface surface = make_mesh_surface(mesh);
        CHECK(surface.sigma[2] == 0);
        CHECK(jet_at<double>(surface, 2, 0.3, 0.3).n == Vec3d(0));
        CHECK(glm::length(jet_at<double>(surface, 0, 0.3, 0.0).p_u - Vec3d(2, 0, 0)) < 0.2);
    }

    TEST_CASE(
        "mesh_surface: the derivatives next to a pole are the sphere's, whether its quads are squeezed there or not") {
        // One lune of a lat-long sphere: at ring 1, p_u is the mean over the squeezed triangles too.
        Mesh mesh;
        const int columns = 3, rows = 4;
        const double step = 0.02;
        for (int j = 0; j <= rows; ++j)
            for (int i = 0; i <= columns; ++i) {
                const Jet<double> s = oracle::sphere(1, step * i, step * j - pi / 2);
                mesh.positions.emplace_back(s.p);
                mesh.normals.emplace_back(s.n);
                mesh.uvs.emplace_back(step * i, step * j);
            }
        for (int j = 0; j < rows; ++j)
            for (int i = 0; i < columns; ++i) {
                const auto at = [&](int a, int b) { return std::uint32_t((j + b) * (columns + 1) + i + a); };
                for (const std::uint32_t corner : {at(0, 0), at(1, 0), at(1, 1), at(0, 1)})
                    mesh.corner_position.push_back(corner);
                mesh.face_begin.push_back(std::uint32_t(mesh.corner_position.size()));
            }
        mesh.corner_normal = mesh.corner_uv = mesh.corner_position;
        const MeshSurface surface = make_mesh_surface(mesh);
        for (std::size_t corner = 0; corner < mesh.corners(); ++corner) {
            const std::uint32_t p = mesh.corner_position[corner];
            if (p / (columns + 1) != 1 || p % (columns + 1) == 0 || p % (columns + 1) == columns) continue;
            const Jet<double> want = oracle::sphere(1, step * (p % (columns + 1)), step - pi / 2);
            CHECK(glm::length(Vec3d(surface.p_u[corner]) - want.p_u) < 0.02 * glm::length(want.p_u));
            CHECK(glm::length(Vec3d(surface.p_v[corner]) - want.p_v) < 0.02 * glm::length(want.p_v));
        }
    }

    TEST_CASE("mesh_surface: mirrored halves that share a vertex and a uv keep their own derivatives") {
        // Two triangles on either side of the line x = 0, sharing it, folded onto the same half of the chart.
        Mesh mesh;
        mesh.face_begin = {0, 3, 6};
        mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}};
        mesh.uvs = {{0, 0}, {1, 0}, {0, 1}, {1, 0}};
        mesh.corner_position = mesh.corner_uv = {0, 1, 2, 0, 2, 3};
        const MeshSurface surface = make_mesh_surface(mesh);
        CHECK(surface.sigma[0] == 1);
        CHECK(surface.sigma[1] == -1);
        CHECK(glm::length(jet_at<double>(surface, 0, 0.2, 0.2).p_u - Vec3d(1, 0, 0)) < 1e-6);
        CHECK(glm::length(jet_at<double>(surface, 1, 0.2, 0.2).p_u - Vec3d(-1, 0, 0)) < 1e-6);
    }

    TEST_CASE("mesh_surface: quads folded over in uv face outward on either side of the fold") {
        // Without the triangle's own derivatives these gave tangent normals of (0, 0, -1), as on Spot's ears.
        int folded = 0;
        for (int i = 0; i < 12; ++i)
            for (int j = 0; j < 12; ++j) {
                Mesh mesh;
                mesh.face_begin = {0, 4};
                mesh.positions = {{0, 0, 0}, {1, 0, 0.2f}, {1, 1, 0}, {0, 1, 0.1f}};
                mesh.uvs = {{0, 0}, {1, 0}, {0.07f + 0.1f * float(i), 0.03f + 0.1f * float(j)}, {0, 1}};
                if (j % 2) mesh.uvs[3] = {0.8f, 0.1f};
                mesh.corner_position = mesh.corner_uv = {0, 1, 2, 3};
                const MeshSurface surface = make_mesh_surface(mesh);
                folded += surface.sigma[0] != surface.sigma[1];
                for (std::uint32_t t = 0; t < 2; ++t)
                    for (const auto& [b1, b2] : {std::pair(1 / 3.0, 1 / 3.0), {0.0, 0.0}, {0.9, 0.05}, {0.1, 0.85}}) {
                        const Jet<double> jet = jet_at<double>(surface, t, b1, b2);
                        CHECK(jet.sigma * glm::dot(glm::cross(jet.p_u, jet.p_v), jet.n) > 0);
                    }
            }
        CHECK(folded >= 10);
    }
}
