// The mip chain of a normal map, with what each level loses: lengths of mean normals and moments of slopes.
//
// Each level is the exact box filter of the finest one: means over rectangles that tile the picture, also where sizes are not
// powers of two. Mean normals are shorter than 1 and are carried on as they are; only the normals that are written have unit
// length. Slopes are s = -(n_x, n_y) / n_z. Their first and second moments can be averaged (Olano and Baker, LEAN Mapping, I3D
// 2010), so that their variance within a texel of any level is exact.
#pragma once
#include "bake/picture/image.h"
#include <vector>

namespace bake {

/// One level: max(1, size >> level) texels along each side.
struct NormalLevel {
    Image<float> normal;  ///< unit vectors, 3 channels in [-1,1]; (0, 0, 1) where the mean is zero
    Image<float> length;  ///< of the mean normals, 1 channel in [0,1]
    Image<float> moments; ///< E s_u, E s_v, E s_u^2, E s_v^2, E s_u s_v
};

/// Slopes are those of normals tilted by at most 89.4 degrees: n_z counts as at least this.
inline constexpr float least_slope_z = 0.01f;

/// All levels, from the picture itself down to one texel, of a tangent-space normal map whose three channels are (n + 1) / 2.
/// Vectors are normalised first; a zero vector counts as (0, 0, 1). `directx`: green is inverted, and is turned back for
/// s_v only: `normal` keeps the sign that is stored.
std::vector<NormalLevel> normal_mips(const Image<float>& map, bool directx = false);

/// Variance of the slopes within a texel, per axis: half the trace of their covariance, at least 0.
float slope_variance(const float* moments) noexcept;

/// Roughness (perceptual, alpha = roughness^2, one channel in [0,1]) with which a material of `roughness` is shaded at this
/// level: alpha'^2 = alpha^2 + 2 V, V = slope_variance(). A Beckmann distribution of alpha has slopes of variance
/// alpha^2 / 2 along each axis, and variances of independent slopes add; GGX of the same alpha is taken as equivalent (Kaplanyan,
/// Hill, Patney and Lefohn, Filtering Distributions of Normals for Shading Antialiasing, HPG 2016).
Image<float> roughness_map(const NormalLevel& level, float roughness);

} // namespace bake
