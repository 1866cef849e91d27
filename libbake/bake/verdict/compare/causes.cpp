#include "bake/verdict/compare/causes.h"
#include "bake/base/parallel.h"
#include "bake/base/progress.h"
#include <bit>
#include <cmath>

namespace bake {
namespace {

/// Sums of squared differences from the method's picture.
struct Errors {
    std::array<double, 1u << cause_count> sum{};
    std::int64_t pixels = 0;

    void add(const HybridSums& pixel) noexcept {
        ++pixels;
        const auto& [a, b] = pixel.half;
        for (std::size_t on = 0; on < sum.size(); ++on) sum[on] += glm::dot(a[on] - a[0], b[on] - b[0]);
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
    std::vector<Errors> parts(groups.size());
    if (progress) progress->start("causes", std::int64_t(groups.size()));
    for_rows(
        std::int64_t(groups.size()), 1,
        [&](std::int64_t begin, std::int64_t end) {
            for (auto i = begin; i < end; ++i)
                for (const HybridSums& pixel : tracer.sums(groups[std::size_t(i)]))
                    if (pixel.object) parts[std::size_t(i)].add(pixel);
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
    const double per_sample = std::exp2(double(options.exposure)) / tracer.samples_per_half();
    for (double& error : all.sum) error *= per_sample * per_sample / (3.0 * double(all.pixels));
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
