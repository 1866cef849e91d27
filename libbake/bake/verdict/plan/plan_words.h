// How a plan is told: the numbers and sentences that its text and its page have in common.
#pragma once
#include "bake/verdict/plan/plan.h"
#include <cmath>
#include <string>
#include <vector>

namespace bake::plan_words {

/// "rmse", "flip" or "deg".
const char* unit(Budget::Metric metric) noexcept;
/// An error: four digits behind the point, or "inf".
std::string shown(double value);
/// Whole numbers below a million, then with a unit: "1.05 M".
std::string count(std::int64_t n);
std::string megabytes(std::int64_t bytes);
/// "0.0300 to 0.0330", "at most 0.0031", "exact", or "-" without an error.
std::string interval(const Rung& rung);
/// "0.0080", "<=0.0031" for a bound, or "-".
std::string value(const Rung& rung);
/// "0.0100 (0.0090 to 0.0110)".
std::string estimate(const SquareEstimate& e);
/// The amount of `text` of what is saved, or "... more": less(1, 3, count) is "2".
template <class Text> std::string less(double part, double whole, const Text& text, const std::string& unit = "") {
    const double saved = whole - part;
    return text(std::abs(saved)) + unit + (saved < 0 ? " more" : "");
}

/// "rmse 0.0100 (normal)".
std::string budget_words(const Budget& budget);
/// "true displacement", "the high-poly mesh": what the objects are judged against.
std::string reference_words(const ScenePlan& plan);
/// "front, top; the worst one counts", or "" without cameras.
std::string camera_words(const ScenePlan& plan);
/// Of the model that is shown, be it the reference.
const RungCost& planned_cost(const ObjectPlan& object) noexcept;

struct Line {
    std::string label, text; ///< printable()
};
/// Why the model was chosen, whether that is settled, the worst view, the cheaper and the dearer model.
std::vector<Line> reasons(const ObjectPlan& object, const char* metric);
/// Decisions on textures, sky and lights.
std::vector<Line> part_lines(const ScenePlan& plan);
/// What errors, bytes and milliseconds are, a line each.
std::vector<std::string> definitions(Budget::Metric metric);

} // namespace bake::plan_words
