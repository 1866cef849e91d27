// The error budget of a bake as text for people and as JSON for programs.
#pragma once
#include "bake/relief/map/method_error.h"
#include <nlohmann/json.hpp>
#include <string>

namespace bake {

std::string to_text(const ErrorBudget& budget);
nlohmann::json to_json(const ErrorBudget& budget);
/// What is known of the method's error, for the methods other than exact.
nlohmann::json to_json(const MethodError& error, NormalMethod method);
std::string to_text(const FilterAdvice& advice);
nlohmann::json to_json(const FilterAdvice& advice);

} // namespace bake
