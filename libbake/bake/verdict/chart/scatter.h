// A chart of error against cost, one dot per method and setting, as an SVG picture.
#pragma once
#include "bake/verdict/chart/pareto.h"
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace bake {

struct ChartDot {
    std::string label;
    double cost = 0, error = 0;
    /// Ends of the error bar; NaN: none.
    double error_low = std::numeric_limits<double>::quiet_NaN(), error_high = std::numeric_limits<double>::quiet_NaN();
};

struct ScatterChart {
    std::string title, x_label, y_label; ///< names of the axes with their units: "render, s"
    std::vector<ChartDot> dots;
    double noise = 0;              ///< errors up to this one are equal, and stand at the end of the axis
    std::optional<double> limit;   ///< an error that is allowed: a dotted line across
    std::string note;              ///< a line beneath, such as what the bars are; empty: none
    int width = 720, height = 480; ///< px, without the lines beneath
};

/// One picture. Both axes are logarithmic. Zero and negative costs, and errors up to chart.noise, stand in a strip of their own
/// before the axis' start, named "0" or "<= noise". Dots of the Pareto front are filled and joined by a line: the best error
/// that can be had for a cost. A label that finds no place beside its dot, and a dot with a value that is not finite, are listed
/// beneath. Each dot is a <g class="dot" data-dot="INDEX"> with its figures as tooltip.
std::string scatter_svg(const ScatterChart& chart);

} // namespace bake
