// Sizes of memory.
#pragma once
#include "verb.h"
#include <cstdint>
#include <optional>

namespace bake {

/// "2G", "1.5GiB", "500M" or bytes. Throws Error{Refusal::usage} that names the flag.
std::uint64_t parse_bytes(const std::string& flag, const std::string& text);
/// Adds --max-memory.
CLI::Option* add_memory_option(CLI::App& sub, std::optional<std::uint64_t>& bytes);
/// "1.2 GiB".
std::string describe_bytes(double bytes);

} // namespace bake
