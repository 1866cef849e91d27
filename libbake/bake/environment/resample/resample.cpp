#include "bake/environment/resample/resample.h"
#include "bake/base/error.h"
#include "bake/base/parallel.h"
#include "bake/base/progress.h"
#include "bake/base/vec.h"
#include "bake/environment/resample/face_accumulator.h"
#include "bake/environment/resample/gather_picture.h"
#include "bake/environment/resample/shared_texels.h"
#include "bake/environment/sky/sky_format.h"
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

/// One row of the result from side x side samples per texel; direction(x, y) is the direction in the source of a point of
/// the result, in texels.
template <class Directions>
void sample_row(const Environment& source, int y, int width, int side, Directions&& direction,
                std::vector<Vec3d>& directions, std::vector<float>& values, float* row) {
    const int channels = source.channels();
    directions.resize(width);
    values.resize(std::size_t(width) * channels);
    if (side == 1) {
        for (int x = 0; x < width; ++x) directions[x] = direction(x + 0.5, y + 0.5);
        sample(source, directions.data(), width, row);
        return;
    }
    std::fill_n(row, std::size_t(width) * channels, 0.0f);
    const float share = 1.0f / float(side * side);
    for (int k = 0; k < side * side; ++k) {
        for (int x = 0; x < width; ++x)
            directions[x] = direction(x + (k % side + 0.5) / side, y + (k / side + 0.5) / side);
        sample(source, directions.data(), width, values.data());
        for (std::size_t i = 0; i < values.size(); ++i) row[i] += share * values[i];
    }
}

/// Rows [low, high) of a face by interpolated samples.
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
            std::vector<float> sampled;
            for (std::int64_t i = begin; i < end; ++i)
                sample_row(
                    source, low + int(i), n, side,
                    [&](double at_x, double at_y) {
                        return middle + (at_x - 0.5 * n) * scale * right + (at_y - 0.5 * n) * scale * down;
                    },
                    looks, sampled, values + i * n * channels);
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
            std::vector<float> sampled;
            for (auto y = int(begin); y < int(end); ++y)
                sample_row(
                    source, y, width, side_of(samples),
                    [&](double at_x, double at_y) {
                        return back * picture_direction(projection, width, height, at_x, at_y);
                    },
                    looks, sampled, image.row(y));
        },
        progress);
    return image;
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

/// Whether a turn moves each texel of a lat-long onto another one: about the vertical, by whole columns.
bool moves_whole_columns(const Environment& source, const glm::dmat3& turn) noexcept {
    if (source.is_cube() || turn[1] != Vec3d(0, 1, 0)) return false;
    const bool edges = source.projection == Projection::latlong_edges; // the last column repeats the first one
    if (!edges && source.projection != Projection::latlong) return false;
    const double columns = source.picture.width() - (edges ? 1 : 0);
    const double moved = std::atan2(turn[2].x, turn[2].z) / (2 * pi) * columns;
    return std::abs(moved - std::round(moved)) < 1e-9 * columns;
}

} // namespace

Samples resolve(const Environment& source, double density, bool same, const ResampleOptions& options) {
    const bool disc = !source.is_cube() && entry_of(source.projection).discs > 0;
    if (options.samples == Samples::exact && disc)
        throw Error(Refusal::usage, std::string("`samples` exact: is not defined for a ") + name(source.projection) +
                                        ", whose texels at the rim have no area on the sphere; take 4x4");
    if (options.samples != Samples::automatic) return options.samples;
    if (disc) return Samples::grid4;
    glm::dmat3 turn = options.turn;
    const bool unturned = turn == glm::dmat3(1);
    if (same && (unturned || (source.is_cube() && snap_to_axes(turn)) || moves_whole_columns(source, turn)))
        return Samples::one;
    return density > 2 * source.density() ? Samples::grid4 : Samples::exact;
}

namespace {

/// Resampling to the faces of a cube.
struct FaceJob {
    const Environment& given;
    FaceGrid grid;
    ResampleOptions options;
    Samples samples;
    Environment joined;            ///< the source with equal shared texels, if those of `given` differ
    std::array<Border, 6> borders; ///< of edge-sampled faces made by exact

    const Environment& source() const noexcept { return joined.picture.empty() ? given : joined; }
};

FaceJob face_job(const Environment& source, const FaceGrid& grid, const ResampleOptions& options) {
    FaceJob job{source, grid, options, resolve(source, density_of(grid), same_lattice(source, grid), options), {}, {}};
    if (job.samples != Samples::exact) return job;
    if (!source.is_cube() && source.projection == Projection::latlong_edges && !is_joined(source.picture)) {
        job.joined.projection = source.projection;
        job.joined.picture = joined(source.picture);
    }
    if (!grid.edges) return job;
    std::array<std::vector<double>, 6> sums;
    for (const CubeFace face : all_cube_faces)
        sums[int(face)] = FaceAccumulator(job.source(), grid, face, options.turn).border();
    job.borders = join_borders(grid.texels, source.channels(), sums);
    for (Border& border : job.borders) shift_to_samples(grid.texels, source.channels(), border);
    return job;
}

/// Rows [low, high) of a face; `accumulator`: that of the face, for exact.
void make_rows(const FaceJob& job, const std::optional<FaceAccumulator>& accumulator, CubeFace face, int low, int high,
               float* values, Progress* progress) {
    if (!accumulator)
        return sampled_rows(job.given, job.grid, face, job.options, job.samples, low, high, values, progress);
    accumulator->rows(low, high, values, progress);
    if (job.grid.edges) put_border(job.borders[int(face)], job.grid.texels, job.given.channels(), low, high, values);
}

std::optional<FaceAccumulator> accumulator_for(const FaceJob& job, CubeFace face) {
    if (job.samples != Samples::exact) return std::nullopt;
    return std::optional<FaceAccumulator>(std::in_place, job.source(), job.grid, face, job.options.turn);
}

} // namespace

Cube to_cube(const Environment& source, const FaceGrid& grid, const ResampleOptions& options, Progress* progress) {
    const FaceJob job = face_job(source, grid, options);
    Cube cube = make_cube(grid.texels, source.channels());
    for (const CubeFace face : all_cube_faces) {
        const auto accumulator = accumulator_for(job, face);
        make_rows(job, accumulator, face, 0, grid.texels, cube[face].data(), progress);
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
        const auto accumulator = accumulator_for(job, face);
        for (int y = 0; y < n; y += height) {
            const int end = std::min(y + height, n);
            Image<float> band(n, end - y, channels);
            // A face that is turned by 180 degrees starts with its last rows.
            const bool around = turns % 4 != 0;
            make_rows(job, accumulator, face, around ? n - end : y, around ? n - y : end, band.data(), progress);
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
