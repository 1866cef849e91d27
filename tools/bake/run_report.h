// The JSON object that a run prints under --json: what every verb says, and the verb's own.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace bake {

class OutputSet;

/// Collects while the verb runs. docs/json.md and docs/json/*.schema.json say what it becomes.
struct RunReport {
    nlohmann::ordered_json object = nlohmann::ordered_json::object(); ///< the verb's own
    int indent = 2;                                                   ///< -1: all in one line
    std::vector<std::string> notes;                                   ///< as they would be printed
    std::string error;                                                ///< the first reason of a refusal

    /// Adds the notes of the verb's object to its own, and keeps one of each.
    void add_note(const std::string& line);
};

/// The whole object. `words`: the command behind "bake".
nlohmann::ordered_json whole_report(const RunReport& report, const std::vector<std::string>& words,
                                    const std::vector<std::string>& outputs, int code);

} // namespace bake
