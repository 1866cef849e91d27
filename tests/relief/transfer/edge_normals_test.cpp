#include "bake/relief/transfer/edge_normals.h"
#include "bake/surface/chart/mesh_surface.h"
#include "relief/transfer/closed_forms.h"
#include "relief/transfer/transfer_meshes.h"

using namespace bake;
using namespace bake::test;

namespace {

/// A point of a surface of two waves, and the unit normal there.
PatchPoint waves(double x, double y) {
    const double z = 0.1 * std::sin(5 * x) * std::cos(4 * y);
    return {{x, y, z},
            glm::normalize(Vec3d(-0.5 * std::cos(5 * x) * std::cos(4 * y), 0.4 * std::sin(5 * x) * std::sin(4 * y), 1)),
            {}};
}

/// Unit normal at the point of the surface that is nearest to p, a point close to it.
Vec3d normal_near(const Vec3d& p) {
    Vec2d at(p);
    for (int i = 0; i < 30; ++i) {
        const PatchPoint s = waves(at.x, at.y);
        const Vec3d aside = p - s.p - glm::dot(p - s.p, s.n) * s.n;
        at += Vec2d(aside);
    }
    return waves(at.x, at.y).n;
}

/// Largest angle in degrees between the true normals and those of a mesh of n x n quads, well inside of its border: curved, or
/// interpolated linearly.
double error_of(int n, bool curved) {
    Mesh mesh;
    add_patch(mesh, n, n, waves);
    const std::vector<Triangle> triangles = triangulate(mesh);
    const std::vector<Vec3f> normals = corner_normals(mesh, triangles);
    const std::vector<EdgeNormals> edges = edge_normals(mesh, triangles, normals);
    double most = 0;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const auto at = [&](int k) { return mesh.positions[mesh.corner_position[triangles[t].corner[k]]]; };
        for (const auto& [b1, b2] :
             {std::pair(1 / 3.f, 1 / 3.f), {0.5f, 0.f}, {0.5f, 0.5f}, {0.f, 0.5f}, {0.1f, 0.6f}}) {
            const float b0 = 1 - b1 - b2;
            const Vec3f p = b0 * at(0) + b1 * at(1) + b2 * at(2);
            if (std::min({p.x, p.y, 1 - p.x, 1 - p.y}) < 0.15f) continue;
            const auto n_of = [&](int k) { return normals[triangles[t].corner[k]]; };
            const Vec3f found = curved ? curved_normal({n_of(0), n_of(1), n_of(2)}, edges[t], b1, b2)
                                       : glm::normalize(b0 * n_of(0) + b1 * n_of(1) + b2 * n_of(2));
            most = std::max(most, oracle::angle_deg(Vec3d(found), normal_near(Vec3d(p))));
        }
    }
    return most;
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("edge_normals: a flat face beside a narrow bevel stays flat") {
        // Profile along x: flat to .9, then round over .1 to the vertical; normals are those of the round part at its ends.
        Mesh mesh;
        add_patch(mesh, 2, 4, [](double s, double t) {
            return s < 0.75 ? PatchPoint{{1.8 * s, t, 0}, {0, 0, 1}, {}} : PatchPoint{{1, t, -0.1}, {1, 0, 0}, {}};
        });
        const std::vector<Triangle> triangles = triangulate(mesh);
        const std::vector<Vec3f> normals = corner_normals(mesh, triangles);
        const std::vector<EdgeNormals> edges = edge_normals(mesh, triangles, normals);
        int flat = 0;
        for (std::size_t t = 0; t < triangles.size(); ++t)
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t a = triangles[t].corner[k], b = triangles[t].corner[(k + 1) % 3];
                if (normals[a] != Vec3f(0, 0, 1) || normals[b] != Vec3f(0, 0, 1)) continue;
                CHECK((edges[t][k] == Vec3f(0, 0, 1)));
                ++flat;
            }
        CHECK(flat > 20);
    }

    TEST_CASE("edge_normals: across a hard edge nothing is taken over") {
        // Two planes that meet at the y axis at a right angle, each with its own normals.
        Mesh mesh;
        add_patch(mesh, 2, 2, [](double s, double t) { return PatchPoint{{s - 1, t, 0}, {0, 0, 1}, {}}; });
        add_patch(mesh, 2, 2, [](double s, double t) { return PatchPoint{{0, t, -s}, {1, 0, 0}, {}}; });
        const std::vector<Triangle> triangles = triangulate(mesh);
        const std::vector<Vec3f> normals = corner_normals(mesh, triangles);
        const std::vector<EdgeNormals> edges = edge_normals(mesh, triangles, normals);
        for (std::size_t t = 0; t < triangles.size(); ++t)
            for (std::size_t k = 0; k < 3; ++k) CHECK((edges[t][k] == normals[triangles[t].corner[0]]));
    }

    TEST_CASE("edge_normals: a zero of either sign is the same") {
        const auto cylinder = [](bool signs) {
            Mesh mesh;
            add_patch(mesh, 24, 4, [](double s, double t) {
                const double a = 2 * pi * s;
                return PatchPoint{{std::cos(a), std::sin(a), t}, {std::cos(a), std::sin(a), 0}, {}};
            });
            std::vector<Vec3f> normals; // one for each corner
            for (std::size_t c = 0; c < mesh.corners(); ++c) {
                normals.push_back(mesh.normals[mesh.corner_normal[c]]);
                if (signs && c / 4 % 2 == 1) normals.back().z = -0.0f;
            }
            return edge_normals(mesh, triangulate(mesh), normals);
        };
        const std::vector<EdgeNormals> one = cylinder(false), both = cylinder(true);
        for (std::size_t t = 0; t < one.size(); ++t)
            for (std::size_t k = 0; k < 3; ++k) CHECK((one[t][k] == both[t][k]));
    }

    TEST_CASE("edge_normals: corners without a normal and triangles without area give finite normals") {
        Mesh mesh = unit_plane();
        mesh.positions[1] = mesh.positions[0];
        const std::vector<Triangle> triangles = triangulate(mesh);
        std::vector<Vec3f> normals = corner_normals(mesh, triangles);
        normals[2] = Vec3f(0);
        for (const EdgeNormals& edge : edge_normals(mesh, triangles, normals))
            for (const Vec3f& n : edge) CHECK(glm::length(n) <= 1.0001f);
        CHECK((curved_normal({Vec3f(0), Vec3f(0), Vec3f(0)}, {Vec3f(0), Vec3f(0), Vec3f(0)}, 0.2f, 0.3f) == Vec3f(0)));
    }
}

TEST_SUITE("oracle") {

    TEST_CASE(
        "edge_normals: the error of curved normals falls with the third power of the edges, and is a tenth of the "
        "linear one") {
        const double coarse = error_of(20, true), fine = error_of(40, true);
        MESSAGE("20 x 20 quads: curved " << coarse << " deg, linear " << error_of(20, false) << " deg; 40 x 40: curved "
                                         << fine << " deg, linear " << error_of(40, false) << " deg");
        CHECK(fine < coarse / 6);
        CHECK(fine < error_of(40, false) / 10);
    }
}
