#include "bake/environment/sky/cross.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

double mean_magnitude(const Image<float>& picture) noexcept {
    double sum = 0;
    for (std::size_t i = 0; i < picture.size(); ++i)
        if (std::isfinite(picture.data()[i])) sum += std::abs(double(picture.data()[i]));
    return sum / double(picture.size());
}

/// Whether the values inside a cell differ by more than `tolerance`; a margin is left out, where compression lets the
/// neighbouring cells shine through.
bool is_filled(const Image<float>& picture, int n, int column, int row, double tolerance) noexcept {
    const int margin = n < 16 ? n / 8 : std::max(2, n / 8);
    for (int c = 0; c < picture.channels(); ++c) {
        float low = picture.at(column * n + margin, row * n + margin, c), high = low;
        for (int y = margin; y < n - margin; ++y)
            for (int x = margin; x < n - margin; ++x) {
                const float value = picture.at(column * n + x, row * n + y, c);
                if (!std::isfinite(value)) return true;
                low = std::min(low, value);
                high = std::max(high, value);
            }
        if (double(high) - double(low) > tolerance) return true;
    }
    return false;
}

} // namespace

CrossShape find_cross(const Image<float>& picture, CubeLayout layout) {
    const bool wide = layout == CubeLayout::hcross;
    const int n = picture.width() / (wide ? 4 : 3);
    const double tolerance = 0.02 * mean_magnitude(picture);
    const auto place = [&](int across) {
        int found = -1, count = 0;
        for (int k = 0; k < 4; ++k)
            if (is_filled(picture, n, wide ? k : across, wide ? across : k, tolerance)) {
                if (k == 1) return 1;
                found = k;
                ++count;
            }
        return count == 1 ? found : 1;
    };
    return {place(0), place(2)};
}

Cube cut_cross(const Image<float>& picture, CubeLayout layout, const CrossShape& shape, const std::string& file) {
    if (shape == CrossShape{}) return cut_faces(picture, layout, FaceOrder::gl, file);
    using F = CubeFace;
    const bool wide = layout == CubeLayout::hcross;
    const TurnedFace across[4] = {{F::pz, 0}, {F::px, 0}, {F::nz, 0}, {F::nx, 0}},
                     down[4] = {{F::pz, 0}, {F::ny, 0}, {F::nz, 2}, {F::py, 0}};
    const int n = picture.width() / (wide ? 4 : 3), offset = (shape.second - shape.first + 4) % 4;
    Cube cube;
    const auto cut = [&](int column, int row, const TurnedFace& place) {
        Image<float> cell(n, n, picture.channels());
        for (int y = 0; y < n; ++y)
            std::copy_n(&picture.at(column * n, row * n + y), std::size_t(n) * picture.channels(), cell.row(y));
        cube[place.face] = turned(cell, -place.turns);
    };
    for (int k = 0; k < 4; ++k) {
        const int step = (k - shape.first + 4) % 4;
        if (wide) cut(k, 1, across[step]);
        else cut(1, k, down[step]);
    }
    if (wide) {
        cut(shape.first, 0, {F::py, 0});
        cut(shape.second, 2, {F::ny, offset});
    } else {
        cut(0, shape.first, {F::nx, 0});
        cut(2, shape.second, {F::px, (4 - offset) % 4});
    }
    return cube;
}

} // namespace bake
