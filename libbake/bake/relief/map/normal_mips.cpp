#include "bake/relief/map/normal_mips.h"
#include "bake/base/parallel.h"
#include "bake/relief/map/normal_code.h"
#include <algorithm>
#include <cmath>
#include <cstdint>

namespace bake {
namespace {

constexpr int normal_channels = 3, moment_channels = 5, channels = normal_channels + moment_channels;

/// Texels of a finer level that one texel covers along an axis.
struct Cover {
    int first, count;
    float first_share, last_share; ///< of the first and the last of them; the others are covered whole
};

Cover cover_of(int fine, int coarse, int at) noexcept {
    const std::int64_t begin = std::int64_t(at) * fine, end = begin + fine; // in 1 / coarse of a fine texel
    const auto first = int(begin / coarse), last = int((end - 1) / coarse);
    return {first, last - first + 1,
            float(std::min<std::int64_t>(end, std::int64_t(first + 1) * coarse) - begin) / float(coarse),
            float(end - std::max<std::int64_t>(begin, std::int64_t(last) * coarse)) / float(coarse)};
}

float share(const Cover& cover, int i) noexcept {
    return i == 0 ? cover.first_share : i == cover.count - 1 ? cover.last_share : 1.0f;
}

/// Means of 2 x 2 texels.
Image<float> halve(const Image<float>& fine) {
    Image<float> coarse(fine.width() / 2, fine.height() / 2, channels);
    for_rows(coarse.height(), 8, [&](std::int64_t begin, std::int64_t end) {
        for (auto y = int(begin); y < int(end); ++y) {
            const float *above = fine.row(2 * y), *below = fine.row(2 * y + 1);
            float* to = coarse.row(y);
            for (int x = 0; x < coarse.width(); ++x, above += 2 * channels, below += 2 * channels, to += channels)
                for (int c = 0; c < channels; ++c)
                    to[c] = 0.25f * ((above[c] + above[channels + c]) + (below[c] + below[channels + c]));
        }
    });
    return coarse;
}

/// Means over the rectangles of width x height texels.
Image<float> box_filter(const Image<float>& fine, int width, int height) {
    Image<float> coarse(width, height, channels);
    const float area = float(width) / float(fine.width()) * (float(height) / float(fine.height()));
    for_rows(height, 8, [&](std::int64_t begin, std::int64_t end) {
        for (auto y = int(begin); y < int(end); ++y) {
            const Cover rows = cover_of(fine.height(), height, y);
            for (int x = 0; x < width; ++x) {
                const Cover columns = cover_of(fine.width(), width, x);
                double sums[channels] = {};
                for (int j = 0; j < rows.count; ++j) {
                    const float* from = &fine.at(columns.first, rows.first + j);
                    for (int i = 0; i < columns.count; ++i, from += channels) {
                        const double weight = double(share(rows, j)) * double(share(columns, i));
                        for (int c = 0; c < channels; ++c) sums[c] += weight * double(from[c]);
                    }
                }
                for (int c = 0; c < channels; ++c) coarse.at(x, y, c) = float(sums[c] * double(area));
            }
        }
    });
    return coarse;
}

/// Normals and moments of slopes of the finest level.
Image<float> finest(const Image<float>& map, bool directx) {
    Image<float> means(map.width(), map.height(), channels);
    for_rows(map.height(), 16, [&](std::int64_t begin, std::int64_t end) {
        for (auto y = int(begin); y < int(end); ++y)
            for (int x = 0; x < map.width(); ++x) {
                const float* rgb = &map.at(x, y);
                Vec3f n = unit_or_zero(decode_normal({rgb[0], rgb[1], rgb[2]}, false));
                if (n == Vec3f(0)) n.z = 1;
                const float z = -std::max(n.z, least_slope_z), u = n.x / z, v = (directx ? -n.y : n.y) / z;
                const float values[channels] = {n.x, n.y, n.z, u, v, u * u, v * v, u * v};
                std::copy_n(values, channels, &means.at(x, y));
            }
    });
    return means;
}

NormalLevel split(const Image<float>& means) {
    const int width = means.width(), height = means.height();
    NormalLevel level{Image<float>(width, height, normal_channels), Image<float>(width, height, 1),
                      Image<float>(width, height, moment_channels)};
    for_rows(height, 16, [&](std::int64_t begin, std::int64_t end) {
        for (auto y = int(begin); y < int(end); ++y)
            for (int x = 0; x < width; ++x) {
                const float* from = &means.at(x, y);
                const Vec3f mean(from[0], from[1], from[2]);
                Vec3f unit = unit_or_zero(mean);
                if (unit == Vec3f(0)) unit.z = 1;
                for (int c = 0; c < normal_channels; ++c) level.normal.at(x, y, c) = unit[c];
                level.length.at(x, y) = std::min(1.0f, glm::length(mean));
                std::copy_n(from + normal_channels, moment_channels, &level.moments.at(x, y));
            }
    });
    return level;
}

} // namespace

std::vector<NormalLevel> normal_mips(const Image<float>& map, bool directx) {
    const Image<float> level0 = finest(map, directx);
    std::vector<NormalLevel> levels;
    levels.push_back(split(level0));
    Image<float> last;
    for (const Image<float>* finer = &level0; std::max(finer->width(), finer->height()) > 1;) {
        const int width = std::max(1, finer->width() / 2), height = std::max(1, finer->height() / 2);
        // Means of means are exact only where texels are covered whole.
        const bool whole = finer->width() % width == 0 && finer->height() % height == 0;
        const bool halved = finer->width() == 2 * width && finer->height() == 2 * height;
        last = halved ? halve(*finer) : box_filter(whole ? *finer : level0, width, height);
        finer = &last;
        levels.push_back(split(last));
    }
    return levels;
}

float slope_variance(const float* moments) noexcept {
    const double u = moments[0], v = moments[1];
    return float(std::max(0.0, (double(moments[2]) - u * u + double(moments[3]) - v * v) / 2));
}

Image<float> roughness_map(const NormalLevel& level, float roughness) {
    Image<float> map(level.normal.width(), level.normal.height(), 1);
    const float alpha = roughness * roughness;
    for_rows(map.height(), 16, [&](std::int64_t begin, std::int64_t end) {
        for (auto y = int(begin); y < int(end); ++y)
            for (int x = 0; x < map.width(); ++x) {
                const float square = alpha * alpha + 2 * slope_variance(&level.moments.at(x, y));
                map.at(x, y) = std::min(1.0f, std::sqrt(std::sqrt(square)));
            }
    });
    return map;
}

} // namespace bake
