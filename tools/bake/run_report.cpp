#include "run_report.h"
#include "bake/base/input_record.h"
#include "bake/base/memory.h"
#include "bake/base/version.h"
#include <algorithm>

namespace bake {
namespace {

using Json = nlohmann::ordered_json;

/// "surface_tangents_raster" for "surface, tangents, raster".
std::string snake_case(const std::string& name) {
    std::string out;
    for (const char c : name) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
        if (plain) out += c;
        else if (!out.empty() && out.back() != '_') out += '_';
    }
    return out;
}

/// Of the steps that the verb told, and their sum.
Json seconds_of(const Json& own) {
    Json out = Json::object();
    double total = 0;
    if (own.is_object())
        for (const auto& [step, seconds] : own.items()) {
            out[snake_case(step)] = seconds;
            total += seconds.get<double>();
        }
    out["total"] = total;
    return out;
}

Json inputs() {
    Json list = Json::array();
    for (const InputFile& input : recorded_inputs()) {
        list.push_back({{"file", input.path}});
        if (!input.hash.empty()) list.back()["xxh128"] = input.hash;
    }
    return list;
}

Json texts_of(const Json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_array() ? *found : Json::array();
}

void add_new(std::vector<std::string>& lines, const std::string& line) {
    if (std::find(lines.begin(), lines.end(), line) == lines.end()) lines.push_back(line);
}

} // namespace

void RunReport::add_note(const std::string& line) {
    const std::lock_guard lock(mutex_);
    add_new(notes_, line);
}

void RunReport::add_error(const std::string& line) {
    const std::lock_guard lock(mutex_);
    if (error_.empty()) error_ = line;
}

std::vector<std::string> RunReport::notes() const {
    const std::lock_guard lock(mutex_);
    return notes_;
}

std::string RunReport::error() const {
    const std::lock_guard lock(mutex_);
    return error_;
}

Json whole_report(const RunReport& report, const std::vector<std::string>& words,
                  const std::vector<std::string>& outputs, int code) {
    std::vector<std::string> argv = {"bake"};
    argv.insert(argv.end(), words.begin(), words.end());
    Json whole = {{"verb", words.empty() ? "" : words[0]}, {"version", version()}, {"argv", argv}, {"exit_code", code}};
    if (const std::string error = report.error(); !error.empty()) whole["error"] = error;
    whole["inputs"] = inputs();
    whole["outputs"] = outputs;
    const Json& own = report.object;
    whole["seconds"] = seconds_of(own.contains("seconds") ? own["seconds"] : Json());
    whole["memory"] = {{"peak_bytes", peak_memory()}};
    std::vector<std::string> notes = report.notes();
    for (const Json& line : texts_of(own, "notes")) add_new(notes, line.get<std::string>());
    whole["notes"] = notes;
    whole["warnings"] = texts_of(own, "warnings");
    for (const auto& [key, value] : own.items())
        if (!whole.contains(key)) whole[key] = value;
    return whole;
}

} // namespace bake
