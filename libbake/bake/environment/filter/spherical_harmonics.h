// Real spherical harmonics of a cube: projection and evaluation.
//
// Orthonormal on the sphere, without the Condon-Shortley sign; x, y, z are cube space:
//   Y_00 = 1 / (2 sqrt pi), Y_1,-1 = sqrt(3 / 4 pi) y, Y_10 = sqrt(3 / 4 pi) z, Y_11 = sqrt(3 / 4 pi) x, ...
#pragma once
#include "bake/environment/sky/cube.h"
#include <vector>

namespace bake {

/// Coefficient (l, m) of channel c is values[(l * l + l + m) * channels + c], m from -l to l, l below bands.
struct ShCoefficients {
    int bands = 0, channels = 0;
    std::vector<double> values; ///< bands * bands * channels
};

/// Integrals of L Y_lm by the values at texel centres and exact solid angles. The mean of the sky is subtracted first, so that
/// the coefficients of a constant sky other than the first are exactly 0. bands >= 1. The same for any number of threads.
ShCoefficients project_sh(const Cube& sky, int bands);

/// The series at the centre of every texel of a cube of `size` texels along an edge.
Cube evaluate_sh(const ShCoefficients& series, int size);

/// Multiplies band l by factors[l]: a convolution with a kernel about the direction itself. bands factors.
void scale_bands(ShCoefficients& series, const std::vector<double>& factors);

/// The same sky in a space whose x points the other way: from cube space to the world, and back.
void mirror_x(ShCoefficients& series) noexcept;

/// Band factors of the clamped cosine: pi, 2 pi / 3, pi / 4, 0, -pi / 24, 0, pi / 64, ...
std::vector<double> cosine_band_factors(int bands);

} // namespace bake
