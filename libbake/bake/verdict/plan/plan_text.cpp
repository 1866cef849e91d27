// The plan as text.
#include "bake/base/printable.h"
#include "bake/base/text.h"
#include "bake/verdict/finding_text.h"
#include "bake/verdict/plan/plan_words.h"
#include "bake/verdict/plan/rung_words.h"
#include "bake/verdict/report_text.h"
#include <cmath>

namespace bake {
namespace {

using namespace plan_words;

std::string savings(const ObjectPlan& object, const RungCost& cost) {
    const RungCost& full = object.reference_cost;
    const auto whole = [](double n) { return count(std::int64_t(n)); };
    const auto bytes = [](double n) { return megabytes(std::int64_t(n)); };
    const auto time = [](double n) { return format("%.3g", n); };
    std::string text = "against " + name(object.reference) + ": " +
                       less(double(cost.triangles), double(full.triangles), whole, " triangles") + ", " +
                       less(double(cost.object_bytes), double(full.object_bytes), bytes, " MB in all") + ", " +
                       less(cost.ms, full.ms, time, " ms");
    if (object.rgb8_bytes > 0)
        text += "; against an RGB8 normal map: " +
                less(double(cost.texture_bytes), double(object.rgb8_bytes), bytes, " MB of textures");
    return text;
}

std::string head(const ScenePlan& plan) {
    const char* metric = unit(plan.budget.metric);
    std::string text = format("  %-16s %-19s %9s  %-20s %8s %10s %9s %8s\n", "object", "model", "error", "interval",
                              "budget", "triangles", "textures", "time");
    return text + format("  %-16s %-19s %9s  %-20s %8s %10s %9s %8s\n", "", "", metric, "two standard errors", metric,
                         "", "MB", "ms");
}

/// The row of an object, and the lines below it.
std::string lines_of(const ObjectPlan& object, const char* metric) {
    const Rung* chosen = chosen_rung(object);
    const RungCost& cost = planned_cost(object);
    std::string text =
        format("  %-16s %-19s %9s  %-20s %8s %10s %9s %8.3g\n", printable(object.object).c_str(),
               name(chosen ? chosen->method : object.reference).c_str(), chosen ? value(*chosen).c_str() : "0",
               chosen ? interval(*chosen).c_str() : "the reference", shown(object.budget).c_str(),
               count(cost.triangles).c_str(), megabytes(cost.texture_bytes).c_str(), cost.ms);
    const auto line = [&](const std::string& label, const std::string& rest) {
        text += format("    %-12s ", label.c_str()) + rest + "\n";
    };
    for (const Line& reason : reasons(object, metric)) line(reason.label, reason.text);
    line("saves", savings(object, cost));
    return text;
}

std::string verification(const ScenePlan& plan) {
    if (plan.verified.empty()) return {};
    const std::string metric = unit(plan.budget.metric);
    std::string text = "  verified by whole pictures of the planned scene and of the reference\n";
    text += format("  %-16s %-16s %-28s %-28s %8s  %s\n", "camera", "object", ("predicted " + metric).c_str(),
                   ("measured " + metric).c_str(), "flip", "");
    for (const Verification& v : plan.verified)
        text += format("  %-16s %-16s %-28s %-28s %8s  %s\n", printable(v.camera).c_str(),
                       v.object.empty() ? "(whole picture)" : printable(v.object).c_str(),
                       v.predicted.pixels > 0 ? estimate(v.predicted).c_str() : "-", estimate(v.measured).c_str(),
                       (v.flip >= 0 ? shown(v.flip) : "-").c_str(), v.within ? "within" : "OVER the budget");
    return text;
}

} // namespace

std::string to_text(const ScenePlan& plan) {
    const char* metric = unit(plan.budget.metric);
    std::string text = counted(plan.objects.size(), "object") + " within " + budget_words(plan.budget) + " of " +
                       reference_words(plan) + "\n";
    if (!plan.cameras.empty()) text += row("cameras", camera_words(plan));
    text += row("exposure", format("%+g stops", double(plan.exposure)));
    if (!plan.objects.empty()) text += head(plan);
    for (const ObjectPlan& object : plan.objects) text += lines_of(object, metric);
    for (const Line& line : part_lines(plan)) text += row(line.label, line.text);
    text += verification(plan);
    for (const std::string& line : definitions(plan.budget.metric)) text += "  " + line + "\n";
    if (plan.interrupted) text += row("warning", "interrupted; printed is what was decided");
    if (plan.over_budget) text += row("warning", "over the budget");
    for (const std::string& note : plan.notes) text += row("note", printable(note));
    return text;
}

} // namespace bake
