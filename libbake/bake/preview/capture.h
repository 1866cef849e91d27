// Renders six cube faces that show a scene from a point.
#pragma once
#include "bake/environment/sky/cube.h"
#include "bake/preview/tracer.h"

namespace bake {

class Progress;

/// Radiance of a built scene seen from `position` (world space), with `settings.spp` samples per texel and
/// `settings.bounces` mirror reflections: three channels, texel-centred, in cube space (world_to_cube). The scene's
/// camera is not used. Every value is finite. The result does not depend on the number of threads. Throws
/// Error{Refusal::usage} when the position is not finite or the size not in [1, 32768].
Cube capture(const Scene& scene, const Vec3f& position, int size, RenderStats* stats = nullptr,
             Progress* progress = nullptr);

} // namespace bake
