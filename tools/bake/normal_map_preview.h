// bake normal-map --preview: a picture of the map, lit, beside the file.
#pragma once
#include "inputs/stopwatch.h"
#include "normal_map_options.h"

namespace bake {

/// Adds --preview and --preview-size.
void add_preview_options(CLI::App& sub, NormalMapArgs& args);
/// Throws Error{Refusal::usage} for a picture that cannot be written and for maps that it cannot show; after complete().
void check_preview(const NormalMapArgs& args);
/// Renders the map under --preview, as its file stores it: on the mesh that it is for, or on a rectangle. `depth`: as
/// resolve_map_depth() gives it. `extent`: of the rectangle, where there is no mesh.
void write_preview(const NormalMapArgs& args, const Image<float>& map, Depth depth, Stopwatch& watch,
                   const Vec2d& extent = Vec2d(1));
/// A line for the result.
std::string preview_text(const NormalMapArgs& args);

} // namespace bake
