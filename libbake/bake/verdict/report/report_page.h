// The report of a comparison as one HTML file, which needs no network and no other file. docs/report.md describes the page.
#pragma once
#include "bake/verdict/report/stored_pictures.h"
#include <string>
#include <vector>

namespace bake {

/// Throws Error{Refusal::unsuitable} if bake was built without esbuild. To be called before anything is rendered.
void require_report_page();

/// The page for the JSON of `bake compare SCENE --json`, any part of which may be missing, and the pictures, the reference
/// first; they are joined to the rows of the JSON by the names of the methods. Throws as require_report_page() and
/// encode_webp().
std::string report_page(const std::string& json, const std::vector<ReportPicture>& pictures);

} // namespace bake
