#include "bake/verdict/report/page_tables.h"
#include "bake/base/text.h"
#include "bake/verdict/chart/svg.h"
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

namespace bake {
namespace {

using Json = nlohmann::ordered_json;

enum class Unit { plain, seconds, bytes, count };

struct Column {
    const char* group;
    const char* title;
    const char* meaning;
    const char* path;
    const char* error; ///< path of the standard error, or ""
    Unit unit;
    int better; ///< -1: small values are good, 1: large ones, 0: neither
};

/// Paths of errors are relative to "object" or "frame".
constexpr Column error_columns[] = {
    {"FLIP", "mean", "FLIP, 0 to 1, of what is shown", "flip/mean", "flip/error", Unit::plain, -1},
    {"FLIP", "p95", "95 % of the pixels have at most this error", "flip/p95", "", Unit::plain, -1},
    {"FLIP", "p99", "99 % of the pixels have at most this error", "flip/p99", "", Unit::plain, -1},
    {"HDR-FLIP", "mean", "largest FLIP of each pixel over a range of exposures", "hdr_flip/mean", "hdr_flip/error",
     Unit::plain, -1},
    {"Light", "RMSE", "root mean squared error of linear light", "rmse/value", "rmse/error", Unit::plain, -1},
    {"Light", "PSNR dB", "of what is shown", "psnr/value", "psnr/error", Unit::plain, 1},
    {"Light", "SSIM", "structural similarity of the shown luma, 1 for equal pictures", "ssim/value", "ssim/error",
     Unit::plain, 1},
};

constexpr Column cost_columns[] = {
    {"Normals °", "mean", "angle between shading normals, degrees", "normals_deg/mean", "", Unit::plain, -1},
    {"Normals °", "p95", "95 % of the pixels have at most this angle", "normals_deg/p95", "", Unit::plain, -1},
    {"Outline px", "mean", "distance between the silhouettes, pixels", "silhouette_px/mean", "", Unit::plain, -1},
    {"Outline px", "max", "largest distance between the silhouettes, pixels", "silhouette_px/max", "", Unit::plain, -1},
    {"Time", "prepare", "to bake, tessellate and build the BVH", "prepare_seconds", "", Unit::seconds, -1},
    {"Time", "render", "", "render_seconds", "", Unit::seconds, -1},
    {"Size", "memory", "", "memory_bytes", "", Unit::bytes, -1},
    {"Size", "triangles", "", "triangles", "", Unit::count, -1},
    {"Size", "textures", "", "texture_bytes", "", Unit::bytes, -1},
};

const Json* find(const Json& json, const std::string& path) {
    const Json* at = &json;
    for (std::size_t begin = 0; begin <= path.size();) {
        const std::size_t end = std::min(path.find('/', begin), path.size());
        if (!at->is_object()) return nullptr;
        const auto next = at->find(path.substr(begin, end - begin));
        if (next == at->end()) return nullptr;
        at = &*next, begin = end + 1;
    }
    return at;
}

/// A number, "inf" as infinity.
std::optional<double> number(const Json& json, const std::string& path) {
    const Json* at = find(json, path);
    if (at && at->is_number()) return at->get<double>();
    if (at && at->is_string() && at->get<std::string>() == "inf") return INFINITY;
    return {};
}

const Json& methods(const Json& report) {
    static const Json none = Json::array();
    const Json* all = find(report, "methods");
    return all && all->is_array() ? *all : none;
}

std::string value_text(double value, Unit unit) {
    if (std::isinf(value)) return "∞";
    if (unit == Unit::seconds) return format("%.3g s", value);
    if (unit == Unit::bytes)
        return value < 1024 ? format("%.0f B", value) : in_binary_units(std::uint64_t(value), true);
    if (unit == Unit::plain) return format("%.3g", value);
    std::string digits = format("%.0f", value);
    for (int at = int(digits.size()) - 3; at > 0; at -= 3) digits.insert(std::size_t(at), "\u2009");
    return digits;
}

/// The number of a method on a key of the keyboard: 0 is the reference.
std::string key(std::size_t index) { return "<kbd>" + std::to_string(index) + "</kbd>"; }

/// One column of a table: its values in the rows, none where they are missing.
struct Filled {
    const Column* column;
    std::vector<std::optional<double>> values, errors;
    std::optional<double> best; ///< if the values differ
};

Filled filled(const Column& column, const std::string& room, const Json& rows) {
    Filled out{&column, {}, {}, {}};
    std::optional<double> worst;
    for (const Json& row : rows) {
        const std::optional<double> v = number(row, room + column.path);
        out.values.push_back(v);
        out.errors.push_back(*column.error ? number(row, room + column.error) : std::optional<double>());
        if (!v) continue;
        if (!out.best || (*v - *out.best) * column.better > 0) out.best = v;
        if (!worst || (*v - *worst) * column.better < 0) worst = v;
    }
    if (out.best == worst) out.best.reset();
    return out;
}

std::string cell(const Filled& column, std::size_t row) {
    const std::optional<double> v = column.values[row];
    if (!v) return "<td>–</td>";
    std::string text = value_text(*v, column.column->unit);
    if (column.errors[row] && std::isfinite(*column.errors[row]))
        text += format(" <small>±%.1g</small>", *column.errors[row]);
    return std::string("<td") + (v == column.best ? " class=\"best\"" : "") + ">" + text + "</td>";
}

std::string table_of(const char* name, const Json& report, const std::vector<Filled>& columns) {
    std::string groups, titles, rows;
    for (std::size_t i = 0, span = 1; i < columns.size(); i += span) {
        span = 1;
        while (i + span < columns.size() && std::string(columns[i].column->group) == columns[i + span].column->group)
            ++span;
        groups +=
            format("<th scope=\"colgroup\" colspan=\"%d\"><span>%s</span></th>", int(span), columns[i].column->group);
    }
    for (const Filled& f : columns)
        titles +=
            std::string("<th scope=\"col\" title=\"") + xml_text(f.column->meaning) + "\">" + f.column->title + "</th>";
    for (std::size_t i = 0; i < methods(report).size(); ++i) {
        const std::string method = xml_text(text_or(methods(report)[i], "method", "?"));
        rows += "<tr data-method=\"" + method + "\"><th scope=\"row\">" + key(i + 1) + " " + method + "</th>";
        for (const Filled& f : columns) rows += cell(f, i);
        rows += "</tr>\n";
    }
    return std::string("<div class=\"wide\"><table>\n<caption>") + name +
           "</caption>\n<thead><tr><th rowspan=\"2\" scope=\"col\">method</th>" + groups + "</tr>\n<tr>" + titles +
           "</tr></thead>\n<tbody>\n" + rows + "</tbody></table></div>\n";
}

template <class Columns>
void take(std::vector<Filled>& to, const Columns& columns, const std::string& room, const Json& report) {
    for (const Column& column : columns) {
        Filled f = filled(column, room, methods(report));
        for (const std::optional<double>& v : f.values)
            if (v) {
                to.push_back(std::move(f));
                break;
            }
    }
}

} // namespace

double number_or(const Json& json, const std::string& path, double otherwise) {
    const std::optional<double> v = number(json, path);
    return v && std::isfinite(*v) ? *v : otherwise;
}

int integer_or(const Json& json, const std::string& path, int otherwise) {
    const double v = number_or(json, path, otherwise);
    return std::abs(v) < 1e9 ? int(v) : otherwise;
}

std::string text_or(const Json& json, const std::string& path, const std::string& otherwise) {
    const Json* at = find(json, path);
    return at && at->is_string() ? at->get<std::string>() : otherwise;
}

std::string page_fact(const char* name, const std::string& value) {
    if (value.empty()) return "";
    return std::string("<div><dt>") + name + "</dt><dd>" + xml_text(value) + "</dd></div>\n";
}

std::string page_title(const Json& report) {
    const std::string object = text_or(report, "object", ""), scene = text_or(report, "scene", "scene");
    return (object.empty() ? "" : object + " in ") + scene + " · bake compare";
}

std::string heading(const Json& report) {
    const std::string object = text_or(report, "object", ""), scene = text_or(report, "scene", "scene");
    if (object.empty()) return xml_text(scene);
    return xml_text(object) + " <span>in " + xml_text(scene) + "</span>";
}

std::string facts(const Json& report) {
    std::string out;
    const int w = integer_or(report, "width", 0), h = integer_or(report, "height", 0);
    const int spp = integer_or(report, "spp", 0);
    std::string reference = text_or(report, "reference/method", "");
    const std::string note = text_or(report, "reference/note", "");
    out += page_fact("camera", text_or(report, "camera", ""));
    out += page_fact("picture", (w > 0 && h > 0 ? format("%d × %d", w, h) : "") +
                                    (spp > 0 ? format(", %d samples per pixel", spp) : ""));
    if (number(report, "exposure"))
        out += page_fact("exposure", format("%+.3g stops", number_or(report, "exposure", 0)));
    if (const auto s = number(report, "reference/prepare_seconds")) reference += format(", %.3g s to prepare", *s);
    if (const auto s = number(report, "reference/render_seconds")) reference += format(", %.3g s to render", *s);
    return out + page_fact("reference", reference + (note.empty() ? "" : "; " + note));
}

std::string caption(const Json& report, const std::string& method, std::size_t index) {
    std::string out = key(index) + " <b>" + xml_text(method) + "</b>";
    if (index == 0) return out + " reference";
    for (const Json& row : methods(report)) {
        if (text_or(row, "method", "") != method) continue;
        if (const auto v = number(row, "object/flip/mean")) out += " FLIP " + value_text(*v, Unit::plain);
        if (const auto v = number(row, "render_seconds")) out += ", " + value_text(*v, Unit::seconds);
        break;
    }
    return out;
}

std::string error_tables(const Json& report) {
    std::vector<Filled> object, frame;
    take(object, error_columns, "object/", report);
    take(frame, error_columns, "frame/", report);
    const bool whole = object.empty() && !frame.empty();
    take(whole ? frame : object, cost_columns, "", report);
    if (whole) return table_of("Errors over the frame", report, frame);
    std::string out = table_of("Errors over the object, and costs", report, object);
    if (!frame.empty()) out += table_of("Errors over the frame", report, frame);
    return out;
}

std::string command_list(const std::vector<PageCommand>& commands) {
    std::string out;
    for (const PageCommand& one : commands)
        if (!one.command.empty())
            out += "<li data-method=\"" + xml_text(one.method) + "\"><span>" + one.label + "</span><code>" +
                   xml_text(one.command) + "</code></li>\n";
    return out.empty() ? "" : "<ol>\n" + out + "</ol>\n";
}

std::string commands(const Json& report) {
    std::vector<PageCommand> all = {{"all", "", text_or(report, "command", "")}};
    for (std::size_t i = 0; i < methods(report).size(); ++i) {
        const std::string method = text_or(methods(report)[i], "method", "?");
        all.push_back({key(i + 1) + " " + xml_text(method), method, text_or(methods(report)[i], "command", "")});
    }
    return command_list(all);
}

} // namespace bake
