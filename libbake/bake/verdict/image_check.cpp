#include "bake/verdict/image_check.h"
#include "bake/base/parallel.h"
#include "bake/base/vec.h"
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace bake {
namespace {

constexpr int chunk_rows = 64;

// Sums of one chunk of rows; added up in the order of the chunks.
struct Sums {
    float min = std::numeric_limits<float>::infinity(), max = -std::numeric_limits<float>::infinity();
    double sum = 0;
    std::size_t nan = 0, inf = 0, count = 0;
    void add(float v) noexcept {
        if (v - v == 0) { // finite
            min = std::min(min, v);
            max = std::max(max, v);
            sum += v;
            ++count;
        } else {
            ++(v != v ? nan : inf);
        }
    }
    void add(const Sums& s) noexcept {
        min = std::min(min, s.min);
        max = std::max(max, s.max);
        sum += s.sum;
        nan += s.nan;
        inf += s.inf;
        count += s.count;
    }
};

bool whole_numbers(SampleType type) noexcept { return type == SampleType::u8 || type == SampleType::u16; }

// A channel, or from channel on the mean of several.
struct Plane {
    const Image<float>* image;
    int channel = 0, count = 1;
};

// Calls visit(value) for every finite value until it returns false.
template <class Visit> void for_values(const Plane& plane, const Visit& visit) {
    for (int y = 0; y < plane.image->height(); ++y) {
        const float* v = plane.image->row(y) + plane.channel;
        for (int x = 0; x < plane.image->width(); ++x, v += plane.image->channels()) {
            float value = v[0];
            if (plane.count > 1) {
                for (int c = 1; c < plane.count; ++c) value += v[c];
                value /= float(plane.count);
            }
            if (value - value == 0 && !visit(value)) return;
        }
    }
}

// Distinct values of integer samples in ascending order: whole multiples of 1 / largest.
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

// Distinct values in ascending order, none when there are more than most_levels.
std::vector<float> distinct_values(const Plane& plane) {
    constexpr std::uint32_t slots = 4 * most_levels;
    std::vector<std::uint32_t> table(slots, 0); // bits of the value + 1: no finite value has all bits set
    std::vector<float> values;
    std::uint32_t last = 0;
    for_values(plane, [&](float v) {
        const std::uint32_t key = std::bit_cast<std::uint32_t>(v + 0.0f) + 1; // -0 is 0
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

// Fewest bits n such that every value is one of k / (2^n - 1), stored with `stored` bits (0: as floats); or, in a
// wider integer, has its low bits zero. 0 when 16 do not do.
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

void count_levels(const Plane& plane, const ImageInfo& info, ChannelCheck& check) {
    const bool whole = whole_numbers(info.type);
    const int sample_bits = info.type == SampleType::u8 ? 8 : 16;
    // The mean of n channels lies on levels n times as fine.
    const int largest = ((1 << sample_bits) - 1) * plane.count;
    const std::vector<float> values = whole ? distinct_levels(plane, largest) : distinct_values(plane);
    const std::size_t texels = std::size_t(plane.image->width()) * plane.image->height();
    const bool too_many =
        values.size() > std::size_t(most_levels) || (values.empty() && check.nan + check.inf < texels);
    check.levels = too_many ? most_levels + 1 : int(values.size());
    for (std::size_t i = 1; i < values.size(); ++i) {
        const double step = double(values[i]) - values[i - 1];
        if (i == 1 || step < check.least_step) check.least_step = step;
    }
    if (plane.count > 1) return;
    const int stored = whole && info.bits > 0 ? std::min(info.bits, sample_bits) : sample_bits;
    if (whole) check.true_bits = std::min(stored, bits_that_hold(values, sample_bits));
    else if (values.size() > 1) check.true_bits = bits_that_hold(values, 0); // one float says nothing of bits
}

double finite_or_zero(double v) noexcept { return v - v == 0 ? v : 0; }

double grey(const float* texel, int channels) noexcept {
    double sum = 0;
    for (int c = 0; c < channels; ++c) sum += finite_or_zero(texel[c]);
    return sum / channels;
}

double ratio(double border, double inside) noexcept {
    if (border == 0) return 0;
    return inside > 0 ? border / inside : std::numeric_limits<double>::max();
}

Tiling measure_tiling(const Image<float>& image, int channels) {
    const int w = image.width(), h = image.height();
    std::vector<double> step_x(h, 0), step_y(h, 0); // row sums; step_y[y]: to the row below, the last one wraps
    std::vector<double> wrap_x(h, 0);
    for_rows(h, chunk_rows, [&](std::int64_t begin, std::int64_t end) {
        for (auto y = int(begin); y < int(end); ++y) {
            const float *row = image.row(y), *below = image.row((y + 1) % h);
            double left = grey(row, channels);
            wrap_x[y] = std::abs(grey(row + std::size_t(w - 1) * image.channels(), channels) - left);
            for (int x = 0; x < w; ++x) {
                const double here = grey(row + std::size_t(x) * image.channels(), channels);
                step_x[y] += std::abs(here - left);
                step_y[y] += std::abs(here - grey(below + std::size_t(x) * image.channels(), channels));
                left = here;
            }
        }
    });
    double inside_x = 0, inside_y = 0, border_x = 0;
    for (int y = 0; y < h; ++y) {
        inside_x += step_x[y];
        border_x += wrap_x[y];
        if (y + 1 < h) inside_y += step_y[y];
    }
    return {w > 1 ? ratio(border_x, inside_x / (w - 1)) : 0, h > 1 ? ratio(step_y[h - 1], inside_y / (h - 1)) : 0};
}

struct ColourSums {
    double tint = 0, tint_sum = 0, length = 0;
    Vec3d normal{0};
    std::size_t not_unit = 0, inward = 0;
};

void measure_colour(const Image<float>& image, int channels, ImageCheck& check) {
    std::vector<ColourSums> sums((image.height() + chunk_rows - 1) / chunk_rows);
    for_rows(image.height(), chunk_rows, [&](std::int64_t begin, std::int64_t end) {
        ColourSums& s = sums[begin / chunk_rows];
        for (auto y = int(begin); y < int(end); ++y)
            for (int x = 0; x < image.width(); ++x) {
                const float* texel = &image.at(x, y);
                const auto [low, high] = std::minmax_element(texel, texel + channels);
                const double tint = 255 * finite_or_zero(double(*high) - *low);
                s.tint = std::max(s.tint, tint);
                s.tint_sum += tint;
                if (channels < 3) continue;
                const Vec3d n(2 * finite_or_zero(texel[0]) - 1, 2 * finite_or_zero(texel[1]) - 1,
                              2 * finite_or_zero(texel[2]) - 1);
                const double length = glm::length(n);
                s.length += length;
                s.normal += n;
                s.not_unit += std::abs(length - 1) > 0.02;
                s.inward += n.z < 0;
            }
    });
    ColourSums all;
    for (const ColourSums& s : sums) {
        all.tint = std::max(all.tint, s.tint);
        all.tint_sum += s.tint_sum;
        all.length += s.length;
        all.normal += s.normal;
        all.not_unit += s.not_unit;
        all.inward += s.inward;
    }
    const double texels = double(image.width()) * image.height();
    check.tint = all.tint;
    check.mean_tint = all.tint_sum / texels;
    check.normal_length = all.length / texels;
    check.mean_normal = all.normal / texels;
    check.not_unit = double(all.not_unit) / texels;
    check.inward = double(all.inward) / texels;
}

void measure_grey(const Image<float>& image, ImageCheck& check) {
    check.grey = check.channels.front();
    if (check.colour_channels > 1) {
        Sums sums;
        const Plane plane{&image, 0, check.colour_channels};
        for_values(plane, [&](float v) { return sums.add(v), true; });
        check.grey = {};
        check.grey.nan = std::size_t(image.width()) * image.height() - sums.count;
        if (sums.count > 0) {
            check.grey.min = sums.min;
            check.grey.max = sums.max;
            check.grey.mean = sums.sum / double(sums.count);
        }
        count_levels(plane, check.info, check.grey);
    }
    check.grey.name = "grey";
    const int bits = check.channels.front().true_bits;
    if (bits > 0) {
        check.grey_step = 1 / (std::ldexp(1.0, bits) - 1);
    } else if (const double largest = std::max(std::abs(check.grey.min), std::abs(check.grey.max)); largest > 0) {
        // The step between floats just below the largest value.
        check.grey_step =
            std::ldexp(1.0, int(std::ceil(std::log2(largest))) - (check.info.type == SampleType::half ? 11 : 24));
    }
}

// Tangent-space normals lean nowhere on average and point out of the surface; colours rarely do both.
Looks judge(const ImageCheck& check) {
    const bool constant = std::all_of(check.channels.begin(), check.channels.begin() + check.colour_channels,
                                      [](const ChannelCheck& c) { return c.min == c.max; });
    if (constant) return Looks::constant;
    const std::size_t colours = check.channels.size() - (check.info.alpha_channel >= 0);
    if (colours == 2 || colours > 4) return Looks::data;
    if (check.colour_channels < 3 || (check.tint <= grey_tint && check.mean_tint <= grey_mean_tint)) return Looks::grey;
    const Vec3d n = check.mean_normal;
    const bool upright = std::abs(n.x) < 0.15 && std::abs(n.y) < 0.15 && n.z > 0.1 && check.inward < 0.1;
    const bool unit = std::abs(check.normal_length - 1) < 0.05;
    const bool leans_nowhere = std::abs(n.x) < 0.05 && std::abs(n.y) < 0.05 && check.normal_length < 0.98;
    return upright && (unit || leans_nowhere) ? Looks::normal_map : Looks::colour;
}

} // namespace

const char* name(Looks looks) noexcept {
    switch (looks) {
    case Looks::constant: return "constant";
    case Looks::grey: return "height or mask";
    case Looks::normal_map: return "tangent normal map";
    case Looks::colour: return "colour";
    case Looks::data: break;
    }
    return "data";
}

ImageCheck check_image(const Image<float>& image, const ImageInfo& info) {
    ImageCheck check;
    check.info = info;
    const int channels = image.channels();
    std::vector<Sums> sums(std::size_t((image.height() + chunk_rows - 1) / chunk_rows) * channels);
    for_rows(image.height(), chunk_rows, [&](std::int64_t begin, std::int64_t end) {
        Sums* own = &sums[std::size_t(begin / chunk_rows) * channels];
        for (auto y = int(begin); y < int(end); ++y)
            for (int x = 0; x < image.width(); ++x)
                for (int c = 0; c < channels; ++c) own[c].add(image.at(x, y, c));
    });
    for (int c = 0; c < channels; ++c) {
        Sums all;
        for (std::size_t i = std::size_t(c); i < sums.size(); i += channels) all.add(sums[i]);
        ChannelCheck channel;
        channel.name = std::size_t(c) < info.channels.size() ? info.channels[c] : std::to_string(c);
        for (char& letter : channel.name)
            if (letter < ' ' || letter > '~') letter = '?';
        channel.nan = all.nan;
        channel.inf = all.inf;
        if (all.count > 0) {
            channel.min = all.min;
            channel.max = all.max;
            channel.mean = all.sum / double(all.count);
        }
        count_levels({&image, c}, info, channel);
        check.true_bits = std::max(check.true_bits, channel.true_bits);
        check.channels.push_back(channel);
    }
    // Alpha comes last in every format that has one; a single channel is data whatever its name.
    const int before_alpha = info.alpha_channel > 0 ? info.alpha_channel : channels;
    check.colour_channels = before_alpha >= 3 ? 3 : 1;
    measure_colour(image, check.colour_channels, check);
    check.tiling = measure_tiling(image, check.colour_channels);
    check.looks = judge(check);
    measure_grey(image, check);
    return check;
}

StepSlope step_slope(double step, int width, double amplitude, double extent) noexcept {
    StepSlope s;
    s.per_texel = 0.5 * step;
    s.slope = amplitude * step * width / (2 * extent);
    s.angle_deg = std::atan(s.slope) * 180 / pi;
    if (s.slope > 0) s.one_degree_amplitude = amplitude * std::tan(pi / 180) / s.slope;
    return s;
}

} // namespace bake
