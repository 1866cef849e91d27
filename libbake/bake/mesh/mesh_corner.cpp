#include "bake/mesh/mesh_corner.h"
#include "bake/base/error.h"
#include "bake/base/parallel.h"
#include "bake/mesh/number_distinct.h"
#include <atomic>
#include <cmath>
#include <cstring>

namespace bake {
namespace {

/// Index of the first value that is not finite, or `count`.
std::size_t first_not_finite(const float* values, std::size_t count) {
    std::atomic<std::size_t> first = count;
    for_rows(std::int64_t(count), 1 << 18, [&](std::int64_t begin, std::int64_t end) {
        float sum = 0; // of x - x: 0 unless some x is not finite
        for (std::int64_t i = begin; i < end; ++i) sum += values[i] - values[i];
        if (sum == 0) return;
        for (std::int64_t i = begin; i < end; ++i) {
            if (std::isfinite(values[i])) continue;
            std::size_t known = first;
            while (std::size_t(i) < known && !first.compare_exchange_weak(known, std::size_t(i))) {
            }
            return;
        }
    });
    return first;
}

void refuse_values(const float* values, std::size_t count, std::size_t components, const std::string& what,
                   const std::string& path) {
    const std::size_t bad = first_not_finite(values, count);
    if (bad < count)
        throw Error(Refusal::unsuitable,
                    path + ": not written, " + what + " " + std::to_string(bad / components) +
                        " of the mesh is not finite; check the inputs for values that are too large");
}

template <class Vec> void refuse_values(const std::vector<Vec>& values, const char* what, const std::string& path) {
    const auto components = std::size_t(Vec::length());
    if (!values.empty()) refuse_values(&values[0][0], values.size() * components, components, what, path);
}

} // namespace

void refuse_unless_finite(const Mesh& mesh, const std::string& path) {
    refuse_values(mesh.positions, "position", path);
    refuse_values(mesh.normals, "normal", path);
    refuse_values(mesh.uvs, "uv", path);
    refuse_values(mesh.tangents, "tangent", path);
    for (const Attribute& a : mesh.attributes)
        refuse_values(a.values.data(), a.values.size(), std::size_t(a.components), a.name, path);
}

DistinctCorners distinct_corners(const Mesh& mesh, std::size_t first_face, std::size_t end_face) {
    const std::uint32_t begin = mesh.face_begin[first_face], end = mesh.face_begin[end_face];
    const std::span<const std::uint32_t> positions = std::span(mesh.corner_position).subspan(begin, end - begin);
    if (positions.empty()) return {};
    const auto [low, high] = std::minmax_element(positions.begin(), positions.end());
    const std::size_t range =
        std::size_t(*high) - *low + 1; // the cost of a node does not depend on the positions of all nodes
    const auto position = [positions, lowest = *low](std::uint32_t c) noexcept { return positions[c] - lowest; };
    const std::uint32_t* const normal = mesh.corner_normal.empty() ? nullptr : &mesh.corner_normal[begin];
    const std::uint32_t* const uv = mesh.corner_uv.empty() ? nullptr : &mesh.corner_uv[begin];
    const auto indices = [=](std::uint32_t c) noexcept {
        return std::uint64_t(normal ? normal[c] : no_index) << 32 | (uv ? uv[c] : no_index);
    };
    DistinctCorners out;
    if (mesh.tangents.empty() && mesh.attributes.empty()) {
        out = distinct_corners(positions.size(), range, position, indices,
                               [indices](std::uint32_t i, std::uint32_t j) { return indices(i) == indices(j); });
    } else {
        const auto key = [&](std::uint32_t c) noexcept {
            std::uint64_t hash = mixed(0, indices(c));
            if (!mesh.tangents.empty())
                for (int k = 0; k < 4; ++k) hash = mixed(hash, float_bits(mesh.tangents[begin + c][k]));
            for (const Attribute& a : mesh.attributes) {
                const auto n = std::size_t(a.components);
                for (std::size_t k = 0; k < n; ++k) hash = mixed(hash, float_bits(a.values[(begin + c) * n + k]));
            }
            return hash;
        };
        const auto same = [&](std::uint32_t i, std::uint32_t j) noexcept {
            if (indices(i) != indices(j)) return false;
            if (!mesh.tangents.empty() && mesh.tangents[begin + i] != mesh.tangents[begin + j]) return false;
            for (const Attribute& a : mesh.attributes) {
                const auto n = std::size_t(a.components);
                for (std::size_t k = 0; k < n; ++k)
                    if (a.values[(begin + i) * n + k] != a.values[(begin + j) * n + k]) return false;
            }
            return true;
        };
        out = distinct_corners(positions.size(), range, position, key, same);
    }
    for (std::uint32_t& c : out.first) c += begin;
    return out;
}

DistinctCorners distinct_corners(const Mesh& mesh) { return distinct_corners(mesh, 0, mesh.faces()); }

} // namespace bake
