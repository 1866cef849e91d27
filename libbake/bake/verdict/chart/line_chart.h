// A chart of one or more series along an axis, with marks at places of it, as an SVG picture.
#pragma once
#include <optional>
#include <string>
#include <vector>

namespace bake {

struct ChartPoint {
    double x = 0, y = 0;
};

struct LineSeries {
    std::string label;
    std::vector<ChartPoint> points;        ///< joined in this order; one that is not finite interrupts the line
    std::vector<ChartPoint> expected = {}; ///< such as by a closed form: wide pale dots without a line
};

/// A vertical line, such as where a method breaks.
struct ChartMark {
    double x = 0;
    std::string label;
};

struct LineChart {
    std::string title, x_label, y_label; ///< names of the axes with their units
    bool logarithmic_x = false, logarithmic_y = false;
    std::vector<LineSeries> series;
    std::vector<ChartMark> marks;
    std::optional<double> limit;   ///< a dotted line across, such as the error from which on a method is broken
    std::string note;              ///< a line beneath; empty: none
    int width = 560, height = 360; ///< px, without the lines beneath
};

/// One picture. Values up to zero stand in a strip of their own before the start of a logarithmic axis. The labels of marks stand
/// above the plot, in rows so that they do not overlap; those of series beneath it. A label wider than the picture is cut.
std::string line_chart_svg(const LineChart& chart);

} // namespace bake
