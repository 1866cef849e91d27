// All intermediate results of a bake for one texel, from the height file to the shaded pixel (docs/route.md).
#pragma once
#include "bake/relief/map/normal_map.h"
#include <string>
#include <vector>

namespace bake {

/// A named result of one step, as numbers, words or both.
struct RouteEntry {
    std::string name;
    std::vector<double> values;
    std::string words;
};

/// One step of the bake.
struct RouteStep {
    std::string title; ///< starts with the name of the module
    std::vector<RouteEntry> entries;
};

struct ExplainInput {
    std::string mesh_path, height_path;
    const Mesh* mesh = nullptr;
    const HeightTexture* height = nullptr;
    NormalMapOptions options;
    Vec2d uv{0.5}; ///< in the unit square
};

/// The steps for the texel of the map that contains uv. The numbers are those of the bake, in float; methods are compared in
/// double. If no face covers the texel, the last step says so.
std::vector<RouteStep> explain(const ExplainInput& input);

/// Aligned lines, six significant digits.
std::string to_text(const std::vector<RouteStep>& route);
/// One JSON object.
std::string to_json(const std::vector<RouteStep>& route);

} // namespace bake
