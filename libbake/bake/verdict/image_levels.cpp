#include "bake/verdict/image_levels.h"
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

// Smallest number of bits n such that every value is a multiple of 1 / (2^n - 1), or an integer whose lower stored - n bits
// are zero. The values have `stored` bits, or are floats if `stored` is 0. Returns 0 for floats that need more than 16 bits.
int bits_that_hold(const std::vector<float>& values, int stored) {
    if (values.empty() || values.front() < 0 || values.back() > 1) return 0;
    const int most = stored > 0 ? stored : 16;
    const double file_levels = stored > 0 ? std::ldexp(1.0, stored) - 1 : 0;
    for (int n = 1; n < most; ++n) {
        const double levels = std::ldexp(1.0, n) - 1;
        const auto holds = [&](float v) {
            const double nearest = std::round(v * levels) / levels;
            if (stored == 0) return std::abs(nearest - v) <= v * 0x1p-12; // half a step of a half float
            return std::abs(std::round(nearest * file_levels) - v * file_levels) < 0.25;
        };
        const auto shifted = [&](float v) {
            return std::fmod(std::round(v * file_levels), std::ldexp(1.0, stored - n)) == 0;
        };
        if (levels + 1 < double(values.size())) continue;
        if (std::all_of(values.begin(), values.end(), holds)) return n;
        if (stored > 0 && std::all_of(values.begin(), values.end(), shifted)) return n;
    }
    return stored > 0 ? stored : 0;
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
    const int stored = whole && info.bits > 0 ? std::min(info.bits, sample_bits) : sample_bits;
    if (whole) levels.true_bits = std::min(stored, bits_that_hold(values, sample_bits));
    else if (values.size() > 1) levels.true_bits = bits_that_hold(values, 0); // one float value does not define a depth
    return levels;
}

} // namespace bake
