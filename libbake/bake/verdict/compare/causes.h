// The share of a method's error by cause: silhouette, self-shadow, parallax, normal, filtering (see hybrids.h).
//
// E(S) is the mean squared difference between the method's picture and the hybrid in which the causes of the set S are as
// in the reference; E of all causes is the error itself. The share of a cause is its Shapley value (Shapley, A Value for
// n-Person Games, 1953): how much E grows when the cause is switched on, averaged over the orders of switching on all five.
// So the shares sum to the error, and causes that act together share alike. A share can be negative: of a cause that hides
// part of another one's error.
#pragma once
#include "bake/verdict/compare/hybrids.h"

namespace bake {

class Progress;

struct CauseOptions {
    RenderSettings
        settings;       ///< of the picture: its size, samples per pixel (rounded up to an even number), seed, bounces
    float exposure = 0; ///< in stops: squared errors are of radiance times 2^exposure
    /// One pixel of every stride x stride is rendered, see pixel_group(); 1: the whole picture. What a pixel shows and filters
    /// is as in the picture.
    int stride = 1;
};

/// Mean squared errors over the three channels and the object's pixels: those in which a sample sees the object in one of
/// the two scenes. Radiance is linear and not clamped, because a clamped mean has no unbiased square from noisy halves. All
/// are products of two independent halves of the samples, and may come out below 0 by noise.
struct CauseShares {
    double silhouette = 0, self_shadow = 0, parallax = 0, normal = 0, filtering = 0; ///< their sum is `total`
    double total = 0;                        ///< the method's error; NaN-free: 0 if no pixel sees the object
    std::array<double, cause_count> alone{}; ///< E of each cause alone, by Cause
    double interaction = 0;                  ///< total less the sum of `alone`
    std::int64_t pixels = 0;                 ///< rendered ones that see the object

    std::array<double, cause_count> shares() const noexcept {
        return {silhouette, self_shadow, parallax, normal, filtering};
    }
};

/// Any number of threads gives the same bytes. Throws the errors of HybridTracer, and Error{Refusal::interrupted} on Ctrl-C.
CauseShares cause_shares(const CauseScenes& scenes, const CauseOptions& options, Progress* progress = nullptr);

/// The Shapley values of a game of five players that is worth `value[S]` to the set S.
std::array<double, cause_count> shapley_values(const std::array<double, 1u << cause_count>& value) noexcept;

} // namespace bake
