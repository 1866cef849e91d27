#include "bake/relief/transfer/high_surface.h"
#include "bake/base/error.h"
#include "bake/mesh/origin.h"
#include "bake/surface/chart/mesh_surface.h"
#include <algorithm>
#include <glm/common.hpp>

namespace bake {
namespace {

/// A fast tree takes about two microseconds per triangle more to build, and saves a third of a microsecond per ray.
constexpr double rays_per_triangle = 6;

BvhMesh bvh_mesh(const Mesh& mesh, const std::vector<Triangle>& triangles) {
    BvhMesh out;
    out.positions.reserve(mesh.positions.size() + 1); // and the one that the Bvh pads them with
    out.positions = mesh.positions;
    out.triangles.resize(triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) out.triangles[t][k] = mesh.corner_position[triangles[t].corner[k]];
    return out;
}

} // namespace

std::vector<HighSurface::Part> HighSurface::parts_of(std::vector<HighMesh> meshes, const Vec3d& origin,
                                                     HighNormals normals, std::uint32_t& number) {
    std::vector<Part> parts;
    for (HighMesh& high : meshes) {
        if (high.mesh.faces() == 0)
            throw Error(Refusal::unsuitable, high.name + ": has no faces; a high-poly mesh needs some");
        move_origin(high.mesh, origin);
        Part part;
        part.triangles = triangulate(high.mesh);
        if (normals != HighNormals::facet) part.normals = corner_normals(high.mesh, part.triangles);
        if (normals == HighNormals::curved) part.edges = edge_normals(high.mesh, part.triangles, part.normals);
        part.first_number = number;
        number += std::uint32_t(high.mesh.materials.size()) + 1;
        part.high = std::move(high);
        parts.push_back(std::move(part));
    }
    return parts;
}

Bvh HighSurface::tree_of(const std::vector<Part>& parts, double rays) {
    std::vector<BvhMesh> meshes;
    double triangles = 0;
    for (const Part& part : parts) {
        meshes.push_back(bvh_mesh(part.high.mesh, part.triangles));
        triangles += double(part.triangles.size());
    }
    return Bvh(std::move(meshes), rays > rays_per_triangle * triangles ? BvhTree::fast : BvhTree::quick, true);
}

HighSurface::HighSurface(std::vector<HighMesh> meshes, const Vec3d& origin, HighNormals normals, double rays,
                         std::uint32_t first_number)
    : next_number_(first_number), parts_(parts_of(std::move(meshes), origin, normals, next_number_)),
      bvh_(tree_of(parts_, rays)) {
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        const Bounds own = bake::bounds(parts_[i].high.mesh);
        bounds_ = i == 0 ? own : Bounds{glm::min(bounds_.min, own.min), glm::max(bounds_.max, own.max)};
    }
}

Hit HighSurface::land(const Ray& ray) const noexcept {
    std::array<Ray, packet_size> rays;
    std::array<Hit, packet_size> hits;
    rays[0] = ray;
    land(rays, 1, hits);
    return hits[0];
}

Vec3f HighSurface::corner_position(std::size_t i, std::uint32_t triangle, std::uint32_t k) const noexcept {
    const Mesh& mesh = parts_[i].high.mesh;
    return mesh.positions[mesh.corner_position[parts_[i].triangles[triangle].corner[k]]];
}

Vec3f HighSurface::corner_normal(std::size_t i, std::uint32_t triangle, std::uint32_t k) const noexcept {
    const Part& part = parts_[i];
    return part.normals.empty() ? facet_normal(i, triangle) : part.normals[part.triangles[triangle].corner[k]];
}

std::uint32_t HighSurface::part_number(const Hit& hit) const noexcept {
    const Part& part = parts_[hit.mesh];
    const std::vector<std::uint32_t>& materials = part.high.mesh.face_material;
    const std::uint32_t material = materials.empty() ? no_index : materials[part.triangles[hit.triangle].face];
    return part.first_number + (material == no_index ? 0 : material + 1);
}

Vec3f HighSurface::position(const Hit& hit) const noexcept {
    const auto at = [&](std::uint32_t k) { return corner_position(hit.mesh, hit.triangle, k); };
    return (1 - hit.b1 - hit.b2) * at(0) + hit.b1 * at(1) + hit.b2 * at(2);
}

Vec3f HighSurface::facet_normal(std::size_t i, std::uint32_t triangle) const noexcept {
    const Vec3d p0(corner_position(i, triangle, 0));
    const Vec3d e1 = Vec3d(corner_position(i, triangle, 1)) - p0, e2 = Vec3d(corner_position(i, triangle, 2)) - p0;
    return Vec3f(unit_or_zero(glm::cross(e1, e2)));
}

void HighSurface::normals(std::span<const Hit, packet_size> hits, std::size_t count, Lanes3& out) const noexcept {
    Lanes3 corner[3];
    Lanes b1, b2;
    bool linear = true;
    for (std::size_t i = 0; i < count; ++i) {
        b1[i] = hits[i].b1, b2[i] = hits[i].b2;
        if (!hits[i]) {
            for (Lanes3& n : corner) n.set(i, {0, 0, 1});
            continue;
        }
        const Part& part = parts_[hits[i].mesh];
        linear = linear && !part.normals.empty() && part.edges.empty();
        if (!linear) break;
        for (std::size_t k = 0; k < 3; ++k) corner[k].set(i, part.normals[part.triangles[hits[i].triangle].corner[k]]);
    }
    if (linear) {
        for (std::size_t i = 0; i < count; ++i)
            out.set(i, (1 - b1[i] - b2[i]) * corner[0][i] + b1[i] * corner[1][i] + b2[i] * corner[2][i]);
        if (!make_unit(out, count)) return;
    }
    for (std::size_t i = 0; i < count; ++i)
        if (hits[i]) out.set(i, normal(hits[i]));
}

Vec3f HighSurface::normal(const Hit& hit) const noexcept {
    const Part& part = parts_[hit.mesh];
    if (part.normals.empty()) return facet_normal(hit.mesh, hit.triangle);
    const auto& corner = part.triangles[hit.triangle].corner;
    const std::array<Vec3f, 3> n{part.normals[corner[0]], part.normals[corner[1]], part.normals[corner[2]]};
    const Vec3f out = part.edges.empty() ? unit_or_zero((1 - hit.b1 - hit.b2) * n[0] + hit.b1 * n[1] + hit.b2 * n[2])
                                         : curved_normal(n, part.edges[hit.triangle], hit.b1, hit.b2);
    return out == Vec3f(0) ? facet_normal(hit.mesh, hit.triangle) : out;
}

} // namespace bake
