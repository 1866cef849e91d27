// What every verb of the command shares.
#pragma once
#include "bake/base/error.h"
#include "bake/base/output_file.h"
#include "bake/base/progress.h"
#include "inputs/stopwatch.h"
#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

namespace bake {

/// Options that every verb has.
struct CommonArgs {
    int threads = 0;    ///< 0: one per core
    bool quiet = false; ///< no progress, no notes, no result as text
    bool json = false;  ///< one JSON object on stdout instead of text
    OutputSet* outputs; ///< the files that the verb writes, which print_result() makes appear
};

/// A verb adds its options to `sub` and returns what to run after parsing: it returns the exit code.
using Verb = std::function<int()>(CLI::App& sub, const CommonArgs& common);

Verb bump_table_verb;
Verb normal_map_verb;
Verb displace_verb;
Verb check_verb;
Verb surface_verb;
Verb render_verb;
Verb explain_verb;
Verb cubemap_verb;

/// Adds what a verb's --help ends with.
void add_examples(CLI::App& sub, const std::string& examples);
/// The message with `field`, as the library names a field of its options, replaced by the flag that sets the field.
std::string with_flags(const std::string& message);
/// One line on stderr, unless --quiet or --json (the object says it): a note that does not stop the run.
void note(const CommonArgs& common, const std::string& line);
/// Makes the files of a verb appear under their names, all together, and prints its result on stdout: the object under --json, else the lines of text unless --quiet, each
/// with the seconds of the steps.
void print_result(const CommonArgs& common, const std::string& text, nlohmann::json object, const Stopwatch& watch);

} // namespace bake
