#include "bake/relief/transfer/casting.h"
#include "bake/base/error.h"
#include "bake/mesh/weld.h"
#include "bake/relief/transfer/hard_edges.h"
#include "bake/relief/transfer/lanes.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

/// One per triangle.
std::vector<Vec3f> facet_normals(const MeshSurface& low) {
    std::vector<Vec3f> out;
    for (const Triangle& t : low.triangles) {
        const auto at = [&](std::size_t k) {
            return Vec3d(low.mesh->positions[low.mesh->corner_position[t.corner[k]]]);
        };
        out.emplace_back(unit_or_zero(glm::cross(at(1) - at(0), at(2) - at(0))));
    }
    return out;
}

template <class T> T mixed(const T& a, const T& b, const T& c, const TexelHit& at) noexcept {
    return (1 - at.b1 - at.b2) * a + at.b1 * b + at.b2 * c;
}

} // namespace

Casting::Casting(const MeshSurface& low, CastBy by, std::vector<Reach> reach) : low_(low), reach_(std::move(reach)) {
    facets_ = facet_normals(low);
    by_face_ = by == CastBy::face;
    if (by_face_) {
        averaged_.resize(low.mesh->corners()); // of a face with several triangles the last
        for (std::size_t t = 0; t < facets_.size(); ++t)
            for (const std::uint32_t corner : low.triangles[t].corner) averaged_[corner] = facets_[t];
    } else {
        HardEdges hard = bake::hard_edges(*low.mesh, low.triangles, low.n);
        averaged_ = std::move(hard.averaged);
        hard_edges_ = hard.ends.size();
        if (by == CastBy::blend && !hard.ends.empty()) own_ = std::move(hard.own), set_hard_edges(hard.ends);
    }
    for (const Reach& r : reach_)
        most_front_ = std::max(most_front_, r.front), most_back_ = std::max(most_back_, r.back);
}

Casting::Casting(const MeshSurface& low, const Mesh& cage, const std::string& path) : low_(low), cage_(true) {
    const Mesh& mesh = *low.mesh;
    if (cage.face_begin != mesh.face_begin)
        throw Error(Refusal::unsuitable,
                    path + ": has other faces than the low-poly mesh; a cage is that mesh with its faces pushed out");
    // Corners that meet in the low-poly mesh meet in the cage.
    const std::vector<std::uint32_t> own = first_equal(mesh.positions), pushed = first_equal(cage.positions);
    std::vector<std::uint32_t> place(mesh.positions.size(), no_index);
    for (std::size_t c = 0; c < mesh.corners(); ++c) {
        std::uint32_t& at = place[own[mesh.corner_position[c]]];
        const std::uint32_t here = pushed[cage.corner_position[c]];
        if (at != no_index && at != here)
            throw Error(Refusal::unsuitable,
                        path + ": its faces do not meet where those of the low-poly mesh do; a cage is "
                               "that mesh with its faces pushed out, in the same order");
        at = here;
    }
    averaged_.resize(mesh.corners());
    const Vec3f between(cage.origin - mesh.origin);
    for (std::size_t c = 0; c < mesh.corners(); ++c) {
        averaged_[c] = cage.positions[cage.corner_position[c]] + between - mesh.positions[mesh.corner_position[c]];
        most_front_ = std::max(most_front_, glm::length(averaged_[c]));
    }
    most_back_ = most_front_;
}

void Casting::set_hard_edges(const std::vector<std::array<std::uint32_t, 2>>& edges) {
    Mesh lines;
    std::vector<Triangle> flat;
    lines.positions = low_.mesh->positions;
    for (const auto& [a, b] : edges) {
        const auto first = std::uint32_t(lines.corner_position.size());
        lines.corner_position.insert(lines.corner_position.end(), {a, b, b});
        flat.push_back({{first, first + 1, first + 2}, std::uint32_t(flat.size())});
        lines.face_begin.push_back(first + 3);
    }
    edges_ = std::make_unique<TriangleTree>(lines, flat);
}

