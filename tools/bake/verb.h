// What every verb of the command shares.
#pragma once
#include "bake/base/error.h"
#include "bake/base/output_file.h"
#include "bake/base/printable.h"
#include "bake/base/progress.h"
#include "inputs/stopwatch.h"
#include "run_report.h"
#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

// CLI11 reads numbers by the locale, and takes NaN, infinity, hexadecimal and octal digits: its own conversion of numbers
// does not compile here. inputs/number_option.h has ours.
template <> CLI::Option* CLI::App::add_option<double>(std::string, double&, std::string) = delete;
template <> CLI::Option* CLI::App::add_option<float>(std::string, float&, std::string) = delete;
template <> CLI::Option* CLI::App::add_option<int>(std::string, int&, std::string) = delete;
template <> CLI::Option* CLI::App::add_option<std::size_t>(std::string, std::size_t&, std::string) = delete;
template <>
CLI::Option* CLI::App::add_option<std::optional<double>>(std::string, std::optional<double>&, std::string) = delete;
template <>
CLI::Option* CLI::App::add_option<std::optional<int>>(std::string, std::optional<int>&, std::string) = delete;

namespace bake {

/// Options that every verb has.
struct CommonArgs {
    int threads = 0;    ///< 0: one per core
    bool quiet = false; ///< no progress, no notes, no result as text
    bool json = false;  ///< one JSON object on stdout instead of text
    OutputSet* outputs; ///< the files that the verb writes, which print_result() makes appear
    RunReport* report;  ///< what is printed under --json when the verb ends
};

/// A verb adds its options to `sub` and returns what to run after parsing: it returns the exit code.
using Verb = std::function<int()>(CLI::App& sub, const CommonArgs& common);

Verb bump_table_verb;
Verb normal_map_verb;
Verb displace_verb;
Verb check_verb;
Verb compare_verb;
Verb plan_verb;
Verb surface_verb;
Verb render_verb;
Verb explain_verb;
Verb cubemap_verb;

/// Adds what a verb's --help ends with.
void add_examples(CLI::App& sub, const std::string& examples);
/// The message with `field`, as the library names a field of its options, replaced by the flag that sets the field.
std::string with_flags(const std::string& message);

// All that the command prints goes through the following functions, which escape what a terminal would obey (printable()
// of base/printable.h).
/// One line on stderr, unless --quiet; under --json among the notes of the object: a note that does not stop the run.
void note(const CommonArgs& common, const std::string& line);
/// One line on stderr: why the run, or a part of it, is refused. Returns the exit code.
int fail(const std::string& message, Refusal why);
/// Text of several lines on stdout. The names in it are printable(), as a newline in a name is not told from its own.
void print_text(const std::string& text);
/// One JSON object on stdout, escaped as JSON does it; bytes that are not UTF-8 become U+FFFD.
void print_json(const nlohmann::ordered_json& object, int indent = 2);
/// Makes the files of a verb appear under their names, all together, and tells its result: under --json the object becomes
/// part of what is printed at the end, else the lines of text are printed unless --quiet, each with the seconds of the steps.
void print_result(const CommonArgs& common, const std::string& text, nlohmann::json object, const Stopwatch& watch);

} // namespace bake
