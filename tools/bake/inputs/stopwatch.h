// Seconds of the steps of a run.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace bake {

class Stopwatch {
public:
    Stopwatch();
    /// Ends a step. The seconds of steps of one name add up.
    void lap(const std::string& step);
    /// Of the step of this name; 0 if there was none.
    double seconds(const std::string& step) const;
    double total() const;
    /// Since the last lap, or since the beginning.
    double elapsed() const;
    /// The steps in order, with their seconds.
    std::string to_text() const;
    nlohmann::json to_json() const;

private:
    double last_;
    std::vector<std::pair<std::string, double>> laps_;
};

} // namespace bake
