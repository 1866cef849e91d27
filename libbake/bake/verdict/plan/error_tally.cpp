#include "bake/verdict/plan/error_tally.h"
#include <algorithm>

namespace bake {
namespace {

/// Neither picture shows the object.
bool is_unseen(const SquareEstimate& estimate) noexcept { return estimate.all && estimate.pixels == 0; }

/// Nothing but equal pictures is within a budget of 0: an estimate without any noise, and a perfect reference.
bool is_nothing(const SquareEstimate& estimate, double reference_error) noexcept {
    return estimate.square == 0 && estimate.error == 0 && reference_error == 0;
}

} // namespace

void ErrorTally::add(const PixelSquare& pixel) noexcept {
    if (!(pixel.a > 0)) return;
    m_ += pixel.m, a_ += pixel.a;
    mm_ += pixel.m * pixel.m, ma_ += pixel.m * pixel.a, aa_ += pixel.a * pixel.a;
    v_ += pixel.v;
    largest_ = std::max(largest_, std::abs(pixel.m)), largest_v_ = std::max(largest_v_, pixel.v);
    ++pixels_;
}

SquareEstimate ErrorTally::estimate(double visited) const noexcept {
    SquareEstimate estimate;
    estimate.pixels = pixels_;
    if (!(a_ > 0)) return estimate;
    const double r = m_ / a_;
    // The sum of (m - r a)^2; rounding may bring it below 0.
    const double squares = std::max(0.0, mm_ - 2 * r * ma_ + r * r * aa_);
    estimate.square = r;
    const double of_pixels = squares + largest_ * largest_, of_samples = v_ + largest_v_;
    estimate.error = std::sqrt((1 - visited) * of_pixels + visited * of_samples) / a_;
    return estimate;
}

Settled judge(const SquareEstimate& estimate, double budget, double reference_error,
              const StoppingRule& rule) noexcept {
    if (std::isinf(budget) || is_unseen(estimate)) return Settled::within;
    const double low = estimate.low() - reference_error, high = estimate.high() + reference_error;
    if (low > 0 && low >= rule.fail_at * budget) return Settled::over;
    if (estimate.pixels < rule.pass_from && !estimate.all) return Settled::open;
    const bool within = budget > 0 ? high <= rule.pass_at * budget : is_nothing(estimate, reference_error);
    return within ? Settled::within : Settled::open;
}

bool acceptable(const SquareEstimate& estimate, double budget, double reference_error,
                const StoppingRule& rule) noexcept {
    if (std::isinf(budget) || is_unseen(estimate)) return true;
    if (!(budget > 0)) return is_nothing(estimate, reference_error);
    const double most = rule.pass_at * budget;
    return std::fmax(0.0, estimate.square + estimate.error) + reference_error * reference_error <= most * most;
}

} // namespace bake
