#include "bake/environment/slope.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

/// The central difference of what lies before and behind, each per texel; not steeper than twice either, and 0 at an
/// extremum: along an axis the texel's values stay between its neighbours'. Van Leer, Towards the Ultimate Conservative
/// Difference Scheme IV, JCP 1977.
inline float limited(float before, float behind) noexcept {
    const float central = 0.5f * (before + behind), most = 2 * std::min(std::abs(before), std::abs(behind));
    if (before * behind <= 0) return 0;
    return std::abs(central) <= most ? central : std::copysign(most, central);
}

/// Both slopes of a channel, from the differences to the four neighbours, each per texel; scaled down where the texel's
/// corners would leave the neighbours' range: Barth and Jespersen, The Design and Application of Upwind Schemes on
/// Unstructured Meshes, AIAA 1989.
inline void set_slopes(Slopes& s, int c, float before_x, float behind_x, float before_y, float behind_y) noexcept {
    s.x[c] = limited(before_x, behind_x);
    s.y[c] = limited(before_y, behind_y);
    const float change = 0.5f * (std::abs(s.x[c]) + std::abs(s.y[c]));
    const float rise = std::max(std::max(-before_x, behind_x), std::max(-before_y, behind_y));
    const float fall = std::max(std::max(before_x, -behind_x), std::max(before_y, -behind_y));
    const float most = std::max(0.0f, std::min(rise, fall));
    if (change <= most) return;
    s.x[c] *= most / change;
    s.y[c] *= most / change;
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
    Beyond result{{}, static_cast<float>(0.5 * n * (stretch - (1 - 1.0 / n)))}; // from the outer texel's centre
    // The slope along the edge is that of this face's own outer texels.
    const int low = std::max(along - 1, 0), high = std::min(along + 1, n - 1);
    const int own_x = std::clamp(x, 0, n - 1), own_y = std::clamp(y, 0, n - 1);
    const float* before = across_s ? &cube[face].at(own_x, low) : &cube[face].at(low, own_y);
    const float* after = across_s ? &cube[face].at(own_x, high) : &cube[face].at(high, own_y);
    const float steps = static_cast<float>(std::max(1, high - low));
    for (int c = 0; c < channels; ++c) result.value[c] = value[c] - static_cast<float>(moved) * (after[c] - before[c]) / steps;
    return result;
}

/// One-sided where the face ends and its samples lie on the edge.
void edge_sampled_slopes(const Image<float>& face, int x, int y, Slopes& s) noexcept {
    const int n = face.width(), channels = face.channels();
    if (n < 2) {
        std::fill_n(s.x, 4, 0.0f);
        std::fill_n(s.y, 4, 0.0f);
        return;
    }
    const int x0 = std::clamp(x, 1, n - 1), x1 = std::clamp(x, 0, n - 2), y0 = std::clamp(y, 1, n - 1), y1 = std::clamp(y, 0, n - 2);
    for (int c = 0; c < channels; ++c) {
        set_slopes(s, c, face.at(x0, y, c) - face.at(x0 - 1, y, c), face.at(x1 + 1, y, c) - face.at(x1, y, c),
                   face.at(x, y0, c) - face.at(x, y0 - 1, c), face.at(x, y1 + 1, c) - face.at(x, y1, c));
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
    const float* own = &picture.at(x, y);
    if (x > 0 && y > 0 && x + 1 < w && y + 1 < h) {
        const float *left = own - channels, *right = own + channels, *up = own - std::size_t(w) * channels, *down = own + std::size_t(w) * channels;
        for (int c = 0; c < channels; ++c) set_slopes(s, c, own[c] - left[c], right[c] - own[c], own[c] - up[c], down[c] - own[c]);
        return;
    }
    const float *left = at(x - 1, y), *right = at(x + 1, y), *up = at(x, y - 1), *down = at(x, y + 1);
    for (int c = 0; c < channels; ++c) {
        if (pole) s.x[c] = s.y[c] = 0;
        else set_slopes(s, c, own[c] - left[c], right[c] - own[c], own[c] - up[c], down[c] - own[c]);
    }
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
        for (int c = 0; c < channels; ++c) set_slopes(s, c, own[c] - left[c], right[c] - own[c], own[c] - up[c], down[c] - own[c]);
    } else {
        const auto side = [&](int i, int j, bool across_s) {
            if (i < 0 || j < 0 || i >= n || j >= n) return beyond_edge(cube, f, i, j, across_s);
            Beyond inside{{}, 1};
            for (int c = 0; c < channels; ++c) inside.value[c] = face.at(i, j, c);
            return inside;
        };
        const Beyond left = side(x - 1, y, true), right = side(x + 1, y, true), up = side(x, y - 1, false), down = side(x, y + 1, false);
        for (int c = 0; c < channels; ++c)
            set_slopes(s, c, (own[c] - left.value[c]) / left.distance, (right.value[c] - own[c]) / right.distance, (own[c] - up.value[c]) / up.distance,
                       (down.value[c] - own[c]) / down.distance);
    }
}

} // namespace bake
