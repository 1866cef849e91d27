// A plan as a page: the pictures in the viewer of reports, and the decisions as tables that need no script.
#pragma once
#include "bake/verdict/plan/manifest.h"
#include "bake/verdict/plan/plan.h"
#include "bake/verdict/report/report_page.h"

namespace bake {

struct PlanPageText {
    std::string scene;   ///< the file
    std::string command; ///< the command line that makes the page
    Manifest manifest;   ///< the bakes that the models need
    std::string folder;  ///< of the manifest, in which its commands run
};

/// For page_of(). A plan without pictures gives a page without a viewer.
PageParts plan_page(const ScenePlan& plan, const PlanPageText& text);

/// Rows of the page, HTML. Names from files are escaped.
std::string decision_table(const ScenePlan& plan);
/// A chart per object; of more than 12 objects in an element that is opened by a click.
std::string rung_charts(const ScenePlan& plan);
/// Textures, sky and lights.
std::string part_table(const ScenePlan& plan);
std::string verification_table(const ScenePlan& plan);

} // namespace bake
