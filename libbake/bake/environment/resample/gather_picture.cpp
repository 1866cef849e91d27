#include "bake/environment/resample/gather_picture.h"
#include "bake/base/parallel.h"
#include "bake/base/progress.h"
#include "bake/environment/resample/lattice.h"
#include "bake/environment/resample/overlap.h"
#include "bake/environment/resample/slope.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

/// Adds the flux of a face in a part of a texel of the picture, given by its overlap with the face.
void add_flux(const Environment& sky, const FaceGrid& grid, CubeFace face, const Overlap& o, double* sum) noexcept {
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
            // From the corner of the cell to the centre of the texel.
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

/// Memory that is kept between the parts of a row.
struct GatherScratch {
    Overlap overlap;
    EdgeRow edges;
};

/// The planes of the six faces.
using FacePlanes = std::vector<FacePlane>;

/// Adds the flux in one part of a texel, a quadrilateral with corners d in the order of overlap(). sum: channels() + 1
/// values.
void add_part(const Environment& sky, const FaceGrid& grid, const FacePlanes& planes, const Vec3d d[4],
              GatherScratch& scratch, double* sum) {
    const Vec3d middle = d[0] + d[1] + d[2] + d[3];
    for (const CubeFace face : all_cube_faces) {
        // A part spans at most 4 degrees, so the middle is near every face that the part overlaps.
        const FacePlane& plane = planes[int(face)];
        if (glm::dot(plane.axis, middle) < 1.8) continue;
        const PlanePoint at = plane.project(middle);
        if (std::abs(at.x - grid.middle()) > 1.3 * grid.scale() + 1 ||
            std::abs(at.y - grid.middle()) > 1.3 * grid.scale() + 1)
            continue;
        PlanePoint p[4];
        for (int i = 0; i < 4; ++i) p[i] = plane.project(d[i]);
        if (!may_overlap(whole_face(grid), p[0], p[1], p[2], p[3])) continue;
        scratch.edges.reset(4);
        for (int i = 0; i < 4; ++i) scratch.edges.cut(i, p[i < 2 ? i : i == 2 ? 3 : 0], p[i == 0 ? 1 : i == 3 ? 3 : 2]);
        const PlanePoint* const corners[4] = {&p[0], &p[1], &p[2], &p[3]};
        const EdgeParts edges[4] = {scratch.edges[0], scratch.edges[1], scratch.edges[2], scratch.edges[3]};
        overlap(grid, corners, edges, scratch.overlap);
        add_flux(sky, grid, face, scratch.overlap, sum);
    }
}

} // namespace

Image<float> gather_picture(const Environment& sky, Projection projection, int width, int height,
                            const glm::dmat3& turn, Progress* progress) {
    const FaceGrid grid{sky.cube.size(), sky.edge_samples};
    const int channels = sky.channels();
    const Lattice lattice(projection, width, height, glm::transpose(turn));
    const int parts = lattice.parts(2.0 / grid.texels), points = width * parts + 1;
    Image<float> picture(width, height, channels);
    FacePlanes planes;
    for (const CubeFace face : all_cube_faces) planes.emplace_back(grid, face);
    for_rows(
        height, 4,
        [&](std::int64_t begin, std::int64_t end) {
            std::vector<Vec3d> upper(points), lower(points);
            std::vector<double> sums(std::size_t(width) * (channels + 1));
            GatherScratch scratch;
            lattice.points(0, parts, lattice.border_y(double(begin)), points, lower.data());
            for (auto y = int(begin); y < int(end); ++y) {
                std::fill(sums.begin(), sums.end(), 0.0);
                for (int part = 0; part < parts; ++part) {
                    std::swap(upper, lower);
                    lattice.points(0, parts, lattice.border_y(y + double(part + 1) / parts), points, lower.data());
                    for (int k = 0; k + 1 < points; ++k) {
                        const Vec3d d[4] = {upper[k], upper[k + 1], lower[k + 1], lower[k]};
                        add_part(sky, grid, planes, d, scratch, &sums[std::size_t(k / parts) * (channels + 1)]);
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
