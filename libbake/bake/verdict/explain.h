// One texel's journey from height file to shaded pixel, every number printed (docs/route.md tells it in words).
#pragma once
#include "bake/relief/map/normal_map.h"
#include <string>
#include <vector>

namespace bake {

/// A named result of one step: numbers, or words.
struct RouteEntry {
    std::string name;
    std::vector<double> values;
    std::string words;
};

/// One step of the route, named after the module that takes it.
struct RouteStep {
    std::string title;
    std::vector<RouteEntry> entries;
};

struct ExplainInput {
    std::string mesh_path, height_path;
    const Mesh* mesh = nullptr;
    const HeightTexture* height = nullptr;
    NormalMapOptions options;
    Vec2d uv{0.5}; ///< in the unit square
};

/// The steps of the texel of the map that uv lies in: the numbers are those of the bake itself (float), the comparison of
/// the methods is in double. Ends early, saying why, where no face lies under the texel.
std::vector<RouteStep> explain(const ExplainInput& input);

/// Aligned lines, six significant digits.
std::string to_text(const std::vector<RouteStep>& route);
/// One JSON object: step, name, values.
std::string to_json(const std::vector<RouteStep>& route);

} // namespace bake
