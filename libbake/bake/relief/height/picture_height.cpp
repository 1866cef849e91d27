#include "bake/relief/height/picture_height.h"
#include "bake/base/error.h"
#include "bake/base/parallel.h"
#include "bake/base/shared_loads.h"
#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <iterator>
#include <mutex>
#include <numeric>

namespace bake {
namespace {

/// Weight of each channel of the file in the grey value.
std::vector<float> grey_weights(const std::string& path, const ImageInfo& info, Grey grey) {
    const int count = int(info.channels.size());
    const auto colour = [&](int c) { return c != info.alpha_channel; };
    std::vector<int> colours;
    for (int c = 0; c < count; ++c)
        if (colour(c)) colours.push_back(c);
    const auto missing = [&](const char* what) {
        return Error(Refusal::unsuitable, path + ": has no " + what + " channel; choose another `grey`");
    };
    std::vector<float> weights(count, 0.0f);
    switch (grey) {
    case Grey::mean:
        if (colours.empty()) throw missing("colour");
        colours.resize(std::min(colours.size(), std::size_t(info.colours > 0 ? info.colours : 3)));
        for (const int c : colours) weights[c] = 1;
        break;
    case Grey::luma:
        if (colours.size() < 3) throw missing("colour (luma needs three)");
        weights[colours[0]] = 0.2126f, weights[colours[1]] = 0.7152f, weights[colours[2]] = 0.0722f;
        break;
    case Grey::a:
        if (info.alpha_channel < 0) throw missing("alpha");
        weights[info.alpha_channel] = 1;
        break;
    default: {
        const std::size_t index = grey == Grey::r ? 0 : grey == Grey::g ? 1 : 2;
        if (index >= colours.size()) throw missing(grey == Grey::r ? "red" : grey == Grey::g ? "green" : "blue");
        weights[colours[index]] = 1;
    }
    }
    return weights;
}

constexpr int most_levels = 256; ///< of what counts as an 8-bit height

/// The different values of one channel, sorted; of many, some more than most_levels of them.
std::vector<float> used_levels(const Image<float>& picture, int channel) {
    std::mutex mutex;
    std::vector<float> levels;
    std::atomic<bool> many{false};
    for_rows(picture.height(), 16, [&](std::int64_t begin, std::int64_t end) {
        // Neighbours are often equal, and a short table of recent values contains most other values.
        constexpr std::uint32_t slots = 1024;
        std::vector<float> recent(slots, std::nanf("")), seen;
        for (auto y = int(begin); y < int(end) && !many; ++y) {
            const float* value = picture.row(y) + channel;
            for (int x = 0; x < picture.width(); ++x, value += picture.channels()) {
                float& slot = recent[std::bit_cast<std::uint32_t>(*value) * 2654435761u / (0xffffffffu / slots + 1)];
                if (slot == *value) continue;
                slot = *value;
                const auto at = std::lower_bound(seen.begin(), seen.end(), *value);
                if (at != seen.end() && *at == *value) continue;
                seen.insert(at, *value);
                if (seen.size() > most_levels) break;
            }
        }
        const std::lock_guard lock(mutex);
        std::vector<float> all;
        std::set_union(levels.begin(), levels.end(), seen.begin(), seen.end(), std::back_inserter(all));
        levels = std::move(all);
        if (levels.size() > most_levels) many = true;
    });
    return levels;
}

double smallest_step(const std::vector<float>& levels) {
    double smallest = 0;
    for (std::size_t i = 1; i < levels.size(); ++i) {
        const double step = double(levels[i]) - levels[i - 1];
        if (i == 1 || step < smallest) smallest = step;
    }
    return smallest;
}

void count_levels(HeightTexture& height, const Image<float>& picture, const std::vector<float>& weights) {
    // One channel is counted, not the grey mean: the mean of a slightly tinted 8-bit picture has more than 256 levels.
    const int channel = int(std::max_element(weights.begin(), weights.end()) - weights.begin());
    const std::vector<float> levels = used_levels(picture, channel);
    const bool many = levels.size() > most_levels;
    height.levels = many ? most_levels + 1 : int(levels.size());
    // A 16-bit file with at most 256 levels is an 8-bit height. Levels of palettes are not those of the indices, so that
    // the stored depth counts only where there are more levels than a palette has.
    const double least = height.info.type == SampleType::u8    ? 1.0 / 255
                         : height.info.type == SampleType::u16 ? 1.0 / 65535
                                                               : level_step(height.info);
    height.step = many ? level_step(height.info) : std::max(least, smallest_step(levels));
}

void refuse_bad_values(const std::string& path, const Image<float>& values) {
    // Slopes of larger values could leave the range of float.
    constexpr float largest = 1e12f;
    std::vector<std::int64_t> bad_in_row(values.height());
    for_rows(values.height(), 64, [&](std::int64_t begin, std::int64_t end) {
        for (auto y = begin; y < end; ++y) {
            const float* row = values.row(int(y));
            for (int x = 0; x < values.width(); ++x) bad_in_row[y] += !(std::abs(row[x]) <= largest);
        }
    });
    const auto bad_row = std::find_if(bad_in_row.begin(), bad_in_row.end(), [](std::int64_t bad) { return bad > 0; });
    if (bad_row == bad_in_row.end()) return;
    const auto y = int(bad_row - bad_in_row.begin());
    const float* const row = values.row(y);
    const auto x = std::find_if(row, row + values.width(), [](float v) { return !(std::abs(v) <= largest); }) - row;
    throw Error(Refusal::unsuitable, path + ": " +
                                         std::to_string(std::accumulate(bad_row, bad_in_row.end(), std::int64_t(0))) +
                                         " values are NaN, infinite or beyond 1e12, the first at texel (" +
                                         std::to_string(x) + ", " + std::to_string(y) + "); repair the height");
}

HeightTexture copy_of(const HeightTexture& height) {
    const Image<float>& from = height.values;
    HeightTexture out{.values = Image<float>(from.width(), from.height(), from.channels()),
                      .info = height.info,
                      .levels = height.levels,
                      .step = height.step,
                      .kind = height.kind};
    for_rows(from.height(), 64, [&](std::int64_t begin, std::int64_t end) {
        std::copy(from.row(int(begin)), from.row(int(end)), out.values.row(int(begin)));
    });
    return out;
}

std::size_t memory_of(const HeightTexture& height) { return sizeof height + height.values.size() * sizeof(float); }

} // namespace

HeightTexture read_height(const std::string& path, Grey grey, const ReadLimits& limits) {
    const std::function<HeightTexture()> read = [&] {
        ImageInfo info;
        Image<float> picture = read_image(path, &info, limits);
        return picture_height(path, std::move(picture), std::move(info), grey);
    };
    const std::string how = "height " + std::to_string(int(grey)) + " " + std::to_string(limits.max_bytes);
    return shared_load(path, how, read, std::function(copy_of), std::function(memory_of));
}

HeightTexture picture_height(const std::string& path, Image<float> picture, ImageInfo info, Grey grey) {
    HeightTexture height{.values = {}, .info = std::move(info), .kind = {}};
    const std::vector<float> weights = grey_weights(path, height.info, grey);
    count_levels(height, picture, weights);
    if (grey == Grey::mean || grey == Grey::luma) height.kind = guess_kind(picture, height.info);
    const int channels = picture.channels(), width = picture.width();
    if (channels == 1) {
        height.values = std::move(picture);
    } else {
        height.values = Image<float>(width, picture.height(), 1);
        float total = 0;
        for (const float weight : weights) total += weight;
        for_rows(picture.height(), 64, [&](std::int64_t begin, std::int64_t end) {
            for (auto y = int(begin); y < int(end); ++y) {
                const float* from = picture.row(y);
                float* to = height.values.row(y);
                for (int x = 0; x < width; ++x, from += channels) {
                    float sum = 0;
                    for (int c = 0; c < channels; ++c)
                        if (weights[c] != 0) sum += weights[c] * from[c];
                    to[x] = sum / total;
                }
            }
        });
    }
    if (!is_integer(height.info.type)) refuse_bad_values(path, height.values);
    if (height.info.palette)
        height.info.notes.push_back("is a picture of palette colours: the height is the grey of each colour");
    return height;
}

} // namespace bake
