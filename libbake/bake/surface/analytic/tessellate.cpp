#include "bake/base/error.h"
#include "bake/base/parallel.h"
#include "bake/mesh/keep_used.h"
#include "bake/surface/analytic/parametric.h"
#include "bake/surface/analytic/parametric_shapes.h"

namespace bake {
namespace {

constexpr std::size_t rows_at_a_time = 8;

/// Grid vertices of one patch, (columns + 1) x (rows + 1), i first.
struct Grid {
    int columns, rows;
    std::size_t size() const noexcept { return std::size_t(columns + 1) * std::size_t(rows + 1); }
    std::uint32_t at(int i, int j) const noexcept { return std::uint32_t(j * (columns + 1) + i); }
    double u(int i) const noexcept { return double(i) / columns; }
    double v(int j) const noexcept { return double(j) / rows; }
};

/// Which grid vertex (i, j) is: at a closure that of the lower end, on a collapsed edge the first of the edge.
struct Sharing {
    const ParametricSurface& surface;
    Grid grid;
    bool low_u = false, high_u = false, low_v = false, high_v = false; ///< edges that collapse to one point

    Sharing(const ParametricSurface& s, Grid g) : surface(s), grid(g) {
        const auto point = [&](int i, int j) { return s.derivatives(g.u(i), g.v(j)).p; };
        const auto collapsed = [&](bool along_u, int at) {
            for (int k = 0; k <= (along_u ? g.columns : g.rows); ++k)
                if (!(along_u ? point(k, at) == point(0, at) : point(at, k) == point(at, 0))) return false;
            return true;
        };
        if (s.closure_v() == Closure::open) low_v = collapsed(true, 0), high_v = collapsed(true, g.rows);
        if (s.closure_u() == Closure::open) low_u = collapsed(false, 0), high_u = collapsed(false, g.columns);
    }
    std::uint32_t position(int i, int j) const noexcept {
        if (j == grid.rows && surface.closure_v() == Closure::periodic) j = 0;
        if (i == grid.columns && surface.closure_u() != Closure::open) {
            i = 0;
            if (surface.closure_u() == Closure::twisted) j = grid.rows - j;
            if (j == grid.rows && surface.closure_v() == Closure::periodic) j = 0;
        }
        if ((j == 0 && low_v) || (j == grid.rows && high_v)) i = 0;
        if ((i == 0 && low_u) || (i == grid.columns && high_u)) j = 0;
        return grid.at(i, j);
    }
    /// The normals of the two ends of a twisted closure are opposite, so they stay apart; at a pole without normal each
    /// meridian keeps its own.
    std::uint32_t normal(int i, int j) const noexcept {
        const bool twisted_end = i == grid.columns && surface.closure_u() == Closure::twisted;
        if (twisted_end)
            return j == grid.rows && surface.closure_v() == Closure::periodic ? grid.at(i, 0) : grid.at(i, j);
        const bool border = i == 0 || i == grid.columns || j == 0 || j == grid.rows;
        if (!border || surface.pole(grid.u(i), grid.v(j)) != Pole::without_normal) return position(i, j);
        return grid.at(i == grid.columns && surface.closure_u() != Closure::open ? 0 : i, j);
    }
};

/// Positions of Bezier patches: corners first, then the inner points of the borders, then those of the patches.
struct BezierSharing {
    const BezierBorders& borders;
    Grid grid;
    std::vector<std::array<std::uint32_t, 2>> inner; ///< borders; first inner point at the rate of columns, of rows
    std::uint32_t inside = 0;                        ///< first point inside a patch

