// The report on two pictures as text and as JSON.
#include "bake/base/printable.h"
#include "bake/base/text.h"
#include "bake/verdict/compare/picture_report.h"
#include "bake/verdict/report_text.h"
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <nlohmann/json.hpp>

namespace bake {
namespace {

const char* errors_of(Metric metric) {
    switch (metric) {
    case Metric::rmse: return "squared errors of linear light";
    case Metric::ssim: return "1 - SSIM of the shown luma";
    case Metric::flip: return "FLIP of what is shown";
    case Metric::hdr_flip: return "largest FLIP over the exposures";
    case Metric::psnr: break;
    }
    return "dB, of what is shown";
}

std::string table_row(const MetricRow& row) {
    std::string text = format("  %-10s %10.6g", name(row.metric), row.value);
    if (row.errors)
        text +=
            format(" %10.4g %10.4g %10.4g %10.4g", row.errors->mean, row.errors->p95, row.errors->p99, row.errors->max);
    else text += format(" %43s", "");
    return text + "  " + errors_of(row.metric) + "\n";
}

} // namespace

std::string to_text(const PictureReport& report) {
    std::string text = printable(report.file + " against " + report.other) + "\n";
    text += row("pictures", format("%d x %d, %s", report.width, report.height, report.grey ? "grey" : "colour"));
    const auto has = [&](std::initializer_list<Metric> metrics) {
        return std::any_of(report.rows.begin(), report.rows.end(), [&](const MetricRow& own) {
            return std::find(metrics.begin(), metrics.end(), own.metric) != metrics.end();
        });
    };
    if (has({Metric::psnr, Metric::ssim, Metric::flip}))
        text += row("shown", format("at exposure %+g", double(report.exposure)) +
                                 (report.automatic_exposure ? ", automatic, of the first picture" : ""));
    if (has({Metric::flip, Metric::hdr_flip}))
        text += row("viewer", format("%.4g pixels per degree", report.pixels_per_degree));
    if (report.hdr_exposures)
        text += row("hdr-flip", format("%d exposures, %+.4g to %+.4g", report.hdr_exposures->count,
                                       report.hdr_exposures->start, report.hdr_exposures->stop));
    text += format("  %-10s %10s %10s %10s %10s %10s  %s\n", "metric", "value", "mean", "p95", "p99", "max",
                   "of the errors of the pixels");
    for (const MetricRow& metric : report.rows) text += table_row(metric);
    return text + finding_rows(report.findings);
}

std::string to_json(const PictureReport& report) {
    using Json = nlohmann::ordered_json;
    Json json = {{"file", report.file},
                 {"against", report.other},
                 {"kind", "pictures"},
                 {"width", report.width},
                 {"height", report.height},
                 {"colours", report.grey ? 1 : 3},
                 {"exposure", report.exposure},
                 {"automatic_exposure", report.automatic_exposure},
                 {"pixels_per_degree", report.pixels_per_degree}};
    if (report.hdr_exposures)
        json["hdr_exposures"] = {{"start", report.hdr_exposures->start},
                                 {"stop", report.hdr_exposures->stop},
                                 {"count", report.hdr_exposures->count}};
    Json& metrics = json["metrics"] = Json::object();
    for (const MetricRow& row : report.rows) {
        Json& metric = metrics[name(row.metric)] = Json::object();
        metric["value"] = std::isinf(row.value) ? Json("inf") : Json(row.value);
        if (row.errors)
            metric["errors"] = {{"mean", row.errors->mean},
                                {"p95", row.errors->p95},
                                {"p99", row.errors->p99},
                                {"max", row.errors->max}};
    }
    json["over_limit"] = report.over_limit;
    json["notes"] = report.findings.notes;
    json["warnings"] = report.findings.warnings;
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

} // namespace bake
