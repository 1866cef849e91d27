// What the verb normal-map prints.
#pragma once
#include "bake/relief/map/bake_budget.h"
#include "bake/relief/map/method_error.h"
#include "normal_map_file.h"

namespace bake {

struct NormalMapResult {
    NormalMapOptions options;
    Image<float> map;
    NormalMapReport report;
    ErrorBudget budget;
    std::optional<FilterAdvice> advice;
    MethodError method_error;
    std::optional<StoredNormalMap> stored; ///< a texture
    double tilt_deg = 0;                   ///< of the normal, by one level of the height
    Filter filter = Filter::central;
    GltfMap asset_map;              ///< of a glTF file
    std::vector<std::string> notes; ///< doubts about the height
    std::string shared_map;         ///< a note on materials that overlap in the uvs
};

/// Notes how the map was stored. Where it is in blocks, the budget's term for the encoding becomes the measured one.
void set_stored(NormalMapResult& result, std::optional<StoredNormalMap> stored);
std::string to_text(const NormalMapArgs& args, const HeightTexture& height, const NormalMapResult& result);
nlohmann::json to_json(const NormalMapArgs& args, const HeightTexture& height, const NormalMapResult& result);
/// Notes on faces and texels that were not baked as they are.
void warn(const CommonArgs& common, const NormalMapArgs& args, const NormalMapReport& report);

} // namespace bake
