#include "budget_text.h"
#include "bake/base/text.h"

namespace bake {

std::string to_text(const ErrorBudget& budget) {
    std::string text = format("error budget (rms): filter %.4f, quantisation %.4f, encoding %.4f, method %.4f deg; ",
                              budget.filter_deg, budget.quantisation_deg, budget.encoding_deg, budget.method_deg);
    if (budget.judged()) text += format("within %.4f deg", budget.total_deg);
    else
        text += format("over %g deg in all: the relief is too steep for its texels to be judged; reduce the amplitude",
                       judged_up_to_deg);
    if (budget.lossy) text += "; without the error of the height's lossy compression";
    return text;
}

nlohmann::json to_json(const ErrorBudget& budget) {
    nlohmann::json json = {{"filter_deg", budget.filter_deg},
                           {"quantisation_deg", budget.quantisation_deg},
                           {"encoding_deg", budget.encoding_deg},
                           {"method_deg", budget.method_deg},
                           {"total_deg", budget.total_deg},
                           {"samples", budget.samples},
                           {"judged", budget.judged()}};
    if (budget.lossy) json["leaves_out"] = "lossy compression of the height";
    return json;
}

nlohmann::json to_json(const MethodError& error, NormalMethod method) {
    nlohmann::json json = {{"largest_deg", error.largest_deg},
                           {"largest_height_x_curvature", error.bend},
                           {"uv", {error.uv.x, error.uv.y}},
                           {"samples", error.samples}};
    if (method == NormalMethod::constant_scale) json.update({{"stretch", error.stretch}, {"skew_deg", error.skew_deg}});
    else json["bound_deg"] = error.bound_deg;
    return json;
}

std::string to_text(const FilterAdvice& advice) {
    return format("--filter %s would be within %.4f deg on this height", std::string(name(advice.filter)).c_str(),
                  advice.total_deg);
}

nlohmann::json to_json(const FilterAdvice& advice) {
    return {{"filter", name(advice.filter)}, {"total_deg", advice.total_deg}};
}

} // namespace bake
