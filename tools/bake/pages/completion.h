// Scripts by which shells complete verbs, options and the words that options take, made from the options.
#pragma once
#include <CLI/CLI.hpp>

namespace bake {

/// For "bash", "zsh" or "fish". Throws Error{Refusal::usage} for another shell.
std::string completion(const CLI::App& app, const std::string& shell);

} // namespace bake
