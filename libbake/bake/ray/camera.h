// A perspective or orthographic camera that looks at a point.
#pragma once
#include "bake/base/vec.h"
#include "bake/ray/ray.h"

namespace bake {

/// Position and orientation of the camera in world space.
struct Camera {
    Vec3f position{0, 0, 5};
    Vec3f target{0, 0, 0};
    Vec3f up{0, 1, 0};     ///< direction that is up in the picture; if parallel to the view, +Z or +X is used instead
    float fov_deg = 40.0f; ///< vertical field of view, from the lower to the upper edge of the picture
    bool orthographic = false;
    float view_height = 2; ///< orthographic: height of the picture in world units
};

/// Unit axes of the picture: right along its x, up against its y, forward along the view direction. The axes are zero if
/// position and target coincide or are not finite; rays of such a camera hit nothing.
struct CameraFrame {
    Vec3f position, right, up, forward;
    float half_height = 0; ///< half the height of the picture at distance 1; orthographic: at every distance
    bool orthographic = false;
};
CameraFrame camera_frame(const Camera& camera) noexcept;

/// The ray through the point (x, y), in pixels, of a width x height picture. (0, 0) is the upper left corner of the
/// upper left pixel; the centre of that pixel is (0.5, 0.5). Pixels are square. The direction has unit length. Rays of an
/// orthographic camera are parallel and start in the plane of its position.
Ray primary_ray(const CameraFrame& frame, double x, double y, int width, int height) noexcept;

/// Upper bound of the length in pixels of a short segment near `at`, for any direction of the segment, in a picture that
/// is `height` pixels high. The bound holds within 60 degrees of the view direction and is finite everywhere, also behind
/// the camera.
double pixels_at_most(const CameraFrame& frame, const Vec3d& at, double length, int height) noexcept;

} // namespace bake
