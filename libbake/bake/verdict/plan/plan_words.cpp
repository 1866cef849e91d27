#include "bake/verdict/plan/plan_words.h"
#include "bake/base/printable.h"
#include "bake/base/text.h"
#include "bake/verdict/plan/rung_words.h"
#include "bake/verdict/plan/texture_form.h"
#include <algorithm>
#include <cmath>

namespace bake::plan_words {
namespace {

std::string cost_of(const RungCost& cost) {
    return count(cost.triangles) + " triangles, " + megabytes(cost.texture_bytes) + " MB of textures, " +
           format("%.3g ms", cost.ms);
}

std::string texels(int channels, int bits, bool half) {
    return bits == bc5_bits ? "BC5" : format("%d channels of %d bits%s", channels, bits, half ? " (half floats)" : "");
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

} // namespace

const char* unit(Budget::Metric metric) noexcept {
    return metric == Budget::Metric::degrees ? "deg" : metric == Budget::Metric::flip ? "flip" : "rmse";
}

std::string shown(double value) {
    if (std::isinf(value)) return "inf";
    return value == 0 ? "0" : value < 1e-4 ? format("%.1e", value) : format("%.4f", value);
}

std::string count(std::int64_t n) {
    if (n < 1'000'000) return std::to_string(n);
    return format("%.3g M", double(n) * 1e-6);
}

std::string megabytes(std::int64_t bytes) { return format("%.3f", double(bytes) * 1e-6); }

std::string interval(const Rung& rung) {
    if (rung.known == Known::bound) return "at most " + shown(rung.bound);
    if (!has_error(rung)) return "-";
    if (rung.error.all && rung.error.error == 0) return "exact";
    return shown(rung.error.low()) + " to " + shown(rung.error.high());
}

std::string value(const Rung& rung) {
    return rung.known == Known::bound ? "<=" + shown(rung.bound) : has_error(rung) ? shown(rung.error.rmse()) : "-";
}

std::string estimate(const SquareEstimate& e) {
    return shown(e.rmse()) + " (" + shown(e.low()) + " to " + shown(e.high()) + ")";
}

std::string budget_words(const Budget& budget) {
    return std::string(unit(budget.metric)) + " " + shown(budget.value) + " (" + budget.name + ")";
}

std::string reference_words(const ScenePlan& plan) {
    const auto has_high = [](const ObjectPlan& object) { return !object.high.empty(); };
    if (std::none_of(plan.objects.begin(), plan.objects.end(), has_high)) return "true displacement";
    if (!std::all_of(plan.objects.begin(), plan.objects.end(), has_high))
        return "true displacement or the high-poly mesh";
    return plan.objects.size() == 1 ? "the high-poly mesh" : "the high-poly meshes";
}

std::string camera_words(const ScenePlan& plan) {
    std::string cameras;
    for (const std::string& camera : plan.cameras)
        cameras += (cameras.empty() ? "" : ", ") + (camera.empty() ? "the scene's" : printable(camera));
    return cameras.empty() ? "" : cameras + "; the worst one counts";
}

const RungCost& planned_cost(const ObjectPlan& object) noexcept {
    const Rung* chosen = chosen_rung(object);
    return chosen ? chosen->cost : object.reference_cost;
}

std::vector<Line> reasons(const ObjectPlan& object, const char* metric) {
    const Rung* chosen = chosen_rung(object);
    std::vector<Line> lines;
    const auto line = [&](const char* label, const std::string& rest) {
        if (!rest.empty()) lines.push_back({label, rest});
    };
    line("high-poly", printable(object.high));
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
    return lines;
}

std::vector<Line> part_lines(const ScenePlan& plan) {
    std::vector<Line> lines;
    for (const TexturePlan& t : plan.textures)
        lines.push_back({"texture", printable(t.file) + ", " + t.kind +
                                        format(": %d x %d, %s, %s MB; was %d x %d, %s, %s MB; ", t.width, t.height,
                                               texels(t.channels, t.bits, t.half).c_str(), megabytes(t.bytes).c_str(),
                                               t.source_width, t.source_height,
                                               texels(t.source_channels, t.source_bits, false).c_str(),
                                               megabytes(t.source_bytes).c_str()) +
                                        "rmse " + estimate(t.error) + "; " + printable(t.why)});
    if (plan.sky)
        lines.push_back({"sky", plan.sky->model +
                                    format(": faces of %d, %d levels, %s MB; was %d, %s MB; ", plan.sky->face,
                                           plan.sky->levels, megabytes(plan.sky->bytes).c_str(), plan.sky->source_face,
                                           megabytes(plan.sky->source_bytes).c_str()) +
                                    "rmse " + estimate(plan.sky->error) + "; " + printable(plan.sky->why)});
    for (const LightPlan& light : plan.lights)
        lines.push_back({"light " + std::to_string(light.light + 1),
                         std::string(!light.keep     ? "is not needed"
                                     : light.shadows ? "stays"
                                                     : "stays, without shadows") +
                             "; rmse " + estimate(light.error) + "; " + printable(light.why)});
    return lines;
}

std::vector<std::string> definitions(Budget::Metric metric) {
    const char* what = metric == Budget::Metric::degrees ? "mean angles between the shading normals"
                       : metric == Budget::Metric::flip
                           ? "mean FLIP of what is shown"
                           : "the RMSE of exposed linear light, each sample clamped to [0, 1],";
    return {std::string("Errors are ") + what, "over the object's area in the picture of the worst camera.",
            "Textures have 8 bits per channel and smaller levels; ms are of a million rays of the tracer."};
}

} // namespace bake::plan_words
