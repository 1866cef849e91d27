// A report with pictures as one HTML file, which needs no network and no other file. docs/report.md describes the page.
#pragma once
#include "bake/verdict/report/stored_pictures.h"
#include <string>
#include <vector>

namespace bake {

/// Throws Error{Refusal::unsuitable} if bake was built without esbuild. To be called before anything is rendered.
void require_report_page();

/// A part of the page below the viewer, which is read without a script.
struct PageSection {
    std::string id, title; ///< of the element, as HTML
    std::string html;      ///< empty: the section is left out
};

struct PageParts {
    std::string title;                 ///< of the window, as text
    std::string heading, facts;        ///< HTML, the facts as page_fact() makes them
    std::vector<PageSection> sections; ///< in their order
    /// JSON of what the viewer shows. Of one camera it has "exposure", "reference" and "methods" as the JSON of `bake
    /// compare SCENE --json`; of several "exposure" and the list "views", each with "camera", "reference" and "methods".
    std::string data;
    std::vector<ReportPicture> pictures; ///< of each view the reference first; joined to the rows by name
};

/// Throws as require_report_page() and encode_webp().
std::string page_of(const PageParts& parts);

/// The page for the JSON of `bake compare SCENE --json`, any part of which may be missing, and the pictures, the reference
/// first; they are joined to the rows of the JSON by the names of the methods. Throws as require_report_page() and
/// encode_webp().
std::string report_page(const std::string& json, std::vector<ReportPicture> pictures);

} // namespace bake
