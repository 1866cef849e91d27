// Words for commands that a shell runs.
#pragma once
#include <string>

namespace bake {

/// The word as a POSIX shell reads it back: in quotes unless all of its characters stand for themselves.
std::string shell_word(const std::string& word);

} // namespace bake
