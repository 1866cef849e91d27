// Projections: how flat pictures of the whole sky map to the sphere. Directions are unit vectors of cube space (cube.h):
// +Z ahead, +X right, +Y up. Picture points are in texels, x right, y down; (0, 0) is the upper left corner of the upper
// left texel.
//
//   latlong        phi = (x / W - 1/2) 2 pi, theta = (1/2 - y / H) pi, d = (sin phi cos theta, sin theta, cos phi cos theta)
//   latlong_edges  OpenEXR's: the centres of the outer texels lie on the picture's edges. The first and the last column are
//                  the same meridian, and the first and last row are the poles: u = (x - 1/2) / (W - 1)
//   octahedral     equal-area: Clarberg, Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD, JGT 2008; as pbrt-v4.
//                  The centre is up, +X is at the right, +Z (ahead) at the bottom, as on face py; the corners are down
//   ball           a mirror ball photographed from far away by a camera that looks ahead. The centre shows the sky behind
//                  the camera, the rim shows the sky ahead
//   probe          angular map (Debevec's light probes): the centre is ahead, the rim is behind, and the angle is
//                  proportional to the radius
#pragma once
#include "bake/base/vec.h"

namespace bake {

enum class Projection { latlong, latlong_edges, octahedral, ball, probe };

/// The direction through a point of a picture of width x height texels. A point outside the disc of ball and probe gets
/// the direction of the nearest point of the rim, a point outside the picture that of the nearest point inside.
Vec3d picture_direction(Projection projection, int width, int height, double x, double y) noexcept;
/// The picture point of a direction of any length; zero and non-finite directions are treated as straight ahead.
Vec2d picture_point(Projection projection, int width, int height, const Vec3d& direction) noexcept;

struct PictureTexel {
    int x, y;
};
/// The texel at (x, y), which may lie up to one step outside the picture: the neighbour on the sphere across the border. A
/// projection without a rule for its border repeats the outer texels.
PictureTexel texel_across(Projection projection, int width, int height, int x, int y) noexcept;

inline bool is_latlong(Projection projection) noexcept {
    return projection == Projection::latlong || projection == Projection::latlong_edges;
}

/// y[i] = atan2(y[i], x[i]) to 1e-11 rad, without branches, so that compilers vectorise the loop.
void arc_tangents(double* y, const double* x, int count) noexcept;

} // namespace bake
