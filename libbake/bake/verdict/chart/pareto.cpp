#include "bake/verdict/chart/pareto.h"
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace bake {

// In the order of cost, then error: a point is on the front if its error is below that of every cheaper point, and the least
// among those of its own cost.
std::vector<bool> pareto_front(const std::vector<CostError>& points, double noise) {
    const auto error = [&](std::size_t i) { return std::max(noise, points[i].error); };
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (!std::isnan(points[i].cost) && !std::isnan(points[i].error)) order.push_back(i);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return points[a].cost < points[b].cost || (points[a].cost == points[b].cost && error(a) < error(b));
    });
    std::vector<bool> front(points.size());
    std::size_t last = 0; // the last point of the front, once there is one
    bool any = false;
    for (const std::size_t i : order) {
        if (any && !(error(i) < error(last)) && !(error(i) == error(last) && points[i].cost == points[last].cost))
            continue;
        front[i] = true;
        last = i;
        any = true;
    }
    return front;
}

} // namespace bake
