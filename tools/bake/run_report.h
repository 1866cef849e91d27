// The JSON object that a run prints under --json: what every verb says, and the verb's own.
#pragma once
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace bake {

class OutputSet;

/// Collects while the verb runs. docs/json.md and docs/json/*.schema.json say what it becomes.
struct RunReport {
    nlohmann::ordered_json object = nlohmann::ordered_json::object(); ///< the verb's own
    int indent = 2;                                                   ///< -1: all in one line

    /// Keeps a note as it would be printed, one of each. From any thread.
    void add_note(const std::string& line);
    /// Keeps the first reason of a refusal. From any thread.
    void add_error(const std::string& line);

    std::vector<std::string> notes() const;
    std::string error() const; ///< empty: none

private:
    mutable std::mutex mutex_;
    std::vector<std::string> notes_;
    std::string error_;
};

/// The whole object. `words`: the command behind "bake".
nlohmann::ordered_json whole_report(const RunReport& report, const std::vector<std::string>& words,
                                    const std::vector<std::string>& outputs, int code);

} // namespace bake
