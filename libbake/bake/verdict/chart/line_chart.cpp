#include "bake/verdict/chart/line_chart.h"
#include "bake/verdict/chart/frame.h"
#include "bake/verdict/chart/svg.h"
#include <algorithm>

namespace bake {
namespace {

constexpr double mark_size = 11, key_size = 11;
/// Okabe and Ito, Color Universal Design, 2008: colours that colour-blind people tell apart. Yellow is left out.
constexpr const char* colours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"};
constexpr const char* dashes[] = {"", " stroke-dasharray=\"7 3\"", " stroke-dasharray=\"2 3\""};
struct MarkStyle {
    const char *colour, *stroke;
};
constexpr MarkStyle mark_styles[] = {{"#a33", "stroke=\"#a33\" stroke-dasharray=\"6 3\""},
                                     {"#55329b", "stroke=\"#55329b\" stroke-dasharray=\"2 3\""},
                                     {"#2d6a2d", "stroke=\"#2d6a2d\" stroke-dasharray=\"8 3 2 3\""}};
constexpr std::size_t colour_count = std::size(colours), dash_count = std::size(dashes);

std::string stroke_of(std::size_t series) {
    return std::string("stroke=\"") + colours[series % colour_count] + "\" stroke-width=\"1.6\"" +
           dashes[series / colour_count % dash_count];
}

bool can_draw(const ChartPoint& p) { return is_drawable(p.x) && is_drawable(p.y); }

/// The values of one coordinate that can be drawn.
std::vector<double> values_of(const LineChart& chart, double ChartPoint::*coordinate) {
    std::vector<double> values;
    for (const LineSeries& s : chart.series)
        for (const std::vector<ChartPoint>* points : {&s.points, &s.expected})
            for (const ChartPoint& p : *points)
                if (can_draw(p)) values.push_back(p.*coordinate);
    return values;
}

Axis axis_along_x(const LineChart& chart) {
    std::vector<double> values = values_of(chart, &ChartPoint::x);
    for (const ChartMark& mark : chart.marks) values.push_back(mark.x);
    return axis_of(values, chart.logarithmic_x);
}

Axis axis_along_y(const LineChart& chart) {
    std::vector<double> values = values_of(chart, &ChartPoint::y);
    if (chart.limit) values.push_back(*chart.limit);
    return axis_of(values, chart.logarithmic_y);
}

std::string draw_series(const LineSeries& series, std::size_t index, const Frame& frame) {
    std::string out = "<g class=\"series\"><title>" + xml_text(series.label) + "</title>\n", line, dots;
    const auto end_line = [&] {
        if (!line.empty()) out += "<polyline fill=\"none\" " + stroke_of(index) + " points=\"" + line + "\"/>\n";
        line.clear();
    };
    for (const ChartPoint& p : series.points) {
        if (!can_draw(p)) {
            end_line();
            continue;
        }
        const std::string x = px(place_px(frame.x, p.x)), y = px(place_px(frame.y, p.y));
        line += (line.empty() ? "" : " ") + x + "," + y;
        dots += "<circle cx=\"" + x + "\" cy=\"" + y + "\" r=\"2.2\" fill=\"" + colours[index % colour_count] +
                "\"><title>" + xml_text(series.label) + ": " + short_number(p.x) + ", " + short_number(p.y) +
                "</title></circle>\n";
    }
    end_line();
    for (const ChartPoint& p : series.expected)
        if (can_draw(p))
            out += "<circle class=\"expected\" cx=\"" + px(place_px(frame.x, p.x)) + "\" cy=\"" +
                   px(place_px(frame.y, p.y)) + "\" r=\"4\" fill=\"" + colours[index % colour_count] +
                   "\" fill-opacity=\"0.35\"/>\n";
    return out + dots + "</g>\n";
}

struct MarkPlace {
    std::size_t index; ///< of chart.marks
    double left, width;
    std::size_t row; ///< from the plot upwards
};

/// Marks from the left to the right, each in the first row where it is right of all others.
std::vector<MarkPlace> place_marks(const LineChart& chart, const Frame& frame) {
    std::vector<MarkPlace> out;
    for (std::size_t i = 0; i < chart.marks.size(); ++i) {
        if (!is_drawable(chart.marks[i].x)) continue;
        const double limit = frame.plot.right - 2, width = std::min(limit, text_width(chart.marks[i].label, mark_size));
        const double left = place_px(frame.x, chart.marks[i].x) - width / 2;
        out.push_back({i, std::clamp(left, 2.0, limit - width), width, 0});
    }
    std::stable_sort(out.begin(), out.end(), [](const MarkPlace& a, const MarkPlace& b) { return a.left < b.left; });
    std::vector<double> ends;
    for (MarkPlace& mark : out) {
        while (mark.row < ends.size() && ends[mark.row] + 6 > mark.left) ++mark.row;
        if (mark.row == ends.size()) ends.push_back(0);
        ends[mark.row] = mark.left + mark.width;
    }
    return out;
}

std::string draw_marks(const LineChart& chart, const std::vector<MarkPlace>& places, const Frame& frame) {
    std::string out;
    for (const MarkPlace& place : places) {
        const ChartMark& mark = chart.marks[place.index];
        const double x = place_px(frame.x, mark.x), base = frame.plot.top - 4 - note_height * double(place.row);
        out += "<g class=\"mark\"><title>" + xml_text(mark.label) + ": " + short_number(mark.x) + "</title>\n";
        // The line starts at the plot, so that it crosses no label: colour and dashes say which one it belongs to.
        const MarkStyle& style = mark_styles[place.index % std::size(mark_styles)];
        out += svg_line(x, frame.plot.top, x, frame.plot.bottom, style.stroke);
        out += svg_text(place.left + place.width / 2, base, fitted(mark.label, mark_size, place.width),
                        {.size = mark_size, .anchor = Anchor::middle, .colour = style.colour}) +
               "</g>\n";
    }
    return out;
}

/// A short piece of each line and its label, as many beside each other as fit, from `base` downwards. Leaves `base` at the next
/// free base line.
std::string draw_key(const LineChart& chart, double width, double& base) {
    std::string out;
    double x = 14;
    for (std::size_t i = 0; i < chart.series.size(); ++i) {
        const std::string label = fitted(chart.series[i].label, key_size, width - 28 - 30);
        const double needed = 30 + text_width(label, key_size);
        if (x > 14 && x + needed > width - 14) {
            x = 14;
            base += note_height;
        }
        out += svg_line(x, base - 4, x + 24, base - 4, stroke_of(i));
        out += svg_text(x + 30, base, label, {.size = key_size});
        x += needed + 16;
    }
    if (!chart.series.empty()) base += note_height;
    return out;
}

} // namespace

std::string line_chart_svg(const LineChart& chart) {
    FrameText text{chart.title, chart.x_label, chart.y_label, "\xE2\x89\xA4 0", chart.width, chart.height};
    const Axis x = axis_along_x(chart), y = axis_along_y(chart);
    std::size_t rows = 0;
    for (const MarkPlace& mark : place_marks(chart, frame_of(text, x, y))) rows = std::max(rows, mark.row + 1);
    text.height += int(note_height * double(rows));
    const Frame frame = frame_of(text, x, y, note_height * double(rows));

    double base = notes_top(text);
    const double start = base;
    std::string key = draw_key(chart, std::max(200, chart.width), base);
    if (!chart.note.empty()) {
        key += svg_text(14, base, fitted(chart.note, key_size, std::max(200, chart.width) - 28),
                        {.size = key_size, .colour = "#555"});
        base += note_height;
    }
    std::string out = draw_frame(text, frame, base - start);
    out += draw_marks(chart, place_marks(chart, frame), frame);
    if (chart.limit && is_drawable(*chart.limit)) {
        const double y = place_px(frame.y, *chart.limit);
        out += svg_line(frame.plot.left, y, frame.plot.right, y, "stroke=\"#777\" stroke-dasharray=\"2 3\"");
    }
    for (std::size_t i = 0; i < chart.series.size(); ++i) out += draw_series(chart.series[i], i, frame);
    return out + key + "</svg>\n";
}

} // namespace bake
