#include "bake/verdict/metric/ssim.h"
#include "bake/base/parallel.h"
#include "bake/verdict/metric/separable.h"
#include <cassert>
#include <vector>

namespace bake {
namespace {

constexpr int radius = ssim_window / 2, band_rows = 32;

/// The weighted means, over the windows of `count` rows from `first` on, of what `value` gives for a pixel of both pictures.
template <class Value>
Rows<double> window_means(const Image<float>& a, const Image<float>& b, const std::vector<double>& weights, int first,
                          int count, const Value& value) {
    Rows<double> rows(a.width() - 2 * radius, count + 2 * radius, radius);
    for (int i = 0; i < rows.count(); ++i) {
        const float *row_a = a.row(first + i), *row_b = b.row(first + i);
        double* out = rows[i] - radius;
        for (int x = 0; x < a.width(); ++x) out[x] = value(double(row_a[x]), double(row_b[x]));
    }
    return along_columns(along_rows(rows, weights), weights, radius);
}

} // namespace

Ssim ssim(const Image<float>& reference, const Image<float>& test, double peak) {
    const int width = reference.width() - 2 * radius, height = reference.height() - 2 * radius;
    assert(width > 0 && height > 0 && reference.channels() == 1 && test.channels() == 1);
    assert(test.width() == reference.width() && test.height() == reference.height());
    const double c1 = 0.01 * peak * 0.01 * peak, c2 = 0.03 * peak * 0.03 * peak;
    const std::vector<double> weights = gaussian_weights(1.5, radius);
    Ssim result{.errors = Image<float>(width, height, 1)};
    std::vector<double> of_rows(height);
    for_rows(height, band_rows, [&](std::int64_t begin, std::int64_t end) {
        const auto means = [&](const auto& value) {
            return window_means(reference, test, weights, int(begin), int(end - begin), value);
        };
        const Rows<double> mean_a = means([](double a, double) { return a; }),
                           mean_b = means([](double, double b) { return b; }),
                           mean_aa = means([](double a, double) { return a * a; }),
                           mean_bb = means([](double, double b) { return b * b; }),
                           mean_ab = means([](double a, double b) { return a * b; });
        for (int i = 0; i < int(end - begin); ++i)
            for (int x = 0; x < width; ++x) {
                const double a = mean_a[i][x], b = mean_b[i][x];
                const double var_a = mean_aa[i][x] - a * a, var_b = mean_bb[i][x] - b * b, cov = mean_ab[i][x] - a * b;
                const double similar =
                    (2 * a * b + c1) * (2 * cov + c2) / ((a * a + b * b + c1) * (var_a + var_b + c2));
                of_rows[begin + i] += similar;
                result.errors.at(x, int(begin) + i) = float(1 - similar);
            }
    });
    double sum = 0;
    for (const double row : of_rows) sum += row;
    result.mean = sum / (double(width) * height);
    return result;
}

Image<float> luma(const Image<float>& picture) {
    const int channels = picture.channels();
    Image<float> grey(picture.width(), picture.height(), 1);
    for_rows(picture.height(), 64, [&](std::int64_t begin, std::int64_t end) {
        for (auto y = int(begin); y < int(end); ++y) {
            const float* p = picture.row(y);
            for (int x = 0; x < picture.width(); ++x, p += channels)
                grey.at(x, y) = channels < 3 ? p[0] : float(0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2]);
        }
    });
    return grey;
}

} // namespace bake
