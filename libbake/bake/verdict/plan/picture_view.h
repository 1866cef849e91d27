// Where points of a built scene lie in the picture of a camera.
#pragma once
#include "bake/preview/scene.h"

namespace bake {

class PictureView {
public:
    /// `camera` is in the scene's own coordinates. Points are relative to scene.origin.
    PictureView(const Scene& scene, const Camera& camera, int width, int height) noexcept
        : frame_(camera_frame(camera)), width_(width), height_(height) {
        frame_.position -= scene.origin;
    }

    const CameraFrame& frame() const noexcept { return frame_; }
    int width() const noexcept { return width_; }
    int height() const noexcept { return height_; }

    /// Unit vector from p towards the viewer.
    Vec3d towards(const Vec3d& p) const noexcept {
        return frame_.orthographic ? -Vec3d(frame_.forward) : unit_or_zero(Vec3d(frame_.position) - p);
    }
    /// Distance from the plane of the camera; negative behind it.
    double depth(const Vec3d& p) const noexcept { return glm::dot(p - Vec3d(frame_.position), Vec3d(frame_.forward)); }
    /// Whether pixels() is defined: before the camera.
    bool before(const Vec3d& p) const noexcept { return depth(p) > 0; }
    /// In pixels, from the upper left corner of the picture.
    Vec2d pixels(const Vec3d& p) const noexcept {
        const Vec3d from = p - Vec3d(frame_.position);
        const double scale = 0.5 * height_ / (frame_.half_height * (frame_.orthographic ? 1 : depth(p)));
        return {0.5 * width_ + scale * glm::dot(from, Vec3d(frame_.right)),
                0.5 * height_ - scale * glm::dot(from, Vec3d(frame_.up))};
    }
    /// Whether a point before the camera lies in the picture, or at most `margin` pixels beside it.
    bool inside(const Vec2d& at, double margin = 0) const noexcept {
        return at.x >= -margin && at.y >= -margin && at.x <= width_ + margin && at.y <= height_ + margin;
    }

private:
    CameraFrame frame_;
    int width_, height_;
};

} // namespace bake
