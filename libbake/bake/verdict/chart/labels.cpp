#include "bake/verdict/chart/labels.h"
#include "bake/base/vec.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

/// Distances between dot and label, px. Labels at the first one stand beside their dot and need no line.
constexpr double rings[] = {3, 14, 26, 40, 56, 74, 94, 116, 140, 164, 180};
/// The right is tried first, then the left, then the diagonals. In sixteenths of a turn, y downwards.
constexpr double directions[] = {0, 8, 14, 2, 10, 6, 12, 4, 15, 1, 9, 7, 13, 3, 11, 5};

/// What a fault of a place costs, in px of distance.
constexpr double line_under_label = 30, crossing = 60;

bool inside(const Box& box, const Box& area) noexcept {
    return box.left >= area.left && box.right <= area.right && box.top >= area.top && box.bottom <= area.bottom;
}

Box dot_box(const LabelRequest& r) noexcept {
    return {r.dot.x - r.radius, r.dot.y - r.radius, r.dot.x + r.radius, r.dot.y + r.radius};
}

/// The label at a direction, its nearest border `distance` from the dot's.
PlacedLabel candidate(const LabelRequest& r, double direction, double distance) noexcept {
    const double c = std::cos(direction * pi / 8), s = std::sin(direction * pi / 8), reach = r.radius + distance;
    const Point2 middle{r.dot.x + c * (reach + r.width / 2), r.dot.y + s * (reach + r.height / 2)};
    PlacedLabel out;
    out.box = {middle.x - r.width / 2, middle.y - r.height / 2, middle.x + r.width / 2, middle.y + r.height / 2};
    out.far = distance > rings[0];
    out.to = {std::clamp(r.dot.x, out.box.left, out.box.right), std::clamp(r.dot.y, out.box.top, out.box.bottom)};
    const double length = std::hypot(out.to.x - r.dot.x, out.to.y - r.dot.y);
    const double part = length > 0 ? std::min(1.0, r.radius / length) : 0;
    out.from = {r.dot.x + part * (out.to.x - r.dot.x), r.dot.y + part * (out.to.y - r.dot.y)};
    return out;
}

struct Placing {
    const std::vector<LabelRequest>& requests;
    const std::vector<Box>& lines;
    Box area;
    std::vector<std::optional<PlacedLabel>> placed;

    bool is_free(const Box& box) const {
        return inside(box, area) &&
               std::none_of(requests.begin(), requests.end(),
                            [&](const LabelRequest& r) { return overlap(dot_box(r), box); }) &&
               std::none_of(placed.begin(), placed.end(), [&](const auto& p) { return p && overlap(p->box, box); });
    }

    double faults(const PlacedLabel& label, std::size_t own) const {
        double sum = 0;
        for (const Box& line : lines)
            if (overlap(line, label.box)) sum += line_under_label;
        for (const auto& p : placed) {
            if (!p) continue;
            if (p->far && crosses(label.box, p->from, p->to)) sum += crossing;
            if (label.far && crosses(p->box, label.from, label.to)) sum += crossing;
        }
        for (std::size_t i = 0; label.far && i < requests.size(); ++i)
            if (i != own && crosses(dot_box(requests[i]), label.from, label.to)) sum += crossing;
        return sum;
    }

    std::optional<PlacedLabel> best(std::size_t own) const {
        std::optional<PlacedLabel> best;
        double least = 0;
        for (const double distance : rings) {
            if (best && least <= distance) break; // what follows is farther
            for (const double direction : directions) {
                const PlacedLabel label = candidate(requests[own], direction, distance);
                if (!is_free(label.box)) continue;
                const double cost = distance + faults(label, own);
                if (best && cost >= least) continue;
                best = label;
                least = cost;
            }
        }
        return best;
    }
};

} // namespace

bool overlap(const Box& a, const Box& b) noexcept {
    return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}

// Liang and Barsky, A New Concept and Method for Line Clipping, 1984: the part of the line within each pair of sides.
bool crosses(const Box& box, const Point2& from, const Point2& to) noexcept {
    double begin = 0, end = 1;
    const auto clip = [&](double start, double step, double low, double high) {
        if (step == 0) return low < start && start < high;
        const double a = (low - start) / step, b = (high - start) / step;
        begin = std::max(begin, std::min(a, b));
        end = std::min(end, std::max(a, b));
        return begin < end;
    };
    return clip(from.x, to.x - from.x, box.left, box.right) && clip(from.y, to.y - from.y, box.top, box.bottom);
}

std::vector<std::optional<PlacedLabel>> place_labels(const std::vector<LabelRequest>& requests, const Box& area,
                                                     const std::vector<Box>& lines) {
    Placing placing{requests, lines, area, {}};
    placing.placed.resize(requests.size());
    for (std::size_t i = 0; i < requests.size(); ++i) placing.placed[i] = placing.best(i);
    return placing.placed;
}

} // namespace bake
