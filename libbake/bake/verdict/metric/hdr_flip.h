// FLIP of pictures with a high dynamic range: the largest FLIP error of each pixel over all exposures at which the reference
// can be looked at.
// Andersson, Nilsson, Shirley and Akenine-Moller, "Visualizing Errors in Rendered High Dynamic Range Images", Eurographics
// 2021, short papers; and the same with Oskarsson and Astrom, "Visualizing the Error in Rendered High Dynamic Range Images",
// Journal of Computer Graphics Techniques 2021.
//
//   tone       t(x) = x (2.51 x + 0.03) / (x (2.43 x + 0.59) + 0.14) with x = 0.6 * 2^e L, clamped to [0, 1]: the ACES curve
//              in the fit of Narkowicz, 2015; t is linear light
//   exposures  from the one at which the brightest luminance of the reference has t = 0.85 to the one at which the median
//              luminance has t = 0.85, in steps of at most one stop
#pragma once
#include "bake/verdict/metric/flip.h"

namespace bake {

class Progress;

struct ExposureRange {
    double start = 0, stop = 0; ///< stops
    int count = 2;              ///< at least 2, evenly spaced, both ends included
    double at(int i) const noexcept { return start + i * (stop - start) / (count - 1); }
};

/// Of linear RGB. Pixels that are not above 0 count in the median, unless the median is one of them: then the median of the
/// others is taken. 0 to 0 for a black picture.
ExposureRange exposure_range(const Image<float>& reference);

/// The curve t, before 0.6 is multiplied: of 2^e L.
double aces_curve(double exposed) noexcept;

/// As flip(); the pictures are linear RGB without an upper bound, and negative values count as 0. `progress` advances by one
/// unit per exposure.
Image<float> hdr_flip(const Image<float>& reference, const Image<float>& test, const ExposureRange& range,
                      const FlipOptions& options = {}, Progress* progress = nullptr);

} // namespace bake
