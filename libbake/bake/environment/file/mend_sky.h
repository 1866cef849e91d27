// The one policy for values that cannot be radiance, for every reader of a sky:
//
//   NaN, infinite                                      refused, or replaced as BadPolicy says
//   negative, together at least 1e-3 of the sky's flux  likewise
//   negative, together less                            replaced by 0, channel by channel, and reported: filters that ring
//                                                      and conversions between colour spaces leave such values
#pragma once
#include "bake/environment/file/radiance.h"
#include "bake/environment/sky/environment.h"
#include <array>
#include <string>

namespace bake {

/// Negative values below this share of the sky's flux are replaced by 0.
inline constexpr double tolerated_negative_share = 1e-3;

/// Values that mend_sky replaced.
struct SkyFaults {
    BadTexels bad;             ///< by the policy; x, y of the first file with any
    std::int64_t negative = 0; ///< texels with negative values that were replaced by 0 because their share is small
    double negative_share = 0; ///< flux of all negative values over that of the positive ones, both over solid angle
};

/// Applies the policy. `files`: of the six faces; of a picture the first. Alpha may be negative. Throws
/// Error{Refusal::unsuitable} naming the first file with a fault that the policy refuses.
SkyFaults mend_sky(Environment& sky, const std::array<std::string, 6>& files, BadPolicy policy, int alpha_channel = -1);

} // namespace bake
