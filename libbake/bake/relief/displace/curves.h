// Lines on a displaced surface, and how many chords approximate them.
#pragma once
#include "bake/relief/displace/error.h"

namespace bake {

/// The displaced surface along a straight line of a patch, at k / count.
std::vector<Vec3d> along(DisplacedPatch& patch, std::uint32_t number, const Vec2d& from, const Vec2d& to,
                         std::uint32_t count);

/// Texels of the height that a line of a patch crosses.
double texels_along(DisplacedPatch& patch, std::uint32_t number, const Vec2d& from, const Vec2d& to);

/// The fewest segments, even in the parameter, whose chords stay within `error` of the samples. Rates up to half the number
/// of samples are tried out; higher ones are estimated from second differences.
std::uint32_t rate_within(std::span<const Vec3d> curve, double error, std::uint32_t most) noexcept;

} // namespace bake
