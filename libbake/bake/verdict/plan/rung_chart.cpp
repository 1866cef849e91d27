#include "bake/verdict/plan/rung_chart.h"
#include "bake/base/text.h"
#include "bake/verdict/chart/scatter.h"
#include "bake/verdict/plan/plan_words.h"
#include "bake/verdict/plan/rung_words.h"

namespace bake {
namespace {

/// "1 x triangles + 0.01 x bytes"
std::string cost_formula(const CostWeights& weights) {
    std::string text;
    const auto add = [&](double weight, const char* what) {
        if (weight == 0) return;
        text += (text.empty() ? "" : " + ") + (weight == 1 ? "" : format("%g x ", weight)) + what;
    };
    add(weights.triangle, "triangles"), add(weights.byte, "bytes of textures"), add(weights.ms, "ms");
    return text;
}

ChartDot dot_of(const Rung& rung, const CostWeights& weights) {
    ChartDot dot;
    dot.label = name(rung.method), dot.cost = rung.cost.total(weights);
    if (rung.known == Known::bound) {
        dot.label += ", at most";
        dot.error = rung.bound;
    } else {
        dot.error = rung.error.rmse(), dot.error_low = rung.error.low(), dot.error_high = rung.error.high();
    }
    return dot;
}

} // namespace

std::string rung_chart(const ScenePlan& plan, const ObjectPlan& object) {
    ScatterChart chart;
    chart.title = object.object;
    chart.x_label = "cost: " + cost_formula(plan.weights), chart.y_label = plan_words::unit(plan.budget.metric);
    chart.width = 520, chart.height = 300;
    chart.limit = object.budget;
    chart.note = "Dotted: the budget. Bars: two standard errors.";
    const Rung* const chosen = chosen_rung(object);
    for (const Rung& rung : object.rungs) {
        if (rung.known != Known::bound && !has_error(rung)) continue;
        chart.dots.push_back(dot_of(rung, plan.weights));
        if (&rung == chosen) chart.dots.back().label += " (chosen)";
    }
    if (chart.dots.empty()) return {};
    const RungCost& full = object.reference_cost;
    const bool is_shown = chosen && chosen->method.shade == Shade::high; // it is the reference
    if (full.triangles > 0 && !is_shown)
        chart.dots.push_back({name(object.reference) + (chosen ? " (reference)" : " (reference, chosen)"),
                              full.total(plan.weights), object.reference_error});
    return scatter_svg(chart);
}

} // namespace bake
