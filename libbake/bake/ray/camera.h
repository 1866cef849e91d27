// A perspective camera that looks at a point.
#pragma once
#include "bake/base/vec.h"
#include "bake/ray/ray.h"

namespace bake {

/// Where the camera stands and what it looks at, in world space.
struct Camera {
    Vec3f position{0, 0, 5};
    Vec3f target{0, 0, 0};
    Vec3f up{0, 1, 0};     ///< any direction that is up in the picture; parallel to the view: +Z or +X is taken
    float fov_deg = 40.0f; ///< vertical, between the lower and upper edge of the picture
};

/// Unit axes of the picture: right along x, up against y, forward into it. All zero when position and target coincide
/// or are not finite: rays of such a camera miss.
struct CameraFrame {
    Vec3f position, right, up, forward;
    float half_height = 0; ///< tan(fov / 2): half the picture's height at distance 1
};
CameraFrame camera_frame(const Camera& camera) noexcept;

/// The ray through picture point (x, y) in pixels of a width x height picture: (0, 0) is the upper left corner of the
/// upper left pixel, whose centre is (0.5, 0.5). Pixels are square. The direction is unit length.
Ray primary_ray(const CameraFrame& frame, double x, double y, int width, int height) noexcept;

/// Pixels that a short segment near `at` may cover in a picture `height` pixels high, however it is turned: never less
/// than what it does cover inside the picture (within 60 degrees of its middle). Finite everywhere, behind the camera too.
double pixels_at_most(const CameraFrame& frame, const Vec3d& at, double length, int height) noexcept;

} // namespace bake
