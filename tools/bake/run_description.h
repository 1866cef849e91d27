// What the files of a run say of it.
#pragma once
#include "bake/base/provenance.h"
#include <CLI/CLI.hpp>

namespace bake {

/// The verb of a parsed command line, and its options that affect the result, with their defaults: names in snake_case,
/// values as they were given, files without their folders.
RunDescription describe_run(const CLI::App& sub);

} // namespace bake
