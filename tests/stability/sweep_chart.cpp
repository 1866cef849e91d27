#include "stability/sweep_chart.h"
#include <algorithm>
#include <cmath>
#include <cstdio>

namespace stability {
namespace {

constexpr double width = 460, height = 300, left = 62, right = 12, top = 30, bottom = 42;
constexpr const char* colours[] = {"#1b6ca8", "#c8502d", "#2a8a4a", "#8a4fa3", "#b08900", "#555555", "#d0609a"};

template <class... Values> std::string text(const char* format, Values... values) {
    char line[512];
    std::snprintf(line, sizeof line, format, values...);
    return line;
}

std::string escaped(const std::string& plain) {
    std::string out;
    for (const char c : plain) out += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
    return out;
}

/// A point of the picture.
struct Vec2 {
    double x = 0, y = 0;
};

/// One axis: from values to pixels.
struct Axis {
    bool log = false;
    double decades = 12; ///< that a logarithmic axis shows at most, below its largest value
    double least = 0, most = 0, begin = 0, end = 0;

    bool shows(double value) const { return std::isfinite(value) && (!log || value > 0); }
    double scaled(double value) const { return log ? std::log10(value) : value; }
    double pixel(double value) const {
        const double part = (scaled(value) - least) / (most - least);
        return begin + std::clamp(part, 0.0, 1.0) * (end - begin);
    }
    void include(double value) {
        if (!shows(value)) return;
        least = any ? std::min(least, scaled(value)) : scaled(value);
        most = any ? std::max(most, scaled(value)) : scaled(value);
        any = true;
    }
    /// Widened to whole ticks.
    void close() {
        if (!any) least = 0, most = 1;
        if (log) most = std::ceil(most - 1e-9), least = std::max(std::floor(least + 1e-9), most - decades);
        if (most - least < (log ? 1 : 1e-12)) most = least + 1;
        if (!log) least = step() * std::floor(least / step() + 1e-9), most = step() * std::ceil(most / step() - 1e-9);
    }
    double step() const {
        if (log) return std::max(1.0, std::ceil((most - least) / 6));
        const double rough = (most - least) / 5, power = std::pow(10, std::floor(std::log10(rough)));
        return power * (rough / power < 1.5 ? 1 : rough / power < 3.5 ? 2 : rough / power < 7.5 ? 5 : 10);
    }
    bool any = false;
};

std::string ticks(const Axis& x, const Axis& y) {
    std::string grid, labels;
    const auto label = [](const Axis& axis, double tick) {
        return axis.log ? text("%g", std::pow(10, tick)) : text("%g", std::abs(tick) < 1e-9 * axis.most ? 0.0 : tick);
    };
    for (int axis = 0; axis < 2; ++axis) {
        const Axis& a = axis == 0 ? x : y;
        const double step = a.step();
        for (double tick = step * std::ceil(a.least / step - 1e-9); tick <= a.most + 1e-9 * step; tick += step) {
            const double at = a.begin + (tick - a.least) / (a.most - a.least) * (a.end - a.begin);
            if (axis == 0) {
                grid += text("M%.0f %.0fV%.0f", at, top, height - bottom);
                labels += text("<text x='%.0f' y='%.0f' text-anchor='middle'>%s</text>", at, height - bottom + 14,
                               label(a, tick).c_str());
            } else {
                grid += text("M%.0f %.0fH%.0f", left, at, width - right);
                labels += text("<text x='%.0f' y='%.0f' text-anchor='end'>%s</text>", left - 5, at + 4,
                               label(a, tick).c_str());
            }
        }
    }
    return "<path d='" + grid + "' stroke='#ddd'/>\n" + labels + "\n";
}

std::string curve(const std::vector<Row>& rows, const std::string& series, const Axis& x, const Axis& y,
                  const char* colour) {
    std::string line, dots;
    bool drawn = false;
    for (const Row& row : rows) {
        if (row.series != series || !x.shows(row.x)) continue;
        if (row.predicted && y.shows(*row.predicted))
            dots += text("M%.1f %.1fh0", x.pixel(row.x), y.pixel(*row.predicted));
        if (y.shows(row.measured))
            line += text("%s%.1f %.1f", drawn ? "L" : "M", x.pixel(row.x), y.pixel(row.measured));
        drawn = y.shows(row.measured);
    }
    return text("<g fill='none' stroke='%s'><path d='", colour) + line + "' stroke-width='1.6'/><path d='" + dots +
           "' stroke-width='4.5' stroke-linecap='round' stroke-opacity='.6'/></g>\n";
}

/// The corner with the fewest points of the curves.
Vec2 free_corner(const std::vector<Row>& rows, const Axis& x, const Axis& y, double wide, double tall) {
    Vec2 best;
    std::size_t fewest = rows.size() + 1;
    for (const double at_y : {top, height - bottom - tall - 6})
        for (const double at_x : {left, width - right - wide - 10}) {
            const auto inside = [&](const Row& row) {
                const double px = x.pixel(row.x), py = y.pixel(row.measured);
                return px > at_x && px < at_x + wide + 10 && py > at_y && py < at_y + tall + 6;
            };
            const auto count = std::size_t(std::count_if(rows.begin(), rows.end(), inside));
            if (count < fewest) fewest = count, best = {at_x, at_y};
        }
    return best;
}

std::string legend(const std::vector<std::string>& series, const std::vector<Row>& rows, const Axis& x_axis,
                   const Axis& y_axis) {
    std::string out;
    if (series.size() == 1 && series[0].empty()) return out;
    std::size_t longest = 0;
    for (const std::string& name : series) longest = std::max(longest, name.size());
    const auto [x, first] = free_corner(rows, x_axis, y_axis, 24 + 6 * double(longest), 13 * double(series.size()));
    for (std::size_t i = 0; i < series.size(); ++i) {
        const double y = first + 14 + 13 * double(i);
        out += text("<rect x='%.0f' y='%.0f' width='%.0f' height='13' fill='#fff' fill-opacity='.75'/>", x + 4, y - 10,
                    24 + 6 * double(series[i].size()));
        out += text("<path d='M%.0f %.0fh14' stroke='%s' stroke-width='1.6'/>", x + 6, y - 4, colours[i % 7]);
        out += text("<text x='%.0f' y='%.0f'>", x + 24, y) + escaped(series[i]) + "</text>\n";
    }
    return out;
}

} // namespace

std::string chart_svg(const Sweep& sweep, const std::vector<Row>& rows) {
    Axis x{.log = sweep.log_x, .decades = 400, .begin = left, .end = width - right},
        y{.log = sweep.log_y, .begin = height - bottom, .end = top};
    for (const Row& row : rows) {
        x.include(row.x), y.include(row.measured);
        if (row.predicted) y.include(*row.predicted);
    }
    y.include(sweep.limit);
    x.close(), y.close();
    std::string title = sweep.name;
    std::replace(title.begin(), title.end(), '_', ' ');
    std::string svg =
        text("<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 %.0f %.0f' width='%.0f' height='%.0f' "
             "font-family='sans-serif' font-size='11'>\n<rect width='100%%' height='100%%' fill='#fff'/>\n",
             width, height, width, height);
    svg += text("<text x='%.0f' y='18' font-size='13'>", left) + escaped(title) +
           "<tspan dx='10' font-size='11' fill='#666'>line: measured, dots: closed form</tspan></text>\n";
    svg += ticks(x, y);
    if (y.shows(sweep.limit))
        svg += text("<path d='M%.0f %.1fH%.0f' stroke='#777' stroke-dasharray='2 3'/>\n", left, y.pixel(sweep.limit),
                    width - right);
    const std::vector<std::string> series = series_of(rows);
    for (std::size_t i = 0; i < series.size(); ++i) svg += curve(rows, series[i], x, y, colours[i % 7]);
    svg += legend(series, rows, x, y);
    svg += text("<text x='%.0f' y='%.0f' text-anchor='middle'>", (left + width - right) / 2, height - 8) +
           escaped(sweep.x_label) + "</text>\n";
    svg += text("<text transform='translate(13 %.0f) rotate(-90)' text-anchor='middle'>", (top + height - bottom) / 2) +
           escaped(sweep.y_label) + "</text>\n</svg>\n";
    return svg;
}

} // namespace stability
