// The sky as a scene sees it from a point: six faces.
#pragma once
#include "bake/environment/sky/cube.h"
#include "bake/preview/tracer.h"

namespace bake {

/// Radiance of a built scene seen from `position` (world space), `settings.spp` samples per texel of its square,
/// `settings.bounces` mirror reflections; three channels, texel-centred, in cube space (world_to_cube). The scene's
/// camera is not used. Every value is finite. Same bytes for any number of threads. Throws Error{Refusal::usage} when
/// the position is not finite or the size not in [1, 32768].
Cube capture(const Scene& scene, const Vec3f& position, int size, RenderStats* stats = nullptr,
             Progress* progress = nullptr);

} // namespace bake
