// The report on a height on a mesh: warnings and notes, as text and as JSON.
#include "bake/base/printable.h"
#include "bake/base/text.h"
#include "bake/verdict/finding_text.h"
#include "bake/verdict/relief_check.h"
#include "bake/verdict/report_text.h"
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace bake {
namespace {

using Json = nlohmann::ordered_json;

/// A shift of the whole surface is told beyond this share of the diagonal, which is a pixel where the object spans a
/// thousand, and beyond this share of the relief's own range.
constexpr double seen_shift = 0.001, least_shift = 0.1;
/// Height over the focal radius from which on the mesh is to blame, not the amplitude.
constexpr double sharp_place = 10;

void judge_methods(const ReliefReport& report, Findings& out) {
    const ReliefCheck& c = report.check;
    if (const std::string text = describe(c.constant_scale, NormalMethod::constant_scale); !text.empty())
        out.notes.push_back(text + "; use `method` exact");
    if (const std::string text = describe(c.blinn, NormalMethod::blinn); !text.empty())
        out.notes.push_back(text + ", and so are surface-gradient and bump tables; use `method` exact");
    if (c.folded > 0) {
        const double safe = 0.99 * report.options.amplitude / (1 - c.fold_margin);
        out.warnings.push_back(
            "exact normals and displacement fold: " + percent(c.folded) +
            " of the surface turns inside out, where the height is beyond the focal radius, which is " +
            number(c.focal) + format(" at uv (%.3g, %.3g)", c.fold_uv.x, c.fold_uv.y) +
            (1 - c.fold_margin < sharp_place
                 ? "; reduce `amplitude` to " + number(safe) + ", or move `midlevel`"
                 : "; the mesh has edges there that are sharper than relief can follow: round "
                   "them, or let the height be 0 there"));
    }
}

void judge_texels(const ReliefCheck& c, Findings& out) {
    if (!c.budget) {
        out.notes.push_back(
            "the charts do not lie in one tile: the errors of the filter, of the levels and of the border "
            "are not predicted");
        return;
    }
    if (c.budget->quantisation_deg > smallest_seen_deg)
        out.notes.push_back(format("the levels of the height tilt the normal by %.2g deg (rms): they are too few for "
                                   "this amplitude; give 16 bits, or `dequantise` a smooth height",
                                   c.budget->quantisation_deg));
    if (c.budget->filter_deg > smallest_seen_deg && c.better_filter)
        out.notes.push_back(format("filter %s is off by %.2g deg (rms) at the frequencies of this height; use `filter` "
                                   "%s",
                                   std::string(name(c.filter)).c_str(), c.budget->filter_deg,
                                   std::string(name(c.better_filter->filter)).c_str()));
    const auto ridge = [&](double deg, const char* axis, const char* field) {
        if (deg > smallest_seen_deg)
            out.warnings.push_back(format("the height does not tile in %s: the step across its border tilts the normal "
                                          "by %.2g deg (rms) along it; set `%s` to clamp, or repair the picture",
                                          axis, deg, field));
    };
    ridge(c.ridge_u_deg, "x", "wrap_u");
    ridge(c.ridge_v_deg, "y", "wrap_v");
}

/// The midlevel at which the mean of the height is 0.
double centred(const ReliefReport& report) {
    return report.options.midlevel + report.check.mean / report.options.amplitude;
}

void judge_offset(const ReliefReport& report, Findings& out) {
    const ReliefCheck& c = report.check;
    const double shift = std::abs(c.mean);
    if (shift <= seen_shift * c.diagonal || shift <= least_shift * (c.most - c.least)) return;
    out.notes.push_back(
        format("the height is %.3g on average: displacement moves the whole surface %s by so much, %s of "
               "the diagonal, and bump and normal maps do not; set `midlevel` to %.4g",
               c.mean, c.mean > 0 ? "out" : "in", percent(shift / c.diagonal).c_str(), centred(report)));
}

Json json_of(const MethodError& error, bool has_bound) {
    Json json = {{"largest_deg", error.largest_deg},
                 {"largest_height_x_curvature", error.bend},
                 {"uv", {error.uv.x, error.uv.y}}};
    if (has_bound) json["bound_deg"] = error.bound_deg;
    else json.update({{"stretch", error.stretch}, {"skew_deg", error.skew_deg}});
    return json;
}

} // namespace

Findings judge(const ReliefReport& report) {
    Findings out;
    judge_methods(report, out);
    judge_texels(report.check, out);
    judge_offset(report, out);
    for (const std::string& doubt : report.check.doubts) out.notes.push_back(report.height_file + ": " + doubt);
    return out;
}

std::string to_text(const ReliefReport& report) {
    const ReliefCheck& c = report.check;
    std::string text = printable(report.file + " + " + report.height_file) + "\n";
    text +=
        row("relief", format("amplitude %.4g, midlevel %.4g; b from %.4g to %.4g, mean %.4g (diagonal %.4g)",
                             report.options.amplitude, report.options.midlevel, c.least, c.most, c.mean, c.diagonal));
    text += row("constant-scale", format("off by up to %.3g deg", c.constant_scale.largest_deg));
    text += row("blinn", format("off by up to %.3g deg; at any slope %.3g", c.blinn.largest_deg, c.blinn.bound_deg));
    text += row("exact",
                format("folds on %s of the surface; smallest 1 + b a %.4g", percent(c.folded).c_str(), c.fold_margin));
    if (c.budget)
        text += row("texels", format("filter %s %.3g deg, levels %.3g deg (rms)", std::string(name(c.filter)).c_str(),
                                     c.budget->filter_deg, c.budget->quantisation_deg));
    if (c.ridge_u_deg > 0 || c.ridge_v_deg > 0)
        text += row("border", format("ridge of %.3g deg along u, %.3g along v (rms)", c.ridge_u_deg, c.ridge_v_deg));
    return text + endings(report.findings);
}

std::string to_json(const ReliefReport& report) {
    const ReliefCheck& c = report.check;
    Json json = {{"file", report.file},
                 {"height", report.height_file},
                 {"kind", "relief"},
                 {"amplitude", report.options.amplitude},
                 {"midlevel", report.options.midlevel},
                 {"diagonal", c.diagonal},
                 {"b", {{"min", c.least}, {"max", c.most}, {"mean", c.mean}}},
                 {"constant_scale", json_of(c.constant_scale, false)},
                 {"blinn", json_of(c.blinn, true)},
                 {"fold", {{"margin", c.fold_margin}, {"uv", {c.fold_uv.x, c.fold_uv.y}}, {"share", c.folded}}},
                 {"filter", name(c.filter)}};
    if (c.focal > 0) json["fold"]["focal_radius"] = c.focal;
    if (c.budget)
        json["error_rms_deg"] = {{"filter", c.budget->filter_deg}, {"quantisation", c.budget->quantisation_deg}};
    if (c.better_filter) json["better_filter"] = name(c.better_filter->filter);
    json["ridge_rms_deg"] = {{"u", c.ridge_u_deg}, {"v", c.ridge_v_deg}};
    json["notes"] = report.findings.notes;
    json["warnings"] = report.findings.warnings;
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

} // namespace bake
