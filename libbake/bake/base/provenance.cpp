#include "bake/base/provenance.h"
#include "bake/base/error.h"
#include "bake/base/input_record.h"
#include "bake/base/job.h"
#include "bake/base/version.h"
#include <nlohmann/json.hpp>

namespace bake {
namespace {

using json = nlohmann::ordered_json;

json object_of(const Facts& facts) {
    json object = json::object();
    for (const Fact& fact : facts) std::visit([&](const auto& value) { object[fact.name] = value; }, fact.value);
    return object;
}

json inputs() {
    json list = json::array();
    for (const InputFile& input : recorded_inputs()) {
        if (input.hash.empty())
            throw Error(Refusal::unreadable, input.path + ": was changed while it was read; run the command again");
        list.push_back({{"name", input.name}, {"xxh128", input.hash}});
    }
    return list;
}

/// Of objects and lists in each other: those of ours have three.
constexpr int deepest = 8;

json value_of(const std::string& record, const std::string& name) {
    const json object = json::parse(record, nullptr, false);
    if (!object.is_object() || !object.contains("values") || !object["values"].is_object()) return {};
    const auto found = object["values"].find(name);
    return found == object["values"].end() ? json() : *found;
}

} // namespace

RunRecord::RunRecord(RunDescription run) : run_(std::move(run)), outer_(current_job().run.exchange(&run_)) {}
RunRecord::~RunRecord() { current_job().run = outer_; }

std::string record_text(const Facts& facts) {
    const RunDescription* const run = current_job().run;
    if (!run) return {};
    json object = {{"software", "bake"}, {"version", version()}, {"verb", run->verb}};
    object["options"] = object_of(run->options);
    object["inputs"] = inputs();
    if (!facts.empty()) object["values"] = object_of(facts);
    return object.dump(-1, ' ', true, json::error_handler_t::replace);
}

std::string record_comment(const Facts& facts) {
    const std::string record = record_text(facts);
    return record.empty() ? "" : std::string(record_key) + ' ' + record;
}

std::string valid_record(std::string text) {
    bool deep = false;
    const auto watch = [&deep](int depth, json::parse_event_t, json&) { return !(deep |= depth > deepest); };
    const json object = json::parse(text, watch, false);
    if (deep || !object.is_object()) return {};
    const auto software = object.find("software");
    return software != object.end() && software->is_string() ? text : "";
}

std::string record_in(std::string_view comment) {
    const std::string key = std::string(record_key) + " {";
    return comment.starts_with(key) ? valid_record(std::string(comment.substr(key.size() - 1))) : "";
}

std::string record_word(const std::string& record, const std::string& name) {
    const json value = value_of(record, name);
    return value.is_string() ? value.get<std::string>() : "";
}

std::vector<double> record_numbers(const std::string& record, const std::string& name) {
    const json value = value_of(record, name);
    std::vector<double> out;
    for (const json& one : value.is_array() ? value : json::array({value}))
        if (one.is_number()) out.push_back(one.get<double>());
    return out.size() == (value.is_array() ? value.size() : 1) ? out : std::vector<double>();
}

} // namespace bake
