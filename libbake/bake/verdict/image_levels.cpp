#include "bake/verdict/image_levels.h"
#include "bake/relief/height/sample_type.h"
#include "bake/relief/map/error_budget.h"
#include <algorithm>
#include <bit>
#include <cmath>

namespace bake {
namespace {

bool whole_numbers(SampleType type) noexcept { return type == SampleType::u8 || type == SampleType::u16; }

// Distinct values of integer samples in ascending order. They are multiples of 1 / largest.
std::vector<float> distinct_levels(const Plane& plane, int largest) {
    std::vector<char> used(std::size_t(largest) + 1, 0);
    for_values(plane, [&](float v) {
        const float level = v * float(largest) + 0.5f;
        if (level >= 0 && level < float(largest) + 1) used[std::size_t(level)] = 1;
        return true;
    });
    std::vector<float> values;
    for (int level = 0; level <= largest; ++level)
        if (used[level]) values.push_back(float(level) / float(largest));
    return values;
}

// Distinct values in ascending order; empty if there are more than most_levels.
std::vector<float> distinct_values(const Plane& plane) {
    constexpr std::uint32_t slots = 4 * most_levels;
    std::vector<std::uint32_t> table(slots, 0); // bits of the value + 1, which is never 0 for a finite value
    std::vector<float> values;
    std::uint32_t last = 0;
    for_values(plane, [&](float v) {
        const std::uint32_t key = std::bit_cast<std::uint32_t>(v + 0.0f) + 1; // turns -0 into 0
        if (key == last) return true;
        last = key;
        std::uint32_t slot = key * 2654435761u >> 14;
        while (table[slot] != 0 && table[slot] != key) slot = (slot + 1) % slots;
        if (table[slot] == key) return true;
        table[slot] = key;
        values.push_back(v);
        return values.size() <= std::size_t(most_levels);
    });
    if (values.size() > std::size_t(most_levels)) values.clear();
    std::sort(values.begin(), values.end());
    return values;
}

// Smallest number of bits n < stored such that every value is a multiple of 1 / (2^n - 1), or an integer whose lower
// stored - n bits are zero; `stored` if there is none.
int bits_of_integers(const std::vector<float>& values, int stored) {
    const double file_levels = std::ldexp(1.0, stored) - 1;
    for (int n = 1; n < stored; ++n) {
        const double levels = std::ldexp(1.0, n) - 1;
        if (levels + 1 < double(values.size())) continue;
        const auto holds = [&](float v) {
            const double nearest = std::round(v * levels) / levels;
            return std::abs(std::round(nearest * file_levels) - v * file_levels) < 0.25;
        };
        const auto shifted = [&](float v) {
            return std::fmod(std::round(v * file_levels), std::ldexp(1.0, stored - n)) == 0;
        };
        if (std::all_of(values.begin(), values.end(), holds)) return n;
        if (std::all_of(values.begin(), values.end(), shifted)) return n;
    }
    return stored;
}

// Smallest number of bits n such that every float is a multiple of 1 / (2^n - 1), up to the rounding of the type; 0 if
// there is none up to 16, or if the rounding is so coarse that most floats would pass.
int bits_of_floats(const std::vector<float>& values) {
    if (values.size() < 2 || values.front() < 0 || values.back() > 1) return 0;
    const bool half = std::all_of(values.begin(), values.end(), [](float v) { return as_half(v) == v; });
    const double rounding = half ? 0x1p-11 : 0x1p-22; // at least half a step, relative to the value
    for (int n = 1; n <= 16; ++n) {
        const double levels = std::ldexp(1.0, n) - 1;
        if (levels + 1 < double(values.size())) continue;
        if (values.back() * rounding * levels > 0.125) return 0;
        const auto holds = [&](float v) { return std::abs(std::round(v * levels) / levels - v) <= v * rounding; };
        if (std::all_of(values.begin(), values.end(), holds)) return n;
    }
    return 0;
}

// The header's depth, if the values are those of this depth spread over `sample_bits`: not for palettes, whose header
// states the depth of the indices.
bool has_depth(const std::vector<float>& values, int bits, int sample_bits) {
    const double levels = std::ldexp(1.0, bits) - 1, file_levels = std::ldexp(1.0, sample_bits) - 1;
    return std::all_of(values.begin(), values.end(),
                       [&](float v) { return std::abs(std::round(v * levels) / levels - v) * file_levels <= 1; });
}

int true_bits(const std::vector<float>& values, const ImageInfo& info, int sample_bits) {
    if (is_signed_integer(info)) return info.bits;
    if (!whole_numbers(info.type)) return info.type == SampleType::u32 ? info.bits : bits_of_floats(values);
    const int bits = bits_of_integers(values, sample_bits);
    if (info.bits <= 0 || info.bits >= bits || !has_depth(values, info.bits, sample_bits)) return bits;
    return info.bits;
}

} // namespace

Levels count_levels(const Plane& plane, const ImageInfo& info, bool has_finite) {
    const bool whole = whole_numbers(info.type);
    const int sample_bits = info.type == SampleType::u8 ? 8 : 16;
    // The mean of n channels is a multiple of 1 / n of a level.
    const int largest = ((1 << sample_bits) - 1) * plane.count;
    const std::vector<float> values = whole ? distinct_levels(plane, largest) : distinct_values(plane);
    const bool too_many = values.size() > std::size_t(most_levels) || (values.empty() && has_finite);
    Levels levels;
    levels.count = too_many ? most_levels + 1 : int(values.size());
    for (std::size_t i = 1; i < values.size(); ++i) {
        const double step = double(values[i]) - values[i - 1];
        if (i == 1 || step < levels.least_step) levels.least_step = step;
    }
    if (plane.count > 1) return levels;
    levels.true_bits = true_bits(values, info, sample_bits);
    return levels;
}

} // namespace bake
