// Options of bake surface.
#pragma once
#include "bake/surface/patch/surface_map.h"
#include "inputs/surface_input.h"

namespace bake {

struct SurfaceArgs {
    SurfaceInput surface;
    std::string out, resolution, maps, maps_out, size = "1024";
    int padding = SurfaceMapOptions{}.padding, tile = 0;
};

void add_surface_options(CLI::App& sub, SurfaceArgs& args);
/// Throws Error{Refusal::usage} for everything that can be refused before a file is read.
void check_usage(const SurfaceArgs& args);
/// "NxM", or N for both. Throws Error{Refusal::usage}.
std::pair<int, int> parse_resolution(const std::string& text);

} // namespace bake