/// 1 on a hard edge, 0 from `width` on.
float Casting::averaged_share(const Vec3f& p, float width) const noexcept {
    const auto distance = float(std::sqrt(edges_->nearest(Vec3d(p)).distance2));
    const float x = distance < width ? distance / width : 1;
    return 1 - x * x * (3 - 2 * x);
}

/// What rays from a triangle are mixed from.
struct Casting::Corners {
    std::array<Vec3f, 3> p, d, own;
    std::array<Reach, 3> reach;
    bool blends; ///< own and d differ
};

Casting::Corners Casting::corners_of(std::uint32_t triangle) const noexcept {
    Corners out{};
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t corner = low_.triangles[triangle].corner[k];
        const std::uint32_t position = low_.mesh->corner_position[corner];
        out.p[k] = low_.mesh->positions[position];
        out.d[k] = by_face_ ? facets_[triangle] : averaged_[corner];
        if (!cage_) out.reach[k] = reach_[position];
        if (own_.empty()) continue;
        out.own[k] = own_[corner];
        out.blends |= out.own[k] != out.d[k];
    }
    return out;
}

Cast Casting::at(const Corners& corners, const TexelHit& at) const noexcept {
    const Vec3f p = mixed(corners.p[0], corners.p[1], corners.p[2], at);
    Vec3f d = mixed(corners.d[0], corners.d[1], corners.d[2], at);
    if (cage_) {
        const float front = glm::length(d);
        return {p + d, -unit_or_zero(d), {front, front, 0}};
    }
    const auto& [r0, r1, r2] = corners.reach;
    const Reach reach{mixed(r0.front, r1.front, r2.front, at), mixed(r0.back, r1.back, r2.back, at),
                      mixed(r0.blend, r1.blend, r2.blend, at)};
    if (corners.blends) {
        const Vec3f own = mixed(corners.own[0], corners.own[1], corners.own[2], at);
        if (own != d) {
            const float share = averaged_share(p, reach.blend);
            d = share * unit_or_zero(d) + (1 - share) * unit_or_zero(own);
        }
    }
    d = unit_or_zero(d);
    return {p + reach.front * d, -d, reach};
}

Cast Casting::at(const TexelHit& at) const noexcept { return this->at(corners_of(at.triangle), at); }

void Casting::at(std::span<const TexelHit> points, std::span<Cast> casts) const noexcept {
    const Corners corners = corners_of(points[0].triangle);
    const std::size_t count = points.size();
    Lanes3 d;
    bool several = count <= packet_size && !cage_ && !corners.blends;
    if (several) {
        for (std::size_t i = 0; i < count; ++i) d.set(i, mixed(corners.d[0], corners.d[1], corners.d[2], points[i]));
        several = !make_unit(d, count);
    }
    const auto& [r0, r1, r2] = corners.reach;
    for (std::size_t i = 0; i < count; ++i) {
        if (!several) {
            casts[i] = at(corners, points[i]);
            continue;
        }
        const TexelHit& at = points[i];
        const Reach reach{mixed(r0.front, r1.front, r2.front, at), mixed(r0.back, r1.back, r2.back, at),
                          mixed(r0.blend, r1.blend, r2.blend, at)};
        casts[i] = {mixed(corners.p[0], corners.p[1], corners.p[2], at) + reach.front * d[i], -d[i], reach};
    }
}

std::optional<Cast> Casting::facing(const TexelHit& at) const noexcept {
    constexpr float least = 0.17f;
    if (cage_) return {};
    Cast cast = this->at(at);
    const Vec3f n = facets_[at.triangle], d = -cast.inward;
    const float cosine = glm::dot(d, n);
    if (!(cosine < least) || n == Vec3f(0)) return {};
    const Vec3f turned = unit_or_zero(least * n + std::sqrt(1 - least * least) * unit_or_zero(d - cosine * n));
    cast.start += cast.reach.front * (turned - d);
    cast.inward = -turned;
    return cast;
}

Vec3f Casting::envelope(std::uint32_t corner) const noexcept {
    const std::uint32_t position = low_.mesh->corner_position[corner];
    const Vec3f p = low_.mesh->positions[position];
    return p + (cage_ ? 1.0f : reach_[position].front) * averaged_[corner];
}

} // namespace bake
