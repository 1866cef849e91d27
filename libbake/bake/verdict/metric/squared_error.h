// Squared errors of a picture against another, and the metrics made of them.
//
//   RMSE   sqrt(MSE)
//   PSNR   10 log10(peak^2 / MSE), in dB
#pragma once
#include "bake/picture/image.h"

namespace bake {

struct SquaredErrors {
    Image<float> picture; ///< one channel: the mean over the channels of the squared differences
    double mean = 0;      ///< MSE, summed in double from the differences themselves
};

/// The pictures have one size and the same channels, all of which count; their values are finite.
SquaredErrors squared_errors(const Image<float>& reference, const Image<float>& test);

double rmse(const SquaredErrors& errors) noexcept;
/// Infinity for equal pictures.
double psnr(const SquaredErrors& errors, double peak = 1) noexcept;

} // namespace bake
