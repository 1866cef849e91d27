#include "bake/verdict/compare/causes.h"
#include "bake/base/parallel.h"
#include "bake/base/progress.h"
#include <bit>
#include <cmath>
#include <glm/common.hpp>

namespace bake {
namespace {

/// Sums of squared differences from the method's picture.
struct Errors {
    std::array<double, 1u << cause_count> sum{};
    std::int64_t pixels = 0;

    /// `scale`: from sums to what is shown.
    void add(const HybridSums& pixel, double scale) noexcept {
        ++pixels;
        const auto shown = [&](const Vec3d& radiance) { return glm::clamp(scale * radiance, 0.0, 1.0); };
        const auto& [a, b] = pixel.half;
        const Vec3d method_a = shown(a[0]), method_b = shown(b[0]);
        for (std::size_t on = 0; on < sum.size(); ++on)
            sum[on] += glm::dot(shown(a[on]) - method_a, shown(b[on]) - method_b);
    }
};

/// From left to right in every row.
std::vector<PixelGroup> pixel_groups(const RenderSettings& settings, int stride) {
    const int edge = block_edge * stride;
    std::vector<PixelGroup> groups;
    for (int y = 0; y < settings.height; y += edge)
        for (int x = 0; x < settings.width; x += edge)
            groups.push_back(pixel_group(settings, x / stride, y / stride, stride));
    return groups;
}

} // namespace

std::array<double, cause_count> shapley_values(const std::array<double, 1u << cause_count>& value) noexcept {
    // Of the 5! orders, |S|! (4 - |S|)! have exactly S before a given cause.
    constexpr double share_of_orders[] = {24 / 120.0, 6 / 120.0, 4 / 120.0, 6 / 120.0, 24 / 120.0};
    std::array<double, cause_count> share{};
    for (int cause = 0; cause < cause_count; ++cause)
        for (CauseSet on = 0; on <= all_causes; ++on)
            if (!(on >> cause & 1))
                share[std::size_t(cause)] += share_of_orders[std::popcount(on)] * (value[on | 1u << cause] - value[on]);
    return share;
}

CauseShares cause_shares(const CauseScenes& scenes, const CauseOptions& options, Progress* progress) {
    const HybridTracer tracer(scenes, options.settings);
    const std::vector<PixelGroup> groups = pixel_groups(options.settings, std::max(1, options.stride));
    const double scale = std::exp2(double(options.exposure)) / tracer.samples_per_half();
    std::vector<Errors> parts(groups.size());
    if (progress) progress->start("causes", std::int64_t(groups.size()));
    for_rows(
        std::int64_t(groups.size()), 1,
        [&](std::int64_t begin, std::int64_t end) {
            for (auto i = begin; i < end; ++i)
                for (const HybridSums& pixel : tracer.sums(groups[std::size_t(i)]))
                    if (pixel.object) parts[std::size_t(i)].add(pixel, scale);
        },
        progress);

    Errors all;
    for (const Errors& part : parts) {
        all.pixels += part.pixels;
        for (std::size_t on = 0; on < all.sum.size(); ++on) all.sum[on] += part.sum[on];
    }
    CauseShares result;
    result.pixels = all.pixels;
    if (all.pixels == 0) return result;
    for (double& error : all.sum) error /= 3.0 * double(all.pixels);
    const auto share = shapley_values(all.sum);
    result.silhouette = share[0], result.self_shadow = share[1], result.parallax = share[2];
    result.normal = share[3], result.filtering = share[4];
    result.total = result.interaction = all.sum[all_causes];
    for (int cause = 0; cause < cause_count; ++cause) {
        result.alone[std::size_t(cause)] = all.sum[1u << cause];
        result.interaction -= all.sum[1u << cause];
    }
    return result;
}

} // namespace bake
