#include "bake/verdict/metric/hdr_flip.h"
#include "bake/base/parallel.h"
#include "bake/base/progress.h"
#include <algorithm>
#include <cmath>
#include <vector>

namespace bake {
namespace {

// t(x) = x (a x + b) / (x (c x + d) + e), with x = 0.6 * 2^e L.
constexpr double a = 2.51, b = 0.03, c = 2.43, d = 0.59, e = 0.14, scale = 0.6;

/// The exposed luminance whose tone is 0.85: the positive root of (a - 0.85 c) x^2 + (b - 0.85 d) x - 0.85 e = 0.
double exposed_at_limit() noexcept {
    constexpr double t = 0.85, p = a - t * c, q = b - t * d, r = -t * e;
    return (-q + std::sqrt(q * q - 4 * p * r)) / (2 * p) / scale;
}

/// Between the two middle values if they are two. Reorders the values.
double median(std::vector<double>& values) {
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return values.size() % 2 == 1 ? *middle : (*std::max_element(values.begin(), middle) + *middle) / 2;
}

Image<float> toned(const Image<float>& picture, double exposure) {
    Image<float> out(picture.width(), picture.height(), 3);
    const double factor = std::exp2(exposure);
    const std::size_t row = std::size_t(picture.width()) * 3;
    for_rows(picture.height(), 64, [&](std::int64_t begin, std::int64_t end) {
        for (auto y = int(begin); y < int(end); ++y)
            for (std::size_t i = 0; i < row; ++i)
                out.row(y)[i] = float(std::min(1.0, aces_curve(factor * picture.row(y)[i])));
    });
    return out;
}

} // namespace

double aces_curve(double exposed) noexcept {
    const double x =
        std::clamp(scale * exposed, 0.0, 1e9); // squares of larger ones could overflow; t is at its limit there
    return x * (a * x + b) / (x * (c * x + d) + e);
}

ExposureRange exposure_range(const Image<float>& reference) {
    std::vector<double> luminance;
    luminance.reserve(reference.size() / 3);
    for (std::size_t i = 0; i + 2 < reference.size(); i += 3) {
        const float* p = reference.data() + i;
        luminance.push_back(std::max(0.0, 0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2]));
    }
    if (luminance.empty()) return {};
    const double brightest = *std::max_element(luminance.begin(), luminance.end());
    if (brightest == 0) return {};
    double middle = median(luminance);
    if (middle == 0) {
        std::erase(luminance, 0.0);
        middle = median(luminance);
    }
    const double limit = std::log2(exposed_at_limit());
    ExposureRange range{limit - std::log2(brightest), limit - std::log2(middle)};
    range.count = std::max(2, int(std::ceil(range.stop - range.start)));
    return range;
}

Image<float> hdr_flip(const Image<float>& reference, const Image<float>& test, const ExposureRange& range,
                      const FlipOptions& options, Progress* progress) {
    Image<float> largest;
    for (int i = 0; i < range.count; ++i) {
        // The pictures are what they were at an exposure just done, unless the range is wider than 0.
        if (i > 0 && range.stop == range.start) break;
        Image<float> errors = flip(toned(reference, range.at(i)), toned(test, range.at(i)), options);
        if (largest.empty()) largest = std::move(errors);
        else
            for (std::size_t k = 0; k < largest.size(); ++k)
                largest.data()[k] = std::max(largest.data()[k], errors.data()[k]);
        if (progress) progress->add(1);
    }
    return largest;
}

} // namespace bake
