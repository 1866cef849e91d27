// A base surface with a relief: at a point, the value of the relief, the displaced point and its exact normal.
//
//   p' = p + d      N' = (p_s + d_s) x (p_t + d_t)      d = b n along the normal
//
// s and t are the parameters of the jet. N' is multiplied by sigma, so that it points outward.
#pragma once
#include "bake/relief/displace/types.h"
#include "bake/relief/map/displaced_normal.h"
#include "bake/surface/patch/base_surface.h"
#include <memory>

namespace bake {

/// The value of the relief at a point, and its derivatives along the parameters of the jet: (b, 0, 0) for a height b along
/// the normal, else the displacement in object space.
struct ReliefValue {
    Vec3d at{0}, s{0}, t{0};
};

struct DisplacedPoint {
    Vec3d p;
    Vec3d normal; ///< N', not unit; zero where the surface has no tangents or folds flat
};

class ReliefSurface {
public:
    /// Both must outlive it. With `as_vectors` the values of heights are displacements b n, whose direction a blend may change.
    ReliefSurface(const BaseSurface& base, const Relief& relief, bool as_vectors = false);

    const BaseSurface& base() const noexcept { return *base_; }
    /// The relief is a height along the normal.
    bool along_normal() const noexcept { return !space_; }
    /// The relief depends on the normal of the base.
    bool uses_normal() const noexcept { return space_ != VectorSpace::object; }
    /// ReliefValue::at is (b, 0, 0), not a displacement.
    bool values_are_heights() const noexcept { return !space_ && !as_vectors_; }
    /// Texels along u and v.
    Vec2d texels() const noexcept { return texels_; }

    /// Values at points of one patch, which are base().evaluate() at `st`. They are zero on a patch without uvs.
    void values(std::uint32_t patch, std::span<const Vec2d> st, std::span<const SurfacePoint> points,
                std::span<ReliefValue> out) const;

    /// The height at a uv, with derivatives along u and v; only with along_normal().
    Height<double> height(const Vec2d& uv) const noexcept { return channels_[0].sample(uv.x, uv.y); }

    /// How far along the normal a value moves the point.
    double height_of(const SurfacePoint& point, const ReliefValue& value) const noexcept {
        return values_are_heights() ? value.at.x : glm::dot(value.at, point.jet.n);
    }
    /// By which vector a value moves the point.
    Vec3d displacement(const SurfacePoint& point, const ReliefValue& value) const noexcept {
        return values_are_heights() ? value.at.x * point.jet.n : value.at;
    }
    DisplacedPoint displaced(const SurfacePoint& point, const ReliefValue& value) const noexcept;

private:
    Vec3d vector(const SurfacePoint& point) const noexcept;

    const BaseSurface* base_;
    std::optional<VectorSpace> space_;
    bool as_vectors_;
    Vec2d texels_;
    std::vector<HeightSampler<float>> channels_; ///< one, or three
};

/// Memory of the samplers of a relief: what they keep, and the most that making them takes.
struct SamplerMemory {
    std::uint64_t kept = 0, most = 0;
};
SamplerMemory sampler_memory(const Relief& relief) noexcept;

/// The value of a height: b and its slopes along the parameters of the jet.
inline ReliefValue along_normal(const SurfacePoint& point, const Height<double>& h) noexcept {
    return {{h.b, 0, 0},
            {h.b_u * point.uv_s.x + h.b_v * point.uv_s.y, 0, 0},
            {h.b_u * point.uv_t.x + h.b_v * point.uv_t.y, 0, 0}};
}

inline DisplacedPoint displaced_along_normal(const Jet<double>& jet, const ReliefValue& value) noexcept {
    const double b = value.at.x;
    if (jet.sigma == 0) return {jet.p + b * jet.n, Vec3d(0)};
    return {jet.p + b * jet.n, detail::cell_normal(jet, {b, value.s.x, value.t.x}, b)};
}

/// min(1 + b a_i) over the principal curvatures a_i: 0 or less where the surface displaced by b turns inside out. 1 where
/// there are no tangents.
inline double fold_margin(const Jet<double>& s, double b) noexcept {
    // n_u = A p_u, n_v = A p_v on the tangent plane: trace and determinant of A come from cross products.
    const double area = glm::dot(s.n, glm::cross(s.p_u, s.p_v));
    if (area == 0 || s.sigma == 0) return 1;
    const double per_area = 1 / area;
    const double mean = 0.5 * per_area * glm::dot(s.n, glm::cross(s.n_u, s.p_v) + glm::cross(s.p_u, s.n_v));
    const double gauss = per_area * glm::dot(s.n, glm::cross(s.n_u, s.n_v));
    const double half = std::sqrt(std::max(0.0, mean * mean - gauss));
    return 1 + b * mean - std::abs(b) * half;
}

/// The same of any displacement d, with q = p + d: the smallest eigenvalue of the map F of the tangent plane that takes p_s
/// to the part of q_s in that plane, and p_t likewise. Where the two are complex, sqrt(det F): a turn within the plane is no
/// fold. 0 or less where the displaced surface faces against n, by a fold or by an overhang. Along the normal F = 1 + b A,
/// and this is fold_margin(jet, b).
inline double fold_margin(const Jet<double>& s, const ReliefValue& value) noexcept {
    const double area = glm::dot(s.n, glm::cross(s.p_u, s.p_v));
    if (area == 0 || s.sigma == 0) return 1;
    const double per_area = 1 / area;
    const Vec3d q_s = s.p_u + value.s, q_t = s.p_v + value.t;
    const double half_trace = 0.5 * per_area * glm::dot(s.n, glm::cross(q_s, s.p_v) + glm::cross(s.p_u, q_t));
    const double determinant = per_area * glm::dot(s.n, glm::cross(q_s, q_t));
    const double square = half_trace * half_trace - determinant;
    return square < 0 ? std::sqrt(determinant) : half_trace - std::sqrt(square);
}

/// Whether the parameters of the jet are u and v; otherwise they are those of the patch.
inline bool along_chart(const SurfacePoint& point) noexcept {
    return point.uv_s == Vec2d(1, 0) && point.uv_t == Vec2d(0, 1);
}

} // namespace bake
