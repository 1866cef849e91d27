#include "bake/environment/slope.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

void keep_positive(const float* value, int channels, Slopes& s) noexcept {
    for (int c = 0; c < channels; ++c) {
        const float drop = 0.5f * (std::abs(s.x[c]) + std::abs(s.y[c]));
        if (drop <= value[c]) continue;
        const float scale = value[c] > 0 ? value[c] / drop : 0;
        s.x[c] *= scale;
        s.y[c] *= scale;
    }
}

/// Across one edge of a face: the value that stands one step outside (x, y), moved along the edge to where the row meets
/// it, and how many texels away that is.
struct Beyond {
    float value[4];
    float distance;
};

Beyond beyond_edge(const Cube& cube, CubeFace face, int x, int y, bool across_s) noexcept {
    const int n = cube.size(), channels = cube.channels();
    const CubeTexel there = texel_across(n, face, x, y);
    const float* value = &cube[there.face].at(there.x, there.y);
    // In the plane of this face the neighbour's centre lies at 1 / (1 - 1/n), and so much further along, too.
    const double stretch = n > 1 ? 1 / (1 - 1.0 / n) : 1;
    const int along = across_s ? y : x;
    const double t = (2 * along + 1.0) / n - 1, moved = 0.5 * n * t * (stretch - 1);
    Beyond result{{}, static_cast<float>(0.5 * n * (stretch - (1 - 1.0 / n)))};
    // The slope along the edge is that of this face's own outer texels.
    const int low = std::max(along - 1, 0), high = std::min(along + 1, n - 1);
    const int own_x = std::clamp(x, 0, n - 1), own_y = std::clamp(y, 0, n - 1);
    const float* before = across_s ? &cube[face].at(own_x, low) : &cube[face].at(low, own_y);
    const float* after = across_s ? &cube[face].at(own_x, high) : &cube[face].at(high, own_y);
    const float steps = static_cast<float>(std::max(1, high - low));
    for (int c = 0; c < channels; ++c) result.value[c] = value[c] - static_cast<float>(moved) * (after[c] - before[c]) / steps;
    return result;
}

/// One sided where the face ends and its samples lie on the edge.
void edge_sampled_slopes(const Image<float>& face, int x, int y, Slopes& s) noexcept {
    const int n = face.width(), channels = face.channels();
    const int x0 = std::max(x - 1, 0), x1 = std::min(x + 1, n - 1), y0 = std::max(y - 1, 0), y1 = std::min(y + 1, n - 1);
    for (int c = 0; c < channels; ++c) {
        s.x[c] = (face.at(x1, y, c) - face.at(x0, y, c)) / static_cast<float>(std::max(1, x1 - x0));
        s.y[c] = (face.at(x, y1, c) - face.at(x, y0, c)) / static_cast<float>(std::max(1, y1 - y0));
    }
}

} // namespace

void picture_slopes(Projection projection, const Image<float>& picture, int x, int y, Slopes& s) noexcept {
    const int w = picture.width(), h = picture.height(), channels = picture.channels();
    const auto at = [&](int i, int j) {
        if (i >= 0 && j >= 0 && i < w && j < h) return &picture.at(i, j);
        const PictureTexel texel = wrapped(projection, w, h, i, j);
        return &picture.at(texel.x, texel.y);
    };
    const bool pole = projection == Projection::latlong_edges && (y == 0 || y == h - 1);
    const float *left = at(x - 1, y), *right = at(x + 1, y), *up = at(x, y - 1), *down = at(x, y + 1);
    for (int c = 0; c < channels; ++c) {
        s.x[c] = pole ? 0 : 0.5f * (right[c] - left[c]);
        s.y[c] = pole ? 0 : 0.5f * (down[c] - up[c]);
    }
    keep_positive(&picture.at(x, y), channels, s);
}

void face_slopes(const Cube& cube, bool edge_samples, CubeFace f, int x, int y, Slopes& s) noexcept {
    const Image<float>& face = cube[f];
    const int n = face.width(), channels = face.channels();
    const float* own = &face.at(x, y);
    if (edge_samples) {
        edge_sampled_slopes(face, x, y, s);
    } else if (x > 0 && y > 0 && x + 1 < n && y + 1 < n) {
        const float *left = own - channels, *right = own + channels;
        const float *up = own - std::size_t(n) * channels, *down = own + std::size_t(n) * channels;
        for (int c = 0; c < channels; ++c) {
            s.x[c] = 0.5f * (right[c] - left[c]);
            s.y[c] = 0.5f * (down[c] - up[c]);
        }
    } else {
        const auto side = [&](int i, int j, bool across_s) {
            if (i < 0 || j < 0 || i >= n || j >= n) return beyond_edge(cube, f, i, j, across_s);
            Beyond inside{{}, 1};
            for (int c = 0; c < channels; ++c) inside.value[c] = face.at(i, j, c);
            return inside;
        };
        const Beyond left = side(x - 1, y, true), right = side(x + 1, y, true), up = side(x, y - 1, false), down = side(x, y + 1, false);
        for (int c = 0; c < channels; ++c) {
            s.x[c] = (right.value[c] - left.value[c]) / (left.distance + right.distance);
            s.y[c] = (down.value[c] - up.value[c]) / (up.distance + down.distance);
        }
    }
    keep_positive(own, channels, s);
}

} // namespace bake
