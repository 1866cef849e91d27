#include "bake/environment/resample/face_accumulator.h"
#include "bake/base/parallel.h"
#include "bake/base/progress.h"
#include "bake/environment/resample/lattice.h"
#include "bake/environment/resample/slope.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

constexpr int block_texels = 32;

/// Source texels that overlap two tiles are processed twice; the sums of large tiles do not fit the cache.
int tile_edge(int face) noexcept { return face < 2048 ? 256 : 512; }

struct SourceLattice {
    Lattice lattice;
    CubeFace face; ///< of a cube
};

/// A block of source texels, and a window of the cells on the face that the block may overlap.
struct SourceBlock {
    int source, x0, y0, x1, y1;
    CellWindow cells;
};

bool intersect(const CellWindow& a, const CellWindow& b) noexcept {
    return a.low_x < b.high_x && b.low_x < a.high_x && a.low_y < b.high_y && b.low_y < a.high_y;
}

/// The window of a block, from the lattice points on its border; empty if the block does not overlap the face.
CellWindow block_window(const Lattice& lattice, const FaceGrid& grid, const FacePlane& plane,
                        const SourceBlock& block) {
    const double reach = 2 * block_texels * lattice.texel_angle(); // from a corner of the block to any other
    if (reach < 0.2) {
        Vec3d corner;
        lattice.points(block.x0, 1, lattice.border_y(block.y0), 1, &corner);
        if (glm::dot(plane.axis, corner) < (0.3 - reach) * glm::length(corner)) return {0, 0, 0, 0};
    }
    std::vector<Vec3d> points;
    const int columns = block.x1 - block.x0 + 1;
    points.resize(2 * columns);
    lattice.points(block.x0, 1, lattice.border_y(block.y0), columns, points.data());
    lattice.points(block.x0, 1, lattice.border_y(block.y1), columns, points.data() + columns);
    for (int y = block.y0 + 1; y < block.y1; ++y)
        for (const int x : {block.x0, block.x1}) {
            points.emplace_back();
            lattice.points(x, 1, y, 1, &points.back());
        }
    double x_low = 1e9, x_high = -1e9, y_low = 1e9, y_high = -1e9;
    bool all_ahead = true, any_ahead = false;
    for (const Vec3d& d : points) {
        const PlanePoint p = plane.project(d);
        const double ma = p.ma / glm::length(d);
        all_ahead &= ma > 0.3;
        any_ahead |= ma > 0.3;
        x_low = std::min(x_low, p.x);
        x_high = std::max(x_high, p.x);
        y_low = std::min(y_low, p.y);
        y_high = std::max(y_high, p.y);
    }
    if (all_ahead)
        return {int(std::floor(x_low)) - 1, int(std::floor(x_high)) + 2, int(std::floor(y_low)) - 1,
                int(std::floor(y_high)) + 2};
    // A coarse block may cover the face although the border of the block is behind the face.
    const bool coarse = block_texels * lattice.texel_angle() > 0.5;
    return any_ahead || coarse ? whole_face(grid) : CellWindow{0, 0, 0, 0};
}

/// Texels [x0, x1) x [y0, y1) of a face that are accumulated together.
struct FaceTile {
    int x0, y0, x1, y1;
    /// Not a power of two: the rows would map to the same cache sets.
    int stride() const noexcept { return x1 - x0 + 2; }
};

/// A part of a texel along x.
struct ColumnPart {
    int texel;
    double width, middle; ///< middle: its distance from the centre of the texel
};

/// Memory that is kept between blocks.
struct AccumulatorScratch {
    std::vector<Vec3d> directions;
    std::vector<ColumnPart> columns;
    std::vector<PlanePoint> upper, lower;
    EdgeRow upper_edges, lower_edges, side_edges;
    Overlap overlap;
};

} // namespace

int border_index(int n, int x, int y) noexcept {
    if (y == 0) return x;
    if (y == n - 1) return n + x;
    if (x == 0) return 2 * n + y;
    if (x == n - 1) return 3 * n + y;
    return -1;
}

struct FaceAccumulator::Impl {
    const Environment& sky;
    FaceGrid grid;
    FacePlane plane;
    std::vector<SourceLattice> sources; ///< with lattices mapped by FacePlane::map of the face
    std::vector<SourceBlock> near;      ///< the blocks that may overlap the face
    int parts;                          ///< Lattice::parts
    bool negative;                      ///< whether a texel of these blocks is negative

