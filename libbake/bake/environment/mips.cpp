#include "bake/environment/mips.h"
#include "bake/base/parallel.h"
#include "bake/environment/solid_angle.h"
#include <algorithm>
#include <cassert>

namespace bake {
namespace {

/// A face with a frame of one texel of its neighbours; the frame's corners are the mean of the three texels that meet.
Image<float> framed(const Cube& sky, int face_index) {
    const Image<float>& face = sky.faces[face_index];
    const int n = face.width(), channels = face.channels();
    Image<float> wide(n + 2, n + 2, channels);
    for (int y = 0; y < n; ++y) std::copy(face.row(y), face.row(y) + std::size_t(n) * channels, wide.row(y + 1) + channels);
    const auto copy_across = [&](int x, int y) {
        const CubeTexel there = texel_across(n, static_cast<CubeFace>(face_index), x, y);
        const float* from = &sky.faces[static_cast<int>(there.face)].at(there.x, there.y);
        std::copy(from, from + channels, &wide.at(x + 1, y + 1));
    };
    for (int i = 0; i < n; ++i)
        for (const int outside : {-1, n}) copy_across(outside, i), copy_across(i, outside);
    for (const int x : {0, n + 1})
        for (const int y : {0, n + 1})
            for (int c = 0; c < channels; ++c) {
                const int x_in = std::clamp(x, 1, n), y_in = std::clamp(y, 1, n);
                wide.at(x, y, c) = (wide.at(x_in, y_in, c) + wide.at(x, y_in, c) + wide.at(x_in, y, c)) / 3;
            }
    return wide;
}

/// Fluxes of row y of a face after the exchange between neighbours, n * channels values.
void exchange_row(const Image<float>& wide, const std::vector<double>& omega, int y, double* flux) noexcept {
    const int n = wide.width() - 2, channels = wide.channels();
    const auto solid_angle = [&](int i, int j) {
        // A texel across an edge is as large as the one before it.
        return omega[std::size_t(std::clamp(j, 0, n - 1)) * n + std::clamp(i, 0, n - 1)];
    };
    for (int x = 0; x < n; ++x) {
        const double own = solid_angle(x, y);
        const float* centre = &wide.at(x + 1, y + 1);
        double* sum = flux + std::size_t(x) * channels;
        for (int c = 0; c < channels; ++c) sum[c] = own * double(centre[c]);
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx) {
                if (dx == 0 && dy == 0) continue;
                const double other = solid_angle(x + dx, y + dy);
                const double e = (dx != 0 && dy != 0 ? 1.0 / 16 : 1.0 / 8) * 2 * own * other / (own + other);
                const float* neighbour = &wide.at(x + 1 + dx, y + 1 + dy);
                for (int c = 0; c < channels; ++c) sum[c] += e * (double(neighbour[c]) - double(centre[c]));
            }
    }
}

/// The pieces into which the edges of n fine and m coarse texels cut an axis.
struct Pieces {
    std::vector<double> lines; ///< in [-1, 1], one more than pieces
    std::vector<int> fine, coarse;
};

Pieces pieces_of(int n, int m) {
    // Positions in units of 1 / (n m), so that equal edges are equal.
    Pieces pieces;
    for (std::int64_t at = 0, end = std::int64_t(n) * m; at < end;) {
        const std::int64_t i = at / m, k = at / n;
        pieces.lines.push_back(2.0 * double(at) / double(end) - 1);
        pieces.fine.push_back(int(i));
        pieces.coarse.push_back(int(k));
        at = std::min((i + 1) * m, (k + 1) * n);
    }
    pieces.lines.push_back(1);
    return pieces;
}

Cube copy_of(const Cube& sky) {
    Cube copy = make_cube(sky.size(), sky.channels());
    for (int f = 0; f < 6; ++f) std::copy(sky.faces[f].data(), sky.faces[f].data() + sky.faces[f].size(), copy.faces[f].data());
    return copy;
}

/// Fluxes shared out to m x m texels by the solid angle of their overlap, with the exchange before it for `tent`.
Cube resized(const Cube& sky, int m, MipFilter filter) {
    assert(!sky.empty() && m >= 1);
    const int n = sky.size(), channels = sky.channels();
    const std::vector<double> omega = texel_solid_angles(n);
    const Pieces pieces = pieces_of(n, m);
    const int count = int(pieces.fine.size());
    const std::vector<double> cells = count == n ? omega : cell_solid_angles(pieces.lines);
    std::array<Image<float>, 6> wide;
    if (filter == MipFilter::tent)
        for_rows(6, 1, [&](std::int64_t begin, std::int64_t end) {
            for (auto f = int(begin); f < int(end); ++f) wide[f] = framed(sky, f);
        });

    Cube coarse = make_cube(m, channels);
    for_rows(std::int64_t(6) * m, 4, [&](std::int64_t begin, std::int64_t end) {
        std::vector<double> flux(std::size_t(n) * channels), sum(std::size_t(m) * channels), area(m);
        for (std::int64_t row = begin; row < end; ++row) {
            const int f = int(row / m), Y = int(row % m);
            std::fill(sum.begin(), sum.end(), 0.0);
            std::fill(area.begin(), area.end(), 0.0);
            const auto first = std::lower_bound(pieces.coarse.begin(), pieces.coarse.end(), Y) - pieces.coarse.begin();
            for (int j = int(first); j < count && pieces.coarse[j] == Y; ++j) {
                const int y = pieces.fine[j];
                const double* omega_row = &omega[std::size_t(y) * n];
                if (filter == MipFilter::tent) {
                    exchange_row(wide[f], omega, y, flux.data());
                } else {
                    const float* from = sky.faces[f].row(y);
                    for (int x = 0; x < n; ++x)
                        for (int c = 0; c < channels; ++c)
                            flux[x * channels + c] = omega_row[x] * double(from[x * channels + c]);
                }
                for (int i = 0; i < count; ++i) {
                    const int x = pieces.fine[i], X = pieces.coarse[i];
                    const double cell = cells[std::size_t(j) * count + i], share = cell / omega_row[x];
                    area[X] += cell;
                    for (int c = 0; c < channels; ++c) sum[X * channels + c] += share * flux[x * channels + c];
                }
            }
            float* to = coarse.faces[f].row(Y);
            for (int X = 0; X < m; ++X)
                for (int c = 0; c < channels; ++c) to[X * channels + c] = float(sum[X * channels + c] / area[X]);
        }
    });
    return coarse;
}

} // namespace

Cube next_mip(const Cube& sky, MipFilter filter) {
    if (sky.size() == 1) return copy_of(sky);
    // On few texels the exchange, even in texels, dulls the middle of a face, where texels are widest, and seams show:
    // 1.24 times the step inside at 2 x 2, against 1.01.
    return resized(sky, sky.size() / 2, sky.size() < 16 ? MipFilter::box : filter);
}

Cube resize_by_area(const Cube& sky, int size) {
    return size == sky.size() ? copy_of(sky) : resized(sky, size, MipFilter::box);
}

std::vector<Cube> mip_chain(const Cube& sky, const MipOptions& options) {
    std::vector<Cube> chain;
    chain.push_back(copy_of(sky));
    while (chain.back().size() / 2 >= std::max(1, options.smallest)) chain.push_back(next_mip(chain.back(), options.filter));
    return chain;
}

} // namespace bake
