#include "batch_report.h"
#include "bake/base/text.h"
#include <map>

namespace bake {
namespace {

using Result = TaskReport::Result;

constexpr const char* words[] = {"unchanged", "done", "failed", "skipped", "interrupted"};

nlohmann::ordered_json object_of(const std::vector<BatchTask>& tasks, const std::vector<TaskReport>& reports,
                                 const char* done) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < tasks.size(); ++i) {
        const TaskReport& report = reports[i];
        nlohmann::ordered_json one = {{"name", tasks[i].name},
                                      {"result", report.result == Result::done ? done : words[int(report.result)]},
                                      {"why", report.why},
                                      {"outputs", tasks[i].outputs}};
        if (report.result == Result::failed) one["code"] = report.code, one["message"] = report.message;
        if (!report.notes.empty()) one["notes"] = report.notes;
        if (report.seconds > 0) one["seconds"] = report.seconds;
        list.push_back(std::move(one));
    }
    return list;
}

/// Each note once, under the first of the tasks that told it.
void print_notes(const CommonArgs& common, const std::vector<BatchTask>& tasks,
                 const std::vector<TaskReport>& reports) {
    struct Told {
        std::size_t first, count;
    };
    std::map<std::string, Told> told;
    std::vector<std::string> in_order;
    for (std::size_t i = 0; i < tasks.size(); ++i)
        for (const std::string& line : reports[i].notes)
            if (const auto [known, fresh] = told.try_emplace(line, Told{i, 0}); ++known->second.count, fresh)
                in_order.push_back(line);
    for (const std::string& line : in_order) {
        const auto [first, count] = told.at(line);
        note(common, tasks[first].name + ": " + line +
                         (count > 1 ? "; so in " + std::to_string(count) + " tasks" : std::string()));
    }
}

/// "3 done, 1 failed, 96 unchanged".
std::string counts_of(const std::vector<TaskReport>& reports, const char* done) {
    std::map<Result, std::size_t> counts;
    for (const TaskReport& report : reports) ++counts[report.result];
    std::string text;
    for (const Result result : {Result::done, Result::failed, Result::skipped, Result::interrupted, Result::unchanged})
        if (const std::size_t count = counts[result]; count > 0)
            text += (text.empty() ? "" : ", ") + std::to_string(count) + " " +
                    (result == Result::done ? done : words[int(result)]);
    return text.empty() ? "no tasks" : text;
}

} // namespace

void print_plan(const CommonArgs& common, const std::string& manifest, const std::vector<BatchTask>& tasks,
                const std::vector<TaskReport>& plan, const Stopwatch& watch) {
    std::string text;
    for (std::size_t i = 0; i < tasks.size(); ++i)
        if (plan[i].result == Result::done) text += printable(tasks[i].name) + ": " + printable(plan[i].why) + "\n";
    print_result(common, text + printable(manifest) + ": " + counts_of(plan, "to run") + "\n",
                 {{"manifest", manifest}, {"tasks", object_of(tasks, plan, "to run")}}, watch);
}

nlohmann::ordered_json emitted_object(const std::string& manifest, const std::vector<BatchTask>& tasks,
                                      const std::string& text) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const BatchTask& task : tasks) list.push_back({{"name", task.name}, {"outputs", task.outputs}});
    nlohmann::ordered_json object = {{"manifest", manifest}, {"tasks", std::move(list)}};
    if (!text.empty()) object["text"] = text;
    return object;
}

void print_reports(const CommonArgs& common, const std::string& manifest, const std::vector<BatchTask>& tasks,
                   const std::vector<TaskReport>& reports, const Stopwatch& watch) {
    constexpr std::size_t most_rows = 50;
    std::size_t rows = 0;
    for (const TaskReport& report : reports) rows += report.result == Result::done;
    std::string text;
    for (std::size_t i = 0; i < tasks.size(); ++i) {
        const TaskReport& report = reports[i];
        if (report.result == Result::unchanged || (report.result == Result::done && rows > most_rows)) continue;
        text += format("%-12s %8.2f s  ", words[int(report.result)], report.seconds) + printable(tasks[i].name);
        text += report.why.empty() ? "\n" : "  (" + printable(report.why) + ")\n";
    }
    if (!common.json) print_notes(common, tasks, reports);
    for (std::size_t i = 0; i < tasks.size(); ++i)
        if (reports[i].result == Result::failed)
            fail(tasks[i].name + ": " + reports[i].message, Refusal(reports[i].code));
    print_result(common, text + printable(manifest) + ": " + counts_of(reports, "done") + "\n",
                 {{"manifest", manifest}, {"tasks", object_of(tasks, reports, "done")}}, watch);
}

} // namespace bake
