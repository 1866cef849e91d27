#include "bake/environment/resample/resample.h"
#include "bake/base/error.h"
#include "bake/base/parallel.h"
#include "bake/base/progress.h"
#include "bake/base/vec.h"
#include "bake/environment/resample/resample_exact.h"
#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <optional>
#include <utility>
#include <vector>

namespace bake {
namespace {

int side_of(Samples samples) noexcept { return samples == Samples::grid4 ? 4 : 1; }

/// One row of the result: side x side looks per texel; direction(x, y) gives the source's direction at a point of the
/// result, in texels.
template <class Directions>
void sample_row(const Environment& source, int y, int width, int side, Directions&& direction,
                std::vector<Vec3d>& looks, std::vector<float>& seen, float* row) {
    const int channels = source.channels();
    looks.resize(width);
    seen.resize(std::size_t(width) * channels);
    if (side == 1) {
        for (int x = 0; x < width; ++x) looks[x] = direction(x + 0.5, y + 0.5);
        sample(source, looks.data(), width, row);
        return;
    }
    std::fill_n(row, std::size_t(width) * channels, 0.0f);
    const float share = 1.0f / float(side * side);
    for (int k = 0; k < side * side; ++k) {
        for (int x = 0; x < width; ++x) looks[x] = direction(x + (k % side + 0.5) / side, y + (k / side + 0.5) / side);
        sample(source, looks.data(), width, seen.data());
        for (std::size_t i = 0; i < seen.size(); ++i) row[i] += share * seen[i];
    }
}

/// Rows [low, high) of a face, sampled.
void sampled_rows(const Environment& source, const FaceGrid& grid, CubeFace face, const ResampleOptions& options,
                  Samples samples, int low, int high, float* values, Progress* progress) {
    const int n = grid.texels, side = side_of(samples), channels = source.channels();
    const glm::dmat3 back = glm::transpose(options.turn);
    // Directions are linear along the face: middle + s right + t down.
    const Vec3d middle = back * cube_direction(CubePoint<double>{face, 0.5, 0.5});
    const Vec3d right = back * cube_direction(CubePoint<double>{face, 1.0, 0.5}) - middle,
                down = back * cube_direction(CubePoint<double>{face, 0.5, 1.0}) - middle;
    const double scale = grid.edges ? 2.0 / std::max(1, n - 1) : 2.0 / n;
    for_rows(
        high - low, 8,
        [&](std::int64_t begin, std::int64_t end) {
            std::vector<Vec3d> looks;
            std::vector<float> seen;
            for (std::int64_t i = begin; i < end; ++i)
                sample_row(
                    source, low + int(i), n, side,
                    [&](double at_x, double at_y) {
                        return middle + (at_x - 0.5 * n) * scale * right + (at_y - 0.5 * n) * scale * down;
                    },
                    looks, seen, values + i * n * channels);
        },
        progress);
}

Image<float> sampled_picture(const Environment& source, Projection projection, int width, int height,
                             const ResampleOptions& options, Samples samples, Progress* progress) {
    Image<float> image(width, height, source.channels());
    const glm::dmat3 back = glm::transpose(options.turn);
    for_rows(
        height, 8,
        [&](std::int64_t begin, std::int64_t end) {
            std::vector<Vec3d> looks;
            std::vector<float> seen;
            for (auto y = int(begin); y < int(end); ++y)
                sample_row(
                    source, y, width, side_of(samples),
                    [&](double at_x, double at_y) {
                        return back * picture_direction(projection, width, height, at_x, at_y);
                    },
                    looks, seen, image.row(y));
        },
        progress);
    return image;
}

/// The values of texels at a face's edges, channels each, by frame_index.
using Frame = std::vector<float>;

/// Texels on the edges and corners stand on two or three faces: all get the mean over their whole solid angle. `frames`:
/// flux and solid angle.
std::array<Frame, 6> join_frames(int n, int channels, const std::array<std::vector<double>, 6>& frames) {
    std::array<Frame, 6> joined;
    for (const CubeFace face : all_cube_faces) {
        Frame& values = joined[int(face)];
        values.resize(std::size_t(4) * n * channels);
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; x += y == 0 || y == n - 1 || n == 1 ? 1 : n - 1) {
                const Vec3d d = cube_direction(CubePoint<double>{face, double(x) / (n - 1), double(y) / (n - 1)});
                std::vector<double> sum(channels + 1, 0.0);
                for (int other = 0; other < 6; ++other) {
                    const PlanePoint at = FacePlane({n, true}, CubeFace(other)).project(d);
                    const double u = (at.x - 1) / 2, v = (at.y - 1) / 2; // texels from the first one's centre
                    if (at.ma < 1 - 1e-9 || std::abs(u - 0.5 * (n - 1)) > 0.5 * n ||
                        std::abs(v - 0.5 * (n - 1)) > 0.5 * n)
                        continue;
                    const int index = frame_index(n, int(std::lround(u)), int(std::lround(v)));
                    for (int c = 0; c <= channels; ++c)
                        sum[c] += frames[other][std::size_t(index) * (channels + 1) + c];
                }
                float* const value = &values[std::size_t(frame_index(n, x, y)) * channels];
                for (int c = 0; c < channels; ++c) value[c] = float(sum[c] / sum[channels]);
            }
    }
    return joined;
}

/// A texel on an edge is folded round it: its light has its middle up to 1/8 of a texel further from the edge's middle
/// than its sample, |t| / 8 at t in [-1, 1]. The value is brought back by its difference to the neighbour on that side,
/// which loses no light but for that in which |t| / 8 changes from texel to texel.
void centre_edges(int n, int channels, Frame& frame) {
    for (int side = 0; side < 4; ++side) {
        const auto at = [&](int i) {
            const int index = side == 0   ? frame_index(n, i, 0)
                              : side == 1 ? frame_index(n, i, n - 1)
                              : side == 2 ? frame_index(n, 0, i)
                                          : frame_index(n, n - 1, i);
            return &frame[std::size_t(index) * channels];
        };
        // From the ends inwards, so that neighbours still hold what they were given; the middle has nothing to move.
        for (int i = 1; 2 * i < n - 1; ++i)
            for (const int k : {i, n - 1 - i}) {
                const float share = float(std::abs(2.0 * k / (n - 1) - 1) / 8);
                float *value = at(k), *inner = at(k < n - 1 - k ? k + 1 : k - 1);
                for (int c = 0; c < channels; ++c) value[c] += share * (inner[c] - value[c]);
            }
    }
}

/// Writes a frame over rows [low, high) of a face.
void put_frame(const Frame& frame, int n, int channels, int low, int high, float* values) {
    for (int y = low; y < high; ++y)
        for (int x = 0; x < n; x += y == 0 || y == n - 1 || n == 1 ? 1 : n - 1)
            std::copy_n(&frame[std::size_t(frame_index(n, x, y)) * channels], channels,
                        values + (std::size_t(y - low) * n + x) * channels);
}

/// Whether the texels that an edge-sampled lat-long has twice or more, its outer columns and rows, are equal.
bool is_joined(const Image<float>& picture) noexcept {
    const int w = picture.width(), h = picture.height(), channels = picture.channels();
    for (int y = 0; y < h; ++y)
        if (!std::equal(&picture.at(0, y), &picture.at(0, y) + channels, &picture.at(w - 1, y))) return false;
    for (const int y : {0, h - 1})
        for (int x = 1; x < w; ++x)
            if (!std::equal(&picture.at(0, y), &picture.at(0, y) + channels, &picture.at(x, y))) return false;
    return true;
}

/// An edge-sampled source whose shared texels differ is read as their mean.
Image<float> joined(const Image<float>& picture) {
    Image<float> copy(picture.width(), picture.height(), picture.channels());
    std::copy_n(picture.data(), picture.size(), copy.data());
    const int w = copy.width(), h = copy.height(), channels = copy.channels();
    for (int c = 0; c < channels; ++c) {
        for (int y = 0; y < h; ++y)
            copy.at(0, y, c) = copy.at(w - 1, y, c) = 0.5f * (copy.at(0, y, c) + copy.at(w - 1, y, c));
        for (const int y : {0, h - 1}) {
            double sum = 0;
            for (int x = 0; x < w; ++x) sum += copy.at(x, y, c);
            for (int x = 0; x < w; ++x) copy.at(x, y, c) = float(sum / w);
        }
    }
    return copy;
}

/// Turns a picture by 180 degrees.
void reverse_texels(Image<float>& image) noexcept {
    const int channels = image.channels();
    float *low = image.data(), *high = low + image.size() - channels;
    for (; low < high; low += channels, high -= channels) std::swap_ranges(low, low + channels, high);
}

bool same_lattice(const Environment& source, const FaceGrid& grid) noexcept {
    return source.is_cube() && source.cube.size() == grid.texels && source.edge_samples == grid.edges;
}

double density_of(const FaceGrid& grid) noexcept { return std::sqrt(6.0 * grid.texels * grid.texels / (4 * pi)); }

} // namespace

