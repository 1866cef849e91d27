// The metrics of two picture files, as a report.
//
//   linear light                               rmse, hdr-flip
//   as shown: exposed, clamped, sRGB curve     psnr (peak 1), ssim (of the luma), flip
#pragma once
#include "bake/base/progress.h"
#include "bake/verdict/compare/figures.h"
#include "bake/verdict/inspect.h"
#include "bake/verdict/metric/hdr_flip.h"
#include <optional>

namespace bake {

enum class Metric { rmse, psnr, ssim, flip, hdr_flip };
const char* name(Metric metric) noexcept;

struct PictureCompareOptions {
    std::optional<Metric> metric; ///< none: all; HDR-FLIP only where both files have float samples
    /// Stops, of what is shown; none: automatic_exposure() of the reference if both files have float samples, else 0.
    std::optional<double> exposure;
    FlipOptions flip;
    std::vector<Limit> limits;
    bool error_picture = false; ///< FLIP is computed for its picture even if it is not the metric
};

struct MetricRow {
    Metric metric;
    double value = 0;                   ///< psnr: dB, infinity for equal pictures; flip: the mean
    std::optional<ErrorSummary> errors; ///< of the pixels; none for psnr
};

struct PictureReport {
    std::string file, other;
    int width = 0, height = 0;
    bool grey = false;
    float exposure = 0;
    bool automatic_exposure = false;
    double pixels_per_degree = 0;
    std::optional<ExposureRange> hdr_exposures;
    std::vector<MetricRow> rows;
    Findings findings;
    bool over_limit = false;
    Image<float> errors; ///< of FLIP, or of HDR-FLIP if that is the metric; empty if neither was computed
};

/// `file` is the reference. Throws the errors of read_picture_pair(), Error{Refusal::unsuitable} for pictures too small for
/// SSIM if that is the metric, and Error{Refusal::usage} for a limit of what is not computed.
PictureReport compare_pictures(const std::string& file, const std::string& other,
                               const PictureCompareOptions& options = {}, Progress* progress = nullptr);

/// rmse, psnr, ssim; flip and hdr-flip with their percentiles. Only what was computed.
std::vector<Figure> figures(const PictureReport& report);
std::string to_text(const PictureReport& report);
std::string to_json(const PictureReport& report);

} // namespace bake
