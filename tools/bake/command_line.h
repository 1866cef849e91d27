// The options of all verbs.
#pragma once
#include "verb.h"

namespace bake {

/// The verbs with all their options: `app` can be looked at, for pages of help, without running anything.
struct CommandLine {
    CommandLine();
    CommandLine(const CommandLine&) = delete;
    CommandLine& operator=(const CommandLine&) = delete;

    /// Reads the words behind "bake" and sets `common` and `chosen`. Returns the exit code where there is nothing to run:
    /// help was asked for and printed, or the words were refused in one line on stderr. Once for each object. Throws
    /// Error{Refusal::usage} for empty words.
    std::optional<int> take(const std::vector<std::string>& words);

    CLI::App app;
    CommonArgs common;
    std::function<int()> chosen; ///< runs the verb with common.outputs; returns the exit code
};

} // namespace bake
