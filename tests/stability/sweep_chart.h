// The chart of a sweep as a small SVG: a line per series as measured, dots by the closed form, the limit dotted.
#pragma once
#include "stability/sweep.h"

namespace stability {

std::string chart_svg(const Sweep& sweep, const std::vector<Row>& rows);

} // namespace stability
