#include "bake/relief/displace/memory.h"
#include "bake/base/error.h"
#include "bake/base/memory.h"
#include "bake/base/parallel.h"
#include "bake/base/text.h"
#include "bake/relief/displace/points.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

template <class... T> std::uint64_t bytes_of(const std::vector<T>&... vectors) noexcept {
    return (std::uint64_t(0) + ... + std::uint64_t(vectors.size() * sizeof(T)));
}

std::uint64_t bytes_of(const JunctionTable& t) noexcept { return bytes_of(t.junctions, t.sides, t.of); }

/// The result, as arrays of a mesh.
std::uint64_t result_bytes(const DisplaceCount& c, const Mesh& base, bool margin) noexcept {
    const std::uint64_t index = sizeof(std::uint32_t);
    const std::uint64_t per_corner = (c.uvs > 0 ? 3 : 2) * index;
    const std::uint64_t per_face = index * (1 + !base.face_material.empty() + !base.face_group.empty());
    return c.points * (sizeof(Vec3f) + (margin ? sizeof(float) : 0)) + c.normals * sizeof(Vec3f) +
           c.uvs * sizeof(Vec2f) + c.faces * per_face + c.corners * per_corner;
}

/// Cells that are not the patches of the base, and the tables of the layout.
std::uint64_t plan_bytes(const Plan& plan) noexcept {
    const PatchCells& cells = plan.rates.cells;
    const CellRates& rates = plan.rates.rates;
    const PatchLayout& l = plan.layout;
    std::uint64_t bytes = bytes_of(rates.edge) + bytes_of(rates.across) + bytes_of(rates.up) +
                          bytes_of(l.edge_owner, l.vertex_owner) +
                          bytes_of(l.edge_first, l.inner_first, l.face_first, l.corner_first) +
                          bytes_of(l.edge_normals, l.edge_uvs) + bytes_of(l.vertex_normals, l.vertex_uvs);
    if (cells.split() > 1)
        bytes += bytes_of(cells.complex().patches) + bytes_of(cells.junctions().edges) +
                 bytes_of(cells.junctions().vertices) + cells.complex().edges / 4;
    return bytes;
}

/// Buffers of the threads for the vertices of one job.
std::uint64_t thread_bytes() noexcept {
    constexpr std::uint64_t points = 8192;
    return std::uint64_t(thread_count()) * points *
           (sizeof(Vec2d) + sizeof(std::uint32_t) + sizeof(SurfacePoint) + sizeof(ReliefValue));
}

} // namespace

DisplaceMemory::DisplaceMemory(const BaseSurface& base, const Relief& relief, const DisplaceOptions& options)
    : base_(&base), relief_(&relief), options_(&options), limit_(memory_limit()) {
    if (options.max_bytes > 0 && options.max_bytes < limit_.bytes) limit_ = {options.max_bytes, "`max_bytes`"};
}

std::uint64_t DisplaceMemory::during_displacement(const Plan& plan, const SeamBlend* blend,
                                                  std::uint64_t result) const {
    const auto jobs = plan.layout.points / 4096 + plan.layout.cells->junctions().vertices.junctions.size() / 256 +
                      plan.layout.cells->junctions().edges.junctions.size() / 16;
    return sampler_memory(*relief_).kept + (blend ? blend->bytes() : 0) + plan_bytes(plan) + result + thread_bytes() +
           jobs * sizeof(PointTally);
}

std::uint64_t DisplaceMemory::during_measurement(const Plan& plan) const {
    const PatchLayout& l = plan.layout;
    std::uint64_t most = 0; // points of a cell
    for (std::uint32_t c = 0; c < l.cells->count(); ++c) {
        const PatchRates r = l.of_cell(c);
        most = std::max(most, std::uint64_t(inner_points(r)) + r.side[0] + r.side[1] + r.side[2] + r.side[3]);
    }
    const std::uint64_t per_point = 2 * sizeof(Vec2d) + sizeof(Vec3d);
    return l.cells->count() * sizeof(CellError) +
           std::min<std::uint64_t>(thread_count(), l.cells->count()) * most * per_point + thread_bytes();
}

DisplaceCount DisplaceMemory::count(const Plan& plan, const SeamBlend* blend, std::size_t without) const {
    const PatchLayout& l = plan.layout;
    DisplaceCount count{l.points, l.normals, l.uvs, l.faces, l.corners};
    const std::uint64_t result = result_bytes(count, base_->mesh(), options_->margin);
    std::uint64_t most = std::max(during_displacement(plan, blend, result), sampler_memory(*relief_).most);
    if (options_->measure_error) most = std::max(most, during_displacement(plan, blend, 0) + during_measurement(plan));
    for (std::size_t i = 0; i < options_->later.size(); ++i)
        if (i != without) most = std::max(most, result + options_->later[i].bytes(count));
    if (options_->rates.rule == Rates::Rule::error) most = std::max(most, search_bytes(plan.rates.searched));
    count.bytes = options_->taken + most;
    return count;
}

