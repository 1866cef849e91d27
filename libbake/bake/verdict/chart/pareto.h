// Which of several methods are worth taking: error against cost.
#pragma once
#include <vector>

namespace bake {

struct CostError {
    double cost = 0, error = 0;
};

/// True for each point that no other beats: none has at most its cost and at most its error, and less of one of the two.
/// Equal points are on the front together. Errors of at most `noise` are equal. A point with a NaN is not on the front.
std::vector<bool> pareto_front(const std::vector<CostError>& points, double noise = 0);

} // namespace bake
