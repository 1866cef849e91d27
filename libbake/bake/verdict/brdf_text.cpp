// The report on a reflection model as text and as JSON.
#include "bake/base/printable.h"
#include "bake/base/text.h"
#include "bake/verdict/brdf_check.h"
#include <nlohmann/json.hpp>

namespace bake {
namespace {

std::string row(const char* name, bool good, const std::string& value) {
    return format("  %-14s %-4s", name, good ? "yes" : "no") + value + "\n";
}

std::string degrees(double from, double to) { return format("f(%g -> %g deg)", from, to); }

const char* name_of(LobeKind kind) { return kind == LobeKind::phong ? "phong" : "blinn"; }

std::string reciprocity_row(const BrdfReport& report) {
    const BrdfRatio& r = report.reciprocity;
    std::string text = "largest ratio 1";
    if (!r.reciprocal()) {
        text = degrees(r.from_deg, r.to_deg) + " / " + degrees(r.to_deg, r.from_deg) + format(" = %.3g", r.ratio);
        if (r.turn_deg != 180) text += format(" at %g deg of azimuth", r.turn_deg);
    }
    if (report.ratio_20_70 > 0)
        text += "; " + degrees(20, 70) + " / " + degrees(70, 20) + format(" = %.3f", report.ratio_20_70);
    return row("reciprocal", r.reciprocal(), text);
}

std::string exponents_from(double least, const char* closed_form) {
    return least > 0 ? format("n >= %.2f", least) + closed_form : "any n";
}

std::string exponent_rows(const BrdfReport& report) {
    std::string text;
    for (const ExponentNeed& need : report.exponents) {
        const bool phong = need.kind == LobeKind::phong; // whose limits have closed forms
        text += format("  %-14s %s with specular s = %g conserves energy for ", "exponent", name_of(need.kind),
                       need.weight) +
                exponents_from(need.as_written, phong ? " (2 pi s - 1)" : "") + " as written, " +
                exponents_from(need.with_cosine, phong ? " (2 pi s - 2)" : "") + " with the factor n.l, " +
                exponents_from(need.as_rendered, phong ? " (2 s - 1)" : "") + " as rendered\n";
    }
    return text;
}

/// 40 columns for 1, at most 60 in all: '=' up to 1, '#' beyond it, '>' where the bar is cut.
std::string bar(double albedo) {
    constexpr int whole = 40, most = 60;
    const int length = std::clamp(int(std::lround(albedo * whole)), 0, most + 1);
    std::string text;
    for (int i = 0; i < std::max(length, whole); ++i) {
        if (i == whole) text += '|';
        text += i == most ? '>' : i >= whole ? '#' : i < length ? '=' : ' ';
    }
    return length <= whole ? text + "|" : text;
}

nlohmann::ordered_json json_of(const BrdfEnergy& energy) {
    return {{"conserved", energy.conserved()},
            {"largest_albedo", energy.largest},
            {"at_deg", energy.largest_deg},
            {"albedo", energy.albedo}};
}

} // namespace

std::string to_text(const BrdfReport& report) {
    const bool differ = !report.exponents.empty(); // as written from as rendered
    const BrdfEnergy &written = report.as_written, &rendered = report.as_rendered;
    std::string text = printable(report.spec) + "\n";
    text += row("positive", report.positive(), format("least f %.4g", report.least));
    const char* const pattern = "largest albedo %.4g at %d deg%s";
    if (differ)
        text += row("energy", written.conserved(),
                    format(pattern, written.largest, written.largest_deg, ", as written: for a light of irradiance 1"));
    text += row(differ ? "" : "energy", rendered.conserved(),
                format(pattern, rendered.largest, rendered.largest_deg,
                       differ ? ", as rendered: for a light of colour c and irradiance pi c" : ""));
    text += reciprocity_row(report) + exponent_rows(report);
    text += differ ? "  view    written rendered  albedo as rendered; | is 1\n" : "  view    albedo; | is 1\n";
    for (std::size_t k = 0; k < BrdfEnergy::angles; ++k) {
        text += format("  %2d deg ", int(k) * BrdfEnergy::step_deg);
        if (differ) text += format("%8.4g ", written.albedo[k]);
        text += format("%8.4g  ", rendered.albedo[k]) + bar(rendered.albedo[k]) + "\n";
    }
    for (const std::string& warning : report.findings.warnings) text += "  warning: " + printable(warning) + "\n";
    return text;
}

std::string to_json(const BrdfReport& report) {
    nlohmann::ordered_json json = {{"brdf", report.spec}, {"kind", "brdf"}};
    json["positive"] = {{"holds", report.positive()}, {"least", report.least}};
    json["energy"] = {{"step_deg", BrdfEnergy::step_deg},
                      {"as_written", json_of(report.as_written)},
                      {"as_rendered", json_of(report.as_rendered)}};
    const BrdfRatio& r = report.reciprocity;
    json["reciprocity"] = {{"holds", r.reciprocal()},
                           {"largest_ratio", r.ratio},
                           {"from_deg", r.from_deg},
                           {"to_deg", r.to_deg},
                           {"azimuth_deg", r.turn_deg}};
    if (report.ratio_20_70 > 0) json["reciprocity"]["ratio_20_70"] = report.ratio_20_70;
    json["exponents"] = nlohmann::ordered_json::array();
    for (const ExponentNeed& need : report.exponents)
        json["exponents"].push_back({{"lobe", name_of(need.kind)},
                                     {"specular", need.weight},
                                     {"as_written", need.as_written},
                                     {"with_cosine", need.with_cosine},
                                     {"as_rendered", need.as_rendered}});
    json["notes"] = report.findings.notes;
    json["warnings"] = report.findings.warnings;
    return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

} // namespace bake
