// Layout of a tessellated surface: the segments of all edges and cells, and the indices of the mesh that follow
// from them.
//
// Points are numbered vertices first, then those inside edges (along the edge), then those inside cells. The normal and
// the uv of a point have its number. Where sides differ, the first group has that number and the normals and uvs of the
// other groups are stored after the points.
#pragma once
#include "bake/surface/patch/patch_cells.h"
#include "bake/surface/patch/patch_domain.h"
#include "bake/surface/patch/tessellation.h"

namespace bake {

/// Segments of every edge, and of the lattice in every cell.
struct CellRates {
    std::uint32_t uniform = 0;             ///< the rate of all edges and cells, or 0
    std::vector<std::uint16_t> edge;       ///< edges; empty with a uniform rate
    std::vector<std::uint16_t> across, up; ///< cells, likewise
    std::uint32_t of_edge(std::uint32_t e) const noexcept { return uniform ? uniform : edge[e]; }
};

/// The fitted rates of one cell.
PatchRates rates_of_cell(const PatchCells& cells, const CellRates& rates, std::uint32_t cell) noexcept;

struct PatchLayout {
    const PatchCells* cells = nullptr;
    const CellRates* rates = nullptr;
    bool has_uv = false;
    std::vector<std::uint32_t> edge_owner, vertex_owner;

    std::vector<std::uint32_t> edge_first;  ///< first point inside an edge; first uv of an edge without length (a pole)
    std::vector<std::uint32_t> inner_first; ///< cells: first point inside
    std::vector<std::uint32_t> face_first, corner_first;   ///< cells + 1
    std::vector<std::uint32_t> edge_normals, edge_uvs;     ///< edge junctions: first number of the second group
    std::vector<std::uint32_t> vertex_normals, vertex_uvs; ///< vertex junctions, likewise
    std::uint64_t points = 0, normals = 0, uvs = 0, faces = 0, corners = 0;

    PatchRates of_cell(std::uint32_t cell) const noexcept { return rates_of_cell(*cells, *rates, cell); }
};

/// `cells` and `rates` must outlive the layout. If a total exceeds 2^32 - 1 the totals are still correct, but all
/// indices are invalid.
PatchLayout make_layout(const PatchCells& cells, const CellRates& rates, bool has_uv);

/// The border of one cell as indices of the mesh, in buffers that are used again.
class RingBuilder {
public:
    PatchRing ring(const PatchLayout& layout, std::uint32_t cell, const PatchRates& rates);

private:
    std::array<std::vector<FaceCorner>, 4> side_;
};

/// The border of one cell as numbers that are local to the cell.
struct CellRing {
    std::array<std::vector<FaceCorner>, 4> side;
    PatchRing ring; ///< views of side

    /// Numbers the points of the cell's lattice from 0, first along the border and then inside, and calls
    /// put(parameters in the patch, parameters in the cell) for each. Returns the first number inside.
    template <class Put>
    std::uint32_t number(const PatchCells& cells, std::uint32_t cell, const PatchRates& r, const Put& put) {
        const Vec2d* const corner = patch_corners(r.sides);
        std::uint32_t next = 0;
        for (int i = 0; i < r.sides; ++i) {
            side[i].clear();
            for (std::uint32_t k = 0; k < r.side[i]; ++k, ++next) {
                put(cells.on_side(cell, i, k, r.side[i]),
                    glm::mix(corner[i], corner[(i + 1) % r.sides], double(k) / r.side[i]));
                side[i].push_back({next, next, next});
            }
        }
        for (int i = 0; i < r.sides; ++i) {
            side[i].push_back(side[(i + 1) % r.sides].front());
            ring.side[i] = side[i];
        }
        if (inner_points(r) == 0) return next;
        const std::uint32_t n = r.sides == 4 ? r.up : r.across;
        for (std::uint32_t j = 1; j < n; ++j)
            for (std::uint32_t i = 1; i < (r.sides == 4 ? r.across : r.across - j); ++i)
                put(cells.at(cell, i, r.across, j, n), Vec2d(double(i) / r.across, double(j) / n));
        return next;
    }
};

} // namespace bake
