#include "bake/verdict/image_check.h"
#include "bake/base/parallel.h"
#include "bake/base/vec.h"
#include <algorithm>
#include <cmath>
#include <limits>

namespace bake {
namespace {

constexpr int chunk_rows = 64;

// Sums over a chunk of rows. Chunks are added in their order, so that the result does not depend on threads.
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
    std::vector<double> step_x(h, 0), step_y(h, 0); // sums per row; step_y[y] is the step to the next row, with wrap
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

std::vector<Sums> channel_sums(const Image<float>& image) {
    const int channels = image.channels();
    std::vector<Sums> chunks(std::size_t((image.height() + chunk_rows - 1) / chunk_rows) * channels);
    for_rows(image.height(), chunk_rows, [&](std::int64_t begin, std::int64_t end) {
        Sums* own = &chunks[std::size_t(begin / chunk_rows) * channels];
        for (auto y = int(begin); y < int(end); ++y)
            for (int x = 0; x < image.width(); ++x)
                for (int c = 0; c < channels; ++c) own[c].add(image.at(x, y, c));
    });
    std::vector<Sums> sums(channels);
    for (std::size_t i = 0; i < chunks.size(); ++i) sums[i % std::size_t(channels)].add(chunks[i]);
    return sums;
}

void set_range(const Sums& sums, ChannelCheck& check) {
    check.nan = sums.nan;
    check.inf = sums.inf;
    if (sums.count == 0) return;
    check.min = sums.min;
    check.max = sums.max;
    check.mean = sums.sum / double(sums.count);
}

void set_levels(const Levels& levels, ChannelCheck& check) {
    check.levels = levels.count;
    check.true_bits = levels.true_bits;
    check.least_step = levels.least_step;
}

void measure_grey(const Image<float>& image, ImageCheck& check) {
    check.grey = check.channels.front();
    if (check.colour_channels > 1) {
        Sums sums;
        const Plane plane{&image, 0, check.colour_channels};
        for_values(plane, [&](float v) { return sums.add(v), true; });
        sums.nan = std::size_t(image.width()) * image.height() - sums.count;
        check.grey = {};
        set_range(sums, check.grey);
        set_levels(count_levels(plane, check.info, sums.count > 0), check.grey);
    }
    check.grey.name = "grey";
    const int bits = check.channels.front().true_bits;
    if (bits > 0) {
        check.grey_step = 1 / (std::ldexp(1.0, bits) - 1);
    } else if (const double level = level_step(check.info); level > 0) {
        check.grey_step = level;
    } else if (const double largest = std::max(std::abs(check.grey.min), std::abs(check.grey.max)); largest > 0) {
        // The step between floats just below the largest value.
        check.grey_step =
            std::ldexp(1.0, int(std::ceil(std::log2(largest))) - (check.info.type == SampleType::half ? 11 : 24));
    }
}

// The mean of tangent-space normals is perpendicular to the surface, and they point outward. Colours rarely do both.
Looks guess_purpose(const ImageCheck& check) {
    const bool constant = std::all_of(check.channels.begin(), check.channels.begin() + check.colour_channels,
                                      [](const ChannelCheck& c) { return c.min == c.max; });
    if (constant) return Looks::constant;
    const std::size_t colours = check.channels.size() - (check.info.alpha_channel >= 0);
    if (colours == 2 || colours > 4) return Looks::data;
    if (check.colour_channels < 3 || (check.tint <= grey_tint && check.mean_tint <= grey_mean_tint)) return Looks::grey;
    const Vec3d n = check.mean_normal;
    const bool upright = std::abs(n.x) < 0.15 && std::abs(n.y) < 0.15 && n.z > 0.1 && check.inward < 0.1;
    const bool unit = std::abs(check.normal_length - 1) < 0.05;
    const bool is_perpendicular = std::abs(n.x) < 0.05 && std::abs(n.y) < 0.05 && check.normal_length < 0.98;
    return upright && (unit || is_perpendicular) ? Looks::normal_map : Looks::colour;
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
    const std::vector<Sums> sums = channel_sums(image);
    for (int c = 0; c < channels; ++c) {
        ChannelCheck channel;
        channel.name = std::size_t(c) < info.channels.size() ? info.channels[c] : std::to_string(c);
        for (char& letter : channel.name)
            if (letter < ' ' || letter > '~') letter = '?';
        set_range(sums[c], channel);
        set_levels(count_levels({&image, c}, info, sums[c].count > 0), channel);
        check.true_bits = std::max(check.true_bits, channel.true_bits);
        check.channels.push_back(channel);
    }
    // Alpha is the last channel in every format. A single channel is data even if it is named alpha.
    const int before_alpha = info.alpha_channel > 0 ? info.alpha_channel : channels;
    check.colour_channels = before_alpha >= 3 ? 3 : 1;
    measure_colour(image, check.colour_channels, check);
    check.tiling = measure_tiling(image, check.colour_channels);
    check.looks = guess_purpose(check);
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
