#include "bake/surface/subdivision/crease_pieces.h"
#include <algorithm>
#include <array>
#include <cmath>

namespace bake {
namespace {

/// Rows: exponents or points; columns: the points of one row of the patch.
using Matrix = std::array<std::array<double, 4>, 4>;

Matrix operator*(const Matrix& a, const Matrix& b) noexcept {
    Matrix out{};
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j)
            for (std::size_t k = 0; k < 4; ++k) out[i][j] += a[i][k] * b[k][j];
    return out;
}

constexpr Matrix identity = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
constexpr Matrix b_spline = {
    {{1 / 6., 4 / 6., 1 / 6., 0}, {-.5, 0, .5, 0}, {.5, -1, .5, 0}, {-1 / 6., .5, -.5, 1 / 6.}}};

/// The points of a row, those beyond borders replaced by the reflection of the points inside.
Matrix with_borders(bool low, bool high) noexcept {
    Matrix points = identity;
    if (low) points[0] = {0, 2, -1, 0};
    if (high) points[3] = {0, -1, 2, 0};
    return points;
}

/// The point of the next level at the crease, which is at point 2.
std::array<double, 4> at_crease(double sharpness) noexcept {
    const double smooth = 1 - sharpness;
    return {0, smooth / 8, sharpness + smooth * 6 / 8, smooth / 8};
}
/// The points of the next level for the half of the cell at the crease, and for the other half.
Matrix near_half(double sharpness) noexcept {
    return {{{1 / 8., 6 / 8., 1 / 8., 0}, {0, .5, .5, 0}, at_crease(sharpness), {0, 0, .5, .5}}};
}
Matrix far_half(double sharpness) noexcept {
    return {{{.5, .5, 0, 0}, {1 / 8., 6 / 8., 1 / 8., 0}, {0, .5, .5, 0}, at_crease(sharpness)}};
}

/// A polynomial in scale * x + offset as one in x.
Matrix substitute(const Matrix& from, double scale, double offset) noexcept {
    constexpr double binomial[4][4] = {{1, 0, 0, 0}, {1, 1, 0, 0}, {1, 2, 1, 0}, {1, 3, 3, 1}};
    Matrix change{};
    for (std::size_t j = 0; j < 4; ++j)
        for (std::size_t k = j; k < 4; ++k)
            change[j][k] = binomial[k][j] * std::pow(scale, double(j)) * std::pow(offset, double(k - j));
    return change * from;
}

struct AxisPiece {
    double begin, end;
    Matrix weight;
};

/// Of a crease at parameter 1.
std::vector<AxisPiece> pieces_across(double sharpness, bool far_border) {
    std::vector<AxisPiece> pieces;
    const double whole = std::floor(sharpness), fraction = sharpness - whole;
    const double line = 1 - std::exp2(-whole); // where the crease begins to be rounded
    Matrix points = with_borders(far_border, false);
    if (whole > 0) pieces.push_back({0, line, b_spline * (with_borders(false, true) * points)});
    for (int level = 0; level < int(whole); ++level) points = near_half(1) * points;
    const double scale = std::exp2(whole);
    if (fraction == 0) {
        pieces.push_back({line, 1, substitute(b_spline * points, scale, -scale * line)});
        return pieces;
    }
    const double middle = (line + 1) / 2;
    pieces.push_back(
        {line, middle, substitute(b_spline * (far_half(fraction) * points), 2 * scale, -2 * scale * line)});
    pieces.push_back(
        {middle, 1, substitute(b_spline * (near_half(fraction) * points), 2 * scale, -2 * scale * middle)});
    return pieces;
}

/// The pieces of a crease at parameter 0.
std::vector<AxisPiece> mirrored(std::vector<AxisPiece> pieces) {
    std::reverse(pieces.begin(), pieces.end());
    for (AxisPiece& piece : pieces) {
        piece = {1 - piece.end, 1 - piece.begin, substitute(piece.weight, -1, 1)};
        for (auto& row : piece.weight) std::reverse(row.begin(), row.end());
    }
    return pieces;
}

} // namespace

std::vector<CreasePiece> crease_pieces(int side, double sharpness, int borders) {
    const auto border = [borders](int s) { return (borders >> s & 1) != 0; };
    const bool across_s = crease_is_along_t(side), at_end = side == 1 || side == 2;
    std::vector<AxisPiece> across = pieces_across(sharpness, border((side + 2) % 4));
    if (!at_end) across = mirrored(std::move(across));
    const Matrix along =
        b_spline * (across_s ? with_borders(border(0), border(2)) : with_borders(border(3), border(1)));
    std::vector<CreasePiece> pieces;
    for (const AxisPiece& piece : across) {
        const Matrix& in_s = across_s ? piece.weight : along;
        const Matrix& in_t = across_s ? along : piece.weight;
        Conversion conversion{16, {}};
        for (std::size_t n = 0; n < 4; ++n)
            for (std::size_t m = 0; m < 4; ++m)
                for (std::size_t j = 0; j < 4; ++j)
                    for (std::size_t i = 0; i < 4; ++i) conversion.weight.push_back(in_s[m][i] * in_t[n][j]);
        pieces.push_back({piece.begin, piece.end, std::move(conversion)});
    }
    return pieces;
}

} // namespace bake