std::uint64_t DisplaceMemory::least_bytes(double triangles) const noexcept {
    // Of quads: a point, a normal, a uv and a face to two triangles, and four corners.
    const double index = sizeof(std::uint32_t);
    const double per_quad = 2 * sizeof(Vec3f) + sizeof(Vec2f) + index + 4 * 3 * index;
    return options_->taken + std::uint64_t(std::min(triangles / 2 * per_quad, 1e18));
}

std::uint64_t DisplaceMemory::search_bytes(std::uint32_t split) const noexcept {
    // A cell is a patch, with two edges and a vertex, their junctions, and what the search knows of each.
    const std::uint64_t index = sizeof(std::uint32_t);
    const std::uint64_t per_cell = sizeof(PatchComplex::Patch) + 2 * (2 * index + sizeof(std::uint16_t)) + 2 * index +
                                   2 * sizeof(std::uint16_t) + sizeof(float) + sizeof(Vec2f) + 4;
    const auto patches = std::uint64_t(base_->complex().patches.size());
    // The search compares two numbers of cells.
    const std::uint64_t cells = std::uint64_t(split) * split + (split / 2) * (split / 2);
    return patches * cells * per_cell + sampler_memory(*relief_).kept + thread_bytes();
}

namespace {

/// What the user may change: the finest level that fits, a step that may be left out.
std::string what_would_fit(const DisplaceMemory& memory, const Plan& plan, const SeamBlend* blend) {
    const DisplaceOptions& options = memory.options();
    const auto fits = [&](const DisplaceCount& c) { return c.bytes <= memory.limit() && within_indices(c); };
    const bool indices = plan.layout.points < no_index && plan.layout.corners < no_index;
    std::string mend = indices ? memory.advice() : "split the mesh";
    for (std::size_t i = 0; i < options.later.size(); ++i)
        if (!options.later[i].option.empty() && fits(memory.count(plan, blend, i)))
            mend += ", or leave out `" + options.later[i].option + "`";
    if (options.rates.rule == Rates::Rule::error) return mend + ", or set a larger `rates.error`";
    if (options.rates.rule == Rates::Rule::edge_size) return mend + ", or set a larger `rates.size`";
    int level = options.rates.levels;
    while (--level >= 0)
        if (fits(memory.count(Plan(memory.base(), uniform_rates(memory.base(), level)), blend))) break;
    if (level < 0)
        return mend + ", or take a coarser mesh" + (options.rates.levels > 0 ? ": not even level 0 fits" : "");
    return mend + ", or set `rates.levels` to " + std::to_string(level);
}

} // namespace

void refuse_large_height(const DisplaceMemory& memory) {
    const std::uint64_t own = sampler_memory(memory.relief()).most, bytes = memory.options().taken + own;
    if (bytes <= memory.limit() || own < memory.options().taken) return;
    const Image<float>& height = memory.relief().values;
    throw Error(Refusal::unsuitable, "to interpolate a height of " + std::to_string(height.width()) + " x " +
                                         std::to_string(height.height()) + " texels needs " +
                                         in_binary_units(bytes, true) + " of memory, more than " +
                                         memory.described_limit() + "; scale the height down, or " + memory.advice());
}

DisplaceCount refuse_too_large(const DisplaceMemory& memory, const Plan& plan, const SeamBlend* blend) {
    const DisplaceCount count = memory.count(plan, blend);
    if (count.bytes <= memory.limit() && within_indices(count)) return count;
    std::string parts;
    for (std::size_t i = 0; i < memory.options().later.size(); ++i) {
        const std::string& option = memory.options().later[i].option;
        const std::uint64_t rest = memory.count(plan, blend, i).bytes;
        if (!option.empty() && rest < count.bytes)
            parts += " (" + in_binary_units(rest, true) + " without `" + option + "`)";
    }
    throw Error(Refusal::unsuitable,
                "the displaced mesh needs " + in_binary_units(count.bytes, true) + " of memory" + parts + " for " +
                    std::to_string(count.points) + " points and " + std::to_string(count.faces) + " faces, more than " +
                    (count.bytes <= memory.limit() ? "its indices can count" : memory.described_limit()) + "; " +
                    what_would_fit(memory, plan, blend));
}

} // namespace bake
