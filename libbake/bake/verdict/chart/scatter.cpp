#include "bake/verdict/chart/scatter.h"
#include "bake/verdict/chart/frame.h"
#include "bake/verdict/chart/svg.h"
#include <algorithm>
#include <numeric>

namespace bake {
namespace {

constexpr double radius = 4.5, label_size = 11, label_height = 13;
constexpr const char* blue = "#1f5fa8";

bool can_draw(const ChartDot& dot) { return is_drawable(dot.cost) && is_drawable(dot.error); }
bool has_bar(const ChartDot& dot) { return is_drawable(dot.error_low) && is_drawable(dot.error_high); }

std::string figures(const ScatterChart& chart, const ChartDot& dot) {
    std::string text =
        chart.x_label + ": " + short_number(dot.cost) + "; " + chart.y_label + ": " + short_number(dot.error);
    if (has_bar(dot)) text += " (" + short_number(dot.error_low) + " to " + short_number(dot.error_high) + ")";
    return text;
}

/// The axis position of an error: those that are noise are zero.
double shown_error(const ScatterChart& chart, double error) { return error <= chart.noise ? 0 : error; }

Axis cost_axis(const ScatterChart& chart) {
    std::vector<double> costs;
    for (const ChartDot& dot : chart.dots)
        if (can_draw(dot)) costs.push_back(dot.cost);
    return axis_of(costs, true);
}

/// A bar that reaches far down would press the dots together: it is followed for a factor of 10, and cut beyond.
Axis error_axis(const ScatterChart& chart) {
    std::vector<double> errors;
    for (const ChartDot& dot : chart.dots) {
        if (!can_draw(dot)) continue;
        errors.push_back(shown_error(chart, dot.error));
        if (errors.back() == 0 || !has_bar(dot)) continue;
        errors.push_back(std::clamp(dot.error_low, dot.error / 10, dot.error));
        errors.push_back(std::max(dot.error_high, dot.error));
    }
    if (chart.limit) errors.push_back(shown_error(chart, *chart.limit));
    return axis_of(errors, true);
}

struct Placed {
    std::size_t index; ///< of chart.dots
    Point2 at;
    bool front;
    Box bar; ///< as wide as its caps; empty if there is none
};

std::vector<Placed> place_dots(const ScatterChart& chart, const Frame& frame) {
    std::vector<CostError> points;
    for (const ChartDot& dot : chart.dots)
        points.push_back(can_draw(dot) ? CostError{dot.cost, dot.error}
                                       : CostError{std::numeric_limits<double>::quiet_NaN(), 0});
    const std::vector<bool> front = pareto_front(points, chart.noise);
    std::vector<Placed> out;
    for (std::size_t i = 0; i < chart.dots.size(); ++i) {
        const ChartDot& dot = chart.dots[i];
        if (!can_draw(dot)) continue;
        const Point2 at{place_px(frame.x, dot.cost), place_px(frame.y, shown_error(chart, dot.error))};
        Box bar;
        if (has_bar(dot) && shown_error(chart, dot.error) > 0) {
            const auto end = [&](double error) {
                const double y = error <= 0 ? frame.plot.bottom : place_px(frame.y, error);
                return std::clamp(y, frame.plot.top, frame.plot.bottom);
            };
            bar = {at.x - 4, std::min(at.y, end(dot.error_high)), at.x + 4, std::max(at.y, end(dot.error_low))};
        }
        out.push_back({i, at, front[i], bar});
    }
    return out;
}

/// Corners of the line along the front: the best error for each cost.
std::vector<Point2> front_line(const std::vector<Placed>& dots) {
    std::vector<Point2> steps;
    for (const Placed& dot : dots)
        if (dot.front) steps.push_back(dot.at);
    std::sort(steps.begin(), steps.end(),
              [](const Point2& a, const Point2& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
    std::vector<Point2> corners;
    for (const Point2& p : steps) {
        if (!corners.empty()) corners.push_back({p.x, corners.back().y});
        corners.push_back(p);
    }
    return corners;
}

std::string draw_front(const std::vector<Point2>& corners) {
    if (corners.size() < 2) return {};
    std::string points;
    for (const Point2& p : corners) points += (points.empty() ? "" : " ") + px(p.x) + "," + px(p.y);
    return "<polyline class=\"front\" fill=\"none\" stroke=\"#8fb4dd\" stroke-width=\"1.5\" points=\"" + points +
           "\"/>\n";
}

std::string draw_limit(const ScatterChart& chart, const Frame& frame) {
    if (!chart.limit || !is_drawable(*chart.limit)) return {};
    const double y = place_px(frame.y, shown_error(chart, *chart.limit));
    return svg_line(frame.plot.left, y, frame.plot.right, y,
                    "class=\"limit\" stroke=\"#b3261e\" stroke-dasharray=\"2 3\"");
}

std::string draw_dot(const ScatterChart& chart, const Placed& dot) {
    const ChartDot& d = chart.dots[dot.index];
    const char* const colour = dot.front ? blue : "#777";
    std::string out = "<g class=\"dot\" data-dot=\"" + std::to_string(dot.index) + "\"><title>" + xml_text(d.label) +
                      ": " + xml_text(figures(chart, d)) + "</title>\n";
    const std::string stroke = std::string("stroke=\"") + colour + "\"";
    if (dot.bar.bottom > dot.bar.top) {
        out += svg_line(dot.at.x, dot.bar.top, dot.at.x, dot.bar.bottom, stroke);
        for (const double y : {dot.bar.top, dot.bar.bottom}) out += svg_line(dot.bar.left, y, dot.bar.right, y, stroke);
    }
    return out + "<circle cx=\"" + px(dot.at.x) + "\" cy=\"" + px(dot.at.y) + "\" r=\"" + px(radius) + "\" " + stroke +
           " stroke-width=\"1.5\" fill=\"" + (dot.front ? colour : "#fff") + "\"/></g>\n";
}

struct Labels {
    std::vector<std::optional<PlacedLabel>> places;
    std::vector<std::size_t> order; ///< place i is that of dot order[i]
};

/// Dots of the front choose first, and then those from the left to the right.
Labels place(const ScatterChart& chart, const std::vector<Placed>& dots, const Frame& frame) {
    Labels out;
    out.order.resize(dots.size());
    std::iota(out.order.begin(), out.order.end(), std::size_t{0});
    std::stable_sort(out.order.begin(), out.order.end(), [&](std::size_t a, std::size_t b) {
        return dots[a].front != dots[b].front ? dots[a].front : dots[a].at.x < dots[b].at.x;
    });
    std::vector<LabelRequest> requests;
    for (const std::size_t i : out.order)
        requests.push_back(
            {dots[i].at, radius + 1, text_width(chart.dots[dots[i].index].label, label_size), label_height});
    std::vector<Box> lines;
    for (const Placed& dot : dots)
        if (dot.bar.bottom > dot.bar.top) lines.push_back(dot.bar);
    const std::vector<Point2> corners = front_line(dots);
    for (std::size_t i = 1; i < corners.size(); ++i) {
        const Point2 &a = corners[i - 1], &b = corners[i];
        lines.push_back(
            {std::min(a.x, b.x) - 1, std::min(a.y, b.y) - 1, std::max(a.x, b.x) + 1, std::max(a.y, b.y) + 1});
    }
    const Box& p = frame.plot;
    out.places = place_labels(requests, {p.left + 2, p.top + 2, p.right - 2, p.bottom - 2}, lines);
    return out;
}

std::string draw_leader(const PlacedLabel& place) {
    if (!place.far) return {};
    return svg_line(place.from.x, place.from.y, place.to.x, place.to.y, "stroke=\"#bbb\" stroke-width=\"0.8\"");
}

/// On a white ground, so that a line beneath does not strike the text through.
std::string draw_label(const ChartDot& dot, bool front, const PlacedLabel& place) {
    const Box& b = place.box;
    std::string out = "<rect x=\"" + px(b.left) + "\" y=\"" + px(b.top) + "\" width=\"" + px(b.right - b.left) +
                      "\" height=\"" + px(b.bottom - b.top) + "\" fill=\"#fff\" fill-opacity=\"0.75\"/>\n";
    // The base line of a text is about a quarter of its height above its lower border.
    return out + svg_text((b.left + b.right) / 2, b.bottom - 3, dot.label,
                          {.size = label_size, .anchor = Anchor::middle, .colour = front ? "#123c6e" : "#555"});
}

} // namespace

std::string scatter_svg(const ScatterChart& chart) {
    FrameText text{chart.title, chart.x_label, chart.y_label, "0", chart.width, chart.height};
    if (chart.noise > 0) text.strip_text = "\xE2\x89\xA4 " + short_number(chart.noise);
    const Frame frame = frame_of(text, cost_axis(chart), error_axis(chart));
    const std::vector<Placed> dots = place_dots(chart, frame);
    const Labels labels = place(chart, dots, frame);

    std::vector<std::string> notes{"Filled, on the line: no other method is both as cheap and as accurate."};
    if (!chart.note.empty()) notes.push_back(chart.note);
    std::string leaders, names;
    for (std::size_t i = 0; i < dots.size(); ++i) {
        const Placed& placed = dots[labels.order[i]];
        const ChartDot& dot = chart.dots[placed.index];
        if (labels.places[i]) {
            leaders += draw_leader(*labels.places[i]);
            names += draw_label(dot, placed.front, *labels.places[i]);
        } else {
            notes.push_back("No room for: " + dot.label + " (" + figures(chart, dot) + ")");
        }
    }
    for (const ChartDot& dot : chart.dots)
        if (!can_draw(dot)) notes.push_back("Not drawn: " + dot.label + " (" + figures(chart, dot) + ")");

    std::string out = draw_frame(text, frame, note_height * double(notes.size()));
    out += draw_limit(chart, frame) + draw_front(front_line(dots));
    out += leaders + names;
    for (const Placed& dot : dots) out += draw_dot(chart, dot);
    return out + draw_notes(text, notes) + "</svg>\n";
}

} // namespace bake
