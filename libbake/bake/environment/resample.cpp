#include "bake/environment/resample.h"
#include "bake/base/error.h"
#include "bake/base/parallel.h"
#include "bake/base/progress.h"
#include "bake/environment/resample_exact.h"
#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <vector>

namespace bake {
namespace {

constexpr double pi = 3.14159265358979323846;

int side_of(Samples samples) noexcept { return samples == Samples::grid4 ? 4 : 1; }

/// One row of the result: side x side looks per texel; direction(x, y) gives the source's direction at a point of the
/// result, in texels.
template <class Directions>
void sample_row(const Environment& source, int y, int width, int side, Directions&& direction, std::vector<Vec3d>& looks, std::vector<float>& seen,
                float* row) {
    const int channels = source.channels();
    looks.resize(width);
    seen.resize(std::size_t(width) * channels);
    if (side == 1) {
        for (int x = 0; x < width; ++x) looks[x] = direction(x + 0.5, y + 0.5);
        sample(source, looks.data(), width, row);
        return;
    }
    std::fill_n(row, std::size_t(width) * channels, 0.0f);
    const float share = 1.0f / static_cast<float>(side * side);
    for (int k = 0; k < side * side; ++k) {
        for (int x = 0; x < width; ++x) looks[x] = direction(x + (k % side + 0.5) / side, y + (k / side + 0.5) / side);
        sample(source, looks.data(), width, seen.data());
        for (std::size_t i = 0; i < seen.size(); ++i) row[i] += share * seen[i];
    }
}

Image<float> sampled_face(const Environment& source, const FaceGrid& grid, CubeFace face, const ResampleOptions& options, Samples samples,
                          Progress* progress) {
    const int n = grid.texels, side = side_of(samples);
    Image<float> image(n, n, source.channels());
    const glm::dmat3 back = glm::transpose(options.turn);
    // Directions are linear along the face: middle + s right + t down.
    const Vec3d middle = back * cube_direction(CubePoint<double>{face, 0.5, 0.5});
    const Vec3d right = back * cube_direction(CubePoint<double>{face, 1.0, 0.5}) - middle, down = back * cube_direction(CubePoint<double>{face, 0.5, 1.0}) - middle;
    const double scale = grid.edges ? 2.0 / std::max(1, n - 1) : 2.0 / n;
    for_rows(n, 8, [&](std::int64_t begin, std::int64_t end) {
        std::vector<Vec3d> looks;
        std::vector<float> seen;
        for (auto y = int(begin); y < int(end); ++y)
            sample_row(source, y, n, side, [&](double at_x, double at_y) { return middle + (at_x - 0.5 * n) * scale * right + (at_y - 0.5 * n) * scale * down; },
                       looks, seen, image.row(y));
    }, progress);
    return image;
}

Image<float> sampled_picture(const Environment& source, Projection projection, int width, int height, const ResampleOptions& options, Samples samples,
                             Progress* progress) {
    Image<float> image(width, height, source.channels());
    const glm::dmat3 back = glm::transpose(options.turn);
    for_rows(height, 8, [&](std::int64_t begin, std::int64_t end) {
        std::vector<Vec3d> looks;
        std::vector<float> seen;
        for (auto y = int(begin); y < int(end); ++y)
            sample_row(source, y, width, side_of(samples), [&](double at_x, double at_y) { return back * picture_direction(projection, width, height, at_x, at_y); },
                       looks, seen, image.row(y));
    }, progress);
    return image;
}

/// Texels on the edges and corners stand on two or three faces: all get the mean over their whole solid angle.
void join_frames(Cube& cube, const std::array<std::vector<double>, 6>& frames) {
    const int n = cube.size(), channels = cube.channels();
    for (const CubeFace face : all_cube_faces)
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; x += y == 0 || y == n - 1 || n == 1 ? 1 : n - 1) {
                const Vec3d d = cube_direction(CubePoint<double>{face, double(x) / (n - 1), double(y) / (n - 1)});
                std::vector<double> sum(channels + 1, 0.0);
                for (int other = 0; other < 6; ++other) {
                    const PlanePoint at = FacePlane({n, true}, CubeFace(other)).project(d);
                    const double u = (at.x - 1) / 2, v = (at.y - 1) / 2; // texels from the first one's centre
                    if (at.ma < 1 - 1e-9 || std::abs(u - 0.5 * (n - 1)) > 0.5 * n || std::abs(v - 0.5 * (n - 1)) > 0.5 * n) continue;
                    const int index = frame_index(n, int(std::lround(u)), int(std::lround(v)));
                    for (int c = 0; c <= channels; ++c) sum[c] += frames[other][std::size_t(index) * (channels + 1) + c];
                }
                for (int c = 0; c < channels; ++c) cube[face].at(x, y, c) = static_cast<float>(sum[c] / sum[channels]);
            }
}

/// A texel on an edge is folded round it: its light has its middle up to 1/8 of a texel further from the edge's middle
/// than its sample, |t| / 8 at t in [-1, 1]. The value is brought back by its difference to the neighbour on that side,
/// which loses no light but for that in which |t| / 8 changes from texel to texel.
void centre_edges(Cube& cube) {
    const int n = cube.size(), channels = cube.channels();
    for (Image<float>& face : cube.faces)
        for (int side = 0; side < 4; ++side) {
            const auto at = [&](int i) { return side == 0 ? &face.at(i, 0) : side == 1 ? &face.at(i, n - 1) : side == 2 ? &face.at(0, i) : &face.at(n - 1, i); };
            // From the ends inwards, so that neighbours still hold what they were given; the middle has nothing to move.
            for (int i = 1; 2 * i < n - 1; ++i)
                for (const int k : {i, n - 1 - i}) {
                    const float share = static_cast<float>(std::abs(2.0 * k / (n - 1) - 1) / 8);
                    float *value = at(k), *inner = at(k < n - 1 - k ? k + 1 : k - 1);
                    for (int c = 0; c < channels; ++c) value[c] += share * (inner[c] - value[c]);
                }
        }
}

/// An edge-sampled source whose shared texels differ is read as their mean.
Image<float> joined(const Image<float>& picture) {
    Image<float> copy(picture.width(), picture.height(), picture.channels());
    std::copy_n(picture.data(), picture.size(), copy.data());
    const int w = copy.width(), h = copy.height(), channels = copy.channels();
    for (int c = 0; c < channels; ++c) {
        for (int y = 0; y < h; ++y) copy.at(0, y, c) = copy.at(w - 1, y, c) = 0.5f * (copy.at(0, y, c) + copy.at(w - 1, y, c));
        for (const int y : {0, h - 1}) {
            double sum = 0;
            for (int x = 0; x < w; ++x) sum += copy.at(x, y, c);
            for (int x = 0; x < w; ++x) copy.at(x, y, c) = static_cast<float>(sum / w);
        }
    }
    return copy;
}

bool same_lattice(const Environment& source, const FaceGrid& grid) noexcept {
    return source.is_cube() && source.cube.size() == grid.texels && source.edge_samples == grid.edges;
}

double density_of(const FaceGrid& grid) noexcept { return std::sqrt(6.0 * grid.texels * grid.texels / (4 * pi)); }

} // namespace

