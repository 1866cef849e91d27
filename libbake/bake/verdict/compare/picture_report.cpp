#include "bake/verdict/compare/picture_report.h"
#include "bake/base/error.h"
#include "bake/base/text.h"
#include "bake/picture/colour.h"
#include "bake/preview/tone.h"
#include "bake/verdict/compare/picture_pair.h"
#include "bake/verdict/metric/squared_error.h"
#include "bake/verdict/metric/ssim.h"
#include <algorithm>

namespace bake {
namespace {

constexpr Metric all_metrics[] = {Metric::rmse, Metric::psnr, Metric::ssim, Metric::flip, Metric::hdr_flip};

/// The metrics to compute; what is left out is noted.
std::vector<Metric> chosen(const PicturePair& pair, const PictureCompareOptions& options, PictureReport& report) {
    const bool small = std::min(report.width, report.height) < ssim_window;
    if (options.metric) {
        if (*options.metric == Metric::ssim && small)
            throw Error(Refusal::unsuitable,
                        report.file + format(": is %d x %d, and the window of SSIM is 11 x 11; use another `metric`",
                                             report.width, report.height));
        return {*options.metric};
    }
    std::vector<Metric> metrics;
    for (const Metric metric : all_metrics) {
        if (metric == Metric::ssim && small)
            report.findings.notes.push_back("ssim is left out: the pictures are smaller than its window, 11 x 11");
        else if (metric != Metric::hdr_flip || !pair.integers) metrics.push_back(metric);
    }
    return metrics;
}

/// Names of what a limit may be set for, before the long work.
void check_limits(const std::vector<Metric>& metrics, const std::vector<Limit>& limits) {
    PictureReport empty;
    for (const Metric metric : metrics) empty.rows.push_back({metric, 0, ErrorSummary{}});
    over_limits(figures(empty), limits);
}

void add_shown_rows(const PicturePair& pair, const std::vector<Metric>& metrics, const PictureCompareOptions& options,
                    PictureReport& report) {
    const auto wanted = [&](Metric m) { return std::find(metrics.begin(), metrics.end(), m) != metrics.end(); };
    const bool as_picture = options.error_picture && options.metric != Metric::hdr_flip;
    if (!wanted(Metric::psnr) && !wanted(Metric::ssim) && !wanted(Metric::flip) && !as_picture) return;
    Image<float> a = shown(pair.reference, report.exposure), b = shown(pair.test, report.exposure);
    if (wanted(Metric::psnr)) report.rows.push_back({Metric::psnr, psnr(squared_errors(a, b)), {}});
    if (wanted(Metric::ssim)) {
        const Ssim s = ssim(luma(a), luma(b));
        report.rows.push_back({Metric::ssim, s.mean, summarise(s.errors)});
    }
    if (!wanted(Metric::flip) && !as_picture) return;
    srgb_to_linear(a);
    srgb_to_linear(b);
    report.errors = flip(a, b, options.flip);
    const ErrorSummary errors = summarise(report.errors);
    if (wanted(Metric::flip)) report.rows.push_back({Metric::flip, errors.mean, errors});
}

void add_hdr_row(const PicturePair& pair, const PictureCompareOptions& options, PictureReport& report,
                 Progress* progress) {
    report.hdr_exposures = exposure_range(pair.reference);
    if (progress) progress->start("hdr-flip", report.hdr_exposures->count);
    Image<float> errors = hdr_flip(pair.reference, pair.test, *report.hdr_exposures, options.flip, progress);
    const ErrorSummary summary = summarise(errors);
    report.rows.push_back({Metric::hdr_flip, summary.mean, summary});
    if (options.metric == Metric::hdr_flip) report.errors = std::move(errors);
}

} // namespace

const char* name(Metric metric) noexcept {
    switch (metric) {
    case Metric::rmse: return "rmse";
    case Metric::psnr: return "psnr";
    case Metric::ssim: return "ssim";
    case Metric::flip: return "flip";
    case Metric::hdr_flip: break;
    }
    return "hdr-flip";
}

PictureReport compare_pictures(const std::string& file, const std::string& other, const PictureCompareOptions& options,
                               Progress* progress) {
    const PicturePair pair = read_picture_pair(file, other);
    PictureReport report{.file = file,
                         .other = other,
                         .width = pair.reference.width(),
                         .height = pair.reference.height(),
                         .grey = pair.grey,
                         .pixels_per_degree = options.flip.pixels_per_degree};
    report.automatic_exposure = !options.exposure && !pair.integers;
    report.exposure = options.exposure            ? float(*options.exposure)
                      : report.automatic_exposure ? automatic_exposure(pair.reference)
                                                  : 0;
    const std::vector<Metric> metrics = chosen(pair, options, report);
    check_limits(metrics, options.limits);
    if (progress) progress->start("compare", 0);
    if (metrics.front() == Metric::rmse) {
        const SquaredErrors errors = squared_errors(pair.reference, pair.test);
        report.rows.push_back({Metric::rmse, rmse(errors), summarise(errors.picture)});
    }
    add_shown_rows(pair, metrics, options, report);
    if (metrics.back() == Metric::hdr_flip) add_hdr_row(pair, options, report, progress);
    if (progress) progress->finish();
    report.findings.notes.insert(report.findings.notes.end(), pair.notes.begin(), pair.notes.end());
    if (std::equal(pair.reference.data(), pair.reference.data() + pair.reference.size(), pair.test.data()))
        report.findings.notes.push_back("the pictures are equal");
    report.findings.warnings = over_limits(figures(report), options.limits);
    report.over_limit = !report.findings.warnings.empty();
    return report;
}

std::vector<Figure> figures(const PictureReport& report) {
    std::vector<Figure> out;
    for (const MetricRow& row : report.rows) switch (row.metric) {
        case Metric::flip:
        case Metric::hdr_flip: add_figures(out, name(row.metric), *row.errors); break;
        case Metric::psnr:
        case Metric::ssim: out.push_back({name(row.metric), row.value, true}); break;
        case Metric::rmse: out.push_back({name(row.metric), row.value}); break;
        }
    return out;
}

} // namespace bake
