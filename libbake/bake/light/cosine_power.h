// Powers of cosines: the lobes of Phong and Blinn, their albedo and their sampling.
//
//   Phong (r.v)^n, r = 2 (n.l) n - l       Phong, Illumination for Computer Generated Pictures, CACM 1975
//   Blinn (n.h)^n, h halfway from l to v   Blinn, Models of Light Reflection for Computer Synthesized Pictures, 1977
#pragma once
#include "bake/base/vec.h"

namespace bake {

/// cos^exponent of the angle with this 1 - cos, 0 from 90 degrees on. 1 - cos instead of cos, because a float near 1 has
/// too few digits for exponents of 10^5 and more.
float cosine_power(float one_minus_cos, float exponent) noexcept;

/// The direction to the z axis with the density cosine_power_density() times cos^exponent, from u in [0, 1).
Vec3f sample_cosine_power(float exponent, const Vec2f& u) noexcept;
/// (n + 1) / (2 pi)
float cosine_power_density(float exponent) noexcept;

/// Directional albedo of the lobes at normal incidence, where it is largest.
/// Integral of (r.v)^n over l: 2 pi / (n + 1). With the factor n.l it is 2 pi / (n + 2).
double phong_albedo(double exponent) noexcept;
double phong_cosine_albedo(double exponent) noexcept;
/// Integral of (n.h)^n over l: 8 pi (1 - 2^-(n + 2)/2) / (n + 2), because the angle to l is twice that to h.
double blinn_albedo(double exponent) noexcept;
/// The same with n.l = 2 (n.h)^2 - 1: 8 pi (n + 2^(-n/2)) / ((n + 2) (n + 4)). One over it makes the lobe reflect 1 at
/// normal incidence and less elsewhere (Giesen, Derivation of Phong and Blinn-Phong BRDF normalization factors, 2009). The usual
/// (n + 8) / (8 pi) is larger: it reflects up to 1.075 (at n = 8).
double blinn_cosine_albedo(double exponent) noexcept;

} // namespace bake
