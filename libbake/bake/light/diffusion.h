// Light that enters a translucent body and leaves it elsewhere: the profile of normalised diffusion.
//
//   R(r) = A (e^(-r/d) + e^(-r/(3d))) / (8 pi d r)      integral of R 2 pi r dr = A
//
// A is the reflectance of a half-space in even light, r the distance from where light enters to where it leaves, and d a
// length that gives the profile of a medium with the mean free path l: d = l / s(A), s = 1.9 - A + 3.5 (A - 0.8)^2, for light that
// enters diffusely. Christensen and Burley, Approximate Reflectance Profiles for Efficient Subsurface Scattering, Pixar
// Technical Memo 15-04, 2015.
#pragma once
#include "bake/base/vec.h"

namespace bake {

/// d of a medium: 0 for a mean free path of 0, where light leaves where it enters.
float diffusion_length(float reflectance, float mean_free_path) noexcept;

/// R / A per area, at the distance r from where light enters; r and d above 0.
float diffusion_profile(float d, float r) noexcept;
/// The share of R within the distance r: 1 - (e^(-r/d) + 3 e^(-r/(3d))) / 4.
float diffusion_within(float d, float r) noexcept;
/// A distance distributed as R 2 pi r / A, from u in [0, 1). That density is the sum of an exponential with the mean d and the
/// weight 1/4 and one with the mean 3 d and the weight 3/4, of which u chooses one.
float sample_diffusion(float d, float u) noexcept;

} // namespace bake
