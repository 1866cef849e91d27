// The lobes of a Bsdf as one viewer sees them: what does not depend on the light. Internal to this room.
#pragma once
#include "bake/light/bsdf.h"
#include "bake/light/ggx_albedo.h"

namespace bake {

inline constexpr float least_n_v = 1e-4f; ///< ggx, mirror: a viewer farther down is moved up to this cosine

/// A lobe as seen by the viewer.
struct SeenLobe {
    float choice = 0;          ///< probability that sample() picks the lobe
    float multiple_choice = 0; ///< ggx: and its light of several bounces
    float exponent = 0;
    GgxRow row;
    Vec3f f0{0}, multiple{0}; ///< ggx: reflectance at normal incidence, and that of light of several bounces
    GgxAlbedo at_v, average;

    /// Directional albedo of ggx.
    Vec3f reflected(const GgxAlbedo& a) const noexcept {
        return f0 * (1 - a.loss - a.schlick) + Vec3f(a.schlick) + multiple * a.loss;
    }
};

struct BsdfView {
    Vec3f n, v;
    Vec3f raised; ///< v, moved up to the horizon if it is below
    float n_raised;
    std::array<SeenLobe, Bsdf::most_lobes> seen;
    int count;
    Vec3f cover{1},
        cover_mean{1}; ///< what the ggx lobes leave to covered lobes: for v, and as mean over all directions
};

BsdfView view_of(const Bsdf& bsdf, const Vec3f& n, const Vec3f& v) noexcept;

/// Albedo for choosing lobes, per unit of weight where the lobe has one: of phong and blinn at normal incidence.
Vec3f estimated_albedo(const Lobe& lobe, const SeenLobe& seen, const BsdfView& view) noexcept;

inline Vec3f mirrored(const Vec3f& v, const Vec3f& n) noexcept { return 2 * glm::dot(n, v) * n - v; }

} // namespace bake
