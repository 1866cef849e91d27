#include "bake/relief/displace/reach.h"
#include "bake/base/error.h"
#include "bake/base/parallel.h"
#include "bake/base/progress.h"
#include "bake/base/text.h"
#include "bake/relief/displace/curves.h"
#include <algorithm>
#include <cmath>
#include <limits>

namespace bake {
namespace {

/// What a curve needs.
struct LineNeed {
    double even = 1;     ///< even segments
    double adaptive = 1; ///< segments that are as long as the curve allows, at the least
    double scale = 0;    ///< adaptive times the root of the error, for small errors
};

LineNeed need_of_line(std::span<const Vec3d> curve, double error) {
    const auto count = std::uint32_t(curve.size()) - 1;
    double bend = 0;
    LineNeed need;
    for (std::uint32_t k = 1; k < count; ++k) {
        const double here = glm::length(curve[k - 1] - 2.0 * curve[k] + curve[k + 1]);
        bend = std::max(bend, here);
        need.scale += std::sqrt(here / 8);
    }
    need.even = rate_within(curve, error, std::numeric_limits<std::uint32_t>::max());
    if (need.even <= count / 2) return need; // the samples themselves are fine enough
    need.even = std::max(1.0, count * std::sqrt(bend / (8 * error)));
    need.adaptive = std::max(1.0, need.scale / std::sqrt(error));
    return need;
}

struct PatchNeed {
    double triangles = 1, scale = 0, even = 1;
};

PatchNeed need_of_patch(DisplacedPatch& patch, std::uint32_t number, std::uint32_t lines, double error) {
    const int sides = patch.surface().base().complex().patches[number].sides();
    LineNeed sum[2] = {{0, 0, 0}, {0, 0, 0}};
    PatchNeed need;
    for (std::uint32_t k = 0; k < lines; ++k) {
        const double x = (k + 0.5) / lines, end = sides == 4 ? 1 : 1 - x;
        for (const bool up : {false, true}) {
            const Vec2d from = up ? Vec2d(x, 0) : Vec2d(0, x), to = up ? Vec2d(x, end) : Vec2d(end, x);
            const double texels = std::clamp(std::ceil(texels_along(patch, number, from, to)), 32.0, 4096.0);
            const LineNeed line = need_of_line(along(patch, number, from, to, std::uint32_t(texels)), error);
            sum[up].adaptive += line.adaptive / lines, sum[up].scale += line.scale / lines;
            need.even = std::max(need.even, line.even);
        }
    }
    const int per_cell = sides == 4 ? 2 : 1;
    need.triangles = per_cell * sum[0].adaptive * sum[1].adaptive;
    need.scale = per_cell * sum[0].scale * sum[1].scale;
    return need;
}

/// The smallest error that all of the limits allow, about.
double reachable(const ErrorNeed& need, const Rates& rates, const DisplaceMemory& memory, double least) {
    const double per_triangle = double(memory.least_bytes(1e9) - memory.options().taken) / 1e9;
    const double room = std::max(1.0, double(memory.limit()) - double(memory.options().taken));
    const double triangles = std::min(room / per_triangle, double(no_index) / 2);
    const double segments = 4.0 * rates.most;
    return std::max({least, 2 * need.scale / triangles, rates.error * std::pow(need.most / segments, 2)});
}

[[noreturn]] void refuse(const Rates& rates, const std::string& why, double reachable) {
    throw Error(Refusal::unsuitable, format("an error of %g cannot be reached: ", rates.error) + why +
                                         format("; set `rates.error` to %.2g or more", 1.05 * reachable));
}

void refuse_unreachable(const SeamedRelief& scene, const Rates& rates, const DisplaceMemory& memory,
                        Progress* progress) {
    const double least = rounding_of_floats(memory.base().mesh());
    const ErrorNeed need = need_of(scene, std::max(rates.error, least), progress);
    Rates asked = rates;
    asked.error = std::max(rates.error, least);
    const double smallest = reachable(need, asked, memory, least);
    if (rates.error < least)
        refuse(rates, format("positions of the result are floats, which are rounded by up to %.2g here", least),
               smallest);
    if (const std::uint64_t bytes = memory.least_bytes(need.triangles); bytes > memory.limit())
        refuse(rates,
               format("it takes %.2g triangles or more, ", need.triangles) + in_binary_units(bytes, true) +
                   " of memory, more than " + memory.described_limit(),
               smallest);
    if (need.triangles > double(no_index) / 2)
        refuse(rates, format("it takes %.2g triangles or more, more than indices can count", need.triangles), smallest);
    if (need.segments > 4.0 * rates.most)
        refuse(rates,
               format("it takes %.2g segments along an edge, and %d are the most", need.segments, 4 * rates.most),
               smallest);
}

/// Before the layout, whose time grows with the number of faces.
void refuse_too_small(const RatePlan& plan, const Rates& rates, const DisplaceMemory& memory) {
    const auto triangles = double(triangles_of(plan));
    const std::uint64_t bytes = memory.least_bytes(triangles);
    const double over = std::max(double(bytes) / double(memory.limit()), 2 * triangles / double(no_index));
    if (over <= 1) return;
    throw Error(Refusal::unsuitable,
                format("segments of %g take %.2g triangles, ", rates.size, triangles) + in_binary_units(bytes, true) +
                    " of memory, more than " +
                    (bytes <= memory.limit() ? "indices can count" : memory.described_limit()) +
                    (bytes <= memory.limit() ? "; " : "; " + memory.advice() + ", or ") +
                    format("set `rates.size` to %.2g or more", 1.05 * rates.size * std::sqrt(over)));
}

} // namespace

double rounding_of_floats(const Mesh& mesh) noexcept {
    const Bounds box = bounds(mesh);
    double largest = 0;
    for (int k = 0; k < 3; ++k)
        largest = std::max({largest, std::abs(double(box.min[k])), std::abs(double(box.max[k]))});
    return largest * std::numeric_limits<float>::epsilon() / 2;
}

ErrorNeed need_of(const SeamedRelief& scene, double error, Progress* progress) {
    const PatchComplex& complex = scene.surface.base().complex();
    const auto patches = std::uint32_t(complex.patches.size());
    const std::uint32_t stride = (patches + 1023) / 1024, probes = (patches + stride - 1) / stride;
    const std::uint32_t lines = std::clamp(1024 / std::max(probes, 1u), 2u, 16u);
    std::vector<PatchNeed> needs(probes);
    if (progress) progress->start("reach", probes);
    for_rows(
        probes, 1,
        [&](std::int64_t begin, std::int64_t end) {
            DisplacedPatch patch(scene.surface, scene.blend);
            for (auto i = begin; i < end; ++i)
                needs[std::size_t(i)] = need_of_patch(patch, std::uint32_t(i) * stride, lines, error);
        },
        progress);
    ErrorNeed all;
    if (needs.empty()) return all;
    const double share = double(patches) / probes;
    for (const PatchNeed& need : needs) all.triangles += share * need.triangles, all.scale += share * need.scale;
    std::sort(needs.begin(), needs.end(), [](const PatchNeed& a, const PatchNeed& b) { return a.even < b.even; });
    all.segments = needs[needs.size() / 2].even;
    all.most = needs[needs.size() * 9 / 10].even;
    return all;
}

RatePlan plan_rates(const SeamedRelief& scene, const Rates& rates, const DisplaceMemory& memory, Progress* progress) {
    if (rates.rule == Rates::Rule::edge_size) {
        RatePlan plan = rates_by_size(scene.surface, scene.blend, rates);
        refuse_too_small(plan, rates, memory);
        return plan;
    }
    if (!(rates.error > 0))
        throw Error(Refusal::usage, "`rates.error`: must be above 0; take a length in object units");
    refuse_unreachable(scene, rates, memory, progress);
    const auto check = [&](std::uint32_t split, double least, double triangles) {
        const std::uint64_t search = memory.options().taken + memory.search_bytes(split);
        if (std::max(search, memory.least_bytes(least)) <= memory.limit() && least <= double(no_index) / 2) return;
        const std::uint64_t bytes = std::max(search, memory.least_bytes(triangles));
        // The number of triangles is inverse to the error.
        const double over = std::max(double(bytes) / double(memory.limit()), 2 * triangles / double(no_index));
        refuse(rates,
               format("it takes %.2g triangles or more, ", triangles) + in_binary_units(bytes, true) +
                   " of memory, more than " + memory.described_limit(),
               rates.error * 1.2 * over);
    };
    return rates_by_error(scene.surface, scene.blend, rates, check, progress);
}

} // namespace bake