Samples resolve(const Environment& source, double density, bool same, const ResampleOptions& options) {
    const bool disc = !source.is_cube() && has_disc(source.projection);
    if (options.samples == Samples::exact && disc)
        throw Error(Refusal::usage, std::string("--samples exact: texels at the rim of a ") + name(source.projection) +
                                        " have no shape to share out; take --samples 4x4");
    if (options.samples != Samples::automatic) return options.samples;
    if (disc) return Samples::grid4;
    glm::dmat3 turn = options.turn;
    const bool unturned = turn == glm::dmat3(1);
    if (same && (unturned || (source.is_cube() && snap_to_axes(turn)))) return Samples::one;
    return density > 2 * source.density() ? Samples::grid4 : Samples::exact;
}

bool faces_alone(const Environment& source, const FaceGrid& grid, const ResampleOptions& options) {
    return !grid.edges || resolve(source, density_of(grid), same_lattice(source, grid), options) != Samples::exact;
}

Image<float> to_face(const Environment& source, const FaceGrid& grid, CubeFace face, const ResampleOptions& options, Progress* progress) {
    const Samples samples = resolve(source, density_of(grid), same_lattice(source, grid), options);
    if (samples == Samples::exact) return FaceRain(source, grid, options.turn).face(face, nullptr, progress);
    return sampled_face(source, grid, face, options, samples, progress);
}

Cube to_cube(const Environment& source, const FaceGrid& grid, const ResampleOptions& options, Progress* progress) {
    const Samples samples = resolve(source, density_of(grid), same_lattice(source, grid), options);
    Cube cube;
    if (samples != Samples::exact) {
        for (const CubeFace face : all_cube_faces) cube[face] = sampled_face(source, grid, face, options, samples, progress);
        return cube;
    }
    Environment clean;
    const bool mend = !source.is_cube() && source.projection == Projection::latlong_edges;
    if (mend) {
        clean.projection = source.projection;
        clean.picture = joined(source.picture);
    }
    const FaceRain rain(mend ? clean : source, grid, options.turn);
    std::array<std::vector<double>, 6> frames;
    for (int k = 0; k < 6; ++k) cube.faces[k] = rain.face(CubeFace(k), grid.edges ? &frames[k] : nullptr, progress);
    if (grid.edges) {
        join_frames(cube, frames);
        centre_edges(cube);
    }
    return cube;
}

Image<float> to_picture(const Environment& source, Projection projection, int width, int height, const ResampleOptions& options, Progress* progress) {
    const bool same = !source.is_cube() && source.projection == projection && source.picture.width() == width && source.picture.height() == height;
    const double density = std::sqrt(double(width) * height / (4 * pi));
    const Samples samples = resolve(source, density, same, options);
    if (samples != Samples::exact) return sampled_picture(source, projection, width, height, options, samples, progress);
    if (source.is_cube()) return gather_picture(source, projection, width, height, options.turn, progress);
    Environment between;
    const double finest = 1.5 * std::max(density, source.density());
    between.cube = to_cube(source, {2 * int(std::ceil(finest * std::sqrt(4 * pi / 6) / 2)), false}, {Samples::exact}, progress);
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
