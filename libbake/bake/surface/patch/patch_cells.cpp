#include "bake/surface/patch/patch_cells.h"

namespace bake {
namespace {

/// Builds the complex of the cells, patch by patch. Its vertices are those of the base, then those inside the base's edges,
/// then those inside its patches; its edges are those along the base's edges, then those inside its patches.
struct Refiner {
    const PatchComplex& base;
    const std::uint32_t K; ///< cells along a side
    PatchComplex out{};
    std::uint32_t next_vertex = base.vertices, next_edge = base.edges * K;
    std::vector<std::uint32_t>
        first_inside{}; ///< edges of the base: first vertex inside; none where there is no length

    /// Point k of a side of a patch, counted along the side.
    std::uint32_t side_vertex(const PatchComplex::Patch& patch, int side, std::uint32_t k) const noexcept {
        const std::uint32_t a = patch.vertex[side], b = patch.vertex[(side + 1) % patch.sides()];
        if (k == 0 || a == b) return a;
        if (k == K) return b;
        return first_inside[patch.edge[side]] + (patch.reversed[side] ? K - k : k) - 1;
    }
    /// Segment k of a side, likewise.
    std::uint32_t side_edge(const PatchComplex::Patch& patch, int side, std::uint32_t k) const noexcept {
        return patch.edge[side] * K + (patch.reversed[side] ? K - 1 - k : k);
    }

    /// The cells of a collapsed patch are points. They keep the numbering of cells by patch regular.
    void add_collapsed(const PatchComplex::Patch& patch) {
        for (std::uint32_t c = 0; c < K * K; ++c, next_edge += 4) {
            PatchComplex::Patch cell{{patch.vertex[0], patch.vertex[0], patch.vertex[0], no_index},
                                     {next_edge, next_edge + 1, next_edge + 2, no_index},
                                     {},
                                     patch.face};
            if (patch.sides() == 4) cell.vertex[3] = patch.vertex[0], cell.edge[3] = next_edge + 3;
            out.patches.push_back(cell);
        }
    }

    void add_quad(const PatchComplex::Patch& patch) {
        const std::uint32_t first_vertex = next_vertex, first_edge = next_edge;
        next_vertex += (K - 1) * (K - 1), next_edge += 2 * K * (K - 1);
        const auto vertex = [&](std::uint32_t i, std::uint32_t j) {
            if (j == 0) return side_vertex(patch, 0, i);
            if (i == K) return side_vertex(patch, 1, j);
            if (j == K) return side_vertex(patch, 2, K - i);
            return i == 0 ? side_vertex(patch, 3, K - j) : first_vertex + (j - 1) * (K - 1) + i - 1;
        };
        struct CellSide {
            std::uint32_t edge;
            bool reversed;
        };
        // Inner edges run along s and t.
        const auto along_s = [&](std::uint32_t i, std::uint32_t j) -> CellSide {
            if (j == 0) return {side_edge(patch, 0, i), patch.reversed[0]};
            if (j == K) return {side_edge(patch, 2, K - 1 - i), !patch.reversed[2]};
            return {first_edge + (j - 1) * K + i, false};
        };
        const auto along_t = [&](std::uint32_t i, std::uint32_t j) -> CellSide {
            if (i == K) return {side_edge(patch, 1, j), patch.reversed[1]};
            if (i == 0) return {side_edge(patch, 3, K - 1 - j), !patch.reversed[3]};
            return {first_edge + K * (K - 1) + j * (K - 1) + i - 1, false};
        };
        for (std::uint32_t j = 0; j < K; ++j)
            for (std::uint32_t i = 0; i < K; ++i) {
                const CellSide a = along_s(i, j), b = along_t(i + 1, j), c = along_s(i, j + 1), d = along_t(i, j);
                out.patches.push_back({{vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)},
                                       {a.edge, b.edge, c.edge, d.edge},
                                       {a.reversed, b.reversed, !c.reversed, !d.reversed},
                                       patch.face});
            }
    }

