#include "stability/sweep_chart.h"
#include "bake/verdict/chart/line_chart.h"
#include <algorithm>
#include <cmath>

namespace stability {
namespace {

/// Errors below this share of the largest value are drawn there: rounding would take most of the chart.
constexpr double least_share = 1e-12;

double largest_of(const Sweep& sweep, const std::vector<Row>& rows) {
    double largest = sweep.limit;
    for (const Row& row : rows)
        for (const double value : {row.measured, row.predicted.value_or(0)})
            if (std::isfinite(value)) largest = std::max(largest, value);
    return largest;
}

} // namespace

std::string chart_svg(const Sweep& sweep, const std::vector<Row>& rows) {
    bake::LineChart chart{.title = sweep.name,
                          .x_label = sweep.x_label,
                          .y_label = sweep.y_label,
                          .logarithmic_x = sweep.log_x,
                          .logarithmic_y = sweep.log_y,
                          .limit = sweep.limit,
                          .note = "line: measured; pale dots: closed form; dotted: limit",
                          .width = 460,
                          .height = 300};
    std::replace(chart.title.begin(), chart.title.end(), '_', ' ');
    const double least = sweep.log_y ? least_share * largest_of(sweep, rows) : -HUGE_VAL;
    const std::vector<std::string> names = series_of(rows);
    for (const std::string& name : names) {
        bake::LineSeries series{.label = name.empty() ? "measured" : name};
        for (const Row& row : rows) {
            if (row.series != name) continue;
            series.points.push_back({row.x, std::fmax(row.measured, least)});
            if (std::isnan(row.measured)) series.points.back().y = row.measured;
            if (row.predicted) series.expected.push_back({row.x, std::fmax(*row.predicted, least)});
        }
        chart.series.push_back(std::move(series));
    }
    return bake::line_chart_svg(chart);
}

} // namespace stability
