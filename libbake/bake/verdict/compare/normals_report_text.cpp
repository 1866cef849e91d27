// The report on two normal maps as text and as JSON.
#include "bake/base/printable.h"
#include "bake/base/text.h"
#include "bake/verdict/compare/normals_report.h"
#include "bake/verdict/report_text.h"
#include <nlohmann/json.hpp>

namespace bake {
namespace {

const char* name(NormalEncoding encoding) {
    switch (encoding) {
    case NormalEncoding::signed_: return "n = rgb";
    case NormalEncoding::srgb_encoded: return "sRGB-encoded";
    case NormalEncoding::srgb_decoded: return "sRGB-decoded";
    default: return "n = 2 rgb - 1";
    }
}

const char* green(const NormalsReport& report) {
    return report.green_turned ? "opposed" : report.check.green_decided ? "agrees" : "not decided";
}

} // namespace

std::string to_text(const NormalsReport& report) {
    const bool tangent = report.space == NormalSpace::tangent;
    std::string text = printable(report.file + " against " + report.other) + "\n";
    text += row("normals", format("%d x %d, %s space, ", report.width, report.height, tangent ? "tangent" : "object") +
                               name(report.values.encoding) + " against " + name(report.other_values.encoding));
    if (tangent)
        text += row("green", green(report) + format(" (correlation of the slopes x %+.4f, y %+.4f)",
                                                    report.check.corr_x, report.check.corr_y));
    text += row("angles", format("mean %.4g, p95 %.4g, p99 %.4g, max %.4g degrees", report.angles.mean,
                                 report.angles.p95, report.angles.p99, report.angles.max));
    return text + finding_rows(report.findings);
}

std::string to_json(const NormalsReport& report) {
    using Json = nlohmann::ordered_json;
    const bool tangent = report.space == NormalSpace::tangent;
    Json json = {{"file", report.file},
                 {"against", report.other},
                 {"kind", "normals"},
                 {"width", report.width},
                 {"height", report.height},
                 {"space", tangent ? "tangent" : "object"},
                 {"encoding", {name(report.values.encoding), name(report.other_values.encoding)}}};
    if (tangent) {
        json["green"] = green(report);
        json["correlation"] = {{"x", report.check.corr_x}, {"y", report.check.corr_y}};
    }
    json["angle_deg"] = {{"mean", report.angles.mean},
                         {"p95", report.angles.p95},
                         {"p99", report.angles.p99},
                         {"max", report.angles.max}};
    json["left_out"] = report.left_out;
    json["over_limit"] = report.over_limit;
    json["notes"] = report.findings.notes;
    json["warnings"] = report.findings.warnings;
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

} // namespace bake
