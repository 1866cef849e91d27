#include "bake/environment/resample_exact.h"
#include "bake/base/parallel.h"
#include "bake/base/progress.h"
#include "bake/environment/lattice.h"
#include "bake/environment/slope.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

constexpr int block_texels = 16;

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
CellWindow block_window(const Lattice& lattice, const FaceGrid& grid, CubeFace face, const Block& block) {
    const FacePlane plane(grid, face);
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
    if (all_ahead) return {int(std::floor(x_low)) - 1, int(std::floor(x_high)) + 2, int(std::floor(y_low)) - 1, int(std::floor(y_high)) + 2};
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

struct Scratch {
    std::vector<Vec3d> directions;
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
    std::vector<Source> sources;
    std::vector<Block> blocks; ///< their windows are per face
    int parts;

    const Image<float>& image(const Source& source) const noexcept { return sky.is_cube() ? sky.cube[source.face] : sky.picture; }

    void slopes(const Source& source, int x, int y, Slopes& s) const noexcept {
        if (sky.is_cube()) face_slopes(sky.cube, sky.edge_samples, source.face, x, y, s);
        else picture_slopes(sky.projection, sky.picture, x, y, s);
    }

    /// Adds a block's texels to the cells of a window; sums: channels + 1 per texel, rows of `stride` texels from (x0, y0).
    template <int channels>
    void rain(const Block& block, CubeFace face, const CellWindow& window, double* sums, int x0, int y0, int stride, Scratch& scratch) const {
        const Source& source = sources[block.source];
        const Image<float>& values = image(source);
        const int columns = block.x1 - block.x0, points = columns * parts + 1;
        scratch.directions.resize(points);
        scratch.upper.resize(points);
        scratch.lower.resize(points);
        const FacePlane plane(grid, face);
        const auto project_row = [&](double y, std::vector<PlanePoint>& row) {
            source.lattice.points(block.x0, parts, y, points, scratch.directions.data());
            for (int k = 0; k < points; ++k) row[k] = plane.project(scratch.directions[k]);
        };
        project_row(source.lattice.border_y(block.y0), scratch.lower);
        scratch.lower_edges.reset(points);
        for (int y = block.y0; y < block.y1; ++y)
            for (int part = 0; part < parts; ++part) {
                std::swap(scratch.upper, scratch.lower);
                std::swap(scratch.upper_edges, scratch.lower_edges);
                scratch.lower_edges.reset(points);
                scratch.side_edges.reset(points);
                const double top = source.lattice.border_y(y + double(part) / parts), bottom = source.lattice.border_y(y + double(part + 1) / parts);
                project_row(bottom, scratch.lower);
                for (int k = 0; k + 1 < points; ++k) {
                    const PlanePoint* const corners[4] = {&scratch.upper[k], &scratch.upper[k + 1], &scratch.lower[k + 1], &scratch.lower[k]};
                    if (!may_meet(window, *corners[0], *corners[1], *corners[2], *corners[3])) continue;
                    scratch.upper_edges.cut(k, *corners[0], *corners[1]);
                    scratch.lower_edges.cut(k, *corners[3], *corners[2]);
                    scratch.side_edges.cut(k, *corners[0], *corners[3]);
                    scratch.side_edges.cut(k + 1, *corners[1], *corners[2]);
                    const EdgeParts edges[4] = {scratch.upper_edges[k], scratch.side_edges[k + 1], scratch.lower_edges[k], scratch.side_edges[k]};
                    overlap(grid, corners, edges, scratch.overlap);
                    const int x = block.x0 + k / parts;
                    const double left = source.lattice.border_x(block.x0 + double(k) / parts), right = source.lattice.border_x(block.x0 + double(k + 1) / parts);
                    const Vec2d light = source.lattice.centroid(x, y);
                    // Texel coordinates a from -1/2 to 1/2, from those of the part.
                    const Vec2d scale(right - left, bottom - top);
                    const Vec2d shift(0.5 * (left + right) - (x + 0.5) - light.x, 0.5 * (top + bottom) - (y + 0.5) - light.y);
                    Slopes s;
                    slopes(source, x, y, s);
                    add<channels>(&values.at(x, y), s, scale, shift, window, scratch.overlap, sums, x0, y0, stride);
                }
            }
    }

    template <int channels>
    void add(const float* value, const Slopes& s, const Vec2d& scale, const Vec2d& shift, const CellWindow& window, const Overlap& o, double* sums,
             int x0, int y0, int stride) const noexcept {
        const double a0 = o.a0 * scale.x + shift.x, ax = o.ax * scale.x, ay = o.ay * scale.x;
        const double b0 = o.b0 * scale.y + shift.y, bx = o.bx * scale.y, by = o.by * scale.y;
        for (int r = std::max(0, window.low_y - o.row); r < std::min(o.rows, window.high_y - o.row); ++r)
            for (int c = std::max(0, window.low_x - o.column); c < std::min(o.columns, window.high_x - o.column); ++c) {
                const CellMoments& m = o.cells[std::size_t(r) * o.columns + c];
                const double area = o.orientation * m.area;
                if (area <= 0) continue; // rounding
                const double gx = o.orientation * m.x + (o.column + c) * area, gy = o.orientation * m.y + (o.row + r) * area;
                const double omega = o.jacobian * area + o.jacobian_x * gx + o.jacobian_y * gy;
                const double a = o.jacobian_middle * (a0 * area + ax * gx + ay * gy);
                const double b = o.jacobian_middle * (b0 * area + bx * gx + by * gy);
                double* sum = sums + (std::size_t(grid.texel(o.row + r) - y0) * stride + (grid.texel(o.column + c) - x0)) * (channels + 1);
                for (int k = 0; k < channels; ++k) sum[k] += double(value[k]) * omega + double(s.x[k]) * a + double(s.y[k]) * b;
                sum[channels] += omega;
            }
    }
};

FaceRain::FaceRain(const Environment& source, const FaceGrid& grid, const glm::dmat3& turn) : impl_(new Impl{source, grid, {}, {}, 1}) {
    Impl& impl = *impl_;
    if (source.is_cube())
        for (const CubeFace face : all_cube_faces) impl.sources.push_back({Lattice(face, source.cube.size(), source.edge_samples, turn), face});
    else
        impl.sources.push_back({Lattice(source.projection, source.picture.width(), source.picture.height(), turn), CubeFace::pz});
    impl.parts = parts_for(impl.sources[0].lattice, 2.0 / grid.texels);
    for (int k = 0; k < int(impl.sources.size()); ++k) {
        const Lattice& lattice = impl.sources[k].lattice;
        for (int y = 0; y < lattice.height(); y += block_texels)
            for (int x = 0; x < lattice.width(); x += block_texels)
                impl.blocks.push_back({k, x, y, std::min(x + block_texels, lattice.width()), std::min(y + block_texels, lattice.height()), {}});
    }
}

FaceRain::~FaceRain() = default;

Image<float> FaceRain::face(CubeFace face, std::vector<double>* frame, Progress* progress) const {
    const Impl& impl = *impl_;
    const FaceGrid& grid = impl.grid;
    const int n = grid.texels, channels = impl.sky.channels();

    std::vector<CellWindow> windows(impl.blocks.size());
    for_rows(std::int64_t(windows.size()), 256, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t i = begin; i < end; ++i) windows[i] = block_window(impl.sources[impl.blocks[i].source].lattice, grid, face, impl.blocks[i]);
    });
    std::vector<Block> near;
    for (std::size_t i = 0; i < windows.size(); ++i)
        if (meet(windows[i], whole_face(grid))) {
            near.push_back(impl.blocks[i]);
            near.back().cells = windows[i];
        }

    Image<float> image(n, n, channels);
    if (frame) frame->assign(std::size_t(4) * n * (channels + 1), 0.0);
    const int tile_texels = tile_of(n), tiles = (n + tile_texels - 1) / tile_texels;
    for_rows(std::int64_t(tiles) * tiles, 1, [&](std::int64_t begin, std::int64_t end) {
        Scratch scratch;
        std::vector<double> sums;
        for (std::int64_t tile = begin; tile < end; ++tile) {
            const int x0 = int(tile % tiles) * tile_texels, y0 = int(tile / tiles) * tile_texels;
            const int x1 = std::min(x0 + tile_texels, n), y1 = std::min(y0 + tile_texels, n), cells = grid.edges ? 2 : 1;
            const CellWindow window{std::max(x0 * cells, grid.low()), std::min(x1 * cells, grid.high()), std::max(y0 * cells, grid.low()),
                                    std::min(y1 * cells, grid.high())};
            sums.assign(std::size_t(x1 - x0) * (y1 - y0) * (channels + 1), 0.0);
            for (const Block& block : near) {
                if (!meet(block.cells, window)) continue;
                switch (channels) {
                case 1: impl.rain<1>(block, face, window, sums.data(), x0, y0, x1 - x0, scratch); break;
                case 2: impl.rain<2>(block, face, window, sums.data(), x0, y0, x1 - x0, scratch); break;
                case 3: impl.rain<3>(block, face, window, sums.data(), x0, y0, x1 - x0, scratch); break;
                default: impl.rain<4>(block, face, window, sums.data(), x0, y0, x1 - x0, scratch); break;
                }
            }
            const double* sum = sums.data();
            for (int y = y0; y < y1; ++y)
                for (int x = x0; x < x1; ++x, sum += channels + 1) {
                    for (int c = 0; c < channels; ++c) image.at(x, y, c) = sum[channels] > 0 ? static_cast<float>(sum[c] / sum[channels]) : 0.0f;
                    const int at = frame ? frame_index(n, x, y) : -1;
                    if (at >= 0) std::copy_n(sum, channels + 1, frame->begin() + std::ptrdiff_t(at) * (channels + 1));
                }
        }
    }, progress);
    return image;
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
            const double omega = o.jacobian * area + o.jacobian_x * (gx + column * area) + o.jacobian_y * (gy + row * area);
            // From the cell's corner to the texel's middle.
            const double off_x = grid.edges && (column & 1) ? 0 : -0.5, off_y = grid.edges && (row & 1) ? 0 : -0.5;
            const double a = o.jacobian_middle * (half * gx + off_x * area), b = o.jacobian_middle * (half * gy + off_y * area);
            face_slopes(sky.cube, sky.edge_samples, face, x, y, s);
            const float* value = &sky.cube[face].at(x, y);
            for (int k = 0; k < channels; ++k) sum[k] += double(value[k]) * omega + double(s.x[k]) * a + double(s.y[k]) * b;
            sum[channels] += omega;
        }
}

} // namespace

