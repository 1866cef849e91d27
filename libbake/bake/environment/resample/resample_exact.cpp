#include "bake/environment/resample/resample_exact.h"
#include "bake/base/parallel.h"
#include "bake/base/progress.h"
#include "bake/environment/resample/lattice.h"
#include "bake/environment/resample/slope.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

constexpr int block_texels = 32;

/// Texels that meet two tiles are shared out twice; sums of large tiles leave the cache.
int tile_of(int face) noexcept { return face < 2048 ? 256 : 512; }

/// A texel is cut into this many parts along x and y, so that their sides, which are taken as great circles, stay within
/// 2e-4 of a result's texel, and no part spans more than 4 degrees.
int parts_for(const Lattice& source, double result_angle) noexcept {
    const double h = source.texel_angle();
    return std::clamp(int(std::ceil(std::max(h / std::sqrt(16 * 2e-4 * result_angle), h / 0.07))), 1, 64);
}

/// The texels of one lattice and their values.
struct Source {
    Lattice lattice;
    CubeFace face; ///< of a cube
};

/// Cells on a face that a block of texels may meet.
struct Block {
    int source, x0, y0, x1, y1;
    CellWindow cells;
};

bool meet(const CellWindow& a, const CellWindow& b) noexcept {
    return a.low_x < b.high_x && b.low_x < a.high_x && a.low_y < b.high_y && b.low_y < a.high_y;
}

/// The window of a block, from the lattice points round it; empty when it lies off the face.
CellWindow block_window(const Lattice& lattice, const FaceGrid& grid, const FacePlane& plane, const Block& block) {
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
    // A coarse block may cover the face while its own border is behind it.
    const bool coarse = block_texels * lattice.texel_angle() > 0.5;
    return any_ahead || coarse ? whole_face(grid) : CellWindow{0, 0, 0, 0};
}

/// The edges of a row of a lattice, cut when they are first asked for.
struct EdgeRow {
    std::vector<EdgePart> parts;
    std::vector<int> first, count; ///< count 0: not cut yet
    int used = 0;

    void reset(int edges) {
        used = 0;
        first.resize(edges);
        count.assign(edges, 0);
    }
    void cut(int k, const PlanePoint& from, const PlanePoint& to) {
        if (count[k] > 0) return;
        first[k] = used;
        count[k] = part_count(from, to);
        used += count[k];
        if (std::size_t(used) > parts.size()) parts.resize(2 * std::size_t(used));
        cut_edge(from, to, parts.data() + first[k]);
    }
    EdgeParts operator[](int k) const noexcept { return {parts.data() + first[k], count[k]}; }
};

/// Texels [x0, x1) x [y0, y1) of a face that are summed together.
struct Tile {
    int x0, y0, x1, y1;
    /// Rows a power of two apart would share their places in the cache.
    int stride() const noexcept { return x1 - x0 + 2; }
};

/// A part of a texel's width: how wide, and where its middle lies from the texel's.
struct ColumnPart {
    int texel;
    double width, middle;
};

struct Scratch {
    std::vector<Vec3d> directions;
    std::vector<ColumnPart> columns;
    std::vector<PlanePoint> upper, lower;
    EdgeRow upper_edges, lower_edges, side_edges;
    Overlap overlap;
};

} // namespace

int frame_index(int n, int x, int y) noexcept {
    if (y == 0) return x;
    if (y == n - 1) return n + x;
    if (x == 0) return 2 * n + y;
    if (x == n - 1) return 3 * n + y;
    return -1;
}

struct FaceRain::Impl {
    const Environment& sky;
    FaceGrid grid;
    FacePlane plane;
    std::vector<Source> sources; ///< their lattices mapped by FacePlane::map of the face
    std::vector<Block> near;     ///< those that may meet the face
    int parts;
    bool negative; ///< whether one of their texels is

    const Image<float>& image(const Source& source) const noexcept {
        return sky.is_cube() ? sky.cube[source.face] : sky.picture;
    }

    void slopes(const Source& source, int x, int y, Slopes& s) const noexcept {
        if (sky.is_cube()) face_slopes(sky.cube, sky.edge_samples, source.face, x, y, s);
        else picture_slopes(sky.projection, sky.picture, x, y, s);
    }

