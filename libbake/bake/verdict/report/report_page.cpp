#include "bake/verdict/report/report_page.h"
#include "bake/base/base64.h"
#include "bake/base/error.h"
#include "bake/base/text.h"
#include "bake/verdict/chart/svg.h"
#include "bake/verdict/metric/false_colour.h"
#include "bake/verdict/report/page_assets.h"
#include "bake/verdict/report/page_tables.h"
#include <map>
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

std::string image(const char* kind, const std::string& webp, const std::string& text, const Image<float>& picture) {
    if (webp.empty()) return "";
    const std::string size = format(" width=\"%d\" height=\"%d\"", picture.width(), picture.height());
    return std::string("<img class=\"") + kind + "\" alt=\"" + xml_text(text) + "\"" + size +
           " decoding=\"async\" loading=\"lazy\" src=\"data:image/webp;base64," + base64(webp) + "\">\n";
}

/// What one camera sees; a report without views is of one camera.
const Json& view_of(const Json& report, int view) {
    const auto views = report.find("views");
    const bool several = views != report.end() && views->is_array() && std::size_t(view) < views->size();
    return several ? (*views)[std::size_t(view)] : report;
}

std::string camera_of(const Json& report, const Json& view) {
    const std::string camera = &view == &report ? "" : text_or(view, "camera", "");
    return camera.empty() ? "" : "<span class=\"camera\">" + xml_text(camera) + "</span> ";
}

/// A figure per picture: what is shown, its highlights, which only the script reads, and the false colours of the errors.
std::string figures(const Json& report, const std::vector<ReportPicture>& pictures, const StoredPictures& stored) {
    std::string out;
    std::map<int, std::size_t> known; // pictures of each view
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        const ReportPicture& picture = pictures[i];
        const StoredPicture& files = stored.pictures[i];
        const Json& view = view_of(report, picture.view);
        out += "<figure data-method=\"" + xml_text(picture.method) +
               format("\" data-view=\"%d\">\n<div>", picture.view) +
               image("shown", files.shown, picture.method, picture.picture) +
               image("highlights", files.highlights, "", picture.picture) +
               image("errors", files.errors, "FLIP errors of " + picture.method, picture.picture) +
               "</div>\n<figcaption>" + camera_of(report, view) + caption(view, picture.method, known[picture.view]++) +
               "</figcaption>\n</figure>\n";
    }
    return out;
}

std::string text_of(const std::vector<PageSection>& sections) {
    std::string out;
    for (const PageSection& section : sections)
        if (!section.html.empty())
            out +=
                "<section id=\"" + section.id + "\">\n<h2>" + section.title + "</h2>\n" + section.html + "</section>\n";
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

std::string page_of(const PageParts& parts) {
    require_report_page();
    const Json report = Json::parse(parts.data);
    double pixels = 0;
    for (const ReportPicture& one : parts.pictures) pixels += double(one.picture.width()) * one.picture.height();
    const StoredPictures stored =
        store_pictures(parts.pictures, float(number_or(report, "exposure", 0)), report_budget(pixels));
    return fill(page_template, {{"title", xml_text(parts.title)},
                                {"style", page_style},
                                {"script", page_script},
                                {"magma", magma_tables()},
                                {"heading", parts.heading},
                                {"facts", parts.facts},
                                {"sections", text_of(parts.sections)},
                                {"figures", figures(report, parts.pictures, stored)},
                                {"stored", xml_text(stored_note(stored))},
                                {"stored_errors", xml_text(errors_note(stored))},
                                {"data", script_data(report)}});
}

std::string report_page(const std::string& json, std::vector<ReportPicture> pictures) {
    const Json report = Json::parse(json);
    return page_of({.title = page_title(report),
                    .heading = heading(report),
                    .facts = facts(report),
                    .sections = {{"shares", "Share of the squared error by cause", share_bars(report)},
                                 {"tables", "Figures", error_tables(report)},
                                 {"commands", "Commands", commands(report)}},
                    .data = json,
                    .pictures = std::move(pictures)});
}

} // namespace bake
