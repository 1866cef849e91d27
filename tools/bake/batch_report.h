// What bake batch prints.
#pragma once
#include "bake/batch/schedule.h"
#include "verb.h"

namespace bake {

/// What would run and why, one line each, and the number of those that are unchanged.
void print_plan(const CommonArgs& common, const std::string& manifest, const std::vector<BatchTask>& tasks,
                const std::vector<TaskReport>& plan, const Stopwatch& watch);
/// A table of the tasks that were run or not reached, then their numbers; what they told, and the reasons of failures, on
/// stderr. Of many tasks the table has those alone that are not done.
void print_reports(const CommonArgs& common, const std::string& manifest, const std::vector<BatchTask>& tasks,
                   const std::vector<TaskReport>& reports, const Stopwatch& watch);

/// What --emit prints under --json. `text`: of the format, empty if it went to a file.
nlohmann::ordered_json emitted_object(const std::string& manifest, const std::vector<BatchTask>& tasks,
                                      const std::string& text);

} // namespace bake
