#include "bake/verdict/plan/flat_patch.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>

namespace bake {
namespace {

double cross2(const Vec2d& a, const Vec2d& b) noexcept { return a.x * b.y - a.y * b.x; }

/// A half-space: n . p + d >= 0.
struct HalfSpace {
    Vec3d n{0};
    double d = 0;
    double at(const Vec3d& p) const noexcept { return glm::dot(n, p) + d; }
};

/// Of the points that lie in the picture, or at most `margin` pixels beside it.
std::array<HalfSpace, 4> view_region(const PictureView& view, double margin) noexcept {
    const CameraFrame& frame = view.frame();
    const Vec3d c(frame.position), right(frame.right), up(frame.up), forward(frame.forward);
    const double per_pixel = 2 * frame.half_height / view.height();
    const double x = (0.5 * view.width() + margin) * per_pixel, y = (0.5 * view.height() + margin) * per_pixel;
    const auto side = [&](const Vec3d& out, double reach) {
        const Vec3d n = frame.orthographic ? -out : reach * forward - out;
        return HalfSpace{n, -glm::dot(n, c) + (frame.orthographic ? reach : 0)};
    };
    return {side(right, x), side(-right, x), side(up, y), side(-up, y)};
}

/// Sutherland and Hodgman, Reentrant Polygon Clipping, 1974.
std::vector<Vec3d> clipped(std::vector<Vec3d> polygon, const std::array<HalfSpace, 4>& region) {
    for (const HalfSpace& side : region) {
        std::vector<Vec3d> kept;
        for (std::size_t k = 0; k < polygon.size(); ++k) {
            const Vec3d &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
            const double at_a = side.at(a), at_b = side.at(b);
            if (at_a >= 0) kept.push_back(a);
            if ((at_a >= 0) != (at_b >= 0)) kept.push_back(a + at_a / (at_a - at_b) * (b - a));
        }
        polygon = std::move(kept);
    }
    return polygon;
}

double area_in_pixels(const std::vector<Vec3d>& polygon, const PictureView& view) noexcept {
    double area = 0;
    for (std::size_t k = 0; k < polygon.size(); ++k)
        area += cross2(view.pixels(polygon[k]), view.pixels(polygon[(k + 1) % polygon.size()])) / 2;
    return std::abs(area);
}

/// The largest shift in pixels of points that move by up to `height` along n.
///
/// In the camera's axes, with x and y over depth 1, a point at depth z that moves by t n moves in the picture by
/// t (n_xy - xy n_z) / (z + t n_z), which is convex in xy.
class Shift {
public:
    Shift(const PictureView& view, const Vec3d& n, double height) noexcept
        : view_(view), n_(glm::dot(n, Vec3d(view.frame().right)), glm::dot(n, Vec3d(view.frame().up)),
                          glm::dot(n, Vec3d(view.frame().forward))),
          height_(height), scale_(0.5 * view.height() / view.frame().half_height) {}

    /// (x, y) is a place at depth 1, or in an orthographic view anything.
    double across(double x, double y) const noexcept {
        if (view_.frame().orthographic) return std::hypot(n_.x, n_.y);
        return std::hypot(n_.x - x * n_.z, n_.y - y * n_.z);
    }
    double pixels(double most_across, double least_depth) const noexcept {
        if (view_.frame().orthographic) return scale_ * height_ * most_across;
        const double depth = least_depth - height_ * std::abs(n_.z);
        return depth > 0 ? scale_ * height_ * most_across / depth : INFINITY;
    }

private:
    const PictureView& view_;
    Vec3d n_;
    double height_, scale_;
};

/// A first bound, of points on the whole plane.
double shift_on_plane(const PictureView& view, const Vec3d& n, double height, double distance) noexcept {
    const CameraFrame& frame = view.frame();
    const Shift shift(view, n, height);
    const double y = frame.half_height, x = y * view.width() / view.height();
    double most = 0, nearness = 0; // one over the depth is linear in the picture
    for (int k = 0; k < 4; ++k) {
        const double at_x = k & 1 ? x : -x, at_y = k & 2 ? y : -y;
        const Vec3d ray = Vec3d(frame.forward) + at_x * Vec3d(frame.right) + at_y * Vec3d(frame.up);
        most = std::max(most, shift.across(at_x, at_y));
        nearness = std::max(nearness, -glm::dot(n, ray) / distance);
    }
    if (frame.orthographic) return shift.pixels(most, 0);
    // Where the relief is hit, the depth differs from that of the plane by less than 5 %.
    return nearness > 0 ? shift.pixels(most, 0.95 / nearness) : 0;
}

} // namespace

std::optional<PatchInPicture> in_picture(const FlatPatch& patch, double height, const PictureView& view) {
    const CameraFrame& frame = view.frame();
    if (view.width() <= 0 || view.height() <= 0 || frame.forward == Vec3f(0)) return {};
    const Vec3d from = Vec3d(frame.position) - patch.corners[0];
    const double side = frame.orthographic ? -glm::dot(patch.n, Vec3d(frame.forward)) : glm::dot(patch.n, from);
    PatchInPicture out;
    out.n = side < 0 ? -patch.n : patch.n;
    const double distance = std::abs(glm::dot(patch.n, from));
    if (frame.orthographic ? std::abs(side) < 1e-3 : !(distance > 20 * height)) return {};
    const double margin = shift_on_plane(view, out.n, height, distance) + 1;
    if (!(margin < 1e4)) return {};
    const auto region = view_region(view, margin);
    const std::vector<Vec3d> seen = clipped(patch.corners, region);
    if (seen.size() < 3) return out;

    const Shift shift(view, out.n, height);
    const double scale = 0.5 * view.height() / frame.half_height;
    double most_across = 0, least_depth = INFINITY, least_cosine = 1;
    out.uv_low = Vec2d(INFINITY), out.uv_high = Vec2d(-INFINITY);
    for (const Vec3d& p : seen) {
        const Vec3d at = p - Vec3d(frame.position);
        const double depth = view.depth(p);
        if (!(depth > height)) return {};
        least_depth = std::min(least_depth, depth);
        most_across = std::max(
            most_across, shift.across(glm::dot(at, Vec3d(frame.right)) / depth, glm::dot(at, Vec3d(frame.up)) / depth));
        least_cosine = std::min(least_cosine, glm::dot(out.n, view.towards(p)));
        const Vec2d uv = patch.uv(p);
        out.uv_low = glm::min(out.uv_low, uv), out.uv_high = glm::max(out.uv_high, uv);
    }
    if (!(least_cosine > 1e-3)) return {};
    out.shift = shift.pixels(most_across, least_depth);
    out.most_tangent = std::sqrt(1 - std::min(1.0, least_cosine * least_cosine)) / least_cosine;
    out.most_density =
        scale * scale * (frame.orthographic ? std::abs(side) : distance / (least_depth * least_depth * least_depth));
    out.area = area_in_pixels(clipped(patch.corners, view_region(view, 0)), view);
    for (std::size_t k = 0; k < patch.corners.size(); ++k) {
        const std::vector<Vec3d> edge =
            clipped({patch.corners[k], patch.corners[(k + 1) % patch.corners.size()]}, region);
        if (edge.size() < 2) continue;
        double length = 0; // of points on one line, some of which may be equal
        for (const Vec3d& p : edge)
            for (const Vec3d& q : edge) length = std::max(length, glm::length(view.pixels(p) - view.pixels(q)));
        out.border += length, ++out.edges;
    }
    return out;
}

} // namespace bake
