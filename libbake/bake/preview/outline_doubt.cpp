#include "bake/preview/outline_doubt.h"
#include "bake/base/parallel.h"
#include "bake/base/text.h"
#include "bake/relief/map/relief_points.h"
#include <algorithm>
#include <cmath>
#include <map>

namespace bake {
namespace {

/// Points on an instance; more where it has more triangles, up to four times as many.
constexpr std::int64_t least_points = 65536;
/// Side of the cells of the outline, in pixels.
constexpr double cell_px = 4;
/// A normal that leaves the direction of view by less than this sine moves no outline.
constexpr double least_sine = 0.05;

/// A point near the outline.
struct OutlinePoint {
    std::int64_t cell = -1; ///< -1: none
    double px = 0;          ///< how far the relief moves it outward
};

/// The instance as the camera sees it.
class OutlineView {
public:
    OutlineView(const Scene& scene, std::size_t instance)
        : scene_(scene), instance_(instance), at_(scene.instances[instance]), frame_(camera_frame(scene)),
          position_(frame_.position), forward_(frame_.forward) {}

    /// b: the height at a point of the shape.
    OutlinePoint at(const ShapePoint& point, double b) const;

private:
    Vec3d place(const Vec3d& p) const {
        return glm::dmat3(at_.linear) * p + Vec3d(at_.translate) - Vec3d(scene_.origin);
    }
    /// World units per pixel at a point; 0 behind the camera.
    double pixel(const Vec3d& p) const;
    std::int64_t cell(const Vec3d& p) const;
    bool on_outline(const Vec3d& p, const Vec3d& out) const;

    const Scene& scene_;
    std::size_t instance_;
    const Instance& at_;
    CameraFrame frame_;
    Vec3d position_, forward_;
};

double OutlineView::pixel(const Vec3d& p) const {
    const double size = 2.0 * frame_.half_height / scene_.settings.height;
    return frame_.orthographic ? size : size * std::max(0.0, glm::dot(p - position_, forward_));
}

std::int64_t OutlineView::cell(const Vec3d& p) const {
    const double per_pixel = pixel(p);
    if (!(per_pixel > 0)) return -1;
    const RenderSettings& settings = scene_.settings;
    const double x = 0.5 * settings.width + glm::dot(p - position_, Vec3d(frame_.right)) / per_pixel;
    const double y = 0.5 * settings.height - glm::dot(p - position_, Vec3d(frame_.up)) / per_pixel;
    if (!(x >= 0 && x < settings.width && y >= 0 && y < settings.height)) return -1;
    return std::int64_t(y / cell_px) * (std::int64_t(settings.width / cell_px) + 1) + std::int64_t(x / cell_px);
}

/// The ray that passes a pixel outside the point p, at `out`, misses the instance, and nothing hides p.
bool OutlineView::on_outline(const Vec3d& p, const Vec3d& out) const {
    const Vec3d view = frame_.orthographic ? forward_ : unit_or_zero(out - position_);
    const double distance = frame_.orthographic ? glm::dot(out - position_, forward_) : glm::length(out - position_);
    if (!(distance > 0)) return false;
    const Hit hit = scene_.bvh->intersect({Vec3f(out - distance * view), Vec3f(view)});
    return !hit || (hit.mesh != instance_ && double(hit.t) > distance - glm::length(out - p));
}

OutlinePoint OutlineView::at(const ShapePoint& point, double b) const {
    const Shape& shape = *at_.shape;
    const auto& corner = shape.surface.triangles[point.triangle].corner;
    const auto position = [&](int k) { return Vec3d(shape.mesh.positions[shape.mesh.corner_position[corner[k]]]); };
    const Vec3d local =
        (1.0 - point.b1 - point.b2) * position(0) + double(point.b1) * position(1) + double(point.b2) * position(2);
    const Vec3d n(unit_or_zero(normal_at(shape, point)));
    const Vec3d p = place(local), up = glm::dmat3(at_.linear) * n; // what one unit of height moves
    const Vec3d view = frame_.orthographic ? forward_ : unit_or_zero(p - position_);
    const Vec3d across = up - glm::dot(up, view) * view;
    const double length = glm::length(across), per_pixel = pixel(p);
    if (!(per_pixel > 0) || !(length > least_sine * glm::length(up))) return {};
    const std::int64_t own = cell(p);
    if (own < 0 || !on_outline(p, p + (per_pixel / length) * across)) return {};
    return {own, b * length / per_pixel};
}

} // namespace

double relief_at_outline_px(const Scene& scene, std::size_t instance, const HeightTexture& height,
                            const HeightOptions& options) {
    const Shape& shape = *scene.instances[instance].shape;
    const auto triangles = std::int64_t(shape.surface.triangles.size());
    if (triangles == 0 || shape.mesh.corner_uv.empty() || !scene.bvh) return 0;
    const OutlineView view(scene, instance);
    const std::int64_t count = std::clamp(triangles, least_points, 4 * least_points);
    std::vector<OutlinePoint> points(static_cast<std::size_t>(count));
    for_rows(count, 1024, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t i = begin; i < end; ++i) {
            const Vec2d even = even_barycentrics(i);
            const ShapePoint at{std::uint32_t(i * triangles / count), float(even.x), float(even.y)};
            const auto [x, y] = texel_at(height.values, Vec2d(uv_at(shape, at)), options);
            const double b = options.amplitude * (double(height.values.at(x, y)) - options.midlevel);
            points[std::size_t(i)] = view.at(at, b);
        }
    });
    std::map<std::int64_t, double> highest;
    for (const OutlinePoint& point : points)
        if (point.cell >= 0) {
            const auto [found, added] = highest.try_emplace(point.cell, point.px);
            if (!added) found->second = std::max(found->second, point.px);
        }
    double largest = 0;
    for (const auto& [cell, px] : highest) largest = std::max(largest, std::abs(px));
    return largest;
}

std::string outline_doubt(const Scene& scene, const Material& material, const HeightTexture& height,
                          const ReliefOptions& options) {
    double largest = 0;
    for (std::size_t i = 0; i < scene.instances.size(); ++i)
        if (scene.instances[i].material == &material)
            largest = std::max(largest, relief_at_outline_px(scene, i, height, options.height));
    if (largest <= smallest_seen_px) return "";
    return format("the relief is shown by normals alone, and the outline stays smooth: it is off by up to %.2g pixels, "
                  "the height of the relief there; use shade = \"displace:16\"",
                  largest);
}

} // namespace bake
