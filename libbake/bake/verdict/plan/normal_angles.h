// The mean angle between shading normals of two scenes over an object.
#pragma once
#include "bake/verdict/plan/pixel_probe.h"

namespace bake {

/// The square of the mean angle in degrees between the mean shading normals of the pixels in which a ray hits the object in
/// both scenes, which see it by the same rays. The first few thousand pixels are looked at; the error of the estimate is from
/// the differences between them, and 0 if these are all. 0 where no pixel shows the object in both.
SquareEstimate mean_angle(const ProbedScene& candidate, const ProbedScene& reference, std::span<const Pixel> pixels,
                          const ProbeOptions& options);

} // namespace bake
