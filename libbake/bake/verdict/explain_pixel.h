// The whole shading of one pixel of a rendered picture: what its ray hits, what each light adds, and the value in the file.
#pragma once
#include "bake/preview/scene.h"
#include "bake/verdict/explain.h"

namespace bake {

/// Pixel (x, y) of the picture that render() makes of a built scene, from the upper left corner. Geometry and material
/// are those of the first sample that hits a mesh; light is the mean over all samples, as in the picture. `radiance` is
/// the very value of the picture. `exposure` is in stops, and `automatic` says where it comes from.
std::vector<RouteStep> explain_pixel(const Scene& scene, int x, int y, float exposure, bool automatic);

} // namespace bake
