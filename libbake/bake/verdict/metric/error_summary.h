// What is told of the errors of many pixels.
#pragma once
#include "bake/picture/image.h"
#include <vector>

namespace bake {

/// Of p95 and p99: the smallest error that at least 95 % (99 %) of the pixels do not exceed, which is the error of a pixel.
struct ErrorSummary {
    double mean = 0, p95 = 0, p99 = 0, max = 0;
};

/// All 0 without errors. The mean is summed in double, row by row.
ErrorSummary summarise(const Image<float>& errors);
ErrorSummary summarise(std::vector<double> errors);

} // namespace bake
