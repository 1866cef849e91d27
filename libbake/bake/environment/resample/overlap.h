// Exact overlap of a small spherical quadrilateral with the texels of a cube's face.
//
// Great circles are straight in the plane of a face, so the quadrilateral is a polygon there. Green's theorem on its
// edges gives, for every cell of the grid it meets,
//     area  = integral dA        x, y = integral of the offset from the cell's upper left corner, in cells
// and with them the solid angle, J = (1 + sc^2 + tc^2)^(-3/2) being linear over so small a quadrilateral.
#pragma once
#include "bake/environment/sky/cube.h"
#include <algorithm>
#include <cstdlib>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <vector>

namespace bake {

/// The cells of a face. Texel-centred: one cell per texel. Edge-sampled (OpenEXR's): the outer texels' centres lie on the
/// face's edges, so half of them lies outside; cells are half texels then, and the outer ones are left out.
struct FaceGrid {
    int texels = 0;
    bool edges = false;

    double scale() const noexcept { return edges ? texels - 1.0 : 0.5 * texels; } ///< cells per unit of sc
    double middle() const noexcept { return edges ? texels : 0.5 * texels; }      ///< cell coordinate of sc = 0
    int low() const noexcept { return edges ? 1 : 0; }                            ///< first cell on the face
    int high() const noexcept { return edges ? 2 * texels - 1 : texels; }         ///< one past the last
    int texel(int cell) const noexcept { return edges ? cell >> 1 : cell; }
};

/// One cell's share of a quadrilateral.
struct CellMoments {
    double area = 0, x = 0, y = 0;
    double unused = 0; ///< so that they are added two by two, in whole registers
};

/// The part of an edge that lies in one cell: what it adds to that cell, and to each cell at its right in the row.
struct EdgePart {
    int x, y; ///< the cell
    CellMoments here, beyond;
};

/// Cells [low_x, high_x) x [low_y, high_y).
struct CellWindow {
    int low_x, high_x, low_y, high_y;
};
inline CellWindow whole_face(const FaceGrid& grid) noexcept {
    return {grid.low(), grid.high(), grid.low(), grid.high()};
}

/// What the overlaps of one quadrilateral are told in, kept between calls for its memory.
struct Overlap {
    int column = 0, row = 0, columns = 0, rows = 0; ///< cells [column, column + columns) x [row, row + rows)
    std::vector<CellMoments> cells;                 ///< rows * columns, row by row; sign as the quadrilateral turns
    double orientation = 1;                         ///< 1 or -1: makes areas positive
    double middle_x = 0, middle_y = 0;              ///< the mean of the corners
    double jacobian = 0, jacobian_x = 0, jacobian_y = 0; ///< J at the middle and its slope, per cell^2
    /// Local coordinates of the quadrilateral, 0 at its middle, -1/2 and 1/2 on its sides: a = ax g + ay h at (g, h) cells
    /// from the middle.
    double ax = 0, ay = 0, bx = 0, by = 0;
};

/// The cell a coordinate lies in, as everything here rounds it, so that all agree. Without the library call that
/// std::floor is on a plain x86-64: faces have 2^17 cells at most along a side, and planes end at 5 times that.
inline int cell_of(double x) noexcept {
    constexpr int off = 1 << 20;
    return int(x + off) - off;
}

/// A point in a face's plane, in cells.
struct PlanePoint {
    double x = 0, y = 0, ma = 0; ///< ma: the component along the face's axis; x and y hold where it is above .2
    int column = 0, row = 0;     ///< the cell
};
/// From directions to the plane of a face.
struct FacePlane {
    Vec3d axis, s, t; ///< the face's axis; sc and tc of a direction, times scale
    double middle;

    FacePlane(const FaceGrid& grid, CubeFace face) noexcept;
    PlanePoint project(const Vec3d& d) const noexcept {
        return place({glm::dot(s, d), glm::dot(t, d), glm::dot(axis, d)});
    }
    /// project(d) is place(map() * d).
    glm::dmat3 map() const noexcept { return glm::transpose(glm::dmat3(s, t, axis)); }
    PlanePoint place(const Vec3d& mapped) const noexcept {
        const double ma = mapped.z, inverse = 1 / (ma > 0.2 ? ma : 0.2);
        const double x = middle + mapped.x * inverse, y = middle + mapped.y * inverse;
        return {x, y, ma, cell_of(x), cell_of(y)};
    }
};

/// An edge's parts, cell by cell: part_count of them.
void cut_edge(const PlanePoint& from, const PlanePoint& to, EdgePart* parts) noexcept;
inline int part_count(const PlanePoint& from, const PlanePoint& to) noexcept {
    return std::abs(to.row - from.row) + std::abs(to.column - from.column) + 1;
}

/// Some parts of a list.
struct EdgeParts {
    const EdgePart* first = nullptr;
    int count = 0;
};

// Not of an initialiser list, which goes through memory.
template <class T> inline T least_of(T a, T b, T c, T d) noexcept { return std::min(std::min(a, b), std::min(c, d)); }
template <class T> inline T most_of(T a, T b, T c, T d) noexcept { return std::max(std::max(a, b), std::max(c, d)); }

/// Whether a quadrilateral lies ahead of the face and its bounding box meets the window.
inline bool may_meet(const CellWindow& window, const PlanePoint& a, const PlanePoint& b, const PlanePoint& c,
                     const PlanePoint& d) noexcept {
    return least_of(a.ma, b.ma, c.ma, d.ma) >= 0.3 && most_of(a.column, b.column, c.column, d.column) >= window.low_x &&
           least_of(a.column, b.column, c.column, d.column) < window.high_x &&
           most_of(a.row, b.row, c.row, d.row) >= window.low_y && least_of(a.row, b.row, c.row, d.row) < window.high_y;
}

/// The quadrilateral with corners (0, 0), (1, 0), (1, 1), (0, 1) of its local coordinates, all of it. `edges`: its upper
/// edge from left to right, its right one downwards, its lower one from left to right, its left one downwards; shared
/// with its neighbours.
void overlap(const FaceGrid& grid, const PlanePoint* const corners[4], const EdgeParts edges[4], Overlap& result);

} // namespace bake
