// Options of bake surface.
#pragma once
#include "bake/surface/patch/surface_map.h"
#include "inputs/surface_input.h"

namespace bake {

/// What the written mesh has beside positions, uvs and what the input has.
struct SurfaceAttributes {
    bool normal = true, tangent = true, curvature = false;
};

struct SurfaceArgs {
    SurfaceInput surface;
    std::string out, maps_out;
    std::vector<MapQuantity> maps; ///< empty: all of them
    std::optional<std::pair<int, int>> resolution;
    std::optional<std::pair<int, int>> size = std::pair(1024, 1024);
    std::optional<SurfaceAttributes> attributes;
    int padding = SurfaceMapOptions{}.padding, tile = 0;
};

void add_surface_options(CLI::App& sub, SurfaceArgs& args);
/// Throws Error{Refusal::usage} for everything that can be refused before a file is read.
void check_usage(const SurfaceArgs& args);

} // namespace bake
