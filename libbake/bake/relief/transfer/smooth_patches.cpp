#include "bake/relief/transfer/smooth_patches.h"
#include "bake/mesh/facet_normal.h"
#include "bake/mesh/side_corners.h"
#include "bake/mesh/topology.h"
#include "bake/mesh/weld.h"
#include "bake/relief/transfer/hard_edges.h"
#include <algorithm>
#include <compare>

namespace bake {
namespace {

constexpr float same_normal = 0.9999f; ///< cosine, as hard_edges()
constexpr float own_normal = 0.94f;    ///< cosine of 20 degrees; a smooth edge of 50 degrees turns the normal by 25
constexpr double least_angle = 0.01;   ///< radians, of an edge that can be seen
constexpr double most_angle = pi * 150 / 180;

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

/// Those that part the faces: of the hard edges those whose sides have normals of their own. In a mesh that has none of these, which
/// is shaded smooth all over, all hard edges.
struct PartingEdges {
    std::vector<std::uint8_t> parts; ///< per edge
    bool smooth = false;             ///< whether the mesh is shaded smooth all over
};
PartingEdges parting_edges(const MeshSurface& surface, const std::vector<std::uint32_t>& vertex,
                           const HalfEdges& half_edges, const EdgeTable& table) {
    const auto ends = side_corners(*surface.mesh, vertex, half_edges);
    std::vector<Pair> hard;
    for (const auto& [a, b] : hard_edges(*surface.mesh, surface.triangles, surface.n).ends)
        hard.push_back(ordered(a, b));
    std::sort(hard.begin(), hard.end());
    std::vector<std::uint8_t> is_hard(table.edges()), is_split(table.edges());
    for (std::uint32_t e = 0; e < table.edges(); ++e) {
        const auto sides = table.of(e);
        if (sides.size() != 2) continue;
        const std::uint32_t h = sides[0], m = sides[1];
        is_hard[e] = std::binary_search(hard.begin(), hard.end(), ordered(half_edges.origin[h], half_edges.target(h)));
        const bool opposite = half_edges.origin[h] != half_edges.origin[m];
        const auto differ = [&](bool end) {
            return glm::dot(surface.n[ends[h][end]], surface.n[ends[m][end != opposite]]) < same_normal;
        };
        is_split[e] = is_hard[e] && (differ(false) || differ(true));
    }
    if (std::find(is_split.begin(), is_split.end(), 1) != is_split.end()) return {is_split, false};
    return {is_hard, true};
}

} // namespace

SmoothPatches::SmoothPatches(const MeshSurface& surface) {
    const Mesh& mesh = *surface.mesh;
    const std::vector<std::uint32_t> vertex = first_equal(mesh.positions);
    const HalfEdges half_edges = make_half_edges(mesh, vertex);
    const EdgeTable table = make_edges(half_edges);
    const PartingEdges hard = parting_edges(surface, vertex, half_edges, table);
    DisjointSets sets(mesh.faces());
    std::vector<std::uint32_t> parting; // edges
    for (std::uint32_t e = 0; e < table.edges(); ++e) {
        const auto sides = table.of(e);
        if (hard.parts[e]) parting.push_back(e);
        else
            for (const std::uint32_t side : sides) sets.join(half_edges.face[sides[0]], half_edges.face[side]);
    }
    const DisjointSets::Numbers numbers = sets.numbers();
    patch_ = numbers.set;
    normals_.assign(surface.n.begin(), surface.n.end());
    if (hard.smooth) set_normals(surface, vertex);
    const std::vector<Facet> facets = facets_of(mesh, surface.triangles);
    std::vector<Pair> pairs;
    for (const std::uint32_t e : parting) {
        const auto sides = table.of(e);
        const std::uint32_t f = half_edges.face[sides[0]], g = half_edges.face[sides[1]];
        const Vec3d &n = facets[f].n, &m = facets[g].n;
        const double angle = std::atan2(glm::length(glm::cross(n, m)), glm::dot(n, m));
        if (angle < least_angle || n == Vec3d(0) || m == Vec3d(0)) continue;
        if (patch_[f] == patch_[g] || angle > most_angle) {
            ++kept_;
            continue;
        }
        const Vec3d middle = 0.5 * (Vec3d(mesh.positions[half_edges.origin[sides[0]]]) +
                                    Vec3d(mesh.positions[half_edges.target(sides[0])]));
        const bool convex = glm::dot(facets[g].middle - middle, n) + glm::dot(facets[f].middle - middle, m) <= 0;
        edges_.push_back({{half_edges.origin[sides[0]], half_edges.target(sides[0])}, convex, angle});
        pairs.push_back({patch_[f], patch_[g]}), pairs.push_back({patch_[g], patch_[f]});
    }
    set_neighbours(numbers.sets, std::move(pairs));
}

/// Where several patches meet, the corners of each have its mean, unless what they have is near that.
void SmoothPatches::set_normals(const MeshSurface& surface, const std::vector<std::uint32_t>& vertex) {
    const Mesh& mesh = *surface.mesh;
    struct Corner {
        std::uint32_t vertex, patch, corner;
        auto operator<=>(const Corner&) const = default;
    };
    std::vector<Corner> corners(mesh.corners());
    std::vector<Vec3d> weighted(mesh.corners(), Vec3d(0));
    for (std::size_t f = 0; f < mesh.faces(); ++f)
        for (std::uint32_t c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c)
            corners[c] = {vertex[mesh.corner_position[c]], patch_[f], c};
    for (const Triangle& t : surface.triangles)
        for (std::uint32_t k = 0; k < 3; ++k) weighted[t.corner[k]] += angle_weighted_normal(mesh, t, k);
    std::sort(corners.begin(), corners.end());
    for (std::size_t begin = 0, end = 0; begin < corners.size(); begin = end) {
        Vec3d sum(0);
        for (; end < corners.size() && corners[end].vertex == corners[begin].vertex &&
               corners[end].patch == corners[begin].patch;
             ++end)
            sum += weighted[corners[end].corner];
        const Vec3f mean(unit_or_zero(sum));
        const auto is_there = [&](std::size_t i) {
            return i < corners.size() && corners[i].vertex == corners[begin].vertex;
        };
        const bool alone = !(begin > 0 && is_there(begin - 1)) && !is_there(end);
        for (std::size_t i = begin; i < end && !alone && mean != Vec3f(0); ++i)
            if (Vec3f& n = normals_[corners[i].corner]; glm::dot(n, mean) < own_normal) n = mean;
    }
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
