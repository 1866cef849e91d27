// Whether a displaced mesh has cracks: its border beside what the base's border becomes at the rates it was cut with.
#pragma once
#include "bake/base/error.h"
#include "bake/mesh/weld.h"
#include "bake/relief/displace/rates.h"
#include "relief/displace/displace_meshes.h"

namespace bake::test {

/// Edges of one face alone, and the points at their ends. A crack makes edges of the border; a T-junction makes its
/// point one of the border.
struct Border {
    std::size_t edges = 0, points = 0;
};

/// By the mesh's indices.
inline Border border_of(const Mesh& mesh) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
    edges.reserve(mesh.corners());
    for (std::size_t f = 0; f < mesh.faces(); ++f)
        for (std::uint32_t c = mesh.face_begin[f], last = mesh.face_begin[f + 1] - 1; c <= last; ++c)
            edges.push_back(
                std::minmax(mesh.corner_position[c], mesh.corner_position[c < last ? c + 1 : mesh.face_begin[f]]));
    std::sort(edges.begin(), edges.end());
    Border border;
    std::vector<bool> on_border(mesh.positions.size());
    for (std::size_t i = 0, end; i < edges.size(); i = end) {
        for (end = i; end < edges.size() && edges[end] == edges[i];) ++end;
        if (end > i + 1 || edges[i].first == edges[i].second) continue;
        ++border.edges;
        on_border[edges[i].first] = on_border[edges[i].second] = true;
    }
    border.points = std::size_t(std::count(on_border.begin(), on_border.end(), true));
    return border;
}

/// That of the base, cut at these rates.
inline Border border_of(const RatePlan& plan) {
    const PatchCells& cells = plan.cells;
    const PatchComplex& complex = cells.complex();
    std::vector<int> uses(complex.edges);
    std::vector<bool> on_border(complex.vertices);
    for (const PatchComplex::Patch& patch : complex.patches)
        for (int i = 0; i < patch.sides() && !is_collapsed(patch); ++i) uses[patch.edge[i]] += !is_point(patch, i);
    Border border;
    for (const PatchComplex::Patch& patch : complex.patches)
        for (int i = 0; i < patch.sides() && !is_collapsed(patch); ++i) {
            if (uses[patch.edge[i]] != 1 || is_point(patch, i)) continue;
            border.edges += plan.rates.of_edge(patch.edge[i]);
            border.points += plan.rates.of_edge(patch.edge[i]) - 1;
            on_border[patch.vertex[i]] = on_border[patch.vertex[(i + 1) % patch.sides()]] = true;
        }
    border.points += std::size_t(std::count(on_border.begin(), on_border.end(), true));
    return border;
}

/// Segments no longer than a size that grows by 8 across the object: neighbours differ everywhere.
inline Rates mixed_rates(const Mesh& mesh, double faces) {
    const Bounds box = bounds(mesh);
    const Vec3d low(box.min), extent = glm::max(Vec3d(box.max - box.min), Vec3d(1e-9));
    Rates rates;
    rates.rule = Rates::Rule::edge_size;
    rates.most = 16;
    rates.size = 8 * diagonal(box) / std::sqrt(faces);
    rates.measure = [=](const Vec3d& a, const Vec3d& b) {
        const Vec3d place = ((a + b) / 2.0 - low) / extent;
        return glm::length(b - a) * (1 + 7 * std::clamp((place.x + place.y + place.z) / 3, 0.0, 1.0));
    };
    return rates;
}

/// What is wrong with a displaced mesh.
struct Cracks {
    long long border_edges = 0; ///< more than the base's border has, cut at the rates
    long long t_junctions = 0;  ///< points of the border, likewise
    long long parted = 0;       ///< edges of the border that are none once bit-equal points are one
    bool any() const noexcept { return border_edges != 0 || t_junctions != 0 || parted != 0; }
};

inline Cracks cracks_of(const Mesh& mesh, const RatePlan& plan) {
    const Border planned = border_of(plan), found = border_of(mesh);
    Mesh welded = mesh;
    weld_positions(welded);
    const auto more = [](std::size_t a, std::size_t b) {
        return static_cast<long long>(a) - static_cast<long long>(b);
    };
    return {more(found.edges, planned.edges), more(found.points, planned.points),
            more(found.edges, border_of(welded).edges)};
}

/// Patches two of whose sides are cut differently.
inline std::size_t mixed_patches(const RatePlan& plan) {
    const PatchCells& cells = plan.cells;
    std::size_t mixed = 0;
    for (const PatchComplex::Patch& patch : cells.complex().patches) {
        bool differ = false;
        for (int i = 1; i < patch.sides(); ++i)
            differ |= plan.rates.of_edge(patch.edge[i]) != plan.rates.of_edge(patch.edge[0]);
        mixed += differ;
    }
    return mixed;
}

/// A base displaced by a noise of 5 % of its diagonal, and the rates it was cut with.
struct Noisy {
    Displaced displaced;
    RatePlan plan;
};

inline Noisy displaced_by_noise(const BaseSurface& base, const Rates& rates, Seam seam) {
    const Relief height = relief(noise(64), 0.05 * diagonal(bounds(base.mesh())));
    DisplaceOptions options;
    options.rates = rates, options.seam = seam;
    const auto plan = [&] {
        if (rates.rule == Rates::Rule::uniform) return uniform_rates(base, rates.levels);
        const SeamedRelief scene = seamed(base, height, seam); // the blend moves points, which changes rates
        return rates_by_size(scene.surface, scene.blend, rates);
    };
    return {displace(base, height, options), plan()};
}

inline Rates uniform(int levels) {
    Rates rates;
    rates.levels = levels;
    return rates;
}

/// uvs for a mesh without: its own from above.
inline void give_uvs(Mesh& mesh) {
    if (!mesh.corner_uv.empty()) return;
    const Bounds box = bounds(mesh);
    const Vec3f extent = glm::max(box.max - box.min, Vec3f(1e-9f));
    for (const Vec3f& p : mesh.positions) mesh.uvs.push_back(Vec2f((p - box.min) / extent));
    mesh.corner_uv = mesh.corner_position;
}

/// Whether the scheme takes it: Loop all triangles, Catmull-Clark others.
inline bool is_cage(const Mesh& mesh, Scheme scheme) {
    if ((mesh.corners() == 3 * mesh.faces()) != (scheme == Scheme::loop)) return false;
    try {
        check_cage(mesh, scheme, "mesh");
    } catch (const Error&) {
        return false;
    }
    return true;
}

} // namespace bake::test
