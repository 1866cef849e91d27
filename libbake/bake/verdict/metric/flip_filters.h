// The filters of FLIP, as weights along one axis, and one band of a picture filtered by them.
#pragma once
#include "bake/picture/image.h"
#include "bake/verdict/metric/flip_colour.h"
#include "bake/verdict/metric/separable.h"
#include <vector>

namespace bake {

/// For one number of pixels per degree.
struct FlipFilters {
    explicit FlipFilters(double pixels_per_degree);

    std::vector<double> luminance, red_green; ///< contrast sensitivity: one Gaussian each
    std::vector<double> blue_yellow[2];       ///< a sum of two Gaussians ...
    double blue_yellow_share[2];              ///< ... with these shares, which sum to 1
    std::vector<double> smooth;               ///< features: a Gaussian ...
    std::vector<double> edge;  ///< ... its first derivative, positive and negative weights summing to 1, -1
    std::vector<double> point; ///< ... its second derivative, with the same sums
    int margin;                ///< the largest radius
};

/// What FLIP compares at each pixel.
struct FlipBand {
    std::vector<Vec3f> colour;      ///< filtered, in Lab after hunt(), row by row
    std::vector<float> edge, point; ///< strength of features
};

/// Rows [begin, end) of a picture with linear RGB, which is clamped to [0, 1].
FlipBand flip_band(const Image<float>& picture, const FlipFilters& filters, const FlipColour& space, int begin,
                   int end);

} // namespace bake
