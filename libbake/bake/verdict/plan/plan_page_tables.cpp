// The tables of the page of a plan.
#include "bake/base/text.h"
#include "bake/verdict/chart/svg.h"
#include "bake/verdict/plan/plan_page.h"
#include "bake/verdict/plan/plan_words.h"
#include "bake/verdict/plan/rung_chart.h"
#include "bake/verdict/plan/rung_words.h"

namespace bake {
namespace {

using namespace plan_words;

constexpr std::size_t most_open_charts = 12;
constexpr int decision_columns = 12;

std::string cell(const std::string& text) { return "<td>" + xml_text(text) + "</td>"; }

std::string whole(double n) { return count(std::int64_t(n)); }
std::string million_bytes(double n) { return megabytes(std::int64_t(n)); }
std::string milliseconds(double ms) { return std::isnan(ms) ? "" : format("%.3g", ms); }

/// Cells of what is spent and saved. Times of several objects do not add up: each is of a million rays.
std::string cost_cells(const RungCost& cost, const RungCost& full, std::int64_t rgb8_bytes) {
    return cell(count(cost.triangles)) + cell(megabytes(cost.texture_bytes)) + cell(milliseconds(cost.ms)) +
           cell(less(double(cost.triangles), double(full.triangles), whole)) +
           cell(less(double(cost.object_bytes), double(full.object_bytes), million_bytes)) +
           cell(less(cost.ms, full.ms, milliseconds)) +
           cell(rgb8_bytes > 0 ? less(double(cost.texture_bytes), double(rgb8_bytes), million_bytes) : "\u2013");
}

void add(RungCost& sum, const RungCost& cost) {
    sum.triangles += cost.triangles, sum.object_bytes += cost.object_bytes;
    sum.texture_bytes += cost.texture_bytes, sum.ms = NAN;
}

/// The row of an object, and below it the reasons.
std::string rows_of(const ObjectPlan& object, const char* metric) {
    const Rung* chosen = chosen_rung(object);
    std::string out = "<tbody>\n<tr><th scope=\"row\">" + xml_text(object.object) + "</th><td class=\"model\">" +
                      name(chosen ? chosen->method : object.reference) + "</td>";
    out += cell(chosen ? value(*chosen) : "0") + cell(chosen ? interval(*chosen) : "the reference") +
           cell(shown(object.budget));
    out += cost_cells(planned_cost(object), object.reference_cost, object.rgb8_bytes) + "</tr>\n";
    out += format("<tr class=\"reasons\"><td colspan=\"%d\"><dl>\n", decision_columns);
    for (const Line& line : reasons(object, metric))
        out += "<div><dt>" + line.label + "</dt><dd>" + xml_text(line.text) + "</dd></div>\n";
    return out + "</dl></td></tr>\n</tbody>\n";
}

std::string decision_head(const char* metric) {
    const auto th = [](const char* title) { return std::string("<th scope=\"col\">") + title + "</th>"; };
    const auto group = [](const char* title, int columns) {
        return format("<th scope=\"colgroup\" colspan=\"%d\"><span>%s</span></th>", columns, title);
    };
    return "<thead><tr><th rowspan=\"2\" scope=\"col\">object</th><th rowspan=\"2\" scope=\"col\">model</th>" +
           group(metric, 3) + group("Costs", 3) + group("Saves against the reference", 3) +
           group("against an RGB8 map", 1) + "</tr>\n<tr>" + th("error") + th("two standard errors") + th("budget") +
           th("triangles") + th("textures, MB") + th("ms") + th("triangles") + th("MB in all") + th("ms") +
           th("textures, MB") + "</tr></thead>\n";
}

} // namespace

std::string decision_table(const ScenePlan& plan) {
    if (plan.objects.empty()) return "";
    const char* const metric = unit(plan.budget.metric);
    std::string rows;
    RungCost cost, full;
    std::int64_t rgb8 = 0;
    for (const ObjectPlan& object : plan.objects) {
        rows += rows_of(object, metric);
        add(cost, planned_cost(object)), add(full, object.reference_cost);
        rgb8 += object.rgb8_bytes;
    }
    if (plan.objects.size() > 1)
        rows += "<tfoot><tr><th scope=\"row\">all</th><td></td><td></td><td></td><td></td>" +
                cost_cells(cost, full, rgb8) + "</tr></tfoot>\n";
    std::string notes;
    for (const std::string& line : definitions(plan.budget.metric)) notes += (notes.empty() ? "" : " ") + line;
    return "<div class=\"wide\"><table>\n" + decision_head(metric) + rows + "</table></div>\n<p class=\"hint\">" +
           xml_text(notes) + "</p>\n";
}

std::string rung_charts(const ScenePlan& plan) {
    std::string charts;
    for (const ObjectPlan& object : plan.objects)
        if (const std::string svg = rung_chart(plan, object); !svg.empty()) charts += "<figure>" + svg + "</figure>\n";
    if (charts.empty()) return "";
    charts = "<div class=\"charts\">\n" + charts + "</div>\n";
    if (plan.objects.size() <= most_open_charts) return charts;
    return format("<details><summary>%d objects</summary>\n", int(plan.objects.size())) + charts + "</details>\n";
}

std::string part_table(const ScenePlan& plan) {
    std::string rows;
    for (const Line& line : part_lines(plan))
        rows += "<tr><th scope=\"row\">" + xml_text(line.label) + "</th>" + cell(line.text) + "</tr>\n";
    return rows.empty() ? "" : "<table class=\"words\"><tbody>\n" + rows + "</tbody></table>\n";
}

std::string verification_table(const ScenePlan& plan) {
    if (plan.verified.empty()) return "";
    const std::string metric = unit(plan.budget.metric);
    std::string rows;
    for (const Verification& v : plan.verified)
        rows += "<tr><th scope=\"row\">" + xml_text(v.camera.empty() ? "the scene's" : v.camera) + "</th>" +
                cell(v.object.empty() ? "(whole picture)" : v.object) +
                cell(v.predicted.pixels > 0 ? estimate(v.predicted) : "\u2013") + cell(estimate(v.measured)) +
                cell(v.flip >= 0 ? shown(v.flip) : "\u2013") +
                (v.within ? "<td>within</td>" : "<td class=\"over\">over the budget</td>") + "</tr>\n";
    return "<div class=\"wide\"><table>\n<caption>Whole pictures of the planned scene and of the reference</caption>\n"
           "<thead><tr><th scope=\"col\">camera</th><th scope=\"col\">object</th><th scope=\"col\">predicted " +
           metric + "</th><th scope=\"col\">measured " + metric +
           "</th><th scope=\"col\">flip</th><th scope=\"col\">budget</th></tr></thead>\n<tbody>\n" + rows +
           "</tbody></table></div>\n";
}

} // namespace bake
