#include "bake/verdict/plan/error_meter.h"
#include "bake/verdict/plan/flip_tiles.h"
#include "bake/verdict/plan/normal_angles.h"
#include <algorithm>
#include <chrono>
#include <utility>

namespace bake {
namespace {

constexpr int flip_half = 16;  ///< samples of each half of a pixel, for a budget
constexpr int shown_half = 4;  ///< for a value that is only told
constexpr int shown_tiles = 4; ///< likewise
constexpr std::size_t timed_pixels = 512;

} // namespace

ErrorMeter::ErrorMeter(Budget::Metric metric, const ProbedScene& reference, std::vector<Pixel> pixels,
                       const ProbeOptions& options)
    : metric_(metric), reference_(reference), options_(options), probe_(reference, std::move(pixels), options) {}

SquareEstimate ErrorMeter::estimate(const ProbedScene& candidate) const {
    if (metric_ == Budget::Metric::degrees) return mean_angle(candidate, reference_, probe_.pixels(), options_);
    return tile_flip(candidate, reference_, probe_.pixels(), options_, {.half = flip_half});
}

ReferenceProbe::Result ErrorMeter::judge(const ProbedScene& candidate, double budget, double reference_error,
                                         bool can_be_finer) {
    if (metric_ == Budget::Metric::rmse)
        return probe_.judge(candidate, budget, reference_error, {.until_reference = can_be_finer});
    const SquareEstimate found = estimate(candidate);
    return {found, bake::judge(found, budget, reference_error)};
}

SquareEstimate ErrorMeter::measure(const ProbedScene& candidate, int pixels) {
    return metric_ == Budget::Metric::rmse ? probe_.measure(candidate, pixels) : estimate(candidate);
}

double ErrorMeter::flip(const ProbedScene& candidate) {
    return tile_flip(candidate, reference_, probe_.pixels(), options_, {.tiles = shown_tiles, .half = shown_half})
        .rmse();
}

double ErrorMeter::ms(const ProbedScene& candidate) const {
    using Clock = std::chrono::steady_clock;
    const std::span<const Pixel> pixels(probe_.pixels().data(), std::min(probe_.pixels().size(), timed_pixels));
    if (pixels.empty()) return 0;
    const Clock::time_point start = Clock::now();
    probe_pixels(candidate, pixels, options_);
    const double ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    return ms * 1e6 / (2.0 * options_.half * double(pixels.size()));
}

} // namespace bake