    /// sums: what falls on each texel of a tile, channels() + 1 values, in rows of tile.stride() texels. Of a sky without
    /// negative texels none is: corners of texels that are no parallelograms would reach a little below the darkest
    /// neighbour, and so below 0.
    void fill(const Tile& tile, std::vector<double>& sums, Scratch& scratch) const {
        const int channels = sky.channels(), cells = grid.edges ? 2 : 1;
        const CellWindow window{std::max(tile.x0 * cells, grid.low()), std::min(tile.x1 * cells, grid.high()),
                                std::max(tile.y0 * cells, grid.low()), std::min(tile.y1 * cells, grid.high())};
        sums.assign(std::size_t(tile.stride()) * (tile.y1 - tile.y0) * (channels + 1), 0.0);
        for (const Block& block : near) {
            if (!meet(block.cells, window)) continue;
            switch (channels) {
            case 1: rain<1>(block, window, tile, sums.data(), scratch); break;
            case 2: rain<2>(block, window, tile, sums.data(), scratch); break;
            case 3: rain<3>(block, window, tile, sums.data(), scratch); break;
            default: rain<4>(block, window, tile, sums.data(), scratch); break;
            }
        }
        if (!negative)
            for (double& sum : sums) sum = std::max(sum, 0.0);
    }

    /// Adds a block's texels to the cells of a window.
    template <int channels>
    void rain(const Block& block, const CellWindow& window, const Tile& tile, double* sums, Scratch& scratch) const {
        const Source& source = sources[block.source];
        const Image<float>& values = image(source);
        const int columns = block.x1 - block.x0, points = columns * parts + 1;
        scratch.directions.resize(points);
        scratch.upper.resize(points);
        scratch.lower.resize(points);
        const auto project_row = [&](double y, std::vector<PlanePoint>& row) {
            source.lattice.points(block.x0, parts, y, points, scratch.directions.data());
            for (int k = 0; k < points; ++k) row[k] = plane.place(scratch.directions[k]);
        };
        scratch.columns.resize(points);
        for (int k = 0; k + 1 < points; ++k) {
            const int x = block.x0 + k / parts;
            const double left = source.lattice.border_x(block.x0 + double(k) / parts),
                         right = source.lattice.border_x(block.x0 + double(k + 1) / parts);
            scratch.columns[k] = {x, right - left, 0.5 * (left + right) - (x + 0.5)};
        }
        project_row(source.lattice.border_y(block.y0), scratch.lower);
        scratch.lower_edges.reset(points);
        for (int y = block.y0; y < block.y1; ++y)
            for (int part = 0; part < parts; ++part) {
                std::swap(scratch.upper, scratch.lower);
                std::swap(scratch.upper_edges, scratch.lower_edges);
                scratch.lower_edges.reset(points);
                scratch.side_edges.reset(points);
                const double top = source.lattice.border_y(y + double(part) / parts),
                             bottom = source.lattice.border_y(y + double(part + 1) / parts);
                project_row(bottom, scratch.lower);
                for (int k = 0; k + 1 < points; ++k) {
                    const PlanePoint* const corners[4] = {&scratch.upper[k], &scratch.upper[k + 1],
                                                          &scratch.lower[k + 1], &scratch.lower[k]};
                    if (!may_meet(window, *corners[0], *corners[1], *corners[2], *corners[3])) continue;
                    scratch.upper_edges.cut(k, *corners[0], *corners[1]);
                    scratch.lower_edges.cut(k, *corners[3], *corners[2]);
                    scratch.side_edges.cut(k, *corners[0], *corners[3]);
                    scratch.side_edges.cut(k + 1, *corners[1], *corners[2]);
                    const EdgeParts edges[4] = {scratch.upper_edges[k], scratch.side_edges[k + 1],
                                                scratch.lower_edges[k], scratch.side_edges[k]};
                    overlap(grid, corners, edges, scratch.overlap);
                    const ColumnPart& column = scratch.columns[k];
                    const int x = column.texel;
                    const Vec2d light = source.lattice.centroid(x, y);
                    // Texel coordinates from -1/2 to 1/2, from those of the part.
                    const Vec2d scale(column.width, bottom - top),
                        shift(column.middle - light.x, 0.5 * (top + bottom) - (y + 0.5) - light.y);
                    Slopes s;
                    slopes(source, x, y, s);
                    add<channels>(&values.at(x, y), s, scale, shift, window, scratch.overlap, tile, sums);
                }
            }
    }