    const Image<float>& image(const SourceLattice& source) const noexcept {
        return sky.is_cube() ? sky.cube[source.face] : sky.picture;
    }

    void slopes(const SourceLattice& source, int x, int y, Slopes& s) const noexcept {
        if (sky.is_cube()) face_slopes(sky.cube, sky.edge_samples, source.face, x, y, s);
        else picture_slopes(sky.projection, sky.picture, x, y, s);
    }

    void find_blocks() {
        std::vector<SourceBlock> blocks;
        for (int k = 0; k < int(sources.size()); ++k) {
            const int width = sources[k].lattice.width(), height = sources[k].lattice.height();
            for (int y = 0; y < height; y += block_texels)
                for (int x = 0; x < width; x += block_texels)
                    blocks.push_back(
                        {k, x, y, std::min(x + block_texels, width), std::min(y + block_texels, height), {}});
        }
        for_rows(std::int64_t(blocks.size()), 256, [&](std::int64_t begin, std::int64_t end) {
            for (std::int64_t i = begin; i < end; ++i)
                blocks[i].cells = block_window(sources[blocks[i].source].lattice, grid, plane, blocks[i]);
        });
        for (const SourceBlock& block : blocks)
            if (intersect(block.cells, whole_face(grid))) near.push_back(block);
    }

    void find_negative() {
        std::vector<char> found(near.size());
        for_rows(std::int64_t(near.size()), 256, [&](std::int64_t begin, std::int64_t end) {
            for (std::int64_t i = begin; i < end; ++i) {
                const SourceBlock& block = near[i];
                const Image<float>& from = image(sources[block.source]);
                for (int y = block.y0; y < block.y1; ++y) {
                    const float* const row = &from.at(block.x0, y);
                    found[i] |= std::any_of(row, row + std::ptrdiff_t(block.x1 - block.x0) * from.channels(),
                                            [](float v) { return v < 0; });
                }
            }
        });
        negative = std::find(found.begin(), found.end(), 1) != found.end();
    }

    /// sums: fluxes of all channels and solid angle of each texel of a tile, in rows of tile.stride() texels. If the source
    /// has no negative values, the sums are clamped to 0: linear reconstruction in texels that are not parallelograms can
    /// undershoot slightly.
    void fill(const FaceTile& tile, std::vector<double>& sums, AccumulatorScratch& scratch) const {
        const int channels = sky.channels(), cells = grid.edges ? 2 : 1;
        const CellWindow window{std::max(tile.x0 * cells, grid.low()), std::min(tile.x1 * cells, grid.high()),
                                std::max(tile.y0 * cells, grid.low()), std::min(tile.y1 * cells, grid.high())};
        sums.assign(std::size_t(tile.stride()) * (tile.y1 - tile.y0) * (channels + 1), 0.0);
        for (const SourceBlock& block : near) {
            if (!intersect(block.cells, window)) continue;
            switch (channels) {
            case 1: accumulate<1>(block, window, tile, sums.data(), scratch); break;
            case 2: accumulate<2>(block, window, tile, sums.data(), scratch); break;
            case 3: accumulate<3>(block, window, tile, sums.data(), scratch); break;
            default: accumulate<4>(block, window, tile, sums.data(), scratch); break;
            }
        }
        if (!negative)
            for (double& sum : sums) sum = std::max(sum, 0.0);
    }

    /// The parts of a block's columns; also sizes the scratch memory.
    void start_block(const SourceBlock& block, AccumulatorScratch& scratch) const {
        const Lattice& lattice = sources[block.source].lattice;
        const int points = (block.x1 - block.x0) * parts + 1;
        scratch.directions.resize(points);
        scratch.upper.resize(points);
        scratch.lower.resize(points);
        scratch.columns.resize(points);
        for (int k = 0; k + 1 < points; ++k) {
            const int x = block.x0 + k / parts;
            const double left = lattice.border_x(block.x0 + double(k) / parts),
                         right = lattice.border_x(block.x0 + double(k + 1) / parts);
            scratch.columns[k] = {x, right - left, 0.5 * (left + right) - (x + 0.5)};
        }
    }

