#include "bake/preview/tone.h"
#include "bake/verdict/compare/picture_report.h"
#include "verdict/compare/files.h"
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

using namespace bake;
using namespace bake::test;

namespace {

const MetricRow& row_of(const PictureReport& report, Metric metric) {
    for (const MetricRow& row : report.rows)
        if (row.metric == metric) return row;
    FAIL(name(metric) << " is missing");
    return report.rows.front();
}

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("picture_report: equal pictures give 0 and infinity in every metric, and are said to be equal") {
        const Files files;
        const std::string a = files.exr("a.exr", noisy(24, 20, 1));
        const PictureReport r = compare_pictures(a, a);
        REQUIRE(r.rows.size() == 5);
        CHECK(row_of(r, Metric::rmse).value == 0);
        CHECK(row_of(r, Metric::psnr).value == std::numeric_limits<double>::infinity());
        CHECK(row_of(r, Metric::ssim).value == 1);
        CHECK(row_of(r, Metric::flip).value == 0);
        CHECK(row_of(r, Metric::hdr_flip).errors->max == 0);
        CHECK(r.findings.notes.back() == "the pictures are equal");
        CHECK(r.findings.warnings.empty());
        CHECK(nlohmann::json::parse(to_json(r))["metrics"]["psnr"]["value"] == "inf");
        CHECK(has(to_text(r), "psnr              inf"));
    }

    TEST_CASE("picture_report: rmse is of linear light, psnr of what is shown at the exposure") {
        const Files files;
        const auto constant = [](double v) { return picture(16, 16, 3, [=](int, int, int) { return v; }); };
        const std::string a = files.exr("a.exr", constant(0.25)), b = files.exr("b.exr", constant(0.5));
        const PictureReport r = compare_pictures(a, b, {.exposure = -1.0});
        CHECK(row_of(r, Metric::rmse).value == 0.25);
        CHECK(row_of(r, Metric::rmse).errors->p95 == 0.0625);
        const double step = shown_value(0.5f, -1, Tone::srgb) - shown_value(0.25f, -1, Tone::srgb);
        CHECK(row_of(r, Metric::psnr).value == doctest::Approx(-20 * std::log10(step)).epsilon(1e-6));
        CHECK_FALSE(r.automatic_exposure);
        // At an exposure at which both are white, nothing is seen of the difference.
        const PictureReport white = compare_pictures(a, b, {.exposure = 4.0});
        CHECK(row_of(white, Metric::flip).value == 0);
        CHECK(row_of(white, Metric::ssim).value == 1);
        CHECK(row_of(white, Metric::rmse).value == 0.25);
    }

    TEST_CASE("picture_report: the exposure is automatic for floats, that of the first, and 0 for integers") {
        const Files files;
        const std::string dim = files.exr("dim.exr", picture(12, 12, 3, [](int, int, int) { return 0.18 / 8; })),
                          bright = files.exr("bright.exr", picture(12, 12, 3, [](int, int, int) { return 0.18 * 4; })),
                          png = files.png("p.png", noisy(12, 12, 1));
        CHECK(compare_pictures(dim, bright).exposure == 3);
        CHECK(compare_pictures(bright, dim).exposure == -2);
        CHECK(compare_pictures(bright, dim).automatic_exposure);
        const PictureReport mixed = compare_pictures(dim, png);
        CHECK(mixed.exposure == 0);
        CHECK_FALSE(mixed.automatic_exposure);
        CHECK(mixed.rows.back().metric == Metric::flip); // no hdr-flip of what is to be shown as it is
        CHECK(compare_pictures(png, png, {.metric = Metric::hdr_flip}).rows.size() == 1);
    }

    TEST_CASE("picture_report: 8-bit pictures are shown as they are stored") {
        const Files files;
        const std::string a = files.png("a.png", picture(11, 11, 3, [](int, int, int) { return 100 / 255.0; })),
                          b = files.png("b.png", picture(11, 11, 3, [](int, int, int) { return 110 / 255.0; }));
        CHECK(row_of(compare_pictures(a, b), Metric::psnr).value ==
              doctest::Approx(20 * std::log10(25.5)).epsilon(1e-5));
    }

    TEST_CASE("picture_report: limits are checked by name before, and hold after") {
        const Files files;
        const std::string a = files.png("a.png", noisy(16, 16, 1)), b = files.png("b.png", noisy(16, 16, 2));
        const PictureReport r = compare_pictures(a, b, {.limits = {{"flip", 0.001}, {"ssim", -1}}});
        CHECK(r.over_limit);
        REQUIRE(r.findings.warnings.size() == 1);
        CHECK(has(r.findings.warnings[0], "over the limit: flip is "));
        CHECK(has(refusal(Refusal::usage,
                          [&] {
                              compare_pictures(a, b, {.metric = Metric::rmse, .limits = {{"flip", 1}}});
                          }),
                  "these are: rmse"));
    }

    TEST_CASE("picture_report: pictures smaller than the window of SSIM have the other metrics") {
        const Files files;
        const std::string a = files.png("a.png", noisy(10, 30, 1));
        const PictureReport r = compare_pictures(a, a);
        CHECK(r.rows.size() == 3);
        CHECK(has(r.findings.notes.front(), "ssim is left out"));
        CHECK(has(refusal(Refusal::unsuitable, [&] { compare_pictures(a, a, {.metric = Metric::ssim}); }),
                  "is 10 x 30, and the window of SSIM is 11 x 11"));
    }

    TEST_CASE("picture_report: the error picture is that of the metric, and FLIP's for metrics without one") {
        const Files files;
        const std::string a = files.exr("a.exr", noisy(16, 16, 1)), b = files.exr("b.exr", noisy(16, 16, 2));
        const auto errors = [&](std::optional<Metric> metric) {
            return compare_pictures(a, b, {.metric = metric, .error_picture = true}).errors;
        };
        const Image<float> flip = errors(Metric::flip), hdr = errors(Metric::hdr_flip);
        CHECK(equal(errors({}), flip));
        CHECK(equal(errors(Metric::rmse), flip));
        CHECK_FALSE(equal(hdr, flip));
        CHECK(compare_pictures(a, b, {.metric = Metric::rmse}).errors.empty());
    }
}
