#include "bake/verdict/plan/high_words.h"
#include "bake/base/text.h"
#include "bake/verdict/plan/plan_words.h"
#include "bake/verdict/plan/rung_words.h"

namespace bake {

std::string why_of_high(const Rung& rung, const CostInput& cost, Budget::Metric metric) {
    const Shade shade = rung.method.shade;
    if (shade == Shade::high) return "high is needed: no cheaper model is within the budget";
    std::string text = name(rung.method) + " is enough: " + plan_words::count(cost.triangles);
    text += cost.triangles == 1 ? " triangle" : " triangles";
    text += shade == Shade::normal ? format(" with a normal map of %d x %d texels", cost.width, cost.height)
                                   : " without the detail";
    if (has_error(rung)) text += std::string(" differ by ") + plan_words::unit(metric) + " " + plan_words::value(rung);
    else text += " differ by no more than the budget";
    return text + " from the high-poly mesh of " + plan_words::count(cost.high);
}

} // namespace bake
