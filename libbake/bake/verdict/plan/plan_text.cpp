// The plan as text.
#include "bake/base/printable.h"
#include "bake/base/text.h"
#include "bake/verdict/finding_text.h"
#include "bake/verdict/plan/plan.h"
#include "bake/verdict/plan/rung_words.h"
#include "bake/verdict/report_text.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

const char* unit(Budget::Metric metric) {
    return metric == Budget::Metric::degrees ? "deg" : metric == Budget::Metric::flip ? "flip" : "rmse";
}

std::string shown(double value) {
    if (std::isinf(value)) return "inf";
    return value == 0 ? "0" : value < 1e-4 ? format("%.1e", value) : format("%.4f", value);
}

/// "12 345" is hard to copy: whole numbers below a million, then with a unit.
std::string count(std::int64_t n) {
    if (n < 1'000'000) return std::to_string(n);
    return format("%.3g M", double(n) * 1e-6);
}

std::string megabytes(std::int64_t bytes) { return format("%.3f", double(bytes) * 1e-6); }

/// "0.0300 to 0.0330", or what a bound says.
std::string interval(const Rung& rung) {
    if (rung.known == Known::bound) return "at most " + shown(rung.bound);
    if (!has_error(rung)) return "-";
    if (rung.error.all && rung.error.error == 0) return "exact";
    return shown(rung.error.low()) + " to " + shown(rung.error.high());
}

std::string value(const Rung& rung) {
    return rung.known == Known::bound ? "<=" + shown(rung.bound) : has_error(rung) ? shown(rung.error.rmse()) : "-";
}

std::string cost_of(const RungCost& cost) {
    return count(cost.triangles) + " triangles, " + megabytes(cost.texture_bytes) + " MB of textures, " +
           format("%.3g ms", cost.ms);
}

/// A line about a neighbour on the ladder.
std::string neighbour(const Rung& rung, const char* metric) {
    std::string text = name(rung.method) + ": ";
    if (rung.known == Known::bound || has_error(rung)) {
        text += std::string(metric) + " " + value(rung);
        if (has_error(rung)) text += " (" + interval(rung) + ")";
        if (rung.known == Known::not_settled) text += ", not settled";
    } else {
        text += rung.known == Known::skipped ? "skipped" : "not tried";
    }
    if (rung.flip >= 0) text += ", flip " + shown(rung.flip);
    text += "; " + cost_of(rung.cost);
    return rung.note.empty() ? text : text + "; " + printable(rung.note);
}

/// "1.2 M triangles": how much less than the other, or more.
template <class Text> std::string less(double part, double whole, const Text& text, const std::string& unit) {
    const double saved = whole - part;
    return text(std::abs(saved)) + unit + (saved < 0 ? " more" : "");
}

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
    const RungCost& cost = chosen ? chosen->cost : object.reference_cost;
    std::string text =
        format("  %-16s %-19s %9s  %-20s %8s %10s %9s %8.3g\n", printable(object.object).c_str(),
               name(chosen ? chosen->method : object.reference).c_str(), chosen ? value(*chosen).c_str() : "0",
               chosen ? interval(*chosen).c_str() : "the reference", shown(object.budget).c_str(),
               count(cost.triangles).c_str(), megabytes(cost.texture_bytes).c_str(), cost.ms);
    const auto line = [&](const char* label, const std::string& rest) {
        if (!rest.empty()) text += format("    %-12s ", label) + rest + "\n";
    };
    line("why", printable(object.why));
    if (chosen && chosen->known == Known::not_settled)
        line("not settled", "the probes end before its error is told from the budget: " + std::string(metric) + " " +
                                interval(*chosen) + ", taken as the cheapest within 1.1 budgets");
    if (chosen && has_error(*chosen))
        line("worst view", (chosen->camera.empty() ? "the camera" : printable(chosen->camera)) +
                               format(", %lld pixels", static_cast<long long>(chosen->error.pixels)) +
                               (chosen->error.all ? ", all of the object" : "") +
                               (chosen->flip >= 0 ? "; mean flip " + shown(chosen->flip) : ""));
    if (const Rung* rung = cheaper_rung(object)) line("cheaper", neighbour(*rung, metric));
    if (const Rung* rung = dearer_rung(object)) line("dearer", neighbour(*rung, metric));
    line("saves", savings(object, cost));
    return text;
}

std::string estimate(const SquareEstimate& e) {
    return shown(e.rmse()) + " (" + shown(e.low()) + " to " + shown(e.high()) + ")";
}

std::string others(const ScenePlan& plan) {
    std::string text;
    for (const TexturePlan& t : plan.textures)
        text += row("texture", printable(t.file) + ", " + t.kind +
                                   format(": %d x %d, %d channels of %d bits%s, %s MB; was %d x %d, %d of %d, %s MB; ",
                                          t.width, t.height, t.channels, t.bits, t.half ? " (half floats)" : "",
                                          megabytes(t.bytes).c_str(), t.source_width, t.source_height,
                                          t.source_channels, t.source_bits, megabytes(t.source_bytes).c_str()) +
                                   "rmse " + estimate(t.error) + "; " + printable(t.why));
    if (plan.sky)
        text += row("sky", plan.sky->model +
                               format(": faces of %d, %d levels, %s MB; was %d, %s MB; ", plan.sky->face,
                                      plan.sky->levels, megabytes(plan.sky->bytes).c_str(), plan.sky->source_face,
                                      megabytes(plan.sky->source_bytes).c_str()) +
                               "rmse " + estimate(plan.sky->error) + "; " + printable(plan.sky->why));
    for (const LightPlan& light : plan.lights)
        text += row("light " + std::to_string(light.light + 1),
                    std::string(!light.keep     ? "is not needed"
                                : light.shadows ? "stays"
                                                : "stays, without shadows") +
                        "; rmse " + estimate(light.error) + "; " + printable(light.why));
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

std::string definition(Budget::Metric metric) {
    const char* what = metric == Budget::Metric::degrees ? "mean angles between the shading normals"
                       : metric == Budget::Metric::flip
                           ? "mean FLIP of what is shown"
                           : "the RMSE of exposed linear light, each sample clamped to [0, 1],";
    return std::string("  Errors are ") + what + "\n  over the object's area in the picture of the worst camera.\n" +
           "  Textures have 8 bits per channel and smaller levels; ms are of a million rays of the tracer.\n";
}

} // namespace

std::string to_text(const ScenePlan& plan) {
    const char* metric = unit(plan.budget.metric);
    std::string text = counted(plan.objects.size(), "object") + " within " + metric + " " + shown(plan.budget.value) +
                       " (" + plan.budget.name + ") of true displacement\n";
    std::string cameras;
    for (const std::string& camera : plan.cameras)
        cameras += (cameras.empty() ? "" : ", ") + (camera.empty() ? "the scene's" : printable(camera));
    if (!cameras.empty()) text += row("cameras", cameras + "; the worst one counts");
    text += row("exposure", format("%+g stops", double(plan.exposure)));
    if (!plan.objects.empty()) text += head(plan);
    for (const ObjectPlan& object : plan.objects) text += lines_of(object, metric);
    text += others(plan) + verification(plan);
    text += definition(plan.budget.metric);
    if (plan.interrupted) text += row("warning", "interrupted; printed is what was decided");
    if (plan.over_budget) text += row("warning", "over the budget");
    for (const std::string& note : plan.notes) text += row("note", printable(note));
    return text;
}

} // namespace bake