Image<float> gather_picture(const Environment& sky, Projection projection, int width, int height, const glm::dmat3& turn, Progress* progress) {
    const FaceGrid grid{sky.cube.size(), sky.edge_samples};
    const int channels = sky.channels();
    const Lattice lattice(projection, width, height, glm::transpose(turn));
    const int parts = parts_for(lattice, 2.0 / grid.texels), points = width * parts + 1;
    Image<float> picture(width, height, channels);
    std::vector<FacePlane> planes;
    for (const CubeFace face : all_cube_faces) planes.emplace_back(grid, face);
    for_rows(height, 4, [&](std::int64_t begin, std::int64_t end) {
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
                        if (std::abs(at.x - grid.middle()) > 1.3 * grid.scale() + 1 || std::abs(at.y - grid.middle()) > 1.3 * grid.scale() + 1) continue;
                        PlanePoint p[4];
                        for (int i = 0; i < 4; ++i) p[i] = plane.project(d[i]);
                        if (!may_meet(whole_face(grid), p[0], p[1], p[2], p[3])) continue;
                        side_edges.reset(4);
                        for (int i = 0; i < 4; ++i) side_edges.cut(i, p[i < 2 ? i : i == 2 ? 3 : 0], p[i == 0 ? 1 : i == 3 ? 3 : 2]);
                        const PlanePoint* const corners[4] = {&p[0], &p[1], &p[2], &p[3]};
                        const EdgeParts edges[4] = {side_edges[0], side_edges[1], side_edges[2], side_edges[3]};
                        overlap(grid, corners, edges, o);
                        add_seen(sky, grid, face, o, &sums[std::size_t(k / parts) * (channels + 1)]);
                    }
                }
            }
            for (int x = 0; x < width; ++x) {
                const double* sum = &sums[std::size_t(x) * (channels + 1)];
                for (int c = 0; c < channels; ++c) picture.at(x, y, c) = sum[channels] > 0 ? static_cast<float>(sum[c] / sum[channels]) : 0.0f;
            }
        }
    }, progress);
    return picture;
}

} // namespace bake
