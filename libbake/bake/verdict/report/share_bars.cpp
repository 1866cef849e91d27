// Stacked bars of the shares of the squared error by cause, as HTML without a script.
#include "bake/base/text.h"
#include "bake/verdict/chart/svg.h"
#include "bake/verdict/report/page_tables.h"
#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

namespace bake {
namespace {

using Json = nlohmann::ordered_json;

struct Cause {
    const char* path;
    const char* name;
};

constexpr Cause causes[] = {{"silhouette", "silhouette"}, {"self_shadow", "self-shadow"},
                            {"parallax", "parallax"},     {"normal", "shading normal"},
                            {"filtering", "filtering"},   {"interaction", "interaction"}};

struct Bar {
    std::string method;
    std::vector<double> shares;  ///< one per cause
    double below = 0, above = 0; ///< sums of the negative and of the positive shares
    std::size_t index = 0;
};

std::vector<Bar> bars_of(const Json& report) {
    std::vector<Bar> bars;
    const auto methods = report.find("methods");
    if (methods == report.end() || !methods->is_array()) return bars;
    for (std::size_t i = 0; i < methods->size(); ++i) {
        const Json& row = (*methods)[i];
        Bar bar{text_or(row, "method", "?"), {}, 0, 0, i + 1};
        for (const Cause& cause : causes) {
            const double share = number_or(row, std::string("shares/") + cause.path, 0);
            bar.shares.push_back(share);
            (share < 0 ? bar.below : bar.above) += std::abs(share);
        }
        if (bar.below + bar.above > 0) bars.push_back(bar);
    }
    return bars;
}

std::string segment(std::size_t cause, double from, double width, double share, const std::string& method) {
    const std::string text = format("%.0f %%", 100 * share);
    return format("<i class=\"cause%d\" style=\"left:%.3f%%;width:%.3f%%\" title=\"", int(cause), from, width) +
           xml_text(method) + format(": %s %s\">", causes[cause].name, text.c_str()) + (width > 6 ? text : "") + "</i>";
}

} // namespace

std::string share_bars(const Json& report) {
    const std::vector<Bar> bars = bars_of(report);
    if (bars.empty()) return "";
    double below = 0, above = 0;
    for (const Bar& bar : bars) below = std::max(below, bar.below), above = std::max(above, bar.above);
    const double scale = 100 / (below + above), zero = scale * below;
    std::string legend, rows;
    for (std::size_t k = 0; k < std::size(causes); ++k)
        if (std::any_of(bars.begin(), bars.end(), [&](const Bar& bar) { return bar.shares[k] != 0; }))
            legend += format("<span><i class=\"cause%d\"></i>%s</span>", int(k), causes[k].name);
    for (const Bar& bar : bars) {
        double left = zero, right = zero;
        rows += "<li data-method=\"" + xml_text(bar.method) + "\"><span><kbd>" + std::to_string(bar.index) + "</kbd> " +
                xml_text(bar.method) + "</span><div>";
        for (std::size_t k = 0; k < bar.shares.size(); ++k) {
            const double share = bar.shares[k], width = scale * std::abs(share);
            if (share < 0) left -= width;
            if (share != 0) rows += segment(k, share < 0 ? left : right, width, share, bar.method);
            if (share > 0) right += width;
        }
        rows += format("<b style=\"left:%.3f%%\"></b></div></li>\n", zero);
    }
    return "<p class=\"legend\">" + legend + "</p>\n<ol>\n" + rows + "</ol>\n";
}

} // namespace bake
