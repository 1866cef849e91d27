#include "bake/environment/engine/encoding_error.h"
#include "bake/environment/sky/solid_angle.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

/// Weighted by solid angle.
EncodingError error_of(const Cube& truth, const Image<float>& stored, float largest) {
    const int n = truth.size();
    const std::vector<double> omega = texel_solid_angles(n);
    double light = 0, found = 0;
    EncodingError error;
    const auto each = [&](auto&& use) {
        for (int face = 0; face < 6; ++face)
            for (int y = 0; y < n; ++y)
                for (int i = 0; i < 3 * n; ++i)
                    use(omega[std::size_t(y * n + i / 3)], double(truth.faces[std::size_t(face)].row(y)[i]),
                        double(stored.row(face * n + y)[std::size_t(i / 3) * stored.channels() + i % 3]));
    };
    each([&](double w, double value, double read) {
        light += w * value, found += w * read;
        error.over += value > double(largest);
    });
    const double total = 3 * 4 * pi, mean = light / total;
    if (!(mean > 0)) return error;
    each([&](double w, double value, double read) {
        const double e = read - value, r = e / (std::abs(value) + mean);
        error.rmse += w * e * e / total, error.relative += w * r * r / total;
    });
    error.rmse = std::sqrt(error.rmse) / mean;
    error.relative = std::sqrt(error.relative);
    error.flux = std::abs(found / light - 1);
    return error;
}

} // namespace

EncodingError encoding_error(std::span<const Cube> truth, const std::vector<Image<float>>& stored, float largest) {
    EncodingError worst;
    for (std::size_t k = 0; k < truth.size(); ++k) {
        const EncodingError error = error_of(truth[k], stored[k], largest);
        worst.rmse = std::max(worst.rmse, error.rmse);
        worst.relative = std::max(worst.relative, error.relative);
        worst.flux = std::max(worst.flux, error.flux);
        worst.over += error.over;
    }
    return worst;
}

} // namespace bake
