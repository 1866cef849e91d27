// Sizes: "N" or "WxH".
#pragma once
#include "verb.h"
#include <optional>
#include <utility>

namespace bake {

/// Width and height from 1 to `most`. Throws Error{Refusal::usage} that names the flag.
std::pair<int, int> parse_size(const std::string& flag, const std::string& text, int most = 65536);
CLI::Option* add_size_option(CLI::App& sub, std::optional<std::pair<int, int>>& size, const std::string& help,
                             int most = 65536, const std::string& flag = "--size");

} // namespace bake
