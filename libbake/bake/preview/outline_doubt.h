// What a scene loses at the outline of an object whose relief is shown by normals alone.
#pragma once
#include "bake/preview/relief_method.h"
#include "bake/preview/scene.h"

namespace bake {

/// Outlines that are off by less, in pixels, do not show.
inline constexpr double smallest_seen_px = 0.5;

/// How far relief along the normals would move the outline of an instance, largest in pixels: the height of the relief there
/// as it is projected (known truth: the silhouette error of every method that does not displace). Along the line of sight
/// the highest point of the relief makes the outline, which is why the highest of each cell of a few pixels counts.
/// The scene is built; 0 for an outline that is not in the picture.
double relief_at_outline_px(const Scene& scene, std::size_t instance, const HeightTexture& height,
                            const HeightOptions& options);

/// One sentence on the largest for the instances with this material; empty if it is at most smallest_seen_px.
std::string outline_doubt(const Scene& scene, const Material& material, const HeightTexture& height,
                          const ReliefOptions& options);

} // namespace bake
