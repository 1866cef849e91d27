#include "budget_text.h"
#include "bake/base/text.h"

namespace bake {

std::string to_text(const ErrorBudget& budget) {
    return format("error budget (rms): filter %.4f, quantisation %.4f, encoding %.4f, method %.4f deg; within %.4f deg",
                  budget.filter_deg, budget.quantisation_deg, budget.encoding_deg, budget.method_deg, budget.total_deg);
}

nlohmann::json to_json(const ErrorBudget& budget) {
    return {{"filter_deg", budget.filter_deg},     {"quantisation_deg", budget.quantisation_deg},
            {"encoding_deg", budget.encoding_deg}, {"method_deg", budget.method_deg},
            {"total_deg", budget.total_deg},       {"samples", budget.samples}};
}

std::string to_text(const FilterAdvice& advice) {
    return format("--filter %s would be within %.4f deg on this height", std::string(name(advice.filter)).c_str(),
                  advice.total_deg);
}

nlohmann::json to_json(const FilterAdvice& advice) {
    return {{"filter", name(advice.filter)}, {"total_deg", advice.total_deg}};
}

} // namespace bake
