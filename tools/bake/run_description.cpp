#include "run_description.h"
#include <algorithm>
#include <string_view>

namespace bake {
namespace {

/// Options that name outputs, or that say how a run is made and told.
constexpr std::string_view left_out[] = {
    "help",    "out",      "maps-out", "cage-out", "debug-rays",   "report-map", "roughness-map",
    "report",  "manifest", "threads",  "quiet",    "json",         "max-memory", "time-limit",
    "measure", "audit",    "strict",   "limit",    "preview",      "display",    "pixel",
    "repeats", "csv",      "verify",   "sh",       "preview-size",
};

/// Of every file that the value names, such as "profile=folder/curve.txt,pointed=0", the name alone.
std::string without_folder(const std::string& value) {
    std::string out;
    for (std::size_t begin = 0; begin <= value.size();) {
        const std::size_t end = std::min(value.find_first_of("=,:", begin), value.size());
        const std::string part = value.substr(begin, end - begin);
        out += part.substr(part.find_last_of('/') + 1);
        if (end < value.size()) out += value[end];
        begin = end + 1;
    }
    return out;
}

/// Of an option that belongs to another one, the default counts where that one is given.
std::string value_of(const CLI::Option& option) {
    if (option.count() == 0) {
        for (const CLI::Option* needed : option.get_needs())
            if (needed->count() == 0) return {};
        return option.get_default_str();
    }
    std::string text;
    for (const std::string& value : option.results()) text += (text.empty() ? "" : " ") + without_folder(value);
    return text;
}

} // namespace

RunDescription describe_run(const CLI::App& sub) {
    RunDescription run{sub.get_name(), {}};
    for (const CLI::Option* option : sub.get_options()) {
        std::string name = option->get_single_name();
        if (std::find(std::begin(left_out), std::end(left_out), name) != std::end(left_out)) continue;
        const std::string value = value_of(*option);
        if (value.empty()) continue;
        std::replace(name.begin(), name.end(), '-', '_');
        run.options.push_back({name, value});
    }
    return run;
}

} // namespace bake
