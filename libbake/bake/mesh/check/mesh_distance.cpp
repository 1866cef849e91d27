#include "bake/mesh/check/mesh_distance.h"
#include "bake/base/parallel.h"
#include "bake/base/progress.h"
#include "bake/mesh/check/hausdorff_bound.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

constexpr std::int64_t grain = 512;
constexpr double degrees = 57.29577951308232;

struct MeshWithTree {
    const Mesh& mesh;
    const std::vector<Triangle>& triangles;
    const TriangleTree& tree;
};

Vec3d corner(const TriangleTree& tree, std::uint32_t place, int k) { return Vec3d(tree.corners(place)[k]); }

Vec3d facet_normal(const TriangleTree& tree, std::uint32_t place) {
    const Vec3d p0 = corner(tree, place, 0);
    return glm::cross(corner(tree, place, 1) - p0, corner(tree, place, 2) - p0);
}

/// The interpolated normal of the file at a point of a triangle; zero if a corner has no normal.
Vec3d shading_normal(const MeshWithTree& m, std::uint32_t place, double b1, double b2) {
    if (m.mesh.corner_normal.empty()) return Vec3d(0);
    Vec3d sum(0);
    const double weight[3] = {1 - b1 - b2, b1, b2};
    for (int k = 0; k < 3; ++k) {
        const std::uint32_t n = m.mesh.corner_normal[m.triangles[m.tree.index(place)].corner[k]];
        if (n == no_index) return Vec3d(0);
        sum += weight[k] * Vec3d(m.mesh.normals[n]);
    }
    return sum;
}

struct Weighted {
    float value, weight;
};

/// Adds the angle between two normals of any length, unless one of them is zero.
void add_angle(std::vector<Weighted>& to, const Vec3d& a, const Vec3d& b, double weight) {
    const Vec3d m = unit_or_zero(a), n = unit_or_zero(b);
    if (m == Vec3d(0) || n == Vec3d(0)) return;
    to.push_back({float(degrees * std::atan2(glm::length(glm::cross(m, n)), glm::dot(m, n))), float(weight)});
}

NormalDeviation deviation(std::vector<Weighted> angles) {
    NormalDeviation d;
    std::sort(angles.begin(), angles.end(), [](const Weighted& a, const Weighted& b) {
        throw_if_interrupted();
        return a.value != b.value ? a.value < b.value : a.weight < b.weight;
    });
    double total = 0, sum = 0, below = 0;
    for (const Weighted& a : angles) {
        total += a.weight;
        sum += double(a.weight) * a.value;
    }
    if (!(total > 0)) return d;
    d.mean = sum / total;
    d.max = angles.back().value;
    for (const Weighted& a : angles) {
        d.p95 = a.value;
        if ((below += a.weight) >= 0.95 * total) break;
    }
    return d;
}

/// Triangles of B nearest to points of A. Triangles of both are numbered in the order of their trees.
struct NearestPlaces {
    std::vector<std::uint32_t> position; ///< per position of A's mesh; no_index if no triangle uses the position
    std::vector<std::uint32_t> inside;   ///< per triangle of A: nearest to one sample on the triangle
};

struct Sampled {
    Farthest farthest;
    double area = 0, sum = 0, squares = 0;
    std::vector<Weighted> facet, shading;
};

std::uint32_t position_of(const MeshWithTree& m, std::uint32_t place, int k) {
    return m.mesh.corner_position[m.triangles[m.tree.index(place)].corner[k]];
}

/// Number of segments that each edge of a triangle is cut into for sub-triangles of about the wanted area.
int segments(double area, double wanted) {
    return std::clamp(int(std::sqrt(std::min(area / wanted, 1e7)) + 0.5), 1, 2048);
}

/// Samples the centroids of sub-triangles of equal area of one triangle of A. `hint` is the nearest triangle of the
/// previous point, from which the search for the next one starts.
void sample(const MeshWithTree& a, const MeshWithTree& b, double wanted, std::uint32_t place, std::uint32_t& hint,
            Sampled& to) {
    const Vec3d p0 = corner(a.tree, place, 0), e1 = corner(a.tree, place, 1) - p0, e2 = corner(a.tree, place, 2) - p0;
    const Vec3d normal = glm::cross(e1, e2);
    const double area = glm::length(normal) / 2;
    const int n = segments(area, wanted);
    const double weight = area / (double(n) * n);
    for (int i = 0; i < n; ++i) {
        throw_if_interrupted();                     // a large triangle has millions of samples
        for (int j = 0; j < 2 * (n - i) - 1; ++j) { // upright and inverted ones alternate
            const double third = j % 2 ? 2.0 / 3 : 1.0 / 3, b1 = (j / 2 + third) / n, b2 = (i + third) / n;
            const Vec3d p = p0 + b1 * e1 + b2 * e2;
            const NearestPoint found = b.tree.nearest(p, hint);
            hint = found.triangle;
            to.farthest.include(p, found);
            to.sum += weight * std::sqrt(found.distance2);
            to.squares += weight * found.distance2;
            add_angle(to.facet, normal, facet_normal(b.tree, found.triangle), weight);
            add_angle(to.shading, shading_normal(a, place, b1, b2),
                      shading_normal(b, found.triangle, found.b1, found.b2), weight);
        }
    }
    to.area += area;
}