    /// Projects a row of lattice points to scratch.lower, whose values become scratch.upper.
    void next_row(const SourceBlock& block, double y, AccumulatorScratch& scratch) const {
        const int points = int(scratch.directions.size());
        std::swap(scratch.upper, scratch.lower);
        std::swap(scratch.upper_edges, scratch.lower_edges);
        sources[block.source].lattice.points(block.x0, parts, y, points, scratch.directions.data());
        for (int k = 0; k < points; ++k) scratch.lower[k] = plane.place(scratch.directions[k]);
        scratch.lower_edges.reset(points);
        scratch.side_edges.reset(points);
    }

    /// Adds the texels of a block to the cells of a window.
    template <int channels>
    void accumulate(const SourceBlock& block, const CellWindow& window, const FaceTile& tile, double* sums,
                    AccumulatorScratch& scratch) const {
        const SourceLattice& source = sources[block.source];
        const Image<float>& values = image(source);
        start_block(block, scratch);
        const int points = int(scratch.directions.size());
        next_row(block, source.lattice.border_y(block.y0), scratch);
        for (int y = block.y0; y < block.y1; ++y)
            for (int part = 0; part < parts; ++part) {
                const double top = source.lattice.border_y(y + double(part) / parts),
                             bottom = source.lattice.border_y(y + double(part + 1) / parts);
                next_row(block, bottom, scratch);
                for (int k = 0; k + 1 < points; ++k) {
                    const PlanePoint* const corners[4] = {&scratch.upper[k], &scratch.upper[k + 1],
                                                          &scratch.lower[k + 1], &scratch.lower[k]};
                    if (!may_overlap(window, *corners[0], *corners[1], *corners[2], *corners[3])) continue;
                    scratch.upper_edges.cut(k, *corners[0], *corners[1]);
                    scratch.lower_edges.cut(k, *corners[3], *corners[2]);
                    scratch.side_edges.cut(k, *corners[0], *corners[3]);
                    scratch.side_edges.cut(k + 1, *corners[1], *corners[2]);
                    const EdgeParts edges[4] = {scratch.upper_edges[k], scratch.side_edges[k + 1],
                                                scratch.lower_edges[k], scratch.side_edges[k]};
                    overlap(grid, corners, edges, scratch.overlap);
                    const ColumnPart& column = scratch.columns[k];
                    const int x = column.texel;
                    const Vec2d centroid = source.lattice.centroid(x, y);
                    // From coordinates in the part to coordinates in the texel, both from -1/2 to 1/2.
                    const Vec2d scale(column.width, bottom - top),
                        shift(column.middle - centroid.x, 0.5 * (top + bottom) - (y + 0.5) - centroid.y);
                    Slopes s;
                    slopes(source, x, y, s);
                    add<channels>(&values.at(x, y), s, scale, shift, window, scratch.overlap, tile, sums);
                }
            }
    }

    template <int channels>
    void add(const float* value, const Slopes& s, const Vec2d& scale, const Vec2d& shift, const CellWindow& window,
             const Overlap& o, const FaceTile& tile, double* sums) const noexcept {
        // Radiance and J are linear functions of the position on the face, so a cell's flux is a linear function of its
        // moments about the middle. The last channel is solid angle.
        double by_area[channels + 1], by_x[channels + 1], by_y[channels + 1];
        const double j = o.jacobian, ax = j * o.ax * scale.x, ay = j * o.ay * scale.x, bx = j * o.bx * scale.y,
                     by = j * o.by * scale.y;
        const double a = j * shift.x, b = j * shift.y;
        for (int k = 0; k < channels; ++k) {
            const double v = value[k], along = s.x[k], down = s.y[k];
            by_area[k] = v * j + along * a + down * b;
            by_x[k] = v * o.jacobian_x + along * ax + down * bx;
            by_y[k] = v * o.jacobian_y + along * ay + down * by;
        }
        by_area[channels] = j;
        by_x[channels] = o.jacobian_x;
        by_y[channels] = o.jacobian_y;
        const int first_row = std::max(0, window.low_y - o.row), last_row = std::min(o.rows, window.high_y - o.row);
        const int first_column = std::max(0, window.low_x - o.column),
                  last_column = std::min(o.columns, window.high_x - o.column);
        for (int r = first_row; r < last_row; ++r) {
            const CellMoments* const cells = o.cells.data() + std::size_t(r) * o.columns;
            double* const row = sums + std::ptrdiff_t(grid.texel(o.row + r) - tile.y0) * tile.stride() * (channels + 1);
            const double off_y = o.row + r - o.middle_y;
            for (int c = first_column; c < last_column; ++c) {
                const CellMoments& m = cells[c];
                const double area = o.orientation * m.area;
                if (area <= 0) continue; // rounding
                const double x = o.orientation * m.x + (o.column + c - o.middle_x) * area,
                             y = o.orientation * m.y + off_y * area;
                double* const sum = row + std::ptrdiff_t(grid.texel(o.column + c) - tile.x0) * (channels + 1);
                for (int k = 0; k <= channels; ++k) sum[k] += by_area[k] * area + by_x[k] * x + by_y[k] * y;
            }
        }
    }
};

