#include "bake/picture/colour.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

/// Whether two curves differ by less than half a level of 8 bits where a level is encoded.
bool is_close(const ToneCurve& curve, const ToneCurve& other) noexcept {
    for (int level = 0; level <= 255; ++level) {
        const double x = level / 255.0, half = 0.5 / 255;
        if (curve(x) < other(std::max(0.0, x - half)) - 1e-6 || curve(x) > other(std::min(1.0, x + half)) + 1e-6)
            return false;
    }
    return true;
}

} // namespace

double ToneCurve::operator()(double x) const noexcept {
    if (samples.empty()) return x >= d ? std::pow(std::max(0.0, a * x + b), g) + e : c * x + f;
    const double at = std::clamp(x, 0.0, 1.0) * double(samples.size() - 1);
    const auto low = std::min(std::size_t(at), samples.size() - 1), high = std::min(low + 1, samples.size() - 1);
    return samples[low] + (at - double(low)) * (double(samples[high]) - samples[low]);
}

ToneCurve power_curve(double exponent) { return {.g = exponent}; }

ToneCurve srgb_curve() { return {.g = 2.4, .a = 1 / 1.055, .b = 0.055 / 1.055, .c = 1 / 12.92, .d = 0.04045}; }

bool ToneCurve::is_srgb() const noexcept { return is_close(*this, srgb_curve()); }
bool ToneCurve::is_linear() const noexcept { return is_close(*this, ToneCurve{}); }

bool ColourTag::is_srgb() const noexcept {
    return !curves.empty() && std::all_of(curves.begin(), curves.end(), [](const ToneCurve& c) { return c.is_srgb(); });
}

float linear_to_srgb(float linear) noexcept {
    if (!(linear > 0)) return 0;
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

} // namespace bake
