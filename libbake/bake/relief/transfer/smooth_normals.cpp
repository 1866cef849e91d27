// Facets are split into pieces of at most about half the length, and the pieces in each cell of a grid are added up, so that the time
// does not depend on the length: a position has some hundreds of cells within reach. Cells are kept in blocks as wide as the reach.
#include "bake/relief/transfer/smooth_normals.h"
#include "bake/base/parallel.h"
#include "bake/mesh/topology.h"
#include "bake/mesh/triangulate.h"
#include "bake/mesh/weld.h"
#include <algorithm>
#include <compare>

namespace bake {
namespace {

constexpr double cell_width = 0.23, piece_width = 0.5; ///< in lengths
constexpr int cells_in_block = 16;                     ///< in each direction
constexpr double reach2 = 12;                  ///< square, in lengths; the block is a little wider than its root
constexpr std::size_t most_pieces = 8'000'000; ///< beyond that facets are split less
constexpr std::int32_t most_cells = 1 << 28;   ///< from the middle of the grid on; a shorter length has wider cells
constexpr float cancelled = 2e-3f; ///< of the sum of the sizes: less is left of two sides of a sheet by rounding
static_assert(cells_in_block * cells_in_block * cell_width * cell_width > reach2);

/// Like exp(-d2 / 2) for squared distances in lengths, but 0 from reach2 on. On a plane the mean of d2 is the same, 2.
float weight(float d2) noexcept {
    const float x = std::max(0.0f, 1 - d2 / float(reach2));
    return (x * x) * (x * x);
}

using Place = std::array<std::int32_t, 3>; ///< of a cell, or of a block

struct Block {
    std::uint32_t component = 0;
    Place at{};
    auto operator<=>(const Block&) const = default;
};

struct Piece {
    Block block;
    Place cell{};
    Vec3f middle{0}, area{0}; ///< lengths; area vector, twice the area long
    auto order() const noexcept { return std::tie(block, cell); }
};

/// Cells with their pieces added up, in groups that are summed side by side.
constexpr std::size_t lanes = 8;
struct Cells {
    std::array<float, lanes> x{}, y{}, z{};    ///< the middle
    std::array<float, lanes> ax{}, ay{}, az{}; ///< the area vector
    std::array<float, lanes> size{};           ///< of the areas, whatever their directions
};
struct BlockCells {
    Block block;
    std::uint32_t begin = 0, end = 0;
};

class Smoothing {
public:
    Smoothing(const Mesh& mesh, double length)
        : mesh_(mesh), vertex_(first_equal(mesh.positions)), scale_(1 / scaled(mesh, length)) {
        add_components();
        add_cells(pieces(triangulate(mesh)));
    }

    /// Per position; zero where the sum is.
    std::vector<Vec3f> normals() const {
        std::vector<std::pair<Block, std::uint32_t>> order;
        for (std::uint32_t v = 0; v < vertex_.size(); ++v)
            if (vertex_[v] == v) order.emplace_back(block_of(component_[v], cell_of(position(v))), v);
        std::sort(order.begin(), order.end());
        std::vector<Vec3f> out(vertex_.size(), Vec3f(0));
        for_rows(std::int64_t(order.size()), 4096, [&](std::int64_t begin, std::int64_t end) {
            std::vector<BlockCells> near;
            for (std::int64_t i = begin; i < end; ++i) {
                const auto& [block, v] = order[std::size_t(i)];
                if (i == begin || block != order[std::size_t(i - 1)].first) near = around(block);
                out[v] = sum(near, position(v));
            }
        });
        for (std::uint32_t v = 0; v < vertex_.size(); ++v) out[v] = out[vertex_[v]];
        return out;
    }

private:
    static double scaled(const Mesh& mesh, double length) {
        return std::max(length, diagonal(bounds(mesh)) / (most_cells * cell_width));
    }
    /// In lengths, from the middle of the mesh on.
    Vec3f position(std::uint32_t v) const noexcept { return Vec3f((Vec3d(mesh_.positions[v]) - middle_) * scale_); }
    static Place cell_of(const Vec3f& p) noexcept {
        const auto at = [&](int k) { return std::int32_t(std::floor(double(p[k]) / cell_width)); };
        return {at(0), at(1), at(2)};
    }
    static Block block_of(std::uint32_t component, const Place& cell) noexcept {
        const auto at = [&](std::size_t k) {
            return (cell[k] - (cell[k] < 0 ? cells_in_block - 1 : 0)) / cells_in_block;
        };
        return {component, {at(0), at(1), at(2)}};
    }

    void add_components() {
        DisjointSets sets(vertex_.size());
        for (std::size_t f = 0; f < mesh_.faces(); ++f)
            for (std::uint32_t c = mesh_.face_begin[f] + 1; c < mesh_.face_begin[f + 1]; ++c)
                sets.join(vertex_[mesh_.corner_position[c - 1]], vertex_[mesh_.corner_position[c]]);
        component_ = sets.numbers().set;
    }

    /// Parts along each side of a triangle.
    int parts_of(const Triangle& t, int most) const noexcept {
        float longest = 0;
        for (std::size_t k = 0; k < 3; ++k)
            longest = std::max(longest, glm::length(position(mesh_.corner_position[t.corner[k]]) -
                                                    position(mesh_.corner_position[t.corner[(k + 1) % 3]])));
        return int(std::clamp(std::ceil(double(longest) / piece_width), 1.0, double(most)));
    }

