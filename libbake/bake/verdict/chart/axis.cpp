#include "bake/verdict/chart/axis.h"
#include "bake/base/text.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

double at_px(const Axis& axis, double position) noexcept {
    return axis.start_px + (position - axis.low) / (axis.high - axis.low) * (axis.end_px - axis.start_px);
}

/// digit times ten to the exponent. From the two numbers, so that no rounding shows: 0.001 ... 50000, else 2e-7.
std::string power_text(int digit, int exponent) {
    if (exponent < -3 || exponent > 4) return format("%de%d", digit, exponent);
    return format("%.*f", std::max(0, -exponent), digit * std::pow(10.0, exponent));
}

/// The step of about `wanted` ticks over a span: 1, 2 or 5 times a power of ten, whichever is nearest by its factor.
double even_step(double span, int wanted) {
    const double even = span / wanted, power = std::pow(10.0, std::floor(std::log10(even))), digit = even / power;
    return power * (digit < std::sqrt(2.0) ? 1 : digit < std::sqrt(10.0) ? 2 : digit < std::sqrt(50.0) ? 5 : 10);
}

std::vector<Tick> even_ticks(const Axis& axis, int wanted) {
    const auto value = [&](double position) { return axis.logarithmic ? std::pow(10.0, position) : position; };
    const double low = value(axis.low), high = value(axis.high), step = even_step(high - low, wanted);
    std::vector<Tick> out;
    for (double k = std::ceil(low / step); k * step <= high && out.size() < 100; ++k) {
        const double at = k * step + 0.0; // 0, not -0
        out.push_back({at_px(axis, axis.logarithmic ? std::log10(at) : at), format("%.6g", at)});
    }
    return out;
}

std::vector<Tick> power_ticks(const Axis& axis, int wanted) {
    const int first = int(std::floor(axis.low)), last = int(std::ceil(axis.high));
    const double decades = axis.high - axis.low;
    const int every = std::max(1, int(std::ceil(decades / wanted)));
    std::vector<Tick> out;
    for (int exponent = first; exponent <= last; ++exponent)
        for (int digit = 1; digit < 10; ++digit) {
            const double position = exponent + std::log10(digit);
            if (position < axis.low || position > axis.high) continue;
            const bool minor = digit == 1 ? exponent % every != 0 : decades < 3 ? digit != 2 && digit != 5 : true;
            if (minor && every > (digit > 1 ? 1 : 4)) continue; // too close to each other
            out.push_back({at_px(axis, position), minor ? "" : power_text(digit, exponent)});
        }
    return out;
}

} // namespace

bool is_drawable(double value) noexcept { return std::abs(value) <= 1e300; }

bool has_position(const Axis& axis, double value) noexcept {
    return is_drawable(value) && (!axis.logarithmic || value > 0);
}

Axis axis_of(const std::vector<double>& values, bool logarithmic) {
    Axis axis;
    axis.logarithmic = logarithmic;
    for (const double value : values) {
        if (!is_drawable(value)) continue;
        if (!has_position(axis, value)) {
            axis.strip = true;
            continue;
        }
        const double position = logarithmic ? std::log10(value) : value;
        axis.low = axis.empty ? position : std::min(axis.low, position);
        axis.high = axis.empty ? position : std::max(axis.high, position);
        axis.empty = false;
    }
    const double least = logarithmic ? std::log10(2.0) : std::max(1e-9 * std::abs(axis.high), 1e-300);
    if (axis.high - axis.low < least) {
        const double half = logarithmic ? least / 2 : axis.high == 0 ? 1 : std::abs(axis.high) / 10;
        const double middle = (axis.low + axis.high) / 2;
        axis.low = middle - half;
        axis.high = middle + half;
    }
    const double margin = 0.06 * (axis.high - axis.low);
    axis.low -= margin;
    axis.high += margin;
    return axis;
}

void lay_axis(Axis& axis, double start_px, double end_px, double strip_width) {
    const double towards = end_px < start_px ? -1 : 1, strip = axis.strip ? strip_width : 0;
    axis.start_px = start_px + towards * strip;
    axis.end_px = end_px;
    axis.strip_px = start_px + towards * strip / 2;
}

double place_px(const Axis& axis, double value) noexcept {
    if (!has_position(axis, value)) return axis.strip_px;
    return at_px(axis, axis.logarithmic ? std::log10(value) : value);
}

std::vector<Tick> ticks(const Axis& axis, int wanted) {
    if (axis.empty) return {};
    return axis.logarithmic && axis.high - axis.low >= 1 ? power_ticks(axis, wanted) : even_ticks(axis, wanted);
}

} // namespace bake
