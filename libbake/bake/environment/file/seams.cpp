#include "bake/environment/file/seams.h"
#include "bake/base/parallel.h"
#include <algorithm>
#include <cmath>
#include <vector>

namespace bake {
namespace {

int colours(const Cube& cube) noexcept { return std::min(3, cube.channels()); }

float seen(float value) noexcept { return std::sqrt(value > 0 ? value : 0.0f); }

/// Texel i of the row that lies `depth` texels inside a side.
CubeTexel texel_on(int n, FaceSide side, int i, int depth) noexcept {
    const auto face = CubeFace(side.face);
    switch (side.side) {
    case 0: return {face, i, depth};
    case 1: return {face, n - 1 - depth, i};
    case 2: return {face, n - 1 - i, n - 1 - depth};
    default: return {face, depth, n - 1 - i};
    }
}

/// Square roots of the radiance along a side: n * colours values.
std::vector<float> row_on(const Cube& cube, FaceSide side, int depth) {
    const int n = cube.size(), channels = colours(cube);
    std::vector<float> row(std::size_t(n) * channels);
    for (int i = 0; i < n; ++i) {
        const CubeTexel at = texel_on(n, side, i, depth);
        for (int c = 0; c < channels; ++c) row[std::size_t(i) * channels + c] = seen(cube[at.face].at(at.x, at.y, c));
    }
    return row;
}

/// Of the steps between two rows.
struct Means {
    double step = 0, square = 0;
};
Means means_of(const std::vector<float>& a, const std::vector<float>& b) noexcept {
    Means sum;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double step = std::abs(double(a[i] - b[i]));
        sum.step += step;
        sum.square += step * step;
    }
    return {sum.step / double(a.size()), sum.square / double(a.size())};
}

std::vector<float> reversed(const std::vector<float>& row, int channels) {
    std::vector<float> back(row.size());
    const std::size_t n = row.size() / channels;
    for (std::size_t i = 0; i < n; ++i)
        for (int c = 0; c < channels; ++c) back[i * channels + c] = row[(n - 1 - i) * channels + c];
    return back;
}

/// Sums over all faces.
struct FaceSums {
    double steps = 0, values = 0;
};

FaceSums face_sums(const Cube& cube) {
    const int n = cube.size(), channels = colours(cube), stride = cube.channels();
    std::vector<FaceSums> rows(std::size_t(6) * n);
    for_rows(6 * n, 64, [&](std::int64_t begin, std::int64_t end) {
        std::vector<float> here(std::size_t(n) * channels), below(here);
        for (std::int64_t r = begin; r < end; ++r) {
            const Image<float>& face = cube.faces[r / n];
            const int y = int(r % n);
            for (int x = 0; x < n; ++x)
                for (int c = 0; c < channels; ++c) {
                    const std::size_t i = std::size_t(x) * channels + c;
                    here[i] = seen(face.row(y)[x * stride + c]);
                    below[i] = seen(face.row(std::min(y + 1, n - 1))[x * stride + c]);
                    rows[r].values += double(here[i]);
                    rows[r].steps += double(std::abs(below[i] - here[i]));
                    if (x > 0) rows[r].steps += double(std::abs(here[i] - here[i - channels]));
                }
        }
    });
    FaceSums sums;
    for (const FaceSums& row : rows) sums.steps += row.steps, sums.values += row.values;
    return sums;
}

} // namespace

/// Found by texel_across for each side of a small cube.
const std::array<Seam, 12>& seams() {
    static const std::array<Seam, 12> found = [] {
        std::array<Seam, 12> all{};
        const int n = 3;
        int count = 0;
        for (int face = 0; face < 6; ++face)
            for (int side = 0; side < 4; ++side) {
                CubeTexel middle = texel_on(n, {face, side}, 1, 0);
                (side % 2 ? middle.x : middle.y) += side == 1 || side == 2 ? 1 : -1;
                const CubeTexel there = texel_across(n, CubeFace(face), middle.x, middle.y);
                const int other = int(there.face);
                for (int k = 0; k < 4; ++k) {
                    const CubeTexel at = texel_on(n, {other, k}, 1, 0);
                    if (at.x == there.x && at.y == there.y && face < other) all[count++] = {{face, side}, {other, k}};
                }
            }
        return all;
    }();
    return found;
}

SideSteps compare_sides(const Cube& cube) {
    SideSteps sides;
    const int n = cube.size(), channels = colours(cube);
    const FaceSums sums = face_sums(cube);
    if (n < 8 || !(sums.steps > 0)) return sides;
    sides.unknown = false;
    const double level = 0.01 * sums.values / (6.0 * n * n * channels), invisible = level * level,
                 everywhere = sums.steps / (12.0 * n * (n - 1) * channels);
    std::array<std::vector<float>, 24> rows, back;
    std::array<double, 24> beside;
    for (int s = 0; s < 24; ++s) {
        const FaceSide side{s / 4, s % 4};
        const std::vector<float> second = row_on(cube, side, 1);
        rows[s] = row_on(cube, side, 0);
        back[s] = reversed(rows[s], channels);
        beside[s] = (means_of(rows[s], second).square + means_of(second, row_on(cube, side, 2)).square) / 2;
    }
    for_rows(24, 1, [&](std::int64_t begin, std::int64_t end) {
        for (int a = int(begin); a < int(end); ++a)
            for (int b = 0; b < 24; ++b)
                for (const bool mirrored : {false, true}) {
                    const Means across = means_of(rows[a], mirrored ? rows[b] : back[b]);
                    const double inside = std::max((beside[a] + beside[b]) / 2, invisible);
                    sides.ratio[mirrored][a][b] = float(std::sqrt(across.square / inside));
                    sides.mean[mirrored][a][b] = float(across.step / everywhere);
                }
    });
    return sides;
}

} // namespace bake
