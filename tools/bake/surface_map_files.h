// The map files of bake surface: PREFIX_normal.exr and so on.
#pragma once
#include "bake/picture/image_io.h"
#include "bake/surface/patch/surface_map.h"
#include <memory>

namespace bake {

/// Map names separated by commas, each at most once. Throws Error{Refusal::usage}.
std::vector<MapQuantity> parse_maps(const std::string& text);

std::string map_file(const std::string& prefix, MapQuantity quantity);

/// One writer per quantity. The files are opened before the work, so that a long bake does not fail at its end.
std::vector<std::unique_ptr<ImageWriter>> open_maps(const std::string& prefix,
                                                    const std::vector<MapQuantity>& quantities,
                                                    const SurfaceMapOptions& options);
void write_maps(std::vector<std::unique_ptr<ImageWriter>>& writers, const std::vector<Image<float>>& maps);

} // namespace bake