    BezierSharing(const BezierBorders& b, Grid g) : borders(b), grid(g) {
        std::uint32_t next = b.corners;
        for (std::size_t k = 0; k < b.curve.size(); ++k) {
            auto& [by_columns, by_rows] = inner.emplace_back();
            by_columns = next, next += std::uint32_t(g.columns - 1);
            by_rows = g.rows == g.columns ? by_columns : next;
            if (g.rows != g.columns) next += std::uint32_t(g.rows - 1);
        }
        inside = next;
    }
    std::size_t points(std::size_t patches) const noexcept {
        return inside + patches * std::size_t(grid.columns - 1) * std::size_t(grid.rows - 1);
    }
    std::uint32_t position(std::size_t patch, int i, int j) const noexcept {
        const auto& corner = borders.corner[patch];
        const bool left = i == 0, right = i == grid.columns, low = j == 0, high = j == grid.rows;
        if ((left || right) && (low || high)) return corner[low ? (left ? 0 : 1) : (left ? 3 : 2)];
        if (!(left || right || low || high))
            return inside + std::uint32_t((int(patch) * (grid.rows - 1) + j - 1) * (grid.columns - 1) + i - 1);
        const std::size_t side = low ? 0 : right ? 1 : high ? 2 : 3;
        const std::uint32_t border = borders.border[patch][side];
        if (borders.point[border]) return corner[side];
        const bool along_u = low || high;
        const int rate = along_u ? grid.columns : grid.rows, k = along_u ? i : j;
        const int along = borders.reversed[patch][side] ? rate - k : k;
        return inner[border][along_u ? 0 : 1] + std::uint32_t(along - 1);
    }
    /// Evaluates the points on the borders, each from the curve of its border alone.
    void place(std::vector<Vec3f>& positions) const {
        for (std::size_t b = 0; b < borders.curve.size(); ++b)
            for (const bool along_u : {true, false}) {
                const int rate = along_u ? grid.columns : grid.rows;
                for (int k = 1; k < rate; ++k)
                    positions[inner[b][along_u ? 0 : 1] + std::uint32_t(k - 1)] =
                        Vec3f(bezier_curve(borders.curve[b], double(k) / rate));
            }
        for (std::size_t p = 0; p < borders.corner.size(); ++p)
            for (std::size_t k = 0; k < 4; ++k) {
                const std::size_t side = k < 2 ? 0 : 2; // along u, below or above
                const bool end = (k == 1 || k == 2) != borders.reversed[p][side];
                positions[borders.corner[p][k]] = Vec3f(borders.curve[borders.border[p][side]][end ? 3 : 0]);
            }
    }
};

} // namespace

Mesh tessellate(const ParametricSurface& surface, int columns, int rows) {
    const int least_columns = surface.closure_u() == Closure::open ? 1 : 3,
              least_rows = surface.closure_v() == Closure::open ? 1 : 3;
    const auto patches = std::size_t(surface.patches());
    const Grid grid{columns, rows};
    const std::string what = std::to_string(columns) + " x " + std::to_string(rows) + " cells";
    if (columns < least_columns || rows < least_rows)
        throw Error{Refusal::usage, surface.name() + ": " + what + " are too few; " + std::to_string(least_columns) +
                                        " x " + std::to_string(least_rows) + " at least"};
    if (double(columns) * rows * double(patches) > 1e9)
        throw Error{Refusal::usage, surface.name() + ": " + what + " are too many; a thousand million at most in all"};

    Mesh mesh;
    const bool bezier = !surface.shape().patches.empty();
    const Sharing sharing(surface, grid);
    const BezierSharing between(surface.shape().borders, grid);
    mesh.positions.resize(bezier ? between.points(patches) : grid.size());
    mesh.normals.resize(patches * grid.size());
    const std::size_t grid_rows = patches * std::size_t(rows + 1);
    for_rows(std::int64_t(grid_rows), rows_at_a_time, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t row = begin; row < end; ++row) {
            const int patch = int(row / (rows + 1)), j = int(row % (rows + 1));
            for (int i = 0; i <= columns; ++i) {
                const double u = grid.u(i), v = grid.v(j);
                const Jet<double> jet = surface.jet(u, v, patch);
                const std::size_t at = std::size_t(patch) * grid.size() + grid.at(i, j);
                mesh.normals[at] = Vec3f(jet.n == Vec3d(0) ? surface.side_normal(u, v, patch) : jet.n);
                const bool inside = i > 0 && i < columns && j > 0 && j < rows;
                if (!bezier) mesh.positions[at] = Vec3f(jet.p);
                else if (inside) mesh.positions[between.position(std::size_t(patch), i, j)] = Vec3f(jet.p);
            }
        }
    });
    if (bezier) between.place(mesh.positions);
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i <= columns; ++i) mesh.uvs.emplace_back(grid.u(i), grid.v(j));

    for (std::size_t patch = 0; patch < patches; ++patch)
        for (int j = 0; j < rows; ++j)
            for (int i = 0; i < columns; ++i) {
                for (const auto& [a, b] : {std::pair(i, j), {i + 1, j}, {i + 1, j + 1}, {i, j + 1}}) {
                    mesh.corner_position.push_back(bezier ? between.position(patch, a, b) : sharing.position(a, b));
                    mesh.corner_normal.push_back(bezier ? std::uint32_t(patch * grid.size() + grid.at(a, b))
                                                        : sharing.normal(a, b));
                    mesh.corner_uv.push_back(grid.at(a, b));
                }
                mesh.face_begin.push_back(std::uint32_t(mesh.corner_position.size()));
            }
    keep_used(mesh.positions, mesh.corner_position);
    keep_used(mesh.normals, mesh.corner_normal);
    return mesh;
}

Mesh without_repeats(const Mesh& mesh) {
    Mesh out = mesh;
    out.face_begin = {0};
    out.corner_position.clear(), out.corner_normal.clear(), out.corner_uv.clear(), out.tangents.clear();
    out.face_material.clear(), out.face_group.clear();
    for (Attribute& attribute : out.attributes) attribute.values.clear();
    std::vector<std::uint32_t> kept;
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
        const std::uint32_t begin = mesh.face_begin[f], end = mesh.face_begin[f + 1];
        kept.clear();
        for (std::uint32_t c = begin; c < end; ++c)
            if (mesh.corner_position[c] != mesh.corner_position[c == begin ? end - 1 : c - 1]) kept.push_back(c);
        if (kept.size() < 3) continue;
        for (const std::uint32_t c : kept) {
            out.corner_position.push_back(mesh.corner_position[c]);
            if (!mesh.corner_normal.empty()) out.corner_normal.push_back(mesh.corner_normal[c]);
            if (!mesh.corner_uv.empty()) out.corner_uv.push_back(mesh.corner_uv[c]);
            if (!mesh.tangents.empty()) out.tangents.push_back(mesh.tangents[c]);
            for (std::size_t a = 0; a < mesh.attributes.size(); ++a) {
                const auto n = std::size_t(mesh.attributes[a].components);
                const auto from = mesh.attributes[a].values.begin() + std::ptrdiff_t(c * n);
                out.attributes[a].values.insert(out.attributes[a].values.end(), from, from + std::ptrdiff_t(n));
            }
        }
        out.face_begin.push_back(std::uint32_t(out.corner_position.size()));
        if (!mesh.face_material.empty()) out.face_material.push_back(mesh.face_material[f]);
        if (!mesh.face_group.empty()) out.face_group.push_back(mesh.face_group[f]);
    }
    return out;
}

} // namespace bake
