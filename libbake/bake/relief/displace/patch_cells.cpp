#include "bake/relief/displace/patch_cells.h"

namespace bake {

PatchCells::PatchCells(const PatchComplex& complex, std::uint32_t split) : base_(&complex), split_(split) {
    if (split_ > 1) refine();
}

std::pair<std::uint32_t, std::uint32_t> PatchCells::row_and_place(std::uint32_t local) const noexcept {
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
    if (base_->patches[patch(cell)].sides() == 4)
        return {part(local % split_, i, m, false), part(local / split_, j, n, false)};
    const auto [row, place] = row_and_place(local);
    const bool turned = place % 2 == 1;
    return {part(place / 2 + turned, i, m, turned), part(row + turned, j, n, turned)};
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

void PatchCells::refine() {
    const PatchComplex& base = *base_;
    const std::uint32_t K = split_;
    PatchComplex& out = refined_;
    const auto edges = base.edges;
    out.seam.resize(std::size_t(edges) * K), out.crease.resize(std::size_t(edges) * K);
    for (std::uint32_t e = 0; e < edges; ++e)
        for (std::uint32_t k = 0; k < K; ++k) {
            out.seam[std::size_t(e) * K + k] = base.seam[e];
            out.crease[std::size_t(e) * K + k] = base.crease[e];
        }
    std::uint32_t next_vertex = base.vertices + edges * (K - 1), next_edge = edges * K;
    out.patches.reserve(base.patches.size() * K * K);
    for (const PatchComplex::Patch& patch : base.patches) {
        const int sides = patch.sides();
        // Point k of a side and segment k of it, counted along the side.
        const auto side_vertex = [&](int side, std::uint32_t k) {
            const std::uint32_t a = patch.vertex[side], b = patch.vertex[(side + 1) % sides];
            if (k == 0 || a == b) return a;
            if (k == K) return b;
            return base.vertices + patch.edge[side] * (K - 1) + (patch.reversed[side] ? K - k : k) - 1;
        };
        const auto side_edge = [&](int side, std::uint32_t k) {
            return patch.edge[side] * K + (patch.reversed[side] ? K - 1 - k : k);
        };
        const std::uint32_t first_vertex = next_vertex, first_edge = next_edge;
        if (is_collapsed(patch)) {
            // Its cells are points: they hold the place of what is numbered by patch.
            for (std::uint32_t c = 0; c < K * K; ++c, next_edge += 4) {
                PatchComplex::Patch cell{{patch.vertex[0], patch.vertex[0], patch.vertex[0], no_index},
                                         {next_edge, next_edge + 1, next_edge + 2, no_index},
                                         {},
                                         patch.face};
                if (sides == 4) cell.vertex[3] = patch.vertex[0], cell.edge[3] = next_edge + 3;
                out.patches.push_back(cell);
            }
        } else if (sides == 4) {
            next_vertex += (K - 1) * (K - 1), next_edge += 2 * K * (K - 1);
            const auto vertex = [&](std::uint32_t i, std::uint32_t j) {
                if (j == 0) return side_vertex(0, i);
                if (i == K) return side_vertex(1, j);
                if (j == K) return side_vertex(2, K - i);
                return i == 0 ? side_vertex(3, K - j) : first_vertex + (j - 1) * (K - 1) + i - 1;
            };
            struct Side {
                std::uint32_t edge;
                bool reversed;
            };
            // Inner edges run along s and t.
            const auto along_s = [&](std::uint32_t i, std::uint32_t j) -> Side {
                if (j == 0) return {side_edge(0, i), patch.reversed[0]};
                if (j == K) return {side_edge(2, K - 1 - i), !patch.reversed[2]};
                return {first_edge + (j - 1) * K + i, false};
            };
            const auto along_t = [&](std::uint32_t i, std::uint32_t j) -> Side {
                if (i == K) return {side_edge(1, j), patch.reversed[1]};
                if (i == 0) return {side_edge(3, K - 1 - j), !patch.reversed[3]};
                return {first_edge + K * (K - 1) + j * (K - 1) + i - 1, false};
            };
            for (std::uint32_t j = 0; j < K; ++j)
                for (std::uint32_t i = 0; i < K; ++i) {
                    const Side a = along_s(i, j), b = along_t(i + 1, j), c = along_s(i, j + 1), d = along_t(i, j);
                    out.patches.push_back({{vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)},
                                           {a.edge, b.edge, c.edge, d.edge},
                                           {a.reversed, b.reversed, !c.reversed, !d.reversed},
                                           patch.face});
                }
        } else {
            next_vertex += (K - 1) * (K - 2) / 2, next_edge += 3 * K * (K - 1) / 2;
            const auto vertex = [&](std::uint32_t i, std::uint32_t j) {
                if (j == 0) return side_vertex(0, i);
                if (i + j == K) return side_vertex(1, j);
                if (i == 0) return side_vertex(2, K - j);
                return first_vertex + (j - 1) * (K - 1) - j * (j - 1) / 2 + i - 1;
            };
            // Each cell that stands upright brings its three sides; those inside are numbered by the turned cell they
            // are shared with.
            const auto inner = [&](std::uint32_t i, std::uint32_t j, std::uint32_t which) {
                const std::uint32_t turned = j * (K - 1) - j * (j - 1) / 2 + i;
                return first_edge + 3 * turned + which;
            };
            for (std::uint32_t j = 0; j < K; ++j)
                for (std::uint32_t i = 0; i + j < K; ++i) {
                    const bool on0 = j == 0, on1 = i + j + 1 == K, on2 = i == 0;
                    out.patches.push_back(
                        {{vertex(i, j), vertex(i + 1, j), vertex(i, j + 1), no_index},
                         {on0 ? side_edge(0, i) : inner(i, j - 1, 0), on1 ? side_edge(1, j) : inner(i, j, 1),
                          on2 ? side_edge(2, K - 1 - j) : inner(i - 1, j, 2), no_index},
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
    }
    out.vertices = next_vertex, out.edges = next_edge;
    out.seam.resize(next_edge), out.crease.resize(next_edge);
    out.sharp_vertex = base.sharp_vertex;
    out.sharp_vertex.resize(next_vertex);
}

namespace {

template <class Number>
std::vector<std::uint32_t> lowest(const PatchComplex& complex, std::uint32_t count, const Number& number) {
    std::vector<std::uint32_t> owner(count, no_index);
    bool collapsed = false;
    const auto claim = [&](std::uint32_t p) {
        for (int i = 0; i < complex.patches[p].sides(); ++i) {
            std::uint32_t& o = owner[number(complex.patches[p], i)];
            if (o == no_index) o = 4 * p + std::uint32_t(i);
        }
    };
    for (std::uint32_t p = 0; p < complex.patches.size(); ++p) {
        if (is_collapsed(complex.patches[p])) collapsed = true;
        else claim(p);
    }
    for (std::uint32_t p = 0; p < complex.patches.size() && collapsed; ++p)
        if (is_collapsed(complex.patches[p])) claim(p);
    return owner;
}

} // namespace

bool detail::sides_cancel(const PatchComplex::Patch& patch) noexcept {
    const int sides = patch.sides();
    int left[4], count = 0;
    for (int i = 0; i < sides; ++i)
        if (!is_point(patch, i)) left[count++] = i;
    for (bool cancelled = true; cancelled && count > 1;) {
        cancelled = false;
        for (int k = 0; k < count && !cancelled; ++k) {
            const int next = (k + 1) % count;
            if (patch.edge[left[k]] != patch.edge[left[next]] || patch.reversed[left[k]] == patch.reversed[left[next]])
                continue;
            int kept = 0;
            for (int m = 0; m < count; ++m)
                if (m != k && m != next) left[kept++] = left[m];
            count = kept;
            cancelled = true;
        }
    }
    return count == 0;
}

std::vector<std::uint32_t> edge_owners(const PatchComplex& complex) {
    return lowest(complex, complex.edges, [](const PatchComplex::Patch& p, int i) { return p.edge[i]; });
}

std::vector<std::uint32_t> vertex_owners(const PatchComplex& complex) {
    return lowest(complex, complex.vertices, [](const PatchComplex::Patch& p, int i) { return p.vertex[i]; });
}

} // namespace bake
