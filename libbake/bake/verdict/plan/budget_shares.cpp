#include "bake/verdict/plan/budget_shares.h"
#include <algorithm>
#include <cmath>
#include <limits>

namespace bake {
namespace {

/// Squared error over all objects that is left, of each camera.
std::vector<double> left_over(std::span<const SharingObject> objects, std::span<const int> taken, double budget) {
    std::vector<double> left;
    for (std::size_t i = 0; i < objects.size(); ++i)
        for (std::size_t camera = 0; camera < objects[i].area.size(); ++camera) {
            if (left.size() <= camera) left.push_back(0);
            const double square = objects[i].options[std::size_t(taken[i])].square;
            left[camera] += objects[i].area[camera] * (budget * budget - square);
        }
    return left;
}

struct Step {
    int object = -1, option = 0;
    double saved_per_error = 0;
};

/// Whether the frame can bear an option instead of the one that is taken.
bool fits(const SharingObject& object, double added, std::span<const double> left) noexcept {
    for (std::size_t camera = 0; camera < object.area.size(); ++camera)
        if (object.area[camera] * added > left[camera]) return false;
    return true;
}

} // namespace

std::vector<int> share_budget(std::span<const SharingObject> objects, double budget) {
    std::vector<int> taken(objects.size(), 0);
    for (;;) {
        const std::vector<double> left = left_over(objects, taken, budget);
        Step best;
        for (std::size_t i = 0; i < objects.size(); ++i) {
            const SharingObject& object = objects[i];
            const ShareOption& now = object.options[std::size_t(taken[i])];
            const double area = object.area.empty() ? 0 : *std::max_element(object.area.begin(), object.area.end());
            for (int k = taken[i] + 1; k < int(object.options.size()); ++k) {
                const ShareOption& option = object.options[std::size_t(k)];
                const double saved = now.cost - option.cost, added = option.square - now.square;
                if (!(saved > 0) || option.square > most_share * budget * budget || !fits(object, added, left))
                    continue;
                const double ratio =
                    added * area > 0 ? saved / (added * area) : std::numeric_limits<double>::infinity();
                if (best.object < 0 || ratio > best.saved_per_error) best = {int(i), k, ratio};
            }
        }
        if (best.object < 0) return taken;
        taken[std::size_t(best.object)] = best.option;
    }
}

} // namespace bake
