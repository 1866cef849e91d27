// All that the command prints: on the streams of the process, or as the current job has it.
#include "bake/base/job.h"
#include "bake/base/text.h"
#include "verb.h"
#include <cstdio>

namespace bake {
namespace {

void print_line(const std::string& message) {
    const std::string line = "bake: " + printable(with_flags(message)) + "\n";
    const Job& job = current_job();
    if (job.hears) job.hears(line);
    if (job.tell) return job.tell(line);
    const char* const wipe = draws_on_terminal() ? "\r\033[K" : ""; // a bar that is drawn there
    std::fprintf(stderr, "%s%s", wipe, line.c_str());
}

void print(const std::string& text) {
    const Job& job = current_job();
    if (job.print) job.print(text);
    else std::fputs(text.c_str(), stdout);
}

} // namespace

void note(const CommonArgs& common, const std::string& line) {
    if (line.empty()) return;
    if (common.json) common.report->add_note(with_flags(line));
    else if (!common.quiet) print_line(line);
}

int fail(const std::string& message, Refusal why) {
    print_line(message);
    return int(why);
}

void print_text(const std::string& text) { print(printable_lines(text)); }

void print_json(const nlohmann::ordered_json& object, int indent) {
    const auto dump = [&](bool ascii) {
        return object.dump(indent, ' ', ascii, nlohmann::ordered_json::error_handler_t::replace);
    };
    std::string text = dump(false);
    if (printable_lines(text) != text) text = dump(true); // as \u009b
    print(text + "\n");
}

void print_result(const CommonArgs& common, const std::string& text, nlohmann::json object, const Stopwatch& watch) {
    common.outputs->commit();
    if (common.json) {
        object["seconds"] = watch.to_json();
        common.report->object = std::move(object);
    } else if (!common.quiet) {
        print_text(text + watch.to_text() + "\n");
    }
}

} // namespace bake
