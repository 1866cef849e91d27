#include "bake/surface/patch/patch_complex.h"
#include "bake/base/parallel.h"
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
    return glm::dot(d, d) > 1e-6f; // normals as files round them are nearer than 0.001
}

bool uvs_differ(const Vec2d& a, const Vec2d& b, double tolerance) noexcept {
    return a != b && !(glm::length(a - b) <= tolerance);
}

} // namespace

PatchComplex make_complex(std::vector<PatchComplex::Patch> patches,
                          const std::function<RimValue(std::uint32_t, int)>& rim, bool middles, double uv_tolerance) {
    PatchComplex complex;
    complex.patches = std::move(patches);
    complex.vertices = renumber(complex.patches);
    const auto next_corner = [&](const PatchComplex::Patch& patch, int k) { return k + 1 < patch.sides() ? k + 1 : 0; };
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

    // The value of a side at the lower end (0), the higher end (1) and the middle (2) of its edge.
    const auto value = [&](std::uint32_t side, int place) {
        const PatchComplex::Patch& patch = complex.patches[side / 4];
        const int k = int(side % 4);
        if (place == 2) return rim(side / 4, 4 + k);
        return rim(side / 4, (place == 1) == patch.reversed[k] ? k : next_corner(patch, k));
    };
    std::vector<char> seam(edges.edges(), 0), crease(edges.edges(), 0);
    for_rows(edges.edges(), grain, [&](std::int64_t begin, std::int64_t end) {
        for (auto e = begin; e < end; ++e) {
            if (edges.begin[e] + 1 == edges.begin[e + 1]) continue;
            for (int place = 0; place < (middles ? 3 : 2); ++place) {
                const RimValue a = value(edges.sides[edges.begin[e]], place);
                for (auto i = edges.begin[e] + 1; i < edges.begin[e + 1]; ++i) {
                    const RimValue b = value(edges.sides[i], place);
                    seam[e] |= uvs_differ(a.uv, b.uv, uv_tolerance);
                    crease[e] |= normals_differ(a.n, b.n);
                }
            }
        }
    });
    complex.seam.assign(seam.begin(), seam.end());
    complex.crease.assign(crease.begin(), crease.end());

    complex.sharp_vertex.assign(complex.vertices, false);
    std::vector<Vec3f> first(complex.vertices, Vec3f(0));
    for (std::uint32_t i = 0; i < complex.patches.size(); ++i)
        for (int k = 0; k < complex.patches[i].sides(); ++k) {
            const std::uint32_t v = complex.patches[i].vertex[k];
            const Vec3f n = rim(i, k).n;
            if (first[v] == Vec3f(0)) first[v] = n;
            else if (normals_differ(first[v], n)) complex.sharp_vertex[v] = true;
        }
    return complex;
}

} // namespace bake
