// Normals of bodies of cubes against those of the bodies that the cubes stand for.
#include "bake/base/parallel.h"
#include "bake/relief/transfer/smooth_normals.h"
#include "bake/surface/chart/mesh_surface.h"
#include "relief/transfer/transfer_meshes.h"
#include "relief/transfer/voxel_meshes.h"

using namespace bake;
using namespace bake::test;

namespace {

const Vec3d sphere_middle(20.3, 20.1, 19.8), torus_middle(36.3, 36.1, 12.8);
Mesh voxel_sphere(double radius = 16) {
    return voxel_mesh(40, [=](const Vec3d& p) { return glm::length(p - sphere_middle) < radius; });
}
Vec3d from_ring(const Vec3d& p) {
    const Vec3d d = p - torus_middle;
    return d - 24.0 * glm::normalize(Vec3d(d.x, d.y, 0));
}
Vec3d on_sphere(const Vec3d& p) { return glm::normalize(p - sphere_middle); }
Vec3d on_torus(const Vec3d& p) { return glm::normalize(from_ring(p)); }

/// Of the corners' normals, the mean over each face, at the middle of the face.
template <class Exact> oracle::Spread error(const Mesh& mesh, const Exact& exact) {
    const std::vector<Vec3f> normals = corner_normals(mesh, triangulate(mesh));
    std::vector<double> angles;
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
        Vec3d middle(0), n(0);
        for (std::uint32_t c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c)
            middle += 0.25 * Vec3d(mesh.positions[mesh.corner_position[c]]), n += Vec3d(normals[c]);
        angles.push_back(oracle::angle_deg(n, exact(middle)));
    }
    return oracle::spread(angles);
}
template <class Exact> oracle::Spread smoothed_error(Mesh mesh, double length, const Exact& exact) {
    smooth_normals(mesh, length);
    return error(mesh, exact);
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("smooth_normals: a sphere and a torus of cubes have the normals of the sphere and the torus") {
        const Mesh sphere = voxel_sphere(),
                   torus = voxel_mesh(74, [](const Vec3d&p) { return glm::length(from_ring(p)) < 10; });
        CHECK(error(sphere, on_sphere).mean > 8); // the mean of the facets around a corner
        const oracle::Spread s2 = smoothed_error(sphere, 2, on_sphere), s3 = smoothed_error(sphere, 3, on_sphere),
                             t2 = smoothed_error(torus, 2, on_torus), t3 = smoothed_error(torus, 3, on_torus);
        CHECK(s2.mean < 0.9);
        CHECK(s2.p95 < 2.3);
        CHECK(s3.mean < 0.45);
        CHECK(s3.p95 < 1.1);
        // The curvature of the tube changes over the length, which bends the mean.
        CHECK(t2.mean < 1.1);
        CHECK(t2.p95 < 2.6);
        CHECK(t3.mean < 1);
    }

    TEST_CASE("smooth_normals: a thin shell of cubes keeps the normals of its two sides") {
        const Mesh shell = voxel_mesh(40, [](const Vec3d& p) {
            const double r = glm::length(p - sphere_middle);
            return r < 16 && r > 13;
        });
        const oracle::Spread spread = smoothed_error(shell, 3, [](const Vec3d& p) {
            return (glm::length(p - sphere_middle) > 14.5 ? 1.0 : -1.0) * on_sphere(p);
        });
        CHECK(spread.mean < 0.45);
        CHECK(spread.max < 1.5);
    }

} // TEST_SUITE

TEST_SUITE("unit") {

    TEST_CASE("smooth_normals: sampled finely, whether the facets are or not") {
        // A box of one facet per side: far from the edges the normals of a corner are the mean of the three sides.
        Mesh box = sharp_box();
        smooth_normals(box, 0.1);
        for (std::size_t c = 0; c < box.corners(); ++c) {
            const Vec3f p = box.positions[box.corner_position[c]], n = box.normals[box.corner_normal[c]];
            CHECK(glm::length(n - glm::normalize(p)) < 0.02f);
        }
    }

    TEST_CASE("smooth_normals: another piece of the mesh does not count; a sum of zero leaves no normal") {
        Mesh planes = unit_plane(0, 8);
        const Mesh above = turned_over(unit_plane(0.01, 8));
        const auto first = std::uint32_t(planes.positions.size());
        planes.positions.insert(planes.positions.end(), above.positions.begin(), above.positions.end());
        for (const std::uint32_t p : above.corner_position) planes.corner_position.push_back(first + p);
        for (std::size_t f = 0; f < above.faces(); ++f) planes.face_begin.push_back(planes.face_begin.back() + 4);
        planes.corner_normal.clear(), planes.corner_uv.clear(), planes.normals.clear();
        smooth_normals(planes, 0.2);
        for (std::size_t v = 0; v < planes.normals.size(); ++v)
            CHECK(glm::length(planes.normals[v] - Vec3f(0, 0, v < first ? 1 : -1)) < 1e-6f);
        // Both sides of one square, split along different diagonals, so that rounding leaves something.
        Mesh leaf;
        leaf.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
        leaf.corner_position = {0, 1, 2, 3, 3, 2, 1, 0};
        leaf.face_begin = {0, 4, 8};
        smooth_normals(leaf, 0.2);
        for (const std::uint32_t normal : leaf.corner_normal) CHECK(normal == no_index);
    }

    TEST_CASE("smooth_normals: neither the number of threads nor an extreme length breaks anything") {
        std::vector<std::vector<Vec3f>> all;
        for (const int threads : {1, 2, 7}) {
            const ThreadLimit limit(threads);
            Mesh mesh = voxel_sphere(6);
            smooth_normals(mesh, 2.5);
            all.push_back(mesh.normals);
        }
        CHECK((all[0] == all[1]));
        CHECK((all[0] == all[2]));
        for (const double length : {1e-12, 1e-3, 1e3, 1e12}) {
            Mesh mesh = voxel_sphere(3);
            smooth_normals(mesh, length);
            for (const Vec3f& n : mesh.normals) CHECK((n == Vec3f(0) || std::abs(glm::length(n) - 1) < 1e-5f));
        }
        Mesh none;
        smooth_normals(none, 1);
        CHECK(none.normals.empty());
    }

} // TEST_SUITE
