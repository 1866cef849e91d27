// Lines on a displaced surface: how finely chords must follow them.
#pragma once
#include "bake/relief/displace/error.h"

namespace bake {

/// The displaced surface along a straight line of a patch, at k / count.
std::vector<Vec3d> along(DisplacedPatch& patch, std::uint32_t number, const Vec2d& from, const Vec2d& to,
                         std::uint32_t count);

/// Texels of the height that a line of a patch crosses.
double texels_along(DisplacedPatch& patch, std::uint32_t number, const Vec2d& from, const Vec2d& to);

/// The fewest segments, at even parameters, whose chords stay within `error` of the samples: tried out while samples are
/// denser than segments, then from their second differences.
std::uint32_t rate_within(std::span<const Vec3d> curve, double error, std::uint32_t most) noexcept;

} // namespace bake
