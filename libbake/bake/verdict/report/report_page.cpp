#include "bake/verdict/report/report_page.h"
#include "bake/base/base64.h"
#include "bake/base/error.h"
#include "bake/base/text.h"
#include "bake/verdict/chart/svg.h"
#include "bake/verdict/metric/false_colour.h"
#include "bake/verdict/report/page_assets.h"
#include "bake/verdict/report/page_tables.h"
#include <nlohmann/json.hpp>
#include <string_view>

namespace bake {
namespace {

using Json = nlohmann::ordered_json;

/// The template with its places {{name}} filled from (name, text) pairs; texts may contain braces.
std::string fill(std::string_view page, const std::vector<std::pair<std::string, std::string>>& texts) {
    std::string out;
    for (std::size_t at = 0; at < page.size();) {
        const std::size_t begin = page.find("{{", at), end = page.find("}}", begin);
        out += page.substr(at, std::min(begin, page.size()) - at);
        if (begin == std::string_view::npos) break;
        const std::string_view name = page.substr(begin + 2, end - begin - 2);
        for (const auto& [key, text] : texts)
            if (key == name) out += text;
        at = end + 2;
    }
    return out;
}

std::string image(const char* kind, const std::string& webp, const std::string& text, const Json& report) {
    if (webp.empty()) return "";
    const std::string size =
        format(" width=\"%d\" height=\"%d\"", integer_or(report, "width", 1024), integer_or(report, "height", 1024));
    return std::string("<img class=\"") + kind + "\" alt=\"" + xml_text(text) + "\"" + size +
           " decoding=\"async\" loading=\"lazy\" src=\"data:image/webp;base64," + base64(webp) + "\">\n";
}

/// A figure per picture: what is shown, its highlights, which only the script reads, and the false colours of the errors.
std::string figures(const Json& report, const std::vector<ReportPicture>& pictures, const StoredPictures& stored) {
    std::string out;
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        const std::string& method = pictures[i].method;
        const StoredPicture& files = stored.pictures[i];
        out += "<figure data-method=\"" + xml_text(method) + "\">\n<div>" +
               image("shown", files.shown, method, report) + image("highlights", files.highlights, "", report) +
               image("errors", files.errors, "FLIP errors of " + method, report) + "</div>\n<figcaption>" +
               caption(report, method, i) + "</figcaption>\n</figure>\n";
    }
    return out;
}

/// The colours of errors as tables of an SVG filter, which the page's pictures and its script share.
std::string magma_tables() {
    std::string out;
    for (int c = 0; c < 3; ++c) {
        out += std::string("<feFunc") + "RGB"[c] + " type=\"table\" tableValues=\"";
        for (int k = 0; k <= 16; ++k) out += format("%s%.4f", k ? " " : "", double(magma(float(k) / 16)[c]));
        out += "\"/>";
    }
    return out;
}

std::string codec(int quality) { return quality > 100 ? "WebP without loss" : format("WebP of quality %d", quality); }

/// How exact the pictures are.
std::string stored_note(const StoredPictures& stored) {
    const std::string loss =
        stored.quality > 100 ? "exact to half a level"
                             : format("off by %.2g of 255 levels (root mean square), 99 %% of the values by at most %g",
                                      stored.rms_levels, stored.p99_levels);
    return "8-bit sRGB levels, " + codec(stored.quality) + ": " + loss;
}

std::string errors_note(const StoredPictures& stored) {
    return std::string(stored.halved_errors ? "means of 2 × 2 pixels, " : "") + "steps of 1/255, " +
           codec(stored.error_quality);
}

/// The JSON for the script. "<" would end a script element or begin a comment.
std::string script_data(const Json& report) {
    const Json data = {{"report", report}, {"highlight_stops", highlight_stops}};
    const std::string text = data.dump(-1, ' ', false, Json::error_handler_t::replace);
    std::string out;
    for (const char c : text)
        if (c == '<') out += "\\u003c";
        else out += c;
    return out;
}

} // namespace

void require_report_page() {
    if (*page_template == 0)
        throw Error(
            Refusal::unsuitable,
            "bake was built without esbuild, which makes the page of reports; install esbuild and build bake anew");
}

std::string report_page(const std::string& json, const std::vector<ReportPicture>& pictures) {
    require_report_page();
    const Json report = Json::parse(json);
    double pixels = 0;
    for (const ReportPicture& picture : pictures) pixels += double(picture.picture.width()) * picture.picture.height();
    const StoredPictures stored =
        store_pictures(pictures, float(number_or(report, "exposure", 0)), report_budget(pixels));
    return fill(page_template, {{"title", xml_text(page_title(report))},
                                {"style", page_style},
                                {"script", page_script},
                                {"magma", magma_tables()},
                                {"heading", heading(report)},
                                {"facts", facts(report)},
                                {"tables", error_tables(report)},
                                {"shares", share_bars(report)},
                                {"commands", commands(report)},
                                {"figures", figures(report, pictures, stored)},
                                {"stored", xml_text(stored_note(stored))},
                                {"stored_errors", xml_text(errors_note(stored))},
                                {"data", script_data(report)}});
}

} // namespace bake
