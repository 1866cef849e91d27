#include "bake/base/parallel.h"
#include "bake/preview/pixel_samples.h"
#include "bake/verdict/plan/pixel_probe.h"
#include <array>

namespace bake {
namespace {

constexpr int least_rays = 4096; ///< through the box of an object; fewer would miss one that is smaller than a pixel
constexpr int most_rays_per_edge = 16;
constexpr std::int64_t most_rays = 1 << 18; ///< beyond one per pixel; what is missed is near what is found

/// Columns and rows of the picture, the ends not included.
struct Region {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    bool empty() const noexcept { return x0 >= x1 || y0 >= y1; }
};

Region united(const Region& a, const Region& b) noexcept {
    if (a.empty()) return b;
    if (b.empty()) return a;
    return {std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)};
}

/// Pixels in which the box of an instance can be seen.
Region region_of(const Instance& instance, const Vec3f& origin, const CameraFrame& frame,
                 const RenderSettings& settings) {
    const std::vector<Vec3f>& positions = instance.shape->mesh.positions;
    if (positions.empty()) return {};
    Vec3f low = positions[0], high = positions[0];
    for (const Vec3f& p : positions) low = glm::min(low, p), high = glm::max(high, p);
    const double pixels = settings.height / (2.0 * frame.half_height);
    Vec2d least(settings.width, settings.height), most(0);
    int behind = 0;
    for (int i = 0; i < 8; ++i) {
        const Vec3f corner(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
        const Vec3d world = Vec3d(instance.linear * corner) + Vec3d(instance.translate) - Vec3d(origin);
        const Vec3d d = world - Vec3d(frame.position);
        const double depth = frame.orthographic ? 1 : glm::dot(d, Vec3d(frame.forward));
        if (!(depth > 0)) ++behind;
        const Vec2d at(0.5 * settings.width + pixels * glm::dot(d, Vec3d(frame.right)) / depth,
                       0.5 * settings.height - pixels * glm::dot(d, Vec3d(frame.up)) / depth);
        least = glm::min(least, at), most = glm::max(most, at);
    }
    if (behind == 8) return {};
    const Region all{0, 0, settings.width, settings.height};
    // The projection of a box that reaches behind the camera has no bounds. One pixel more is for rounding.
    if (behind > 0 || !std::isfinite(least.x + least.y + most.x + most.y)) return all;
    const auto inside = [](double x, int size) { return int(std::clamp(x, 0.0, double(size))); };
    return {inside(std::floor(least.x) - 1, all.x1), inside(std::floor(least.y) - 1, all.y1),
            inside(std::ceil(most.x) + 1, all.x1), inside(std::ceil(most.y) + 1, all.y1)};
}

/// Marks the pixels of a row of the region that a ray of their lattice sees the object in.
class RowMarker {
public:
    RowMarker(const ProbedScene& probed, const CameraFrame& frame, const RenderSettings& settings, int edge)
        : probed_(probed), frame_(frame), settings_(settings), edge_(edge) {}

    void operator()(const Region& region, int y, std::uint8_t* row) const {
        const std::int64_t count = std::int64_t(region.x1 - region.x0) * edge_ * edge_;
        std::array<Ray, packet_size> rays;
        std::array<Hit, packet_size> hits;
        for (std::int64_t first = 0; first < count; first += packet_size) {
            const int lanes = int(std::min<std::int64_t>(packet_size, count - first));
            for (int lane = 0; lane < lanes; ++lane) {
                const auto in_pixel = int((first + lane) % (edge_ * edge_));
                const double x = column(region, first + lane) + (in_pixel % edge_ + 0.5) / edge_;
                const double at = y + (in_pixel / edge_ + 0.5) / edge_;
                rays[std::size_t(lane)] = primary_ray(frame_, x, at, settings_.width, settings_.height);
            }
            probed_.scene->bvh->intersect(rays, (PacketMask(1) << lanes) - 1, hits);
            for (int lane = 0; lane < lanes; ++lane) {
                const Hit& hit = hits[std::size_t(lane)];
                if (hit && probed_.of_object[hit.mesh]) row[column(region, first + lane)] = 1;
            }
        }
    }

private:
    int column(const Region& region, std::int64_t ray) const noexcept { return region.x0 + int(ray / (edge_ * edge_)); }

    const ProbedScene& probed_;
    const CameraFrame& frame_;
    const RenderSettings& settings_;
    int edge_;
};

void mark(const ProbedScene& probed, const ProbeOptions& options, int rays_per_edge, std::vector<std::uint8_t>& marks) {
    const RenderSettings& settings = options.settings;
    const Scene& scene = *probed.scene;
    CameraFrame frame = camera_frame(options.camera);
    frame.position -= scene.origin;
    Region region;
    for (std::size_t i = 0; i < probed.of_object.size(); ++i)
        if (probed.of_object[i]) region = united(region, region_of(scene.instances[i], scene.origin, frame, settings));
    if (region.empty()) return;
    const std::int64_t pixels = std::int64_t(region.x1 - region.x0) * (region.y1 - region.y0);
    int edge = std::max(1, rays_per_edge);
    while (edge < most_rays_per_edge && pixels * edge * edge < least_rays) ++edge;
    while (edge > 1 && pixels * edge * edge > most_rays) --edge;
    const RowMarker mark_row(probed, frame, settings, edge);
    for_rows(region.y1 - region.y0, 1, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t y = region.y0 + begin; y < region.y0 + end; ++y)
            mark_row(region, int(y), &marks[std::size_t(y) * std::size_t(settings.width)]);
    });
}

bool is_near(const std::vector<std::uint8_t>& marks, int width, int height, int x, int y) noexcept {
    for (int j = std::max(0, y - 1); j <= std::min(height - 1, y + 1); ++j)
        for (int i = std::max(0, x - 1); i <= std::min(width - 1, x + 1); ++i)
            if (marks[std::size_t(j) * std::size_t(width) + std::size_t(i)]) return true;
    return false;
}

} // namespace

std::vector<Pixel> object_pixels(std::span<const ProbedScene> scenes, const ProbeOptions& options, int rays_per_edge) {
    const int width = options.settings.width, height = options.settings.height;
    if (width <= 0 || height <= 0) return {};
    std::vector<std::uint8_t> marks(std::size_t(width) * std::size_t(height));
    for (const ProbedScene& scene : scenes)
        if (scene.of_object.empty()) std::fill(marks.begin(), marks.end(), std::uint8_t(1));
        else mark(scene, options, rays_per_edge, marks);
    // The number that a pixel is sorted by is another purpose than its samples, so it has a seed of its own.
    const std::uint64_t key = hash(std::uint64_t(2) << 32 | options.seed);
    std::vector<std::pair<std::uint64_t, Pixel>> order;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            if (is_near(marks, width, height, x, y))
                order.push_back({hash((std::uint64_t(y) << 32 | std::uint64_t(x)) ^ key), {x, y}});
    // hash() maps different numbers to different ones, so no two pixels tie.
    std::sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<Pixel> pixels;
    pixels.reserve(order.size());
    for (const auto& [number, pixel] : order) pixels.push_back(pixel);
    return pixels;
}

} // namespace bake
