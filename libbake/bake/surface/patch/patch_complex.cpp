#include "bake/surface/patch/patch_complex.h"
#include "bake/base/parallel.h"
#include "bake/base/progress.h"
#include "bake/mesh/topology.h"
#include <algorithm>
#include <utility>

namespace bake {
namespace {

constexpr std::int64_t grain = 16384;

std::uint32_t renumber(std::vector<PatchComplex::Patch>& patches) {
    std::uint32_t highest = 0, vertices = 0;
    for (const PatchComplex::Patch& patch : patches)
        for (int k = 0; k < patch.sides(); ++k) highest = std::max(highest, patch.vertex[k]);
    std::vector<std::uint32_t> number(std::size_t(highest) + 1, no_index);
    for (PatchComplex::Patch& patch : patches)
        for (int k = 0, sides = patch.sides(); k < sides; ++k) {
            std::uint32_t& n = number[patch.vertex[k]];
            if (n == no_index) n = vertices++;
            patch.vertex[k] = n;
        }
    return vertices;
}

bool normals_differ(const Vec3f& a, const Vec3f& b) noexcept {
    if (a == Vec3f(0) || b == Vec3f(0)) return false;
    const Vec3f d = a - b;
    return glm::dot(d, d) > 1e-6f; // equal normals that files have rounded differ by less than 0.001
}

bool uvs_differ(const Vec2d& a, const Vec2d& b, double tolerance) noexcept {
    return a != b && !(glm::length(a - b) <= tolerance);
}

int next_corner(const PatchComplex::Patch& patch, int k) noexcept { return k + 1 < patch.sides() ? k + 1 : 0; }

using Rim = std::function<RimValue(std::uint32_t, int)>;

/// Marks the edges at whose ends, or middles, the values of the patches differ.
void find_seams(PatchComplex& complex, const EdgeTable& edges, const Rim& rim, bool middles, double uv_tolerance) {
    // The value of a side at the lower end (0), the higher end (1) or the middle (2) of its edge.
    const auto value = [&](std::uint32_t side, int at) {
        const PatchComplex::Patch& patch = complex.patches[side / 4];
        const int k = int(side % 4);
        if (at == 2) return rim(side / 4, 4 + k);
        return rim(side / 4, (at == 1) == patch.reversed[k] ? k : next_corner(patch, k));
    };
    std::vector<char> seam(edges.edges(), 0), crease(edges.edges(), 0); // bytes, because threads write them
    for_rows(edges.edges(), grain, [&](std::int64_t begin, std::int64_t end) {
        for (auto e = std::uint32_t(begin); e < end; ++e) {
            const auto sides = edges.of(e);
            if (sides.size() == 1) continue;
            for (int at = 0; at < (middles ? 3 : 2); ++at) {
                const RimValue a = value(sides[0], at);
                for (const std::uint32_t side : sides.subspan(1)) {
                    const RimValue b = value(side, at);
                    seam[e] |= uvs_differ(a.uv, b.uv, uv_tolerance);
                    crease[e] |= normals_differ(a.n, b.n);
                }
            }
        }
    });
    complex.seam.assign(seam.begin(), seam.end());
    complex.crease.assign(crease.begin(), crease.end());
}

void find_sharp_vertices(PatchComplex& complex, const Rim& rim) {
    complex.sharp_vertex.assign(complex.vertices, false);
    std::vector<Vec3f> first(complex.vertices, Vec3f(0));
    for (std::uint32_t i = 0; i < complex.patches.size(); ++i) {
        if (i % 65536 == 0) throw_if_interrupted();
        for (int k = 0; k < complex.patches[i].sides(); ++k) {
            const std::uint32_t v = complex.patches[i].vertex[k];
            const Vec3f n = rim(i, k).n;
            if (first[v] == Vec3f(0)) first[v] = n;
            else if (normals_differ(first[v], n)) complex.sharp_vertex[v] = true;
        }
    }
}

} // namespace

PatchComplex make_complex(std::vector<PatchComplex::Patch> patches, const Rim& rim, bool middles, double uv_tolerance) {
    PatchComplex complex;
    complex.patches = std::move(patches);
    complex.vertices = renumber(complex.patches);
    const auto sides = std::uint32_t(complex.patches.size() * 4);
    const EdgeTable edges = make_edges(complex.vertices, sides, [&](std::uint32_t side) -> SideEnds {
        const PatchComplex::Patch& patch = complex.patches[side / 4];
        const int k = int(side % 4);
        if (k >= patch.sides()) return {no_index, no_index};
        return {patch.vertex[k], patch.vertex[next_corner(patch, k)]};
    });
    complex.edges = edges.edges();
    for_rows(std::int64_t(complex.patches.size()), grain, [&](std::int64_t begin, std::int64_t end) {
        for (auto i = begin; i < end; ++i) {
            PatchComplex::Patch& patch = complex.patches[i];
            for (int k = 0; k < 4; ++k) {
                patch.edge[k] = edges.edge[4 * i + k];
                patch.reversed[k] = k < patch.sides() && patch.vertex[k] > patch.vertex[next_corner(patch, k)];
            }
        }
    });
    find_seams(complex, edges, rim, middles, uv_tolerance);
    find_sharp_vertices(complex, rim);
    return complex;
}

} // namespace bake
