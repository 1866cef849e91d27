// What bake surface reports about a surface and its maps, as text and as JSON.
#pragma once
#include "bake/surface/patch/surface_map.h"
#include "bake/surface/patch/surface_summary.h"
#include "verb.h"

namespace bake {

/// `what` describes the surface in one line, such as "torus; 96 x 48 cells".
std::string to_text(const std::string& what, const SurfaceMesh& mesh, const SurfaceSummary& summary);
std::string to_text(const SurfaceMapReport& report, const SurfaceMapOptions& options);
nlohmann::json to_json(const SurfaceSummary& summary, bool has_uv);
nlohmann::json to_json(const SurfaceMapReport& report);
/// One note for each kind of texel or face that the maps could not show.
void warn(const CommonArgs& common, const std::string& title, const SurfaceMapReport& report);

} // namespace bake