Samples resolve(const Environment& source, double density, bool same, const ResampleOptions& options) {
    const bool disc = !source.is_cube() && has_disc(source.projection);
    if (options.samples == Samples::exact && disc)
        throw Error(Refusal::usage, std::string("`samples` exact: texels at the rim of a ") + name(source.projection) +
                                        " have no shape to share out; take `samples` 4x4");
    if (options.samples != Samples::automatic) return options.samples;
    if (disc) return Samples::grid4;
    glm::dmat3 turn = options.turn;
    const bool unturned = turn == glm::dmat3(1);
    if (same && (unturned || (source.is_cube() && snap_to_axes(turn)))) return Samples::one;
    return density > 2 * source.density() ? Samples::grid4 : Samples::exact;
}

namespace {

/// How the faces of a cube are made.
struct FaceJob {
    const Environment& given;
    FaceGrid grid;
    ResampleOptions options;
    Samples samples;
    Environment clean;           ///< the source with its shared texels joined, where they were not
    std::array<Frame, 6> frames; ///< what exact puts at the edges of edge-sampled faces

    const Environment& source() const noexcept { return clean.picture.empty() ? given : clean; }
};

FaceJob face_job(const Environment& source, const FaceGrid& grid, const ResampleOptions& options) {
    FaceJob job{source, grid, options, resolve(source, density_of(grid), same_lattice(source, grid), options), {}, {}};
    if (job.samples != Samples::exact) return job;
    if (!source.is_cube() && source.projection == Projection::latlong_edges && !is_joined(source.picture)) {
        job.clean.projection = source.projection;
        job.clean.picture = joined(source.picture);
    }
    if (!grid.edges) return job;
    std::array<std::vector<double>, 6> sums;
    for (const CubeFace face : all_cube_faces)
        sums[int(face)] = FaceRain(job.source(), grid, face, options.turn).frame();
    job.frames = join_frames(grid.texels, source.channels(), sums);
    for (Frame& frame : job.frames) centre_edges(grid.texels, source.channels(), frame);
    return job;
}

/// Rows [low, high) of a face; `rain`: of that face, for exact.
void make_rows(const FaceJob& job, const FaceRain* rain, CubeFace face, int low, int high, float* values,
               Progress* progress) {
    if (!rain) return sampled_rows(job.given, job.grid, face, job.options, job.samples, low, high, values, progress);
    rain->rows(low, high, values, progress);
    if (job.grid.edges) put_frame(job.frames[int(face)], job.grid.texels, job.given.channels(), low, high, values);
}

std::optional<FaceRain> rain_of(const FaceJob& job, CubeFace face) {
    if (job.samples != Samples::exact) return std::nullopt;
    return std::optional<FaceRain>(std::in_place, job.source(), job.grid, face, job.options.turn);
}

} // namespace

