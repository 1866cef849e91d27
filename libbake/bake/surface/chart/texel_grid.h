// Triangles of a UV chart on an integer grid, and the texels that they cover.
//
// Corners are snapped to a grid of about 2^30 steps across the unit square, which is finer than the rounding of float
// uvs. After that, whether a triangle covers a texel is decided in integers, without rounding. Triangles inside the
// unit square need 64 bits, others 128.
#pragma once
#include "bake/mesh/triangulate.h"
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace bake::texel_grid {

using Wide = __int128;

struct TexelGrid {
    int width, height;
    int bits;          ///< a texel is 2^bits steps wide; at least 2, so that centres and half texels are grid points
    std::int64_t step; ///< 2^bits
    std::int64_t moved_x = 0,
                 moved_y = 0; ///< steps by which charts are moved, so that another place comes to the centres

    TexelGrid(int w, int h) : width(w), height(h) {
        bits = std::max(2, 30 - int(std::bit_width(unsigned(std::max(w, h) - 1))));
        step = std::int64_t(1) << bits;
    }
};

template <class I> struct GridPoint { I x, y; };

using GridTriangle = std::array<GridPoint<std::int64_t>, 3>;

inline std::int64_t snapped(double texels, double step) noexcept {
    const double limit = double(std::int64_t(1) << 59); // 10^8 tiles away; products stay within 128 bits
    return std::int64_t(std::floor(std::clamp(texels * step, -limit, limit) + 0.5));
}

/// The uv triangle on the grid: x to the right, y down, as in the image.
inline GridTriangle corners_of(const Mesh& mesh, const Triangle& triangle, const TexelGrid& grid) noexcept {
    GridTriangle out;
    for (int k = 0; k < 3; ++k) {
        const Vec2f uv = mesh.uvs[mesh.corner_uv[triangle.corner[k]]];
        out[k].x = snapped(double(uv.x) * grid.width, double(grid.step)) + grid.moved_x;
        out[k].y = snapped((1 - double(uv.y)) * grid.height, double(grid.step)) + grid.moved_y;
    }
    return out;
}

inline Wide doubled_area(const GridTriangle& c) noexcept {
    return Wide(c[1].x - c[0].x) * (c[2].y - c[0].y) - Wide(c[1].y - c[0].y) * (c[2].x - c[0].x);
}

struct GridBox {
    std::int64_t x0, x1, y0, y1;
};

inline GridBox box_of(const GridTriangle& c) noexcept {
    const auto [x0, x1] = std::minmax({c[0].x, c[1].x, c[2].x});
    const auto [y0, y1] = std::minmax({c[0].y, c[1].y, c[2].y});
    return {x0, x1, y0, y1};
}

inline bool inside_square(const GridBox& box, const TexelGrid& grid) noexcept {
    return box.x0 >= 0 && box.y0 >= 0 && box.x1 <= grid.step * grid.width && box.y1 <= grid.step * grid.height;
}

/// Whether the closed triangle (which may be a segment or a point) and the closed unit square have a point in common:
/// true unless a side of one of them separates them.
inline bool touches_square(const GridTriangle& c, const GridBox& box, const TexelGrid& grid) noexcept {
    const std::int64_t right = grid.step * grid.width, bottom = grid.step * grid.height;
    if (box.x1 < 0 || box.y1 < 0 || box.x0 > right || box.y0 > bottom) return false;
    const GridPoint<std::int64_t> square[4] = {{0, 0}, {right, 0}, {right, bottom}, {0, bottom}};
    for (int k = 0; k < 3; ++k) {
        const auto &a = c[k], &b = c[(k + 1) % 3], &other = c[(k + 2) % 3];
        const auto side = [&](const GridPoint<std::int64_t>& p) {
            return Wide(b.x - a.x) * (p.y - a.y) - Wide(b.y - a.y) * (p.x - a.x);
        };
        const Wide inner = side(other);
        bool all_left = true, all_right = true;
        for (const auto& p : square) {
            const Wide s = side(p);
            all_left &= s > 0;
            all_right &= s < 0;
        }
        if ((all_left && inner <= 0) || (all_right && inner >= 0)) return false;
    }
    return true;
}

template <class I> struct GridEdge {
    I x, y, dx, dy; ///< starts at (x, y); side() >= 0 in the triangle
    I reach;        ///< largest change of side() from a texel's centre to a corner of the texel
    bool owns;      ///< points on the edge belong to this triangle, not to its neighbour

    I side(I px, I py) const noexcept { return dx * (py - y) - dy * (px - x); }
};

/// A triangle with area, counter-clockwise. I is std::int64_t in the unit square, Wide elsewhere.
template <class I> struct TexelTriangle {
    GridEdge<I> edge[3]; ///< edge k starts at corner order[k]
    int order[3];        ///< the corners in the order that makes the area positive
    double inverse_area;
    GridBox box;
};

template <class I> TexelTriangle<I> shape_of(const GridTriangle& c, const TexelGrid& grid) noexcept {
    TexelTriangle<I> shape;
    const Wide area = doubled_area(c);
    shape.order[0] = 0;
    shape.order[1] = area > 0 ? 1 : 2;
    shape.order[2] = area > 0 ? 2 : 1;
    for (int k = 0; k < 3; ++k) {
        const auto &a = c[shape.order[k]], &b = c[shape.order[(k + 1) % 3]];
        GridEdge<I>& edge = shape.edge[k];
        edge.x = I(a.x), edge.y = I(a.y);
        edge.dx = I(b.x) - I(a.x), edge.dy = I(b.y) - I(a.y);
        edge.reach = ((edge.dx < 0 ? -edge.dx : edge.dx) + (edge.dy < 0 ? -edge.dy : edge.dy)) * I(grid.step / 2);
        edge.owns = edge.dy > 0 || (edge.dy == 0 && edge.dx > 0);
    }
    shape.inverse_area = 1 / double(area > 0 ? area : -area);
    shape.box = box_of(c);
    return shape;
}

/// Texels first to last of a row; none if last < first.
struct TexelSpan {
    int first, last;
};

template <class I> I floored(I a, I b, bool& exact) noexcept { // b > 0
    const I quotient = a / b, rest = a % b;
    exact = rest == 0;
    return quotient - (rest < 0);
}

/// The texels of row y whose centre is in or on the triangle. With `reach`: those whose square touches the half-planes
/// of all three edges. `owned`, if not null, receives the texels whose centre belongs to this triangle alone.
template <class I>
TexelSpan span_of(const TexelTriangle<I>& shape, const TexelGrid& grid, int y, bool reach, TexelSpan* owned = nullptr) {
    const I step = grid.step, half = step / 2, center = I(y) * step + half;
    I first = 0, last = grid.width - 1, own_first = first, own_last = last;
    for (const GridEdge<I>& edge : shape.edge) {
        // side() at the centre of texel i is at - slope * i.
        const I at = edge.side(half, center) + (reach ? edge.reach : I(0)), slope = edge.dy * step;
        bool exact;
        if (slope > 0) {
            const I bound = floored(at, slope, exact);
            last = std::min(last, bound);
            own_last = std::min(own_last, bound - (exact && !edge.owns));
        } else if (slope < 0) {
            const I bound = -floored(at, I(-slope), exact);
            first = std::max(first, bound);
            own_first = std::max(own_first, bound + (exact && !edge.owns));
        } else {
            if (at < 0) return {0, -1};
            if (at == 0 && !edge.owns) own_last = -1;
        }
        if (last < first) return {0, -1};
    }
    if (owned) *owned = own_first <= own_last ? TexelSpan{int(own_first), int(own_last)} : TexelSpan{0, -1};
    return {int(first), int(last)};
}

struct NearestPoint {
    double distance; ///< squared, in steps
    float b1, b2;
};

/// The point of the triangle nearest to the centre of texel (i, y), which is outside: a point of an edge.
template <class I> NearestPoint nearest(const TexelTriangle<I>& shape, const TexelGrid& grid, int i, int y) noexcept {
    const I px = I(i) * grid.step + grid.step / 2, py = I(y) * grid.step + grid.step / 2;
    NearestPoint best{HUGE_VAL, 0, 0};
    for (int k = 0; k < 3; ++k) {
        const GridEdge<I>& edge = shape.edge[k];
        const double dx = double(edge.dx), dy = double(edge.dy), length = dx * dx + dy * dy;
        const double ax = double(px - edge.x), ay = double(py - edge.y);
        const double bx = double(px - edge.x - edge.dx), by = double(py - edge.y - edge.dy);
        // Symmetric in the two ends, so that the neighbour computes the same distance to the last bit.
        const double from_a = ax * dx + ay * dy, from_b = -(bx * dx + by * dy);
        double distance, t;
        if (from_a <= 0) distance = ax * ax + ay * ay, t = 0;
        else if (from_b <= 0) distance = bx * bx + by * by, t = 1;
        else {
            const double side = double(edge.side(px, py));
            distance = side * side / length;
            t = std::min(1.0, from_a / length);
        }
        if (!(distance < best.distance)) continue;
        float weight[3] = {0, 0, 0};
        weight[shape.order[k]] = float(1 - t);
        weight[shape.order[(k + 1) % 3]] = float(t);
        best = {distance, weight[1], weight[2]};
    }
    return best;
}

} // namespace bake::texel_grid
