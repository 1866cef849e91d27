#include "bake/environment/resample/shared_texels.h"
#include "bake/environment/resample/face_accumulator.h"
#include "bake/environment/resample/overlap.h"
#include <algorithm>
#include <cmath>

namespace bake {

std::array<Border, 6> join_borders(int n, int channels, const std::array<std::vector<double>, 6>& sums) {
    std::array<Border, 6> joined;
    for (const CubeFace face : all_cube_faces) {
        Border& values = joined[int(face)];
        values.resize(std::size_t(4) * n * channels);
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; x += y == 0 || y == n - 1 || n == 1 ? 1 : n - 1) {
                const Vec3d d = cube_direction(CubePoint<double>{face, double(x) / (n - 1), double(y) / (n - 1)});
                std::vector<double> sum(channels + 1, 0.0);
                for (int other = 0; other < 6; ++other) {
                    const PlanePoint at = FacePlane({n, true}, CubeFace(other)).project(d);
                    const double u = (at.x - 1) / 2, v = (at.y - 1) / 2; // in texels, from the centre of the first
                    if (at.ma < 1 - 1e-9 || std::abs(u - 0.5 * (n - 1)) > 0.5 * n ||
                        std::abs(v - 0.5 * (n - 1)) > 0.5 * n)
                        continue;
                    const int index = border_index(n, int(std::lround(u)), int(std::lround(v)));
                    for (int c = 0; c <= channels; ++c) sum[c] += sums[other][std::size_t(index) * (channels + 1) + c];
                }
                float* const value = &values[std::size_t(border_index(n, x, y)) * channels];
                for (int c = 0; c < channels; ++c) value[c] = float(sum[c] / sum[channels]);
            }
    }
    return joined;
}

void shift_to_samples(int n, int channels, Border& border) {
    for (int side = 0; side < 4; ++side) {
        const auto at = [&](int i) {
            const int index = side == 0   ? border_index(n, i, 0)
                              : side == 1 ? border_index(n, i, n - 1)
                              : side == 2 ? border_index(n, 0, i)
                                          : border_index(n, n - 1, i);
            return &border[std::size_t(index) * channels];
        };
        // From the ends inwards, so that the neighbour has not been shifted yet; the middle is not shifted.
        for (int i = 1; 2 * i < n - 1; ++i)
            for (const int k : {i, n - 1 - i}) {
                const float share = float(std::abs(2.0 * k / (n - 1) - 1) / 8);
                float *value = at(k), *inner = at(k < n - 1 - k ? k + 1 : k - 1);
                for (int c = 0; c < channels; ++c) value[c] += share * (inner[c] - value[c]);
            }
    }
}

void put_border(const Border& border, int n, int channels, int low, int high, float* values) {
    for (int y = low; y < high; ++y)
        for (int x = 0; x < n; x += y == 0 || y == n - 1 || n == 1 ? 1 : n - 1)
            std::copy_n(&border[std::size_t(border_index(n, x, y)) * channels], channels,
                        values + (std::size_t(y - low) * n + x) * channels);
}

bool is_joined(const Image<float>& picture) noexcept {
    const int w = picture.width(), h = picture.height(), channels = picture.channels();
    for (int y = 0; y < h; ++y)
        if (!std::equal(&picture.at(0, y), &picture.at(0, y) + channels, &picture.at(w - 1, y))) return false;
    for (const int y : {0, h - 1})
        for (int x = 1; x < w; ++x)
            if (!std::equal(&picture.at(0, y), &picture.at(0, y) + channels, &picture.at(x, y))) return false;
    return true;
}

Image<float> joined(const Image<float>& picture) {
    Image<float> copy(picture.width(), picture.height(), picture.channels());
    std::copy_n(picture.data(), picture.size(), copy.data());
    const int w = copy.width(), h = copy.height(), channels = copy.channels();
    for (int c = 0; c < channels; ++c) {
        for (int y = 0; y < h; ++y)
            copy.at(0, y, c) = copy.at(w - 1, y, c) = 0.5f * (copy.at(0, y, c) + copy.at(w - 1, y, c));
        for (const int y : {0, h - 1}) {
            double sum = 0;
            for (int x = 0; x < w; ++x) sum += copy.at(x, y, c);
            for (int x = 0; x < w; ++x) copy.at(x, y, c) = float(sum / w);
        }
    }
    return copy;
}

} // namespace bake
