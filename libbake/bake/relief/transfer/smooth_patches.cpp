#include "bake/relief/transfer/smooth_patches.h"
#include "bake/mesh/topology.h"
#include "bake/mesh/weld.h"
#include "bake/relief/transfer/hard_edges.h"
#include <algorithm>

namespace bake {
namespace {

constexpr float own_normal = 0.94f;  ///< cosine of 20 degrees; a smooth edge of 50 degrees turns the normal by 25
constexpr double least_angle = 0.01; ///< radians, of an edge that can be seen

using Pair = std::array<std::uint32_t, 2>;
Pair ordered(std::uint32_t a, std::uint32_t b) noexcept { return {std::min(a, b), std::max(a, b)}; }

/// Per face, the unit sum over its triangles, and the mean of its corners.
struct Facet {
    Vec3d n{0}, middle{0};
};
std::vector<Facet> facets_of(const Mesh& mesh, const std::vector<Triangle>& triangles) {
    std::vector<Facet> out(mesh.faces());
    for (const Triangle& t : triangles) {
        const auto at = [&](std::size_t k) { return Vec3d(mesh.positions[mesh.corner_position[t.corner[k]]]); };
        out[t.face].n += glm::cross(at(1) - at(0), at(2) - at(0));
    }
    for (std::size_t f = 0; f < out.size(); ++f) {
        out[f].n = unit_or_zero(out[f].n);
        for (std::uint32_t c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c)
            out[f].middle +=
                Vec3d(mesh.positions[mesh.corner_position[c]]) / double(mesh.face_begin[f + 1] - mesh.face_begin[f]);
    }
    return out;
}

} // namespace

SmoothPatches::SmoothPatches(const MeshSurface& surface) {
    const Mesh& mesh = *surface.mesh;
    const std::vector<std::uint32_t> vertex = first_equal(mesh.positions);
    const HalfEdges half_edges = make_half_edges(mesh, vertex);
    const EdgeTable table = make_edges(half_edges);
    const HardEdges hard = hard_edges(mesh, surface.triangles, surface.n);
    std::vector<Pair> is_hard;
    for (const auto& [a, b] : hard.ends) is_hard.push_back(ordered(a, b));
    std::sort(is_hard.begin(), is_hard.end());
    normals_.assign(surface.n.begin(), surface.n.end());
    for (std::size_t c = 0; c < normals_.size(); ++c)
        if (glm::dot(normals_[c], hard.own[c]) < own_normal) normals_[c] = hard.own[c];

    DisjointSets sets(mesh.faces());
    std::vector<std::uint32_t> parting; // edges
    for (std::uint32_t e = 0; e < table.edges(); ++e) {
        const auto sides = table.of(e);
        if (sides.size() != 2) continue;
        const Pair ends = ordered(half_edges.origin[sides[0]], half_edges.target(sides[0]));
        if (std::binary_search(is_hard.begin(), is_hard.end(), ends)) parting.push_back(e);
        else sets.join(half_edges.face[sides[0]], half_edges.face[sides[1]]);
    }
    const DisjointSets::Numbers numbers = sets.numbers();
    patch_ = numbers.set;
    const std::vector<Facet> facets = facets_of(mesh, surface.triangles);
    std::vector<Pair> pairs;
    for (const std::uint32_t e : parting) {
        const auto sides = table.of(e);
        const std::uint32_t f = half_edges.face[sides[0]], g = half_edges.face[sides[1]];
        const Vec3d &n = facets[f].n, &m = facets[g].n;
        const double angle = std::atan2(glm::length(glm::cross(n, m)), glm::dot(n, m));
        if (angle < least_angle || n == Vec3d(0) || m == Vec3d(0)) continue;
        const Vec3d middle = 0.5 * (Vec3d(mesh.positions[half_edges.origin[sides[0]]]) +
                                    Vec3d(mesh.positions[half_edges.target(sides[0])]));
        const bool convex = glm::dot(facets[g].middle - middle, n) + glm::dot(facets[f].middle - middle, m) <= 0;
        edges_.push_back({{half_edges.origin[sides[0]], half_edges.target(sides[0])}, convex, angle});
        if (patch_[f] == patch_[g]) ++within_;
        else pairs.push_back({patch_[f], patch_[g]}), pairs.push_back({patch_[g], patch_[f]});
    }
    set_neighbours(numbers.sets, std::move(pairs));
}

void SmoothPatches::set_neighbours(std::uint32_t patches, std::vector<Pair> pairs) {
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    begin_.assign(std::size_t(patches) + 1, 0);
    for (const auto& [patch, other] : pairs) ++begin_[patch + 1], neighbours_.push_back(other);
    for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
}

bool SmoothPatches::are_near(std::uint32_t a, std::uint32_t b) const noexcept {
    if (a == b) return false;
    std::span<const std::uint32_t> few = neighbours(a), many = neighbours(b);
    if (few.size() > many.size()) std::swap(few, many), std::swap(a, b);
    const auto has = [](std::span<const std::uint32_t> list, std::uint32_t i) {
        return std::binary_search(list.begin(), list.end(), i);
    };
    return has(few, b) || std::any_of(few.begin(), few.end(), [&](std::uint32_t i) { return has(many, i); });
}

} // namespace bake
