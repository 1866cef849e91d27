// The comparison of methods as text, as JSON and as CSV.
#include "bake/base/printable.h"
#include "bake/base/text.h"
#include "bake/verdict/compare/scene_comparison.h"
#include "bake/verdict/finding_text.h"
#include "bake/verdict/report_text.h"
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

namespace bake {
namespace {

using Json = nlohmann::ordered_json;

/// Shares of the total by name, and the interaction; 0 without an error.
std::vector<std::pair<std::string, double>> parts(const CauseShares& shares) {
    const double scale = shares.total > 0 ? 1 / shares.total : 0;
    return {{"silhouette", shares.silhouette * scale}, {"self_shadow", shares.self_shadow * scale},
            {"parallax", shares.parallax * scale},     {"normal", shares.normal * scale},
            {"filtering", shares.filtering * scale},   {"interaction", shares.interaction * scale}};
}

Json number_or_word(double value) { return std::isinf(value) ? Json("inf") : Json(value); }

Json json_of(const Estimate& estimate) {
    return {{"value", number_or_word(estimate.value)}, {"error", number_or_word(estimate.error)}};
}

Json json_of(const Estimate& mean, const ErrorSummary& pixels) {
    return {{"mean", mean.value}, {"error", mean.error}, {"p95", pixels.p95}, {"p99", pixels.p99}, {"max", pixels.max}};
}

Json json_of(const AreaErrors& area) {
    return {{"pixels", area.pixels},
            {"rmse", json_of(area.rmse)},
            {"mean_square", json_of(area.square)},
            {"psnr", json_of(area.psnr)},
            {"ssim", json_of(area.ssim)},
            {"flip", json_of(area.flip, area.flip_of_pixels)},
            {"hdr_flip", json_of(area.hdr_flip, area.hdr_flip_of_pixels)}};
}

Json json_of(const Seconds& seconds) {
    return {{"median", seconds.median}, {"least", seconds.least}, {"most", seconds.most}};
}

Json json_of(const std::string& method, const MethodCost& cost) {
    return {{"method", method},
            {"prepare_seconds", cost.prepare.median},
            {"render_seconds", cost.render.median},
            {"prepare", json_of(cost.prepare)},
            {"render", json_of(cost.render)},
            {"triangles", cost.triangles},
            {"memory_bytes", cost.object_bytes},
            {"texture_bytes", cost.texture_bytes}};
}

void add_shares(const CauseShares& shares, Json& json) {
    for (const auto& [cause, part] : parts(shares)) (cause == "interaction" ? json : json["shares"])[cause] = part;
    json["shares_of"] = {{"mean_square", shares.total}, {"pixels", shares.pixels}};
}

Json json_of(const MethodRow& row) {
    const PictureErrors& errors = row.errors;
    Json json = json_of(row.method, row.cost);
    json["object"] = json_of(errors.object);
    json["frame"] = json_of(errors.frame);
    json["normals_deg"] = {{"mean", errors.angles.mean}, {"p95", errors.angles.p95}, {"max", errors.angles.max}};
    if (errors.outline.known) json["silhouette_px"] = {{"mean", errors.outline.mean}, {"max", errors.outline.max}};
    if (row.shares) add_shares(*row.shares, json);
    json["worst"] = {
        {"x", errors.worst.x}, {"y", errors.worst.y}, {"width", errors.worst.width}, {"height", errors.worst.height}};
    json["on_time_front"] = row.on_time_front;
    json["on_bytes_front"] = row.on_bytes_front;
    return json;
}

std::string reference_text(const SceneComparison& comparison) {
    const ReferenceRow& reference = comparison.reference;
    std::string text = reference.method + format(", %.3g M triangles, %.2f s", double(reference.cost.triangles) * 1e-6,
                                                 reference.cost.seconds());
    if (reference.refinements > 0)
        text += format("; %d refinement%s, the last changed rmse %.2g +- %.1g", reference.refinements,
                       reference.refinements == 1 ? "" : "s", reference.change.value, reference.change.error);
    return text + (reference.why.empty() ? "" : "; " + reference.why);
}

std::string cause_table(const SceneComparison& comparison) {
    const auto has_shares = [](const MethodRow& row) { return row.shares.has_value(); };
    if (std::none_of(comparison.rows.begin(), comparison.rows.end(), has_shares)) return {};
    std::string text = "  share of the squared error by cause: the first five sum to 100 %; interaction: 100 % less "
                       "each cause alone\n";
    text += format("  %-18s %10s %11s %9s %8s %10s %12s\n", "method", "silhouette", "self-shadow", "parallax", "normal",
                   "filtering", "interaction");
    for (const MethodRow& row : comparison.rows) {
        if (!row.shares) continue;
        const auto all = parts(*row.shares);
        const auto cent = [&](int i) { return 100 * all[std::size_t(i)].second; };
        text += format("  %-18s %8.1f %% %9.1f %% %7.1f %% %6.1f %% %8.1f %% %10.1f %%\n", row.method.c_str(), cent(0),
                       cent(1), cent(2), cent(3), cent(4), cent(5));
    }
    return text;
}

std::string table_row(const MethodRow& row) {
    const AreaErrors& object = row.errors.object;
    const char fronts[] = {row.on_time_front ? 't' : ' ', row.on_bytes_front ? 'b' : ' ', 0};
    std::string outline = "-";
    if (row.errors.outline.known) outline = format("%.2f/%.1f", row.errors.outline.mean, row.errors.outline.max);
    return format("  %-18s %7.2f %7.2f %9lld %7.1f  %.5f %.0e %6.2f %6.4f  %.4f %.0e %.3f %.3f  %5.2f %5.1f  %9s  %s\n",
                  row.method.c_str(), row.cost.prepare.median, row.cost.render.median,
                  static_cast<long long>(row.cost.triangles), double(row.cost.object_bytes) * 1e-6, object.rmse.value,
                  object.rmse.error, object.psnr.value, object.ssim.value, object.flip.value, object.flip.error,
                  object.flip_of_pixels.p95, object.hdr_flip.value, row.errors.angles.mean, row.errors.angles.p95,
                  outline.c_str(), fronts);
}

} // namespace

std::string to_text(const SceneComparison& comparison) {
    std::string text = printable(comparison.object) + ": the methods against true displacement\n";
    text += row("picture", format("%d x %d, %d samples per pixel, exposure %+g%s", comparison.width, comparison.height,
                                  comparison.spp, double(comparison.exposure),
                                  comparison.automatic_exposure ? ", automatic, of the reference" : ""));
    text += row("reference", reference_text(comparison));
    text +=
        format("  %-18s %7s %7s %9s %7s  %-13s %6s %6s  %-12s %5s %5s  %-11s  %9s  %s\n", "method", "prepare", "render",
               "triangles", "memory", "rmse", "psnr", "ssim", "flip", "p95", "hdr", "normal, deg", "outline", "front");
    text += format("  %-18s %7s %7s %9s %7s  %-13s %6s %6s  %-12s %5s %5s  %-11s  %9s  %s\n", "", "s", "s", "", "MB",
                   "      +-", "dB", "", "     +-", "", "mean", "mean   p95", "mean/max px", "");
    for (const MethodRow& method : comparison.rows) text += table_row(method);
    text +=
        "  Errors are over the pixels that show the object in either picture. front: no other method is as good in\n"
        "  both rmse and time (t) or bytes (b), and better in one.\n";
    text += cause_table(comparison);
    return text + finding_rows({.warnings = comparison.warnings, .notes = comparison.notes});
}

std::string to_json(const SceneComparison& comparison, const std::string& scene,
                    const std::function<std::string(const std::string& method)>& command) {
    const ReferenceRow& reference = comparison.reference;
    Json json = {{"verb", "compare"},
                 {"kind", "methods"},
                 {"scene", scene},
                 {"object", comparison.object},
                 {"width", comparison.width},
                 {"height", comparison.height},
                 {"spp", comparison.spp},
                 {"exposure", comparison.exposure},
                 {"automatic_exposure", comparison.automatic_exposure},
                 {"command", command("")}};
    Json& own = json["reference"] = json_of(reference.method, reference.cost);
    own["refinements"] = reference.refinements;
    if (reference.refinements > 0) own["change"] = json_of(reference.change);
    own["note"] = reference.why;
    Json& methods = json["methods"] = Json::array();
    for (const MethodRow& method : comparison.rows) {
        methods.push_back(json_of(method));
        methods.back()["command"] = command(method.method);
    }
    json["interrupted"] = comparison.interrupted;
    json["over_limit"] = comparison.over_limit;
    json["notes"] = comparison.notes;
    json["warnings"] = comparison.warnings;
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string to_csv(const SceneComparison& comparison) {
    std::string text =
        "method,prepare_s,render_s,render_least_s,render_most_s,triangles,memory_bytes,texture_bytes,rmse,"
        "rmse_error,psnr,ssim,ssim_error,flip,flip_error,flip_p95,flip_p99,hdr_flip,hdr_flip_error,"
        "frame_rmse,frame_flip,normal_mean_deg,normal_p95_deg,outline_mean_px,outline_max_px,silhouette,self_shadow,"
        "parallax,normal,filtering,interaction\n";
    for (const MethodRow& row : comparison.rows) {
        const AreaErrors& object = row.errors.object;
        text += row.method +
                format(",%.4g,%.4g,%.4g,%.4g,%lld,%lld,%lld", row.cost.prepare.median, row.cost.render.median,
                       row.cost.render.least, row.cost.render.most, static_cast<long long>(row.cost.triangles),
                       static_cast<long long>(row.cost.object_bytes), static_cast<long long>(row.cost.texture_bytes));
        for (const double value :
             {object.rmse.value, object.rmse.error, object.psnr.value, object.ssim.value, object.ssim.error,
              object.flip.value, object.flip.error, object.flip_of_pixels.p95, object.flip_of_pixels.p99,
              object.hdr_flip.value, object.hdr_flip.error, row.errors.frame.rmse.value, row.errors.frame.flip.value,
              row.errors.angles.mean, row.errors.angles.p95, row.errors.outline.mean, row.errors.outline.max})
            text += format(",%.6g", value);
        for (const auto& [cause, part] : parts(row.shares.value_or(CauseShares{})))
            text += row.shares ? format(",%.4f", part) : ",";
        text += "\n";
    }
    return text;
}

} // namespace bake
