// Manual pages, made from the options.
#pragma once
#include <CLI/CLI.hpp>

namespace bake {

/// The page bake(1), for the whole command, or bake-VERB(1), for one of its verbs, as text for man.
std::string man_page(const CLI::App& app);

} // namespace bake
