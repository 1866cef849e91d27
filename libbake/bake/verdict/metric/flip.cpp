#include "bake/verdict/metric/flip.h"
#include "bake/base/parallel.h"
#include "bake/verdict/metric/flip_filters.h"
#include <algorithm>
#include <cassert>
#include <cmath>

namespace bake {
namespace {

constexpr int band_rows = 64;

/// Distances of colours mapped to [0, 1]: section 4.1.3. The largest one, between green and blue, becomes 1; those below 0.4
/// of it take the range to 0.95.
class Redistribution {
public:
    explicit Redistribution(const FlipColour& space) noexcept
        : largest_(powered(hyab(hunt(space.lab({0, 1, 0})), hunt(space.lab({0, 0, 1}))))) {}
    float operator()(float distance) const noexcept {
        constexpr float knee = 0.95f;
        const float power = powered(distance), limit = 0.4f * largest_;
        if (power < limit) return knee / limit * power;
        return std::min(1.0f, knee + (power - limit) / (largest_ - limit) * (1 - knee));
    }

private:
    static float powered(float distance) noexcept { return std::pow(distance, 0.7f); }
    float largest_;
};

float feature_difference(const FlipBand& a, const FlipBand& b, std::size_t i) noexcept {
    const float edge = std::abs(a.edge[i] - b.edge[i]), point = std::abs(a.point[i] - b.point[i]);
    return std::min(1.0f, std::sqrt(std::max(edge, point) / std::sqrt(2.0f)));
}

} // namespace

Image<float> flip(const Image<float>& reference, const Image<float>& test, const FlipOptions& options) {
    assert(reference.width() == test.width() && reference.height() == test.height());
    assert(reference.channels() == 3 && test.channels() == 3);
    const FlipFilters filters(options.pixels_per_degree);
    const FlipColour space;
    const Redistribution redistributed(space);
    Image<float> errors(reference.width(), reference.height(), 1);
    for_rows(errors.height(), band_rows, [&](std::int64_t begin, std::int64_t end) {
        const FlipBand a = flip_band(reference, filters, space, int(begin), int(end));
        const FlipBand b = flip_band(test, filters, space, int(begin), int(end));
        float* out = errors.row(int(begin));
        for (std::size_t i = 0; i < a.colour.size(); ++i)
            out[i] = std::pow(redistributed(hyab(a.colour[i], b.colour[i])), 1 - feature_difference(a, b, i));
    });
    return errors;
}

} // namespace bake