FaceAccumulator::FaceAccumulator(const Environment& source, const FaceGrid& grid, CubeFace face, const glm::dmat3& turn)
    : impl_(new Impl{source, grid, FacePlane(grid, face), {}, {}, 1, false}) {
    Impl& impl = *impl_;
    if (source.is_cube())
        for (const CubeFace from : all_cube_faces)
            impl.sources.push_back({Lattice(from, source.cube.size(), source.edge_samples, turn), from});
    else
        impl.sources.push_back(
            {Lattice(source.projection, source.picture.width(), source.picture.height(), turn), CubeFace::pz});
    impl.parts = impl.sources[0].lattice.parts(2.0 / grid.texels);
    impl.find_blocks();
    impl.find_negative();
    for (SourceLattice& from : impl.sources) from.lattice.turn_further(impl.plane.map());
}

FaceAccumulator::~FaceAccumulator() = default;

void FaceAccumulator::rows(int low, int high, float* values, Progress* progress) const {
    const int n = impl_->grid.texels, channels = impl_->sky.channels(), edge = tile_edge(n);
    const int across = (n + edge - 1) / edge, down = (high - low + edge - 1) / edge;
    for_rows(
        std::int64_t(across) * down, 1,
        [&](std::int64_t begin, std::int64_t end) {
            AccumulatorScratch scratch;
            std::vector<double> sums;
            for (std::int64_t k = begin; k < end; ++k) {
                const int x0 = int(k % across) * edge, y0 = low + int(k / across) * edge;
                const FaceTile tile{x0, y0, std::min(x0 + edge, n), std::min(y0 + edge, high)};
                impl_->fill(tile, sums, scratch);
                for (int y = tile.y0; y < tile.y1; ++y)
                    for (int x = tile.x0; x < tile.x1; ++x) {
                        const double* const sum =
                            &sums[(std::size_t(y - y0) * tile.stride() + (x - x0)) * (channels + 1)];
                        float* const value = values + (std::size_t(y - low) * n + x) * channels;
                        for (int c = 0; c < channels; ++c)
                            value[c] = sum[channels] > 0 ? float(sum[c] / sum[channels]) : 0.0f;
                    }
            }
        },
        progress);
}

std::vector<double> FaceAccumulator::border() const {
    constexpr int length = 256;
    const int n = impl_->grid.texels, channels = impl_->sky.channels(), pieces = (n + length - 1) / length;
    std::vector<double> values(std::size_t(4) * n * (channels + 1), 0.0);
    for_rows(std::int64_t(4) * pieces, 1, [&](std::int64_t begin, std::int64_t end) {
        AccumulatorScratch scratch;
        std::vector<double> sums;
        for (std::int64_t k = begin; k < end; ++k) {
            const int side = int(k / pieces), first = int(k % pieces) * length, last = std::min(first + length, n),
                      outer = side % 2 ? n - 1 : 0;
            const FaceTile tile =
                side < 2 ? FaceTile{first, outer, last, outer + 1} : FaceTile{outer, first, outer + 1, last};
            impl_->fill(tile, sums, scratch);
            for (int y = tile.y0; y < tile.y1; ++y)
                for (int x = tile.x0; x < tile.x1; ++x) {
                    if (side > 1 && (y == 0 || y == n - 1)) continue; // corners belong to the rows
                    std::copy_n(&sums[(std::size_t(y - tile.y0) * tile.stride() + (x - tile.x0)) * (channels + 1)],
                                channels + 1, values.begin() + std::ptrdiff_t(border_index(n, x, y)) * (channels + 1));
                }
        }
    });
    return values;
}

} // namespace bake