Cube to_cube(const Environment& source, const FaceGrid& grid, const ResampleOptions& options, Progress* progress) {
    const FaceJob job = face_job(source, grid, options);
    Cube cube = make_cube(grid.texels, source.channels());
    for (const CubeFace face : all_cube_faces) {
        const auto rain = rain_of(job, face);
        make_rows(job, rain ? &*rain : nullptr, face, 0, grid.texels, cube[face].data(), progress);
    }
    return cube;
}

void each_band(const Environment& source, const FaceGrid& grid, const ResampleOptions& options,
               const std::array<TurnedFace, 6>& faces,
               const std::function<void(int k, int y, Image<float>& band)>& take, Progress* progress) {
    const FaceJob job = face_job(source, grid, options);
    const int n = grid.texels, channels = source.channels(), height = job.samples == Samples::exact ? 512 : 128;
    for (int k = 0; k < 6; ++k) {
        const auto [face, turns] = faces[k];
        assert(turns % 2 == 0);
        const auto rain = rain_of(job, face);
        for (int y = 0; y < n; y += height) {
            const int end = std::min(y + height, n);
            Image<float> band(n, end - y, channels);
            // Upside down the last rows come first, backwards.
            const bool around = turns % 4 != 0;
            make_rows(job, rain ? &*rain : nullptr, face, around ? n - end : y, around ? n - y : end, band.data(),
                      progress);
            if (around) reverse_texels(band);
            take(k, y, band);
        }
    }
}

