// Exact overlap of a small spherical quadrilateral with the texels of a cube's face.
//
// Great circles are straight in the plane of a face, so the quadrilateral is a polygon there. Green's theorem applied to its
// edges gives, for every cell of the grid that the polygon overlaps,
//     area  = integral dA        x, y = integral of the offset from the cell's upper left corner, in cells
// The solid angle follows from these, because J = (1 + sc^2 + tc^2)^(-3/2) is nearly linear over a small quadrilateral.
#pragma once
#include "bake/environment/sky/cube.h"
#include <algorithm>
#include <cstdlib>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <vector>

namespace bake {

/// The cells of a face. Texel-centred faces have one cell per texel. In edge-sampled faces (OpenEXR's) the centres of the
/// outer texels lie on the edges, so that half of each outer texel is outside; cells are half texels, without the outer ones.
struct FaceGrid {
    int texels = 0;
    bool edges = false;

    double scale() const noexcept { return edges ? texels - 1.0 : 0.5 * texels; } ///< cells per unit of sc
    double middle() const noexcept { return edges ? texels : 0.5 * texels; }      ///< cell coordinate of sc = 0
    int low() const noexcept { return edges ? 1 : 0; }                            ///< first cell on the face
    int high() const noexcept { return edges ? 2 * texels - 1 : texels; }         ///< one past the last
    int texel(int cell) const noexcept { return edges ? cell >> 1 : cell; }
};

/// Moments of the part of a quadrilateral in one cell.
struct CellMoments {
    double area = 0, x = 0, y = 0;
    double unused = 0; ///< pads to two registers, so that additions vectorise
};

/// The part of an edge that lies in one cell, and its contributions to that cell and to each cell at its right in the row.
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

/// The overlaps of one quadrilateral; reused between calls for its memory.
struct Overlap {
    int column = 0, row = 0, columns = 0, rows = 0;      ///< cells [column, column + columns) x [row, row + rows)
    std::vector<CellMoments> cells;                      ///< rows * columns, row by row; negative for one winding
    double orientation = 1;                              ///< 1 or -1: makes areas positive
    double middle_x = 0, middle_y = 0;                   ///< the mean of the corners
    double jacobian = 0, jacobian_x = 0, jacobian_y = 0; ///< J at the middle and its slope, per cell^2
    /// Local coordinates (a, b) of the quadrilateral, 0 at its middle and -1/2 and 1/2 on its sides: a = ax g + ay h and
    /// b = bx g + by h at (g, h) cells from the middle.
    double ax = 0, ay = 0, bx = 0, by = 0;
};

/// The cell that contains a coordinate: floor, for all code here, so that the rounding is consistent. std::floor is a library
/// call on baseline x86-64. Faces have at most 2^17 cells along a side, and coordinates are at most 5 times as large.
inline int cell_of(double x) noexcept {
    constexpr int off = 1 << 20;
    return int(x + off) - off;
}

/// A point in a face's plane, in cells.
struct PlanePoint {
    double x = 0, y = 0, ma = 0; ///< ma: component along the face's axis; x and y are valid if ma > .2
    int column = 0, row = 0;     ///< the cell
};
/// Projection of directions to the plane of a face.
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

/// Cuts an edge at the borders of the cells: part_count parts.
void cut_edge(const PlanePoint& from, const PlanePoint& to, EdgePart* parts) noexcept;
inline int part_count(const PlanePoint& from, const PlanePoint& to) noexcept {
    return std::abs(to.row - from.row) + std::abs(to.column - from.column) + 1;
}

/// A range of parts.
struct EdgeParts {
    const EdgePart* first = nullptr;
    int count = 0;
};

/// Edges that are cut when they are first needed, and shared between quadrilaterals.
class EdgeRow {
public:
    void reset(int edges) {
        used_ = 0;
        first_.resize(edges);
        count_.assign(edges, 0);
    }
    void cut(int k, const PlanePoint& from, const PlanePoint& to) {
        if (count_[k] > 0) return;
        first_[k] = used_;
        count_[k] = part_count(from, to);
        used_ += count_[k];
        if (std::size_t(used_) > parts_.size()) parts_.resize(2 * std::size_t(used_));
        cut_edge(from, to, parts_.data() + first_[k]);
    }
    EdgeParts operator[](int k) const noexcept { return {parts_.data() + first_[k], count_[k]}; }

private:
    std::vector<EdgePart> parts_;
    std::vector<int> first_, count_; ///< count 0: not cut yet
    int used_ = 0;
};

// std::min and std::max of an initialiser list go through memory.
template <class T> inline T least_of(T a, T b, T c, T d) noexcept { return std::min(std::min(a, b), std::min(c, d)); }
template <class T> inline T most_of(T a, T b, T c, T d) noexcept { return std::max(std::max(a, b), std::max(c, d)); }

/// Whether a quadrilateral is ahead of the face and its bounding box overlaps the window.
inline bool may_overlap(const CellWindow& window, const PlanePoint& a, const PlanePoint& b, const PlanePoint& c,
                        const PlanePoint& d) noexcept {
    return least_of(a.ma, b.ma, c.ma, d.ma) >= 0.3 && most_of(a.column, b.column, c.column, d.column) >= window.low_x &&
           least_of(a.column, b.column, c.column, d.column) < window.high_x &&
           most_of(a.row, b.row, c.row, d.row) >= window.low_y && least_of(a.row, b.row, c.row, d.row) < window.high_y;
}

/// The overlaps of the quadrilateral with corners (0, 0), (1, 0), (1, 1), (0, 1) of its local coordinates. `edges`: the upper
/// edge from left to right, the right edge downwards, the lower edge from left to right, and the left edge downwards, so
/// that neighbours can share them.
void overlap(const FaceGrid& grid, const PlanePoint* const corners[4], const EdgeParts edges[4], Overlap& result);

} // namespace bake
