#include "bake/environment/resample/overlap.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

/// Appends the part of an edge within cell (x, y), given in coordinates of the cell.
inline void add_part(EdgePart*& parts, int x, int y, double x0, double y0, double x1, double y1) noexcept {
    const double h = y1 - y0, middle = 0.5 * (y0 + y1), across = x0 + x1;
    *parts++ = {x,
                y,
                {h * (1 - 0.5 * across), h * (0.5 - (across * across - x0 * x1) * (1.0 / 6)),
                 h * (middle - (across * middle * 6 + (x1 - x0) * h) * (1.0 / 12))},
                {h, 0.5 * h, h * middle}};
}

template <int sign> inline void add(CellMoments& sum, const CellMoments& part) noexcept {
    sum.area += sign * part.area;
    sum.x += sign * part.x;
    sum.y += sign * part.y;
    sum.unused += sign * part.unused;
}

/// Adds the parts of an edge to the cells, `columns` to a row, of which the first is (column, row).
template <int sign>
inline void add_edge(const EdgeParts& edge, CellMoments* cells, int column, int row, int columns) noexcept {
    for (const EdgePart *part = edge.first, *end = part + edge.count; part != end; ++part) {
        CellMoments* const here = cells + std::ptrdiff_t(part->y - row) * columns + (part->x - column);
        CellMoments* const row_end = cells + std::ptrdiff_t(part->y - row + 1) * columns;
        add<sign>(*here, part->here);
        for (CellMoments* right = here + 1; right < row_end; ++right) add<sign>(*right, part->beyond);
    }
}

/// Cuts a part of an edge within one row of cells at the borders of the columns.
inline void cut_row(EdgePart*& parts, int row, int c0, int c1, double x0, double y0, double x1, double y1) noexcept {
    if (c0 == c1) return add_part(parts, c0, row, x0 - c0, y0, x1 - c0, y1);
    const double slope = (y1 - y0) / (x1 - x0);
    double x = x0, y = y0;
    for (int c = c0; c != c1; c += c0 < c1 ? 1 : -1) {
        const int border = c0 < c1 ? c + 1 : c;
        const double next = y0 + slope * (border - x0);
        add_part(parts, c, row, x - c, y, border - c, next);
        x = border;
        y = next;
    }
    add_part(parts, c1, row, x - c1, y, x1 - c1, y1);
}

} // namespace

FacePlane::FacePlane(const FaceGrid& grid, CubeFace face) noexcept : middle(grid.middle()) {
    axis = cube_direction(CubePoint<double>{face, 0.5, 0.5});
    s = (cube_direction(CubePoint<double>{face, 1, 0.5}) - axis) * grid.scale();
    t = (cube_direction(CubePoint<double>{face, 0.5, 1}) - axis) * grid.scale();
}

void cut_edge(const PlanePoint& from, const PlanePoint& to, EdgePart* parts) noexcept {
    const int r0 = from.row, r1 = to.row;
    if (r0 == r1) return cut_row(parts, r0, from.column, to.column, from.x, from.y - r0, to.x, to.y - r0);
    const double slope = (to.x - from.x) / (to.y - from.y);
    // Clamped to the range of the ends: rounding must not move a point to a column outside it.
    const double least = std::min(from.x, to.x), most = std::max(from.x, to.x);
    double x = from.x, y = from.y;
    int column = from.column;
    for (int r = r0; r != r1; r += r0 < r1 ? 1 : -1) {
        const int border = r0 < r1 ? r + 1 : r;
        const double next = std::clamp(from.x + slope * (border - from.y), least, most);
        const int next_column = cell_of(next);
        cut_row(parts, r, column, next_column, x, y - r, next, border - r);
        x = next;
        y = border;
        column = next_column;
    }
    cut_row(parts, r1, column, to.column, x, y - r1, to.x, to.y - r1);
}

void overlap(const FaceGrid& grid, const PlanePoint* const corners[4], const EdgeParts edges[4], Overlap& result) {
    const PlanePoint &p0 = *corners[0], &p1 = *corners[1], &p2 = *corners[2], &p3 = *corners[3];
    result.column = least_of(p0.column, p1.column, p2.column, p3.column);
    result.row = least_of(p0.row, p1.row, p2.row, p3.row);
    const int columns = result.columns = most_of(p0.column, p1.column, p2.column, p3.column) - result.column + 1;
    const int rows = result.rows = most_of(p0.row, p1.row, p2.row, p3.row) - result.row + 1;
    const std::size_t count = std::size_t(rows) * columns;
    if (result.cells.size() < count) result.cells.resize(count);
    CellMoments* const cells = result.cells.data();
    std::fill_n(cells, count, CellMoments{});
    // On the way around the quadrilateral the lower and the left edge are traversed backwards.
    add_edge<1>(edges[0], cells, result.column, result.row, columns);
    add_edge<1>(edges[1], cells, result.column, result.row, columns);
    add_edge<-1>(edges[2], cells, result.column, result.row, columns);
    add_edge<-1>(edges[3], cells, result.column, result.row, columns);

    // J and the local coordinates are evaluated at the middle.
    const double mx = 0.25 * (p0.x + p1.x + p2.x + p3.x), my = 0.25 * (p0.y + p1.y + p2.y + p3.y);
    const double inverse_scale = 1 / grid.scale();
    const double sc = (mx - grid.middle()) * inverse_scale, tc = (my - grid.middle()) * inverse_scale;
    const double r2 = 1 / (1 + sc * sc + tc * tc), j = r2 * std::sqrt(r2) * inverse_scale * inverse_scale;
    result.jacobian_x = -3 * j * r2 * sc * inverse_scale;
    result.jacobian_y = -3 * j * r2 * tc * inverse_scale;
    result.jacobian = j;
    result.middle_x = mx;
    result.middle_y = my;

    const double ux = 0.5 * (p1.x - p0.x + p2.x - p3.x), uy = 0.5 * (p1.y - p0.y + p2.y - p3.y);
    const double vx = 0.5 * (p3.x - p0.x + p2.x - p1.x), vy = 0.5 * (p3.y - p0.y + p2.y - p1.y);
    const double det = ux * vy - uy * vx, inverse_det = det != 0 ? 1 / det : 0;
    result.orientation = det < 0 ? 1 : -1; // areas are measured to the right of a falling edge
    result.ax = vy * inverse_det;
    result.ay = -vx * inverse_det;
    result.bx = -uy * inverse_det;
    result.by = ux * inverse_det;
}

} // namespace bake
