// Renders pictures of a scene: radiance, and beside it what the camera's rays hit.
#pragma once
#include "bake/preview/tracer.h"
#include <string>
#include <vector>

namespace bake {

class Progress;

/// The channels of render_layers(), with the names of OpenEXR files that compositing programs expect:
///   R G B A              mean radiance; share of the samples that hit a mesh
///   emission diffuse specular reflection   the parts of R, G, B, as in Radiance
///   albedo N Ng          means of the diffuse reflectance and of the shading and facet normals, in world space
///   Z P uv id.object id.triangle   of the first sample: distance from the camera, position, uv, numbers from 1 (0: no mesh)
///   lit repaired rays    share of lights that are not shadowed, of samples whose relief is in trouble, rays per sample
const std::vector<std::string>& layer_channels();

/// Mean radiance per pixel of a built scene, three channels; of settings.part alone, if given. All values are finite. The
/// result does not depend on the number of threads.
Image<float> render(const Scene& scene, const RenderSettings& settings, RenderStats* stats = nullptr,
                    Progress* progress = nullptr);
/// The same with the channels of layer_channels(). A mean beyond the range of floats is 0.
Image<float> render_layers(const Scene& scene, const RenderSettings& settings, RenderStats* stats = nullptr,
                           Progress* progress = nullptr);

} // namespace bake
