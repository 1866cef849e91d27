#include "bake/verdict/image_check.h"
#include "bake/base/parallel.h"
#include "bake/base/vec.h"
#include "bake/relief/height/sample_type.h"
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
    if (is_signed_integer(check.info)) {
        check.grey_step = level_step(check.info);
    } else if (bits > 0) {
        check.grey_step = 1 / (std::ldexp(1.0, bits) - 1);
    } else if (const double level = level_step(check.info); level > 0) {
        check.grey_step = level;
    } else if (const double largest = std::max(std::abs(check.grey.min), std::abs(check.grey.max)); largest > 0) {
        // The step between floats just below the largest value.
        check.grey_step =
            std::ldexp(1.0, int(std::ceil(std::log2(largest))) - (check.info.type == SampleType::half ? 11 : 24));
    }
}

} // namespace

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
    check.colour_channels = colour_channels(info, channels);
    check.kind = guess_kind(image, info);
    check.tiling = measure_tiling(image, check.colour_channels);
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
