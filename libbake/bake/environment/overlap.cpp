#include "bake/environment/overlap.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

/// A part of an edge that lies in one cell: adds what lies at its right in the cell, and notes for the cells further
/// right that they are covered over its height.
inline void add_part(CellMoments& cell, CellMoments& beyond, double x0, double y0, double x1, double y1) noexcept {
    const double h = y1 - y0, middle = 0.5 * (y0 + y1);
    cell.area += h * (1 - 0.5 * (x0 + x1));
    cell.x += h * (0.5 - (x0 * x0 + x0 * x1 + x1 * x1) * (1.0 / 6));
    cell.y += h * (middle - (2 * (x0 * y0 + x1 * y1) + x0 * y1 + x1 * y0) * (1.0 / 6));
    beyond.area += h;
    beyond.x += 0.5 * h;
    beyond.y += h * middle;
}

/// An edge within one row of cells, cut at the columns' borders. `width` cells and one to spare in `row`.
inline void add_in_row(CellMoments* row, CellMoments* beyond, double x0, double y0, double x1, double y1) noexcept {
    int c0 = int(x0), c1 = int(x1);
    if (c0 == c1) {
        add_part(row[c0], beyond[c0 + 1], x0 - c0, y0, x1 - c0, y1);
        return;
    }
    const double slope = (y1 - y0) / (x1 - x0);
    double x = x0, y = y0;
    if (c0 < c1) {
        for (int c = c0; c < c1; ++c) {
            const double next = y0 + slope * (c + 1 - x0);
            add_part(row[c], beyond[c + 1], x - c, y, 1, next);
            x = c + 1;
            y = next;
        }
    } else {
        for (int c = c0; c > c1; --c) {
            const double next = y0 + slope * (c - x0);
            add_part(row[c], beyond[c + 1], x - c, y, 0, next);
            x = c;
            y = next;
        }
    }
    add_part(row[c1], beyond[c1 + 1], x - c1, y, x1 - c1, y1);
}

void add_edge(CellMoments* cells, CellMoments* beyond, int stride, double x0, double y0, double x1, double y1) noexcept {
    const int r0 = int(y0), r1 = int(y1);
    if (r0 == r1) {
        add_in_row(cells + r0 * stride, beyond + r0 * stride, x0, y0 - r0, x1, y1 - r0);
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
            add_in_row(cells + r * stride, beyond + r * stride, x, y - r, next, 1);
            x = next;
            y = r + 1;
        }
    } else {
        for (int r = r0; r > r1; --r) {
            const double next = cut(r);
            add_in_row(cells + r * stride, beyond + r * stride, x, y - r, next, 0);
            x = next;
            y = r;
        }
    }
    add_in_row(cells + r1 * stride, beyond + r1 * stride, x, y - r1, x1, y1 - r1);
}

} // namespace

PlanePoint project(const FaceGrid& grid, CubeFace face, const Vec3d& d) noexcept {
    double ma = 0, sc = 0, tc = 0;
    switch (face) {
    case CubeFace::px: ma = d.x, sc = -d.z, tc = -d.y; break;
    case CubeFace::nx: ma = -d.x, sc = d.z, tc = -d.y; break;
    case CubeFace::py: ma = d.y, sc = d.x, tc = d.z; break;
    case CubeFace::ny: ma = -d.y, sc = d.x, tc = -d.z; break;
    case CubeFace::pz: ma = d.z, sc = d.x, tc = -d.y; break;
    case CubeFace::nz: ma = -d.z, sc = -d.x, tc = -d.y; break;
    }
    const double inverse = 1 / (ma > 0.2 ? ma : 0.2);
    return {grid.middle() + grid.scale() * (sc * inverse), grid.middle() + grid.scale() * (tc * inverse), ma};
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

    const int column = int(std::floor(x_low)), row = int(std::floor(y_low));
    const int columns = int(std::floor(x_high)) - column + 1, rows = int(std::floor(y_high)) - row + 1;
    const int stride = columns + 1; // one to spare, which `beyond` writes to
    result.column = column;
    result.row = row;
    result.columns = columns;
    result.rows = rows;
    const int count = rows * stride;
    result.cells.assign(std::size_t(2 * count), {});
    CellMoments *cells = result.cells.data(), *beyond = cells + count;
    for (int i = 0; i < 4; ++i) {
        const PlanePoint &from = p[i], &to = p[(i + 1) & 3];
        add_edge(cells, beyond, stride, from.x - column, from.y - row, to.x - column, to.y - row);
    }
    for (int r = 0; r < rows; ++r) {
        CellMoments covered;
        for (int c = 0; c < columns; ++c) {
            const CellMoments& here = beyond[r * stride + c];
            covered.area += here.area;
            covered.x += here.x;
            covered.y += here.y;
            const CellMoments& own = cells[r * stride + c];
            cells[r * columns + c] = {own.area + covered.area, own.x + covered.x, own.y + covered.y};
        }
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
