#include "bake/verdict/plan/budget.h"
#include "bake/base/error.h"
#include "bake/base/parse_double.h"
#include <limits>
#include <optional>
#include <utility>

namespace bake {
namespace {

constexpr std::pair<std::string_view, double> names[] = {{"strict", 0.005}, {"normal", 0.01}, {"loose", 0.02}};
constexpr std::pair<std::string_view, Budget::Metric> metrics[] = {
    {"rmse", Budget::Metric::rmse}, {"flip", Budget::Metric::flip}, {"deg", Budget::Metric::degrees}};

[[noreturn]] void refuse(const std::string& word, const std::string& why) {
    throw Error(Refusal::usage, "`budget` " + word + ": " + why);
}

std::optional<double> value_of(const std::string& text) {
    if (text == "inf") return std::numeric_limits<double>::infinity();
    const auto value = parse_finite(text);
    return value && *value >= 0 ? value : std::nullopt;
}

} // namespace

Budget parse_budget(const std::string& word) {
    for (const auto& [name, value] : names)
        if (name == word) return {.metric = Budget::Metric::rmse, .value = value, .name = word};
    const std::size_t equals = word.find('=');
    for (const auto& [name, metric] : metrics) {
        if (word.substr(0, equals) != name || equals == std::string::npos) continue;
        const auto value = value_of(word.substr(equals + 1));
        if (!value) refuse(word, "is not a number from 0 up, or inf; write such as " + std::string(name) + "=0.01");
        return {.metric = metric, .value = *value, .name = word};
    }
    refuse(word, "is not a budget; write strict, normal, loose, rmse=0.01, flip=0.02 or deg=1");
}

} // namespace bake
