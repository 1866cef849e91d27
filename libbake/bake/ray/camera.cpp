#include "bake/ray/camera.h"
#include "bake/base/vec.h"
#include <cmath>

namespace bake {

CameraFrame camera_frame(const Camera& camera) noexcept {
    // In double, so that the axes are accurate for a small target far from the origin.
    const Vec3d forward = unit_or_zero(Vec3d(camera.target) - Vec3d(camera.position));
    const auto right_of = [&](const Vec3d& up) {
        const Vec3d right = glm::cross(forward, unit_or_zero(up));
        return glm::length(right) > 1e-6 ? unit_or_zero(right) : Vec3d(0);
    };
    Vec3d right = right_of(Vec3d(camera.up));
    if (right == Vec3d(0)) right = right_of(Vec3d(0, 0, 1));
    if (right == Vec3d(0)) right = right_of(Vec3d(1, 0, 0));
    CameraFrame frame;
    frame.position = camera.position;
    frame.forward = Vec3f(forward);
    frame.right = Vec3f(right);
    frame.up = Vec3f(glm::cross(right, forward));
    const double half = camera.orthographic ? 0.5 * camera.view_height : std::tan(0.5 * camera.fov_deg * (pi / 180.0));
    frame.half_height = float(half);
    frame.orthographic = camera.orthographic;
    return frame;
}

Ray primary_ray(const CameraFrame& frame, double x, double y, int width, int height) noexcept {
    const double step = 2.0 * frame.half_height / height; // one pixel at distance 1
    const double right = (x - 0.5 * width) * step;
    const double up = (0.5 * height - y) * step; // row 0 is the top
    const Vec3d across = right * Vec3d(frame.right) + up * Vec3d(frame.up);
    if (frame.orthographic) return {Vec3f(Vec3d(frame.position) + across), frame.forward};
    return {frame.position, Vec3f(unit_or_zero(Vec3d(frame.forward) + across))};
}

double pixels_at_most(const CameraFrame& frame, const Vec3d& at, double length, int height) noexcept {
    if (!(length > 0)) return 0;
    if (frame.orthographic) return length * height / (2.0 * frame.half_height);
    const Vec3d towards = at - Vec3d(frame.position);
    // The distance is at least the length of the segment. The depth is at least half the distance, that is 60 degrees off axis.
    const double distance = std::max(glm::length(towards), length);
    const double depth = std::max(glm::dot(towards, Vec3d(frame.forward)), 0.5 * distance);
    // Perpendicular to the view a segment covers the angle length / distance. The projection stretches it radially by
    // (distance / depth)^2.
    return length * distance / (depth * depth) * height / (2.0 * frame.half_height);
}

} // namespace bake
