// What the verb normal-map prints.
#pragma once
#include "bake/relief/map/bake_budget.h"
#include "normal_map_options.h"

namespace bake {

struct NormalMapResult {
    Image<float> map;
    NormalMapReport report;
    ErrorBudget budget;
    std::optional<FilterAdvice> advice;
    double tilt_deg = 0;
    std::vector<std::string> notes; ///< doubts about the height
    Filter filter = Filter::central;
    std::vector<std::string> mesh_notes; ///< of reading the mesh
};

/// The result as text or as one JSON object.
void print(const NormalMapArgs& args, const HeightTexture& height, const NormalMapResult& result,
           const NormalMapOptions& options, const Stopwatch& watch, bool json);
/// Notes on faces and texels that were not baked as they are.
void warn(const CommonArgs& common, const NormalMapArgs& args, const NormalMapReport& report);

} // namespace bake
