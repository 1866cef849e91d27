// Pictures as the page of a report stores them: WebP of what is shown at the exposure of the reference, a second picture of
// what is brighter than white, so that the exposure can be turned down, and a third of the errors.
#pragma once
#include "bake/picture/image.h"
#include <string>
#include <vector>

namespace bake {

/// One method's picture, and its errors beside the reference.
struct ReportPicture {
    std::string method;
    Image<float> picture; ///< linear RGB radiance, not exposed
    Image<float> errors;  ///< one channel, FLIP from 0 to 1; of the reference it may be empty
    int view = 0;         ///< of the page: which camera sees it
};

/// Stops above white that the picture of highlights reaches: its level v stands for 2^(v / 255 * highlight_stops).
inline constexpr int highlight_stops = 8;

struct StoredPicture {
    std::string shown;      ///< WebP of shown_value() with the sRGB curve
    std::string highlights; ///< WebP without loss: 0 where a channel is at most white; empty if all of them are
    std::string errors;     ///< WebP, grey, 255 for an error of 1; empty without errors
};

struct StoredPictures {
    std::vector<StoredPicture> pictures;
    int quality = 0; ///< of `shown`, as encode_webp() takes it; the same for all, so that no method looks better by it
    int error_quality = 0;      ///< of `errors`
    bool halved_errors = false; ///< `errors` are half as wide and high
    double rms_levels = 0; ///< root of the mean squared difference between decoded and exact values of `shown`, of 255
    double p99_levels = 0; ///< 99 % of the values differ by at most this
};

/// Bytes that the files of a page may have together: encoded as base64 they and the page are below 3 MB for 11 pictures of
/// 1024 x 1024 and less, and in proportion for more pixels.
double report_budget(double pixels) noexcept;

/// At the best quality at which the files take at most `budget` bytes, and at the lowest if none does. Values that are NaN
/// or negative count as 0. Throws Error{Refusal::unsuitable} as encode_webp().
StoredPictures store_pictures(const std::vector<ReportPicture>& pictures, float exposure, double budget);

} // namespace bake
