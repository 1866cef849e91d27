// The point of an intersection of half-spaces that is nearest to zero.
#pragma once
#include "bake/base/vec.h"
#include <optional>
#include <span>

namespace bake {

/// All x with a . x <= c; a is a unit vector.
struct HalfSpace {
    Vec3d a;
    double c;
};

/// Nothing if the intersection is empty. `slack`: by how much each side may be exceeded. Tries all sets of up to three sides that the
/// point may lie on, which is meant for few half-spaces.
std::optional<Vec3d> nearest_to_zero(std::span<const HalfSpace> spaces, double slack) noexcept;

} // namespace bake
