// Directional albedo of the GGX lobe with height-correlated Smith masking, from a small table.
//
//   E(mu, alpha)  = integral of D G2 / (4 n.v) over l, with mu = n.v: what reflectance 1 gives
//   E5(mu, alpha) = the same with the factor (1 - v.h)^5
//
// With Schlick's reflectance F = F0 + (1 - F0) (1 - v.h)^5 the lobe has the albedo F0 (E - E5) + E5. 1 - E is the light of
// paths that meet the surface more than once, which the lobe leaves out.
//
// Walter et al., Microfacet Models for Refraction through Rough Surfaces, EGSR 2007. Heitz, Understanding the
// Masking-Shadowing Function in Microfacet-Based BRDFs, JCGT 2014. The table is computed on first use, by any thread.
#pragma once
#include "bake/base/vec.h"
#include <array>

namespace bake {

/// The smallest alpha of the table and of the lobe: a smoother surface is taken as this one.
inline constexpr float least_ggx_alpha = 1e-4f;

struct GgxAlbedo {
    float loss = 0;    ///< 1 - E, at least 0
    float schlick = 0; ///< E5
};

/// The table at one alpha, which is clamped to [least_ggx_alpha, 1]: to be looked up at several angles.
struct GgxRow {
    float alpha = 1;
    int first = 0; ///< of four rows to interpolate, with their weights
    std::array<float, 4> weight{};
};
GgxRow ggx_row(float alpha) noexcept;

/// At the cosine `mu` of the angle to the normal, in [0, 1]. Largest error of E 6e-4, of E5 1.2e-3.
GgxAlbedo ggx_albedo(const GgxRow& row, float mu) noexcept;

/// The integrals themselves, by quadrature, some microseconds long. alpha in [least_ggx_alpha, 1], mu in (0, 1].
GgxAlbedo integrated_ggx_albedo(double alpha, double mu) noexcept;

/// Mean of ggx_albedo() over the hemisphere, weighted by mu: 2 times the integral of it times mu over mu.
GgxAlbedo ggx_mean_albedo(const GgxRow& row) noexcept;

/// A direction to the z axis for the light of several bounces, whose value is in proportion to the loss: that is large for mu
/// near alpha alone. `u` in [0, 1). The density mu / (pi (mu^2 + alpha^2) ln(1 + 1 / alpha^2)) follows it within a small
/// factor, where a density in proportion to mu would give factors of 1 / alpha^2.
Vec3f sample_ggx_loss(float alpha, const Vec2f& u) noexcept;
float ggx_loss_density(float alpha, float mu) noexcept;

} // namespace bake
