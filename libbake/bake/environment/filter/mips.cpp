#include "bake/environment/filter/mips.h"
#include "bake/base/parallel.h"
#include "bake/environment/sky/frame.h"
#include "bake/environment/sky/solid_angle.h"
#include <algorithm>
#include <cassert>

namespace bake {
namespace {

/// The exchange of the texels of a row with their eight neighbours; the same for every face.
struct Exchange {
    /// For each neighbour (dx, dy), e_jk of each texel and channel: n * channels values.
    std::array<std::vector<double>, 9> with;

    Exchange(int n, int channels) {
        for (std::vector<double>& row : with) row.resize(std::size_t(n) * channels);
    }
    void set_row(const std::vector<double>& omega, int n, int channels, int y) noexcept {
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx) {
                // A texel across an edge of the cube has the same solid angle as its neighbour on this side.
                const double* own = &omega[std::size_t(y) * n];
                const double* other = &omega[std::size_t(std::clamp(y + dy, 0, n - 1)) * n];
                const double weight = dx != 0 && dy != 0 ? 1.0 / 16 : 1.0 / 8;
                double* row = with[3 * dy + dx + 4].data();
                for (int x = 0; x < n; ++x) {
                    const double there = other[std::clamp(x + dx, 0, n - 1)];
                    const double e = weight * 2 * own[x] * there / (own[x] + there);
                    for (int c = 0; c < channels; ++c) row[x * channels + c] = e;
                }
            }
    }
    /// Adds the exchange of row y of a face to its fluxes.
    void apply(const Image<float>& wide, int y, double* flux) const noexcept {
        const int channels = wide.channels(), count = (wide.width() - 2) * channels;
        const float* own = wide.row(y + 1) + channels;
        for (const int neighbour : {0, 1, 2, 3, 5, 6, 7, 8}) {
            const float* other = wide.row(y + neighbour / 3) + neighbour % 3 * channels;
            const double* e = with[neighbour].data();
            for (int i = 0; i < count; ++i) flux[i] += e[i] * (double(other[i]) - double(own[i]));
        }
    }
};

/// The pieces into which the borders of n fine and m coarse texels cut an axis.
struct AxisPieces {
    std::vector<double> lines; ///< in [-1, 1], one more than pieces
    std::vector<int> fine, coarse;
};

AxisPieces pieces_of(int n, int m) {
    // Integer positions in units of 1 / (n m), so that equal borders compare equal.
    AxisPieces pieces;
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
    for (int f = 0; f < 6; ++f)
        std::copy(sky.faces[f].data(), sky.faces[f].data() + sky.faces[f].size(), copy.faces[f].data());
    return copy;
}

/// Sums of the coarse texels of one row.
struct RowSums {
    std::vector<double> flux, sums,
        area; ///< flux: of a fine row; sums: of a coarse row of all faces; area: of its texels

    RowSums(int n, int m, int channels)
        : flux(std::size_t(n) * channels), sums(std::size_t(6) * m * channels), area(std::size_t(m)) {}

    /// `share`: of each piece in the solid angle of its fine texel; `pieces.fine` and `coarse` are ascending.
    void add(const AxisPieces& pieces, const std::vector<double>& share, int face, int channels) noexcept {
        double* const sum = &sums[std::size_t(face) * area.size() * channels];
        for (std::size_t i = 0; i < share.size(); ++i)
            for (int c = 0; c < channels; ++c)
                sum[pieces.coarse[i] * channels + c] += share[i] * flux[pieces.fine[i] * channels + c];
    }
};

/// The fluxes of all texels, divided between m x m texels by the solid angle of their overlap; with `exchange`, after the
/// exchange between neighbours.
Cube resized(const Cube& sky, int m, bool exchange) {
    assert(!sky.empty() && m >= 1);
    const int n = sky.size(), channels = sky.channels();
    const std::vector<double> omega = texel_solid_angles(n);
    const AxisPieces pieces = pieces_of(n, m);
    const int count = int(pieces.fine.size());
    const std::vector<double> cells = count == n ? omega : cell_solid_angles(pieces.lines);
    std::array<Image<float>, 6> wide;
    if (exchange)
        for_rows(6, 1, [&](std::int64_t begin, std::int64_t end) {
            for (auto f = int(begin); f < int(end); ++f) wide[f] = framed(sky, CubeFace(f));
        });

    Cube coarse = make_cube(m, channels);
    for_rows(m, 2, [&](std::int64_t begin, std::int64_t end) {
        RowSums row(n, m, channels);
        std::vector<double> share(count);
        Exchange exchanges(exchange ? n : 0, channels);
        for (auto Y = int(begin); Y < int(end); ++Y) {
            std::fill(row.sums.begin(), row.sums.end(), 0.0);
            std::fill(row.area.begin(), row.area.end(), 0.0);
            const auto first = std::lower_bound(pieces.coarse.begin(), pieces.coarse.end(), Y) - pieces.coarse.begin();
            for (int j = int(first); j < count && pieces.coarse[j] == Y; ++j) {
                const int y = pieces.fine[j];
                const double *omega_row = &omega[std::size_t(y) * n], *cell_row = &cells[std::size_t(j) * count];
                if (exchange) exchanges.set_row(omega, n, channels, y);
                for (int i = 0; i < count; ++i) {
                    row.area[pieces.coarse[i]] += cell_row[i];
                    share[i] = count == n ? 1 : cell_row[i] / omega_row[pieces.fine[i]];
                }
                for (int f = 0; f < 6; ++f) {
                    const float* from = sky.faces[f].row(y);
                    for (int x = 0; x < n; ++x)
                        for (int c = 0; c < channels; ++c)
                            row.flux[x * channels + c] = omega_row[x] * double(from[x * channels + c]);
                    if (exchange) exchanges.apply(wide[f], y, row.flux.data());
                    row.add(pieces, share, f, channels);
                }
            }
            for (int f = 0; f < 6; ++f) {
                const double* sum = &row.sums[std::size_t(f) * m * channels];
                float* to = coarse.faces[f].row(Y);
                for (int X = 0; X < m; ++X)
                    for (int c = 0; c < channels; ++c)
                        to[X * channels + c] = float(sum[X * channels + c] / row.area[X]);
            }
        }
    });
    return coarse;
}

} // namespace

Cube next_mip(const Cube& sky) {
    if (sky.size() == 1) return copy_of(sky);
    // On few texels the exchange darkens the middle of a face, where texels are largest, and seams become visible: 1.24
    // times the step inside at 2 x 2, against 1.01 without it.
    return resized(sky, sky.size() / 2, sky.size() >= 16);
}

Cube resize_by_area(const Cube& sky, int size) { return size == sky.size() ? copy_of(sky) : resized(sky, size, false); }

std::vector<Cube> mip_chain(const Cube& sky) {
    std::vector<Cube> chain;
    chain.push_back(copy_of(sky));
    while (chain.back().size() > 1) chain.push_back(next_mip(chain.back()));
    return chain;
}

} // namespace bake
