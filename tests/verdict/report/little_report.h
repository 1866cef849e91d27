// A report of ten methods, small and with known values.
#pragma once
#include "bake/verdict/report/report_page.h"
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace bake::test {

inline constexpr int report_width = 96, report_height = 64;
inline constexpr float report_exposure = 1;

/// The name of the fourth method is one that HTML must not take for its own.
inline std::vector<std::string> report_methods() {
    return {"plain", "roughness",      "constant-scale", "<b>&\"blinn\"", "exact",
            "bump",  "bump+roughness", "normal",         "displace:16",   "displace+normal:16"};
}

/// Shown levels, at the exposure of the reference, of the square from (8, 8) to (24, 24): (40 + 15 i, 128, 60) of picture i.
inline int square_red(std::size_t i) { return 40 + 15 * int(i); }

inline float light_of(int level) {
    const float v = float(level) / 255;
    return (v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f)) / std::exp2(report_exposure);
}

/// A square of its own colour; from (40, 8) to (56, 24) a radiance of 4, which is 8 when exposed; the rest is grey. Errors are
/// 0.5 in the first square and 0 elsewhere.
inline std::vector<ReportPicture> report_pictures() {
    std::vector<ReportPicture> out;
    std::vector<std::string> names = report_methods();
    names.insert(names.begin(), "displace:256");
    for (std::size_t i = 0; i < names.size(); ++i) {
        ReportPicture picture{names[i], Image<float>(report_width, report_height, 3), {}};
        if (i > 0) picture.errors = Image<float>(report_width, report_height, 1);
        for (int y = 0; y < report_height; ++y)
            for (int x = 0; x < report_width; ++x) {
                const bool in_rows = y >= 8 && y < 24, square = in_rows && x >= 8 && x < 24;
                const bool bright = in_rows && x >= 40 && x < 56;
                const int levels[] = {square ? square_red(i) : 100, square ? 128 : 100, square ? 60 : 100};
                for (int c = 0; c < 3; ++c) picture.picture.at(x, y, c) = bright ? 4 : light_of(levels[c]);
                if (i > 0) picture.errors.at(x, y) = square ? 0.5f : 0;
            }
        out.push_back(std::move(picture));
    }
    return out;
}

/// The largest error is that of method 2. Method 1 has a PSNR of infinity, the last one no costs.
inline nlohmann::ordered_json report_json() {
    using Json = nlohmann::ordered_json;
    Json report = {{"verb", "compare"},
                   {"scene", "s.toml"},
                   {"object", "ball"},
                   {"camera", ""},
                   {"width", report_width},
                   {"height", report_height},
                   {"spp", 64},
                   {"exposure", report_exposure},
                   {"command", "bake compare s.toml --report out.html"},
                   {"reference",
                    {{"method", "displace:256"}, {"segments", 256}, {"note", "fine enough"}, {"render_seconds", 9.5}}},
                   {"methods", Json::array()}};
    const std::vector<std::string> names = report_methods();
    for (std::size_t i = 0; i < names.size(); ++i) {
        const double flip = i == 1 ? 0.9 : 0.02 + 0.01 * double(i);
        const Json errors = {{"rmse", {{"value", flip / 3}, {"error", flip / 100}}},
                             {"psnr", {{"value", i == 0 ? Json("inf") : Json(30 + double(i))}}},
                             {"ssim", {{"value", 1 - flip}}},
                             {"flip", {{"mean", flip}, {"p95", 0.95}, {"p99", 0.99}, {"error", 0.001}}}};
        Json row = {{"method", names[i]},
                    {"command", "bake compare s.toml --methods '" + names[i] + "'"},
                    {"object", errors},
                    {"frame", errors},
                    {"normals_deg", {{"mean", 12.5 - double(i)}, {"p95", 30}}},
                    {"silhouette_px", {{"mean", 1.5}, {"max", 4}}},
                    {"shares",
                     {{"silhouette", 0.5},
                      {"self_shadow", 0.25},
                      {"parallax", 0.1},
                      {"normal", 0.1},
                      {"filtering", 0.15},
                      {"interaction", -0.1}}},
                    {"worst", {{"x", 8}, {"y", 8}, {"width", 16}, {"height", 16}}}};
        if (i + 1 < names.size()) {
            row["prepare_seconds"] = 0.1 * double(i), row["render_seconds"] = 0.5;
            row["memory_bytes"] = 1 << (12 + i), row["triangles"] = 1234567, row["texture_bytes"] = 65536;
        }
        report["methods"].push_back(row);
    }
    return report;
}

} // namespace bake::test
