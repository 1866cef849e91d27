// Contours of placed meshes, against those of meshes whose points are where the placement puts them.
#include "bake/verdict/plan/contour_edges.h"
#include "preview/little_scenes.h"
#include <doctest/doctest.h>

using namespace bake;
using namespace bake::test;

namespace {

constexpr int picture_size = 100;

struct Contour {
    std::vector<ContourEdge> edges;
    std::vector<Vec3d> from, to; ///< in the scene's own coordinates
};

Contour contour_of(Mesh mesh, const Placement& placement, const Camera& camera) {
    Scene scene = one_mesh(std::move(mesh), Material{}, true);
    scene.instances.clear();
    add_instance(scene, *scene.shapes[0], *scene.materials[0], placement);
    build(scene);
    Contour out{contour_edges(scene, 0, PictureView(scene, camera, picture_size, picture_size)), {}, {}};
    const Instance& placed = scene.instances[0];
    const MeshSurface& surface = placed.shape->surface;
    for (const ContourEdge& edge : out.edges) {
        const auto at = [&](int k) {
            const std::uint32_t corner = surface.triangles[edge.triangle].corner[std::size_t(k % 3)];
            return Vec3d(placed.linear * surface.mesh->positions[surface.mesh->corner_position[corner]]) +
                   Vec3d(placed.translate);
        };
        out.from.push_back(at(edge.from)), out.to.push_back(at(edge.from + 1));
    }
    return out;
}

/// Without the seam of sphere_mesh(), whose two sides differ by rounding.
Mesh closed_sphere(int columns, int rows) {
    Mesh mesh = sphere_mesh(columns, rows);
    const auto across = std::size_t(columns) + 1;
    for (std::size_t row = 0; row < mesh.positions.size(); row += across)
        mesh.positions[row + across - 1] = mesh.positions[row];
    return mesh;
}

Camera camera_at(const Vec3f& position) {
    Camera camera;
    camera.position = position, camera.target = Vec3f(0);
    return camera;
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("contour_edges: of a placed mesh they are those of a mesh that has its points there") {
        const Placement placement{
            .translate = Vec3f(0.3f, -0.2f, 0.5f), .rotate_deg = Vec3f(20, -35, 50), .scale = Vec3f(0.4f, 1.7f, 1)};
        const Mesh sphere = closed_sphere(24, 12);
        Scene scene = one_mesh(sphere, Material{});
        scene.instances.clear();
        const Instance placed = [&] {
            add_instance(scene, *scene.shapes[0], *scene.materials[0], placement);
            return scene.instances[0];
        }();
        Mesh moved = sphere;
        for (Vec3f& p : moved.positions) p = placed.linear * p + placed.translate;
        for (const Vec3f& from : {Vec3f(0, 1, 5), Vec3f(-4, 2, 1), Vec3f(1, -6, 0.5f)}) {
            const Contour a = contour_of(sphere, placement, camera_at(from)),
                          b = contour_of(moved, {}, camera_at(from));
            REQUIRE(a.edges.size() == b.edges.size());
            CHECK(a.edges.size() > 12);
            for (std::size_t i = 0; i < a.edges.size(); ++i) {
                CHECK(a.edges[i].triangle == b.edges[i].triangle);
                CHECK(a.edges[i].from == b.edges[i].from);
            }
        }
    }

    TEST_CASE("contour_edges: of an ellipsoid they lie near its outline") {
        // The points with n . (eye - p) = 0 are those with (p / s^2) . eye = 1.
        const Vec3d scale(0.5, 1.5, 1), eye(3, 2, 4);
        const Contour contour = contour_of(closed_sphere(64, 32), {.scale = Vec3f(scale)}, camera_at(Vec3f(eye)));
        CHECK(contour.edges.size() >= 64);
        for (std::size_t i = 0; i < contour.from.size(); ++i)
            for (const Vec3d& p : {contour.from[i], contour.to[i]}) {
                // Of unit length in the coordinates of the sphere; edges are 0.1 long.
                const Vec3d on_sphere = p / scale, towards = eye / scale;
                CHECK(glm::length(on_sphere) == doctest::Approx(1).epsilon(1e-5));
                CHECK(std::abs(glm::dot(on_sphere, towards) - 1) < 0.15 * glm::length(towards));
            }
    }

    TEST_CASE("contour_edges: the border of an open mesh, and nothing behind the camera") {
        const Contour square = contour_of(plane_mesh(4), {}, camera_at(Vec3f(0, 0, 4)));
        CHECK(square.edges.size() == 4 * 4);
        for (std::size_t i = 0; i < square.from.size(); ++i) {
            const Vec3d middle = 0.5 * (square.from[i] + square.to[i]);
            CHECK(std::max(std::abs(middle.x), std::abs(middle.y)) == 1);
        }
        Camera away = camera_at(Vec3f(0, 0, 4));
        away.target = Vec3f(0, 0, 8);
        CHECK(contour_of(plane_mesh(4), {}, away).edges.empty());
    }
}
