#include "bake/verdict/compare/silhouette.h"
#include "bake/base/parallel.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace bake {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Squared distances along a row of values: out[x] = min over k of (x - k)^2 + in[k], by the lower envelope of parabolas
/// (Felzenszwalb and Huttenlocher, Distance Transforms of Sampled Functions, Theory of Computing 8, 2012).
void nearest_along(std::span<const double> in, std::span<double> out, std::vector<int>& vertex,
                   std::vector<double>& from) {
    const int count = int(in.size());
    vertex.assign(std::size_t(count), 0);
    from.assign(std::size_t(count) + 1, infinite);
    int last = -1; // of the parabolas in the envelope
    for (int k = 0; k < count; ++k) {
        if (std::isinf(in[std::size_t(k)])) continue;
        double start = -infinite;
        while (last >= 0) {
            const int v = vertex[std::size_t(last)];
            start = ((in[std::size_t(k)] + double(k) * k) - (in[std::size_t(v)] + double(v) * v)) / (2.0 * (k - v));
            if (start > from[std::size_t(last)]) break;
            --last;
            start = -infinite;
        }
        ++last;
        vertex[std::size_t(last)] = k;
        from[std::size_t(last)] = start;
        from[std::size_t(last) + 1] = infinite;
    }
    for (int x = 0, i = 0; x < count; ++x) {
        if (last < 0) {
            out[std::size_t(x)] = infinite;
            continue;
        }
        while (from[std::size_t(i) + 1] < x) ++i;
        const int v = vertex[std::size_t(i)];
        out[std::size_t(x)] = double(x - v) * (x - v) + in[std::size_t(v)];
    }
}

bool on_outline(const ObjectMask& mask, int x, int y) noexcept {
    if (!mask.at(x, y)) return false;
    return (x > 0 && !mask.at(x - 1, y)) || (x + 1 < mask.width && !mask.at(x + 1, y)) ||
           (y > 0 && !mask.at(x, y - 1)) || (y + 1 < mask.height && !mask.at(x, y + 1));
}

struct Outline {
    std::vector<std::array<int, 2>> points;
    std::vector<double> squared_distance; ///< of each ray of the mask to the nearest point
};

Outline outline_of(const ObjectMask& mask) {
    Outline outline;
    const int width = mask.width, height = mask.height;
    std::vector<double> columns(std::size_t(width) * std::size_t(height), infinite);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            if (on_outline(mask, x, y)) {
                outline.points.push_back({x, y});
                columns[std::size_t(x) * std::size_t(height) + std::size_t(y)] = 0; // transposed
            }
    std::vector<double> rows(columns.size());
    for_rows(width, 16, [&](std::int64_t begin, std::int64_t end) {
        std::vector<int> vertex;
        std::vector<double> from, out(std::size_t(height), 0.0);
        for (std::int64_t x = begin; x < end; ++x) {
            const std::span<const double> in(columns.data() + x * height, std::size_t(height));
            nearest_along(in, out, vertex, from);
            for (int y = 0; y < height; ++y)
                rows[std::size_t(y) * std::size_t(width) + std::size_t(x)] = out[std::size_t(y)];
        }
    });
    outline.squared_distance.resize(rows.size());
    for_rows(height, 16, [&](std::int64_t begin, std::int64_t end) {
        std::vector<int> vertex;
        std::vector<double> from;
        for (std::int64_t y = begin; y < end; ++y)
            nearest_along({rows.data() + y * width, std::size_t(width)},
                          {outline.squared_distance.data() + y * width, std::size_t(width)}, vertex, from);
    });
    return outline;
}

/// Sets the bits of a row of rays.
void trace_row(const Scene& scene, const CameraFrame& frame, const std::vector<std::uint8_t>& of_object, int y,
               ObjectMask& mask) {
    std::array<Ray, packet_size> rays;
    std::array<Hit, packet_size> hits;
    const double step = 1.0 / mask.factor;
    const RenderSettings& settings = scene.settings;
    for (int x = 0; x < mask.width; x += packet_size) {
        const int count = std::min(packet_size, mask.width - x);
        const PacketMask active = count == 32 ? ~PacketMask(0) : (PacketMask(1) << count) - 1;
        for (int i = 0; i < count; ++i)
            rays[std::size_t(i)] =
                primary_ray(frame, (x + i + 0.5) * step, (y + 0.5) * step, settings.width, settings.height);
        scene.bvh->intersect(rays, active, hits);
        for (int i = 0; i < count; ++i) {
            const Hit& hit = hits[std::size_t(i)];
            mask.inside[std::size_t(y) * std::size_t(mask.width) + std::size_t(x + i)] = hit && of_object[hit.mesh];
        }
    }
}

} // namespace

ObjectMask object_mask(const Scene& scene, const std::vector<std::uint8_t>& of_object, int factor) {
    ObjectMask mask{.factor = factor,
                    .width = scene.settings.width * factor,
                    .height = scene.settings.height * factor,
                    .inside = {}};
    mask.inside.resize(std::size_t(mask.width) * std::size_t(mask.height));
    const CameraFrame frame = camera_frame(scene);
    for_rows(mask.height, 8, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t y = begin; y < end; ++y) trace_row(scene, frame, of_object, int(y), mask);
    });
    return mask;
}

std::vector<std::uint8_t> pixels_of_either(const ObjectMask& a, const ObjectMask& b) {
    const int width = a.width / a.factor, height = a.height / a.factor;
    std::vector<std::uint8_t> pixels(std::size_t(width) * std::size_t(height));
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x)
            if (a.at(x, y) || b.at(x, y))
                pixels[std::size_t(y / a.factor) * std::size_t(width) + std::size_t(x / a.factor)] = 1;
    return pixels;
}

OutlineError outline_error(const ObjectMask& a, const ObjectMask& b) {
    const Outline first = outline_of(a), second = outline_of(b);
    if (first.points.empty() && second.points.empty()) return {};
    if (first.points.empty() || second.points.empty()) return {.known = false};
    double sum = 0, largest = 0;
    const auto measure = [&](const Outline& from, const Outline& to) {
        for (const auto& [x, y] : from.points) {
            const double distance =
                std::sqrt(to.squared_distance[std::size_t(y) * std::size_t(a.width) + std::size_t(x)]);
            sum += distance, largest = std::max(largest, distance);
        }
    };
    measure(first, second);
    measure(second, first);
    const double count = double(first.points.size() + second.points.size());
    return {.mean = sum / count / a.factor, .max = largest / a.factor};
}

} // namespace bake
