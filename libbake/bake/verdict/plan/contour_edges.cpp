#include "bake/verdict/plan/contour_edges.h"
#include "bake/base/parallel.h"
#include "bake/mesh/topology.h"
#include "bake/mesh/weld.h"

namespace bake {
namespace {

/// The triangle of a face that has the side from corner h to corner `next`.
ContourEdge edge_at(const MeshSurface& surface, std::uint32_t face, std::uint32_t h, std::uint32_t next) noexcept {
    // A face of n corners has n - 2 triangles.
    const std::uint32_t begin = surface.mesh->face_begin[face], end = surface.mesh->face_begin[face + 1];
    for (std::uint32_t t = begin - 2 * face; t < end - 2 * (face + 1); ++t)
        for (int k = 0; k < 3; ++k)
            if (surface.triangles[t].corner[std::size_t(k)] == h &&
                surface.triangles[t].corner[std::size_t((k + 1) % 3)] == next)
                return {t, k};
    return {begin - 2 * face, 0};
}

} // namespace

std::vector<ContourEdge> contour_edges(const Scene& scene, std::uint32_t instance, const PictureView& view) {
    const Instance& placed = scene.instances[instance];
    const MeshSurface& surface = placed.shape->surface;
    const Mesh& mesh = *surface.mesh;
    std::vector<Vec3d> world(mesh.positions.size());
    const glm::dmat3 linear(placed.linear);
    const Vec3d translate = Vec3d(placed.translate) - Vec3d(scene.origin);
    for (std::size_t i = 0; i < world.size(); ++i) world[i] = linear * Vec3d(mesh.positions[i]) + translate;
    const auto corner = [&](std::uint32_t c) { return world[mesh.corner_position[c]]; };

    std::vector<std::int8_t> side(mesh.faces(), 0);
    for_rows(std::int64_t(mesh.faces()), 4096, [&](std::int64_t first, std::int64_t last) {
        for (auto f = std::size_t(first); f < std::size_t(last); ++f) {
            const std::uint32_t begin = mesh.face_begin[f], end = mesh.face_begin[f + 1];
            Vec3d area(0);
            for (std::uint32_t c = begin + 1; c + 1 < end; ++c)
                area += glm::cross(corner(c) - corner(begin), corner(c + 1) - corner(begin));
            const double facing = end > begin ? glm::dot(area, view.towards(corner(begin))) : 0;
            side[f] = facing > 0 ? 1 : facing < 0 ? -1 : 0;
        }
    });

    const HalfEdges half_edges = make_half_edges(mesh, first_equal(mesh.positions));
    const EdgeTable edges = make_edges(half_edges);
    std::vector<ContourEdge> found;
    for (std::uint32_t e = 0; e < edges.edges(); ++e) {
        const auto sides = edges.of(e);
        const std::uint32_t h = sides.front(), face = half_edges.face[h];
        // Faces seen edge on are on both sides of a contour.
        bool inner = sides.size() == 2 && side[face] != 0;
        // Two half-edges of one direction: the faces have opposite orientations.
        if (inner) {
            const std::uint32_t mate = sides.back();
            const int turn = half_edges.origin[mate] == half_edges.origin[h] ? -1 : 1;
            inner = side[half_edges.face[mate]] * turn == side[face];
        }
        if (inner) continue;
        const std::uint32_t next = half_edges.next(h);
        if (view.before(corner(h)) && view.before(corner(next))) found.push_back(edge_at(surface, face, h, next));
    }
    return found;
}

} // namespace bake