    template <int channels>
    void add(const float* value, const Slopes& s, const Vec2d& scale, const Vec2d& shift, const CellWindow& window,
             const Overlap& o, const Tile& tile, double* sums) const noexcept {
        // Radiance and J are linear in the place on the face, so what a cell gets is linear in its moments about the middle;
        // the last of the numbers is solid angle.
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

FaceRain::FaceRain(const Environment& source, const FaceGrid& grid, CubeFace face, const glm::dmat3& turn)
    : impl_(new Impl{source, grid, FacePlane(grid, face), {}, {}, 1, false}) {
    Impl& impl = *impl_;
    if (source.is_cube())
        for (const CubeFace from : all_cube_faces)
            impl.sources.push_back({Lattice(from, source.cube.size(), source.edge_samples, turn), from});
    else
        impl.sources.push_back(
            {Lattice(source.projection, source.picture.width(), source.picture.height(), turn), CubeFace::pz});
    impl.parts = parts_for(impl.sources[0].lattice, 2.0 / grid.texels);

    std::vector<Block> blocks;
    for (int k = 0; k < int(impl.sources.size()); ++k) {
        const Lattice& lattice = impl.sources[k].lattice;
        for (int y = 0; y < lattice.height(); y += block_texels)
            for (int x = 0; x < lattice.width(); x += block_texels)
                blocks.push_back({k,
                                  x,
                                  y,
                                  std::min(x + block_texels, lattice.width()),
                                  std::min(y + block_texels, lattice.height()),
                                  {}});
    }
    for_rows(std::int64_t(blocks.size()), 256, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t i = begin; i < end; ++i)
            blocks[i].cells = block_window(impl.sources[blocks[i].source].lattice, grid, impl.plane, blocks[i]);
    });
    for (const Block& block : blocks)
        if (meet(block.cells, whole_face(grid))) impl.near.push_back(block);
    std::vector<char> negative(impl.near.size());
    for_rows(std::int64_t(impl.near.size()), 256, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t i = begin; i < end; ++i) {
            const Block& block = impl.near[i];
            const Image<float>& from = impl.image(impl.sources[block.source]);
            for (int y = block.y0; y < block.y1; ++y) {
                const float* const row = &from.at(block.x0, y);
                negative[i] |= std::any_of(row, row + std::ptrdiff_t(block.x1 - block.x0) * from.channels(),
                                           [](float v) { return v < 0; });
            }
        }
    });
    impl.negative = std::find(negative.begin(), negative.end(), 1) != negative.end();
    for (Source& from : impl.sources) from.lattice.turn_further(impl.plane.map());
}

FaceRain::~FaceRain() = default;

