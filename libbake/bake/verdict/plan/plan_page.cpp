#include "bake/verdict/plan/plan_page.h"
#include "bake/base/text.h"
#include "bake/verdict/chart/svg.h"
#include "bake/verdict/compare/picture_errors.h"
#include "bake/verdict/plan/plan_words.h"
#include "bake/verdict/report/page_tables.h"
#include <algorithm>
#include <nlohmann/json.hpp>

namespace bake {
namespace {

using Json = nlohmann::ordered_json;
using Shows = PlanPicture::Shows;

const char* name(const ScenePlan& plan, Shows shows) {
    const bool displaced = std::all_of(plan.objects.begin(), plan.objects.end(),
                                       [](const ObjectPlan& object) { return object.high.empty(); });
    if (shows == Shows::reference)
        return plan.objects.empty() ? "as it is" : displaced ? "displaced in full" : "in full";
    return shows == Shows::planned ? "planned" : "everything bumped";
}

Json json_of(const FrameErrors& errors) {
    const ErrorSummary& flip = errors.flip_summary;
    const PixelRect& worst = errors.worst;
    return {{"frame",
             {{"flip", {{"mean", flip.mean}, {"p95", flip.p95}, {"p99", flip.p99}}},
              {"rmse", {{"value", errors.rmse.value}, {"error", errors.rmse.error}}}}},
            {"worst", {{"x", worst.x}, {"y", worst.y}, {"width", worst.width}, {"height", worst.height}}}};
}

/// The rows and the pictures of the viewer.
struct Views {
    Json json = Json::array();
    std::vector<ReportPicture> pictures;
};

Views views_of(const ScenePlan& plan) {
    Views views;
    const Halves* reference = nullptr;
    for (const PlanPicture& one : plan.pictures) {
        const std::string shows = name(plan, one.shows);
        ReportPicture picture{shows, mean_picture(one.halves), {}, int(one.camera)};
        if (one.shows == Shows::reference) {
            reference = &one.halves;
            views.json.push_back(
                {{"camera", plan.cameras[one.camera]}, {"reference", {{"method", shows}}}, {"methods", Json::array()}});
        } else {
            FrameErrors errors = frame_errors(*reference, one.halves, {.exposure = plan.exposure, .flip = {}});
            Json row = {{"method", shows}};
            row.update(json_of(errors));
            views.json.back()["methods"].push_back(std::move(row));
            picture.errors = std::move(errors.flip);
        }
        views.pictures.push_back(std::move(picture));
    }
    return views;
}

std::string picture_tables(const Json& views) {
    std::string out;
    for (std::size_t k = 0; k < views.size(); ++k) {
        const std::string camera = text_or(views[k], "camera", "");
        out += format("<div data-view=\"%d\">", int(k)) +
               (camera.empty() || views.size() < 2 ? "" : "<h3>" + xml_text(camera) + "</h3>\n") +
               error_tables(views[k]) + "</div>\n";
    }
    return out;
}

std::string facts(const ScenePlan& plan) {
    using namespace plan_words;
    std::string out = page_fact("budget", budget_words(plan.budget)) + page_fact("cameras", camera_words(plan));
    if (!plan.pictures.empty()) {
        const Image<float>& picture = plan.pictures.front().halves.a;
        out += page_fact("picture", format("%d \u00d7 %d", picture.width(), picture.height()));
    }
    return out + page_fact("exposure", format("%+.3g stops", double(plan.exposure)));
}

std::string list_of_notes(const ScenePlan& plan) {
    std::vector<std::string> lines;
    if (plan.interrupted) lines.push_back("interrupted; shown is what was decided");
    if (plan.over_budget) lines.push_back("over the budget");
    lines.insert(lines.end(), plan.notes.begin(), plan.notes.end());
    std::string out;
    for (const std::string& line : lines) out += "<li>" + xml_text(line) + "</li>\n";
    return out.empty() ? "" : "<ul>\n" + out + "</ul>\n";
}

std::string commands(const PlanPageText& text) {
    std::vector<PageCommand> list = {{"this plan", "", text.command}};
    for (const Bake& bake : text.manifest.bakes) {
        std::string command = "bake";
        for (const std::string& word : command_of(bake)) command += " " + shell_word(word);
        list.push_back({xml_text(bake.name), "", command});
    }
    std::string out = command_list(list);
    if (!text.manifest.bakes.empty())
        out += "<p class=\"hint\">The bakes run one after the other in the folder <code>" + xml_text(text.folder) +
               "</code>.</p>\n";
    return out;
}

} // namespace

PageParts plan_page(const ScenePlan& plan, const PlanPageText& text) {
    Views views = views_of(plan);
    PageParts parts;
    parts.title = text.scene + " \u00b7 bake plan";
    parts.heading = xml_text(text.scene) + " <span>planned</span>";
    parts.facts = facts(plan);
    parts.sections = {{"decisions", "Decisions", decision_table(plan)},
                      {"parts", "Textures, sky and lights", part_table(plan)},
                      {"verified", "Verification", verification_table(plan)},
                      {"tables", "Errors of the pictures", picture_tables(views.json)},
                      {"rungs", "Models that were tried", rung_charts(plan)},
                      {"notes", "Notes", list_of_notes(plan)},
                      {"commands", "Commands", commands(text)}};
    parts.data = Json{{"verb", "plan"},
                      {"scene", text.scene},
                      {"exposure", plan.exposure},
                      {"first", name(plan, Shows::planned)},
                      {"views", std::move(views.json)}}
                     .dump(-1, ' ', false, Json::error_handler_t::replace);
    parts.pictures = std::move(views.pictures);
    return parts;
}

} // namespace bake
