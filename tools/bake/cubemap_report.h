// What bake cubemap tells of a run.
#pragma once
#include "cubemap_options.h"
#include <nlohmann/json.hpp>

namespace bake {

/// Notes on the input: how it was read, and seams that are open.
std::vector<std::string> input_notes(const CubemapArgs& args, const EnvironmentReport& report);
/// Notes on the input and the output.
std::vector<std::string> cubemap_notes(const CubemapArgs& args, const EnvironmentReport& report,
                                       const EnvironmentWritten& written);
nlohmann::json cubemap_json(const CubemapArgs& args, const EnvironmentReport& report, const EnvironmentWritten& written,
                            int channels);
/// Adds the naming and the orientation of six faces; nothing for other inputs.
void add_orientation(const EnvironmentReport& report, nlohmann::json& json);
/// ", seam ratio 0.85", or nothing when the input is not six faces.
std::string seam_text(const EnvironmentReport& report);

} // namespace bake