void FaceRain::rows(int low, int high, float* values, Progress* progress) const {
    const int n = impl_->grid.texels, channels = impl_->sky.channels(), edge = tile_of(n);
    const int across = (n + edge - 1) / edge, down = (high - low + edge - 1) / edge;
    for_rows(
        std::int64_t(across) * down, 1,
        [&](std::int64_t begin, std::int64_t end) {
            Scratch scratch;
            std::vector<double> sums;
            for (std::int64_t k = begin; k < end; ++k) {
                const int x0 = int(k % across) * edge, y0 = low + int(k / across) * edge;
                const Tile tile{x0, y0, std::min(x0 + edge, n), std::min(y0 + edge, high)};
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

std::vector<double> FaceRain::frame() const {
    constexpr int length = 256;
    const int n = impl_->grid.texels, channels = impl_->sky.channels(), pieces = (n + length - 1) / length;
    std::vector<double> frame(std::size_t(4) * n * (channels + 1), 0.0);
    for_rows(std::int64_t(4) * pieces, 1, [&](std::int64_t begin, std::int64_t end) {
        Scratch scratch;
        std::vector<double> sums;
        for (std::int64_t k = begin; k < end; ++k) {
            const int side = int(k / pieces), first = int(k % pieces) * length, last = std::min(first + length, n),
                      outer = side % 2 ? n - 1 : 0;
            const Tile tile = side < 2 ? Tile{first, outer, last, outer + 1} : Tile{outer, first, outer + 1, last};
            impl_->fill(tile, sums, scratch);
            for (int y = tile.y0; y < tile.y1; ++y)
                for (int x = tile.x0; x < tile.x1; ++x) {
                    if (side > 1 && (y == 0 || y == n - 1)) continue; // corners belong to the rows
                    std::copy_n(&sums[(std::size_t(y - tile.y0) * tile.stride() + (x - tile.x0)) * (channels + 1)],
                                channels + 1, frame.begin() + std::ptrdiff_t(frame_index(n, x, y)) * (channels + 1));
                }
        }
    });
    return frame;
}

namespace {

/// Adds what a part of a result's texel sees of a face.
void add_seen(const Environment& sky, const FaceGrid& grid, CubeFace face, const Overlap& o, double* sum) noexcept {
    const int channels = sky.channels();
    const CellWindow window = whole_face(grid);
    const double half = grid.edges ? 0.5 : 1;
    Slopes s;
    for (int r = std::max(0, window.low_y - o.row); r < std::min(o.rows, window.high_y - o.row); ++r)
        for (int c = std::max(0, window.low_x - o.column); c < std::min(o.columns, window.high_x - o.column); ++c) {
            const CellMoments& m = o.cells[std::size_t(r) * o.columns + c];
            const double area = o.orientation * m.area;
            if (area <= 0) continue; // rounding
            const int column = o.column + c, row = o.row + r, x = grid.texel(column), y = grid.texel(row);
            const double gx = o.orientation * m.x, gy = o.orientation * m.y;
            const double omega = o.jacobian * area + o.jacobian_x * (gx + (column - o.middle_x) * area) +
                                 o.jacobian_y * (gy + (row - o.middle_y) * area);
            // From the cell's corner to the texel's middle.
            const double off_x = grid.edges && (column & 1) ? 0 : -0.5, off_y = grid.edges && (row & 1) ? 0 : -0.5;
            const double a = o.jacobian * (half * gx + off_x * area), b = o.jacobian * (half * gy + off_y * area);
            face_slopes(sky.cube, sky.edge_samples, face, x, y, s);
            const float* value = &sky.cube[face].at(x, y);
            for (int k = 0; k < channels; ++k)
                sum[k] += std::max(double(value[k]) * omega + double(s.x[k]) * a + double(s.y[k]) * b,
                                   value[k] >= 0 ? 0.0 : -1e300);
            sum[channels] += omega;
        }
}

} // namespace

Image<float> gather_picture(const Environment& sky, Projection projection, int width, int height,
                            const glm::dmat3& turn, Progress* progress) {
    const FaceGrid grid{sky.cube.size(), sky.edge_samples};
    const int channels = sky.channels();
    const Lattice lattice(projection, width, height, glm::transpose(turn));
    const int parts = parts_for(lattice, 2.0 / grid.texels), points = width * parts + 1;
    Image<float> picture(width, height, channels);
    std::vector<FacePlane> planes;
    for (const CubeFace face : all_cube_faces) planes.emplace_back(grid, face);
    for_rows(
        height, 4,
        [&](std::int64_t begin, std::int64_t end) {
            std::vector<Vec3d> upper(points), lower(points);
            std::vector<double> sums(std::size_t(width) * (channels + 1));
            Overlap o;
            EdgeRow side_edges;
            lattice.points(0, parts, lattice.border_y(double(begin)), points, lower.data());
            for (auto y = int(begin); y < int(end); ++y) {
                std::fill(sums.begin(), sums.end(), 0.0);
                for (int part = 0; part < parts; ++part) {
                    std::swap(upper, lower);
                    lattice.points(0, parts, lattice.border_y(y + double(part + 1) / parts), points, lower.data());
                    for (int k = 0; k + 1 < points; ++k) {
                        const Vec3d d[4] = {upper[k], upper[k + 1], lower[k + 1], lower[k]};
                        const Vec3d middle = d[0] + d[1] + d[2] + d[3];
                        for (const CubeFace face : all_cube_faces) {
                            // A part spans 4 degrees at most: its middle lies near every face it meets.
                            const FacePlane& plane = planes[int(face)];
                            if (glm::dot(plane.axis, middle) < 1.8) continue;
                            const PlanePoint at = plane.project(middle);
                            if (std::abs(at.x - grid.middle()) > 1.3 * grid.scale() + 1 ||
                                std::abs(at.y - grid.middle()) > 1.3 * grid.scale() + 1)
                                continue;
                            PlanePoint p[4];
                            for (int i = 0; i < 4; ++i) p[i] = plane.project(d[i]);
                            if (!may_meet(whole_face(grid), p[0], p[1], p[2], p[3])) continue;
                            side_edges.reset(4);
                            for (int i = 0; i < 4; ++i)
                                side_edges.cut(i, p[i < 2 ? i : i == 2 ? 3 : 0], p[i == 0 ? 1 : i == 3 ? 3 : 2]);
                            const PlanePoint* const corners[4] = {&p[0], &p[1], &p[2], &p[3]};
                            const EdgeParts edges[4] = {side_edges[0], side_edges[1], side_edges[2], side_edges[3]};
                            overlap(grid, corners, edges, o);
                            add_seen(sky, grid, face, o, &sums[std::size_t(k / parts) * (channels + 1)]);
                        }
                    }
                }
                for (int x = 0; x < width; ++x) {
                    const double* sum = &sums[std::size_t(x) * (channels + 1)];
                    for (int c = 0; c < channels; ++c)
                        picture.at(x, y, c) = sum[channels] > 0 ? float(sum[c] / sum[channels]) : 0.0f;
                }
            }
        },
        progress);
    return picture;
}

} // namespace bake