Sampled sample_all(const MeshWithTree& a, const MeshWithTree& b, std::size_t samples, NearestPlaces& nearest) {
    double area = 0;
    std::vector<std::uint32_t> owner(a.mesh.positions.size(), no_index); // the first triangle that uses each position
    for (std::uint32_t place = 0; place < a.tree.size(); ++place) {
        if (place % 65536 == 0) throw_if_interrupted();
        area += glm::length(facet_normal(a.tree, place)) / 2;
        for (int k = 0; k < 3; ++k) {
            std::uint32_t& first = owner[position_of(a, place, k)];
            first = std::min(first, place);
        }
    }
    const double wanted =
        std::max(area / double(std::max<std::size_t>(samples, 1)), std::numeric_limits<double>::min());
    nearest.position.assign(owner.size(), no_index);
    nearest.inside.resize(a.tree.size());
    std::vector<Sampled> parts((a.tree.size() + grain - 1) / grain);
    for_rows(a.tree.size(), grain, [&](std::int64_t begin, std::int64_t end) {
        std::uint32_t hint = no_index;
        Sampled& part = parts[begin / grain];
        for (auto place = std::uint32_t(begin); place < end; ++place) {
            for (int k = 0; k < 3; ++k) {
                const std::uint32_t position = position_of(a, place, k);
                if (owner[position] != place) continue;
                const Vec3d p(a.mesh.positions[position]);
                const NearestPoint found = b.tree.nearest(p, hint);
                nearest.position[position] = hint = found.triangle;
                part.farthest.include(p, found);
            }
            sample(a, b, wanted, place, hint, part);
            nearest.inside[place] = hint;
        }
    });
    Sampled all;
    for (Sampled& part : parts) { // in the order of the parts, so that sums do not depend on threads
        all.farthest.include(part.farthest);
        all.area += part.area;
        all.sum += part.sum;
        all.squares += part.squares;
        all.facet.insert(all.facet.end(), part.facet.begin(), part.facet.end());
        all.shading.insert(all.shading.end(), part.shading.begin(), part.shading.end());
        part = {};
    }
    return all;
}

std::vector<Piece> pieces_of(const MeshWithTree& a, const NearestPlaces& nearest) {
    std::vector<Piece> pieces(a.tree.size());
    for_rows(a.tree.size(), grain, [&](std::int64_t begin, std::int64_t end) {
        for (auto place = std::uint32_t(begin); place < end; ++place) {
            Piece& piece = pieces[place];
            for (int k = 0; k < 3; ++k) {
                piece.p[k] = corner(a.tree, place, k);
                piece.near[k] = nearest.position[position_of(a, place, k)];
            }
            piece.near[3] = nearest.inside[place];
        }
    });
    return pieces;
}

OneWayDistance one_way(const MeshWithTree& a, const MeshWithTree& b, const MeshDistanceOptions& options, double least) {
    NearestPlaces nearest;
    Sampled sampled = sample_all(a, b, options.samples, nearest);
    OneWayDistance d;
    d.facet = deviation(std::move(sampled.facet));
    d.shading = deviation(std::move(sampled.shading));
    if (sampled.area > 0) {
        d.mean = sampled.sum / sampled.area;
        d.rms = std::sqrt(sampled.squares / sampled.area);
    }
    const BoundOptions bound = {options.gap, least, options.most_cuts};
    d.upper = std::sqrt(upper_bound2(pieces_of(a, nearest), b.tree, bound, sampled.farthest));
    d.lower = std::sqrt(sampled.farthest.distance2);
    d.farthest = sampled.farthest.point;
    d.nearest = sampled.farthest.nearest;
    return d;
}

} // namespace

MeshDistance mesh_distance(const Mesh& a, const std::vector<Triangle>& a_triangles, const Mesh& b,
                           const std::vector<Triangle>& b_triangles, const MeshDistanceOptions& options) {
    const TriangleTree a_tree(a, a_triangles), b_tree(b, b_triangles);
    const MeshWithTree whole_a = {a, a_triangles, a_tree}, whole_b = {b, b_triangles, b_tree};
    Bounds box = bounds(a);
    const Bounds other = bounds(b);
    for (int k = 0; k < 3; ++k) {
        box.min[k] = std::min(box.min[k], other.min[k]);
        box.max[k] = std::max(box.max[k], other.max[k]);
    }
    MeshDistance d;
    d.diagonal = diagonal(box);
    d.shading = !a.corner_normal.empty() && !b.corner_normal.empty();
    d.there = one_way(whole_a, whole_b, options, options.negligible * d.diagonal);
    d.back = one_way(whole_b, whole_a, options, options.negligible * d.diagonal);
    d.lower = std::max(d.there.lower, d.back.lower);
    d.upper = std::max(d.there.upper, d.back.upper);
    return d;
}

} // namespace bake
