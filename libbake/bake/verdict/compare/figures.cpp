#include "bake/verdict/compare/figures.h"
#include "bake/base/error.h"
#include "bake/verdict/finding_text.h"
#include <algorithm>

namespace bake {

void add_figures(std::vector<Figure>& figures, const std::string& name, const ErrorSummary& errors) {
    figures.push_back({name, errors.mean});
    figures.push_back({name + "-p95", errors.p95});
    figures.push_back({name + "-p99", errors.p99});
    figures.push_back({name + "-max", errors.max});
}

std::vector<std::string> over_limits(const std::vector<Figure>& figures, const std::vector<Limit>& limits) {
    std::vector<std::string> over;
    for (const Limit& limit : limits) {
        const auto named = [&](const Figure& f) { return f.name == limit.name; };
        const auto figure = std::find_if(figures.begin(), figures.end(), named);
        if (figure == figures.end()) {
            std::string names;
            for (const Figure& f : figures) names += (names.empty() ? "" : ", ") + f.name;
            throw Error(Refusal::usage, "`limit` " + limit.name + ": is not computed here; these are: " + names);
        }
        const bool beyond = figure->higher_is_better ? figure->value < limit.value : figure->value > limit.value;
        if (beyond)
            over.push_back("over the limit: " + limit.name + " is " + number(figure->value) + ", the limit " +
                           (figure->higher_is_better ? "at least " : "") + number(limit.value));
    }
    return over;
}

} // namespace bake