    void add_triangle(const PatchComplex::Patch& patch) {
        const std::uint32_t first_vertex = next_vertex, first_edge = next_edge;
        next_vertex += (K - 1) * (K - 2) / 2, next_edge += 3 * K * (K - 1) / 2;
        const auto vertex = [&](std::uint32_t i, std::uint32_t j) {
            if (j == 0) return side_vertex(patch, 0, i);
            if (i + j == K) return side_vertex(patch, 1, j);
            if (i == 0) return side_vertex(patch, 2, K - j);
            return first_vertex + (j - 1) * (K - 1) - j * (j - 1) / 2 + i - 1;
        };
        // Inner edges are numbered by the turned cell that has them: three each.
        const auto inner = [&](std::uint32_t i, std::uint32_t j, std::uint32_t which) {
            const std::uint32_t turned = j * (K - 1) - j * (j - 1) / 2 + i;
            return first_edge + 3 * turned + which;
        };
        for (std::uint32_t j = 0; j < K; ++j)
            for (std::uint32_t i = 0; i + j < K; ++i) {
                const bool on0 = j == 0, on1 = i + j + 1 == K, on2 = i == 0;
                out.patches.push_back(
                    {{vertex(i, j), vertex(i + 1, j), vertex(i, j + 1), no_index},
                     {on0 ? side_edge(patch, 0, i) : inner(i, j - 1, 0), on1 ? side_edge(patch, 1, j) : inner(i, j, 1),
                      on2 ? side_edge(patch, 2, K - 1 - j) : inner(i - 1, j, 2), no_index},
                     {on0 && patch.reversed[0], on1 && patch.reversed[1], on2 && patch.reversed[2], false},
                     patch.face});
                if (on1) continue;
                // Corners (1,1), (0,1), (1,0) of the lattice square.
                out.patches.push_back({{vertex(i + 1, j + 1), vertex(i, j + 1), vertex(i + 1, j), no_index},
                                       {inner(i, j, 0), inner(i, j, 1), inner(i, j, 2), no_index},
                                       {true, true, true, false},
                                       patch.face});
            }
    }

    PatchComplex run() && {
        for (std::uint32_t e = 0; e < base.edges; ++e) {
            out.seam.insert(out.seam.end(), K, base.seam[e]);
            out.crease.insert(out.crease.end(), K, base.crease[e]);
        }
        std::vector<bool> has_length(base.edges, true);
        for (const PatchComplex::Patch& patch : base.patches)
            for (int i = 0; i < patch.sides(); ++i)
                if (is_point(patch, i)) has_length[patch.edge[i]] = false;
        for (std::uint32_t e = 0; e < base.edges; ++e) {
            first_inside.push_back(next_vertex);
            if (has_length[e]) next_vertex += K - 1;
        }
        out.patches.reserve(base.patches.size() * K * K);
        for (const PatchComplex::Patch& patch : base.patches) {
            if (is_collapsed(patch)) add_collapsed(patch);
            else if (patch.sides() == 4) add_quad(patch);
            else add_triangle(patch);
        }
        out.vertices = next_vertex, out.edges = next_edge;
        out.seam.resize(next_edge), out.crease.resize(next_edge);
        out.sharp_vertex = base.sharp_vertex;
        out.sharp_vertex.resize(next_vertex);
        return std::move(out);
    }
};

} // namespace

PatchCells::PatchCells(const BaseSurface& base, std::uint32_t split)
    : base_(&base), base_complex_(&base.complex()), base_junctions_(&base.junctions()), split_(split) {
    if (split_ == 1) return;
    refined_ = Refiner{base.complex(), split_}.run();
    refined_junctions_ = make_junctions(refined_);
}

std::pair<std::uint32_t, std::uint32_t> PatchCells::row_and_column(std::uint32_t local) const noexcept {
    // Row j of a triangle starts at j (2 split - j).
    std::uint32_t j = 0;
    while ((j + 1) * (2 * split_ - j - 1) <= local) ++j;
    return {j, local - j * (2 * split_ - j)};
}

Vec2d PatchCells::at(std::uint32_t cell, std::uint32_t i, std::uint32_t m, std::uint32_t j,
                     std::uint32_t n) const noexcept {
    const auto part = [&](std::uint32_t whole, std::uint32_t k, std::uint32_t rate, bool back) {
        return (double(whole) * rate + (back ? -double(k) : double(k))) / (double(split_) * rate);
    };
    if (split_ == 1) return {part(0, i, m, false), part(0, j, n, false)};
    const std::uint32_t local = cell % (split_ * split_);
    if (base_complex_->patches[patch(cell)].sides() == 4)
        return {part(local % split_, i, m, false), part(local / split_, j, n, false)};
    const auto [row, column] = row_and_column(local);
    const bool turned = column % 2 == 1;
    return {part(column / 2 + turned, i, m, turned), part(row + turned, j, n, turned)};
}

Vec2d PatchCells::on_side(std::uint32_t cell, int side, std::uint32_t k, std::uint32_t rate) const noexcept {
    const bool quad = complex().patches[cell].sides() == 4;
    switch (side) {
    case 0: return at(cell, k, rate, 0, rate);
    case 1: return quad ? at(cell, rate, rate, k, rate) : at(cell, rate - k, rate, k, rate);
    case 2: return quad ? at(cell, rate - k, rate, rate, rate) : at(cell, 0, rate, rate - k, rate);
    default: return at(cell, 0, rate, rate - k, rate);
    }
}

} // namespace bake
