#include "bake/preview/tone.h"
#include "bake/picture/colour.h"
#include <algorithm>
#include <cmath>
#include <vector>

namespace bake {

float shown_value(float radiance, float exposure, Tone tone) noexcept {
    const float x = std::max(0.0f, radiance) * std::exp2(exposure);
    if (tone == Tone::srgb) return linear_to_srgb(std::min(x, 1.0f));
    const float y = std::min(0.6f * x, 1e6f);
    return linear_to_srgb(std::clamp(y * (2.51f * y + 0.03f) / (y * (2.43f * y + 0.59f) + 0.14f), 0.0f, 1.0f));
}

float automatic_exposure(const Image<float>& picture) {
    constexpr double grey = 0.18, brightest = 4;
    std::vector<float> luminance;
    double logs = 0;
    for (std::size_t i = 0; i + 2 < picture.size(); i += std::size_t(picture.channels())) {
        const float* c = picture.data() + i;
        const float y = 0.2126f * c[0] + 0.7152f * c[1] + 0.0722f * c[2];
        if (!(y > 0)) continue;
        luminance.push_back(y);
        logs += std::log2(double(y));
    }
    if (luminance.empty()) return 0;
    const auto high = luminance.begin() + std::ptrdiff_t(double(luminance.size() - 1) * 0.99);
    std::nth_element(luminance.begin(), high, luminance.end());
    const double by_mean = std::log2(grey) - logs / double(luminance.size());
    const double by_highlights = std::log2(brightest) - std::log2(double(*high));
    return 0.0f + float(std::clamp(std::min(std::round(4 * by_mean), std::floor(4 * by_highlights)) / 4, -64.0, 64.0));
}

} // namespace bake
