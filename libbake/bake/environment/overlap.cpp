#include "bake/environment/overlap.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

/// Without the library call that std::floor is on a plain x86-64. Faces have 2^17 cells at most along a side, and planes
/// are cut at 5 times that.
inline int floor_of(double x) noexcept {
    constexpr int off = 1 << 20;
    return int(x + off) - off;
}

/// A part of an edge that lies in cell c of a row of `columns` cells: adds what lies at its right, in the cell itself and
/// in those further right, which are covered over the part's height.
inline void add_part(CellMoments* row, int c, int columns, double x0, double y0, double x1, double y1) noexcept {
    const double h = y1 - y0, middle = 0.5 * (y0 + y1), across = x0 + x1;
    CellMoments& cell = row[c];
    cell.area += h * (1 - 0.5 * across);
    cell.x += h * (0.5 - (across * across - x0 * x1) * (1.0 / 6));
    cell.y += h * (middle - (across * middle * 6 + (x1 - x0) * h) * (1.0 / 12));
    for (int right = c + 1; right < columns; ++right) {
        row[right].area += h;
        row[right].x += 0.5 * h;
        row[right].y += h * middle;
    }
}

/// An edge within one row of cells, cut at the columns' borders.
inline void add_in_row(CellMoments* row, int columns, double x0, double y0, double x1, double y1) noexcept {
    const int c0 = int(x0), c1 = int(x1);
    if (c0 == c1) {
        add_part(row, c0, columns, x0 - c0, y0, x1 - c0, y1);
        return;
    }
    const double slope = (y1 - y0) / (x1 - x0);
    double x = x0, y = y0;
    if (c0 < c1) {
        for (int c = c0; c < c1; ++c) {
            const double next = y0 + slope * (c + 1 - x0);
            add_part(row, c, columns, x - c, y, 1, next);
            x = c + 1;
            y = next;
        }
    } else {
        for (int c = c0; c > c1; --c) {
            const double next = y0 + slope * (c - x0);
            add_part(row, c, columns, x - c, y, 0, next);
            x = c;
            y = next;
        }
    }
    add_part(row, c1, columns, x - c1, y, x1 - c1, y1);
}

inline void add_edge(CellMoments* cells, int columns, double x0, double y0, double x1, double y1) noexcept {
    const int r0 = int(y0), r1 = int(y1);
    if (r0 == r1) {
        add_in_row(cells + r0 * columns, columns, x0, y0 - r0, x1, y1 - r0);
        return;
    }
    const double slope = (x1 - x0) / (y1 - y0);
    double x = x0, y = y0;
    // Kept between the ends: rounding must not leave the row's cells.
    const double least = std::min(x0, x1), most = std::max(x0, x1);
    const auto cut = [&](double at) { return std::clamp(x0 + slope * (at - y0), least, most); };
    if (r0 < r1) {
        for (int r = r0; r < r1; ++r) {
            const double next = cut(r + 1);
            add_in_row(cells + r * columns, columns, x, y - r, next, 1);
            x = next;
            y = r + 1;
        }
    } else {
        for (int r = r0; r > r1; --r) {
            const double next = cut(r);
            add_in_row(cells + r * columns, columns, x, y - r, next, 0);
            x = next;
            y = r;
        }
    }
    add_in_row(cells + r1 * columns, columns, x, y - r1, x1, y1 - r1);
}

} // namespace

FacePlane::FacePlane(const FaceGrid& grid, CubeFace face) noexcept : middle(grid.middle()) {
    axis = cube_direction(CubePoint<double>{face, 0.5, 0.5});
    s = (cube_direction(CubePoint<double>{face, 1, 0.5}) - axis) * grid.scale();
    t = (cube_direction(CubePoint<double>{face, 0.5, 1}) - axis) * grid.scale();
}

bool overlap(const FaceGrid& grid, const CellWindow& window, const PlanePoint* p, Overlap& result) {
    double x_low = p[0].x, x_high = p[0].x, y_low = p[0].y, y_high = p[0].y, ma = p[0].ma;
    for (int i = 1; i < 4; ++i) {
        x_low = std::min(x_low, p[i].x);
        x_high = std::max(x_high, p[i].x);
        y_low = std::min(y_low, p[i].y);
        y_high = std::max(y_high, p[i].y);
        ma = std::min(ma, p[i].ma);
    }
    if (ma < 0.3 || x_high <= window.low_x || x_low >= window.high_x || y_high <= window.low_y || y_low >= window.high_y) return false;

    const int column = floor_of(x_low), row = floor_of(y_low);
    const int columns = floor_of(x_high) - column + 1, rows = floor_of(y_high) - row + 1;
    result.column = column;
    result.row = row;
    result.columns = columns;
    result.rows = rows;
    const std::size_t count = std::size_t(rows) * columns;
    if (result.cells.size() < count) result.cells.resize(count);
    CellMoments* const cells = result.cells.data();
    std::fill_n(cells, count, CellMoments{});
    for (int i = 0; i < 4; ++i) {
        const PlanePoint &from = p[i], &to = p[(i + 1) & 3];
        add_edge(cells, columns, from.x - column, from.y - row, to.x - column, to.y - row);
    }

    // The middle, the mean of the corners, is where J and the local coordinates are taken.
    const double mx = 0.25 * (p[0].x + p[1].x + p[2].x + p[3].x), my = 0.25 * (p[0].y + p[1].y + p[2].y + p[3].y);
    const double inverse_scale = 1 / grid.scale();
    const double sc = (mx - grid.middle()) * inverse_scale, tc = (my - grid.middle()) * inverse_scale;
    const double r2 = 1 / (1 + sc * sc + tc * tc), j = r2 * std::sqrt(r2) * inverse_scale * inverse_scale;
    result.jacobian_x = -3 * j * r2 * sc * inverse_scale;
    result.jacobian_y = -3 * j * r2 * tc * inverse_scale;
    result.jacobian_middle = j;
    result.jacobian = j - result.jacobian_x * mx - result.jacobian_y * my;

    const double ux = 0.5 * (p[1].x - p[0].x + p[2].x - p[3].x), uy = 0.5 * (p[1].y - p[0].y + p[2].y - p[3].y);
    const double vx = 0.5 * (p[3].x - p[0].x + p[2].x - p[1].x), vy = 0.5 * (p[3].y - p[0].y + p[2].y - p[1].y);
    const double det = ux * vy - uy * vx, inverse_det = det != 0 ? 1 / det : 0;
    result.orientation = det < 0 ? 1 : -1; // what lies right of a falling edge counts
    result.ax = vy * inverse_det;
    result.ay = -vx * inverse_det;
    result.bx = -uy * inverse_det;
    result.by = ux * inverse_det;
    result.a0 = -result.ax * mx - result.ay * my;
    result.b0 = -result.bx * mx - result.by * my;
    return true;
}

} // namespace bake
