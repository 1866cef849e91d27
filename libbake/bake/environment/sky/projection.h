// How flat pictures of the whole sky lie on the sphere. Directions are unit vectors of cube space (cube.h): +Z ahead,
// +X right, +Y up; picture points are in texels, x right, y down, (0, 0) the upper left corner of the upper left texel.
//
//   latlong        phi = (x / W - 1/2) 2 pi, theta = (1/2 - y / H) pi, d = (sin phi cos theta, sin theta, cos phi cos theta)
//   latlong_edges  OpenEXR's: the outer texels' centres lie on the picture's edges, so the first and the last column are
//                  the same meridian, and the first and last row are the poles: u = (x - 1/2) / (W - 1)
//   octahedral     equal-area: Clarberg, Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD, JGT 2008; as pbrt-v4.
//                  Up is the centre, +X right, +Z (ahead) down, as on face py; the corners are straight down
//   ball           a mirror ball photographed from afar by a camera that looks ahead: the centre shows what is behind it,
//                  the rim what is ahead
//   probe          angular map (Debevec's light probes): the centre is ahead, the rim behind, the angle grows evenly
#pragma once
#include "bake/base/vec.h"

namespace bake {

enum class Projection { latlong, latlong_edges, octahedral, ball, probe };
const char* name(Projection projection) noexcept;

/// The direction through a point of a picture of width x height texels. Outside the disc of ball and probe: that of the
/// rim. Points outside the picture: that of the nearest inside.
Vec3d picture_direction(Projection projection, int width, int height, double x, double y) noexcept;
/// Where a direction of any length lies; zero and non-finite ones are taken as straight ahead.
Vec2d picture_point(Projection projection, int width, int height, const Vec3d& direction) noexcept;

/// Whether the picture is a square whose corners stand for nothing.
inline bool has_disc(Projection projection) noexcept {
    return projection == Projection::ball || projection == Projection::probe;
}

/// atan2 of many: 1e-11 rad, branch-free, so that compilers vectorise the loop. y[i] = atan2(y[i], x[i]).
void arc_tangents(double* y, const double* x, int count) noexcept;

} // namespace bake
