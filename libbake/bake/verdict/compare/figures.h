// The numbers of a comparison that a limit can be set for.
#pragma once
#include "bake/verdict/metric/error_summary.h"
#include <string>
#include <vector>

namespace bake {

struct Figure {
    std::string name;
    double value = 0;
    bool higher_is_better = false;
};

struct Limit {
    std::string name;
    double value = 0;
};

/// NAME, NAME-p95, NAME-p99 and NAME-max, the first being the mean.
void add_figures(std::vector<Figure>& figures, const std::string& name, const ErrorSummary& errors);

/// One warning for each figure that is beyond its limit. Throws Error{Refusal::usage} for a limit of a name that no figure
/// has; the message lists the names.
std::vector<std::string> over_limits(const std::vector<Figure>& figures, const std::vector<Limit>& limits);

} // namespace bake
