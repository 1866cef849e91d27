// What a comparison renders where it is not told: methods, and the displacement that the reference begins with.
#pragma once
#include "bake/preview/scene_entries.h"
#include <cstdint>
#include <span>
#include <vector>

namespace bake {

inline constexpr int most_displacement_levels = 10;
/// A reference does not begin with more triangles, unless a method has as many.
inline constexpr double most_first_triangles = 4e6;

/// Methods without displacement, a coarse and a fine displacement, the coarse one also with a residual normal map: for an
/// object of this many triangles.
std::vector<ShadeMethod> default_methods(std::int64_t triangles);

/// Levels of the first reference of an object of this many triangles: it has edges a quarter as long as those of the finest
/// displacement that is judged, or half as long where a quarter is more than most_first_triangles, and at least 200000
/// triangles. At most most_displacement_levels.
int first_reference_levels(std::int64_t triangles, std::span<const ShadeMethod> methods);

} // namespace bake