    std::vector<Piece> pieces(const std::vector<Triangle>& triangles) const {
        int most = 256;
        const auto count = [&] {
            std::size_t all = 0;
            for (const Triangle& t : triangles) all += std::size_t(parts_of(t, most)) * std::size_t(parts_of(t, most));
            return all;
        };
        while (most > 1 && count() > most_pieces) most /= 2;
        // Pieces that would still be much longer than wanted help nothing.
        for (const Triangle& t : triangles)
            if (parts_of(t, 4 * most + 1) > 4 * most) most = 1;
        std::vector<Piece> out;
        out.reserve(count());
        for (const Triangle& t : triangles) split(t, parts_of(t, most), out);
        return out;
    }
    /// Into parts^2 equal triangles.
    void split(const Triangle& t, int parts, std::vector<Piece>& out) const {
        const std::uint32_t component = component_[vertex_[mesh_.corner_position[t.corner[0]]]];
        const auto at = [&](std::size_t k) { return position(mesh_.corner_position[t.corner[k]]); };
        const Vec3f p = at(0), u = (at(1) - p) / float(parts), v = (at(2) - p) / float(parts), area = glm::cross(u, v);
        const auto add = [&](float i, float j) {
            const Vec3f middle = p + i * u + j * v;
            const Place cell = cell_of(middle);
            out.push_back({block_of(component, cell), cell, middle, area});
        };
        for (int i = 0; i < parts; ++i)
            for (int j = 0; i + j < parts; ++j) {
                add(float(i) + 1 / 3.f, float(j) + 1 / 3.f);
                if (i + j + 1 < parts) add(float(i) + 2 / 3.f, float(j) + 2 / 3.f);
            }
    }

    void add_cells(std::vector<Piece> pieces) {
        std::stable_sort(pieces.begin(), pieces.end(),
                         [](const Piece& a, const Piece& b) { return a.order() < b.order(); });
        std::size_t lane = 0;
        for (std::size_t begin = 0, end = 0; begin < pieces.size(); begin = end) {
            Vec3f sum(0), moment(0);
            float size = 0;
            for (; end < pieces.size() && pieces[end].order() == pieces[begin].order(); ++end) {
                const float area = glm::length(pieces[end].area);
                sum += pieces[end].area, moment += area * pieces[end].middle, size += area;
            }
            if (size == 0) continue;
            if (blocks_.empty() || blocks_.back().block != pieces[begin].block) {
                blocks_.push_back({pieces[begin].block, std::uint32_t(cells_.size()), 0});
                lane = 0;
            }
            if (lane % lanes == 0) cells_.emplace_back(), lane = 0;
            const Vec3f middle = moment / size;
            Cells& cells = cells_.back();
            cells.x[lane] = middle.x, cells.y[lane] = middle.y, cells.z[lane] = middle.z;
            cells.ax[lane] = sum.x, cells.ay[lane] = sum.y, cells.az[lane] = sum.z;
            cells.size[lane++] = size;
            blocks_.back().end = std::uint32_t(cells_.size());
        }
    }

    /// The block and its neighbours.
    std::vector<BlockCells> around(const Block& block) const {
        std::vector<BlockCells> out;
        for (int x = -1; x <= 1; ++x)
            for (int y = -1; y <= 1; ++y)
                for (int z = -1; z <= 1; ++z) {
                    const Block wanted{block.component, {block.at[0] + x, block.at[1] + y, block.at[2] + z}};
                    const auto found =
                        std::lower_bound(blocks_.begin(), blocks_.end(), wanted,
                                         [](const BlockCells& a, const Block& b) { return a.block < b; });
                    if (found != blocks_.end() && found->block == wanted) out.push_back(*found);
                }
        return out;
    }
    Vec3f sum(const std::vector<BlockCells>& near, const Vec3f& p) const noexcept {
        Cells sums;
        for (const BlockCells& block : near)
            for (std::uint32_t i = block.begin; i < block.end; ++i) add(cells_[i], p, sums);
        Vec3f out(0);
        float size = 0;
        for (std::size_t k = 0; k < lanes; ++k) out += Vec3f(sums.ax[k], sums.ay[k], sums.az[k]), size += sums.size[k];
        return glm::length(out) > cancelled * size ? unit_or_zero(out) : Vec3f(0);
    }

    static void add(const Cells& cells, const Vec3f& p, Cells& sums) noexcept {
        for (std::size_t k = 0; k < lanes; ++k) {
            const float x = cells.x[k] - p.x, y = cells.y[k] - p.y, z = cells.z[k] - p.z;
            const float w = weight(x * x + y * y + z * z);
            sums.ax[k] += w * cells.ax[k], sums.ay[k] += w * cells.ay[k], sums.az[k] += w * cells.az[k];
            sums.size[k] += w * cells.size[k];
        }
    }

    const Mesh& mesh_;
    std::vector<std::uint32_t> vertex_, component_; ///< positions
    double scale_;                                  ///< lengths per unit
    Vec3d middle_ = 0.5 * (Vec3d(bounds(mesh_).min) + Vec3d(bounds(mesh_).max));
    std::vector<Cells> cells_;
    std::vector<BlockCells> blocks_;
};

} // namespace

void smooth_normals(Mesh& mesh, double length) {
    if (mesh.faces() == 0) return;
    mesh.normals = Smoothing(mesh, length).normals();
    mesh.corner_normal = mesh.corner_position;
    for (std::uint32_t& normal : mesh.corner_normal)
        if (mesh.normals[normal] == Vec3f(0)) normal = no_index;
    mesh.tangents.clear(); // of the former normals
}

} // namespace bake