Image<float> to_picture(const Environment& source, Projection projection, int width, int height,
                        const ResampleOptions& options, Progress* progress) {
    const bool same = !source.is_cube() && source.projection == projection && source.picture.width() == width &&
                      source.picture.height() == height;
    const double density = std::sqrt(double(width) * height / (4 * pi));
    const Samples samples = resolve(source, density, same, options);
    if (samples != Samples::exact)
        return sampled_picture(source, projection, width, height, options, samples, progress);
    if (source.is_cube()) return gather_picture(source, projection, width, height, options.turn, progress);
    Environment between;
    const double finest = 1.5 * std::max(density, source.density());
    between.cube =
        to_cube(source, {2 * int(std::ceil(finest * std::sqrt(4 * pi / 6) / 2)), false}, {Samples::exact}, progress);
    return gather_picture(between, projection, width, height, options.turn, progress);
}

glm::dmat3 turn_of(double yaw_deg, double pitch_deg, double roll_deg) noexcept {
    const double y = glm::radians(yaw_deg), p = glm::radians(pitch_deg), r = glm::radians(roll_deg);
    // Columns: where right, up and ahead go.
    const glm::dmat3 yaw(Vec3d(std::cos(y), 0, -std::sin(y)), Vec3d(0, 1, 0), Vec3d(std::sin(y), 0, std::cos(y)));
    const glm::dmat3 pitch(Vec3d(1, 0, 0), Vec3d(0, std::cos(p), -std::sin(p)), Vec3d(0, std::sin(p), std::cos(p)));
    const glm::dmat3 roll(Vec3d(std::cos(r), -std::sin(r), 0), Vec3d(std::sin(r), std::cos(r), 0), Vec3d(0, 0, 1));
    glm::dmat3 turn = roll * pitch * yaw;
    snap_to_axes(turn);
    return turn;
}

bool snap_to_axes(glm::dmat3& turn) noexcept {
    glm::dmat3 rounded;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            rounded[i][j] = std::round(turn[i][j]);
            if (std::abs(rounded[i][j] - turn[i][j]) > 1e-12) return false;
        }
    turn = rounded;
    return true;
}

} // namespace bake
