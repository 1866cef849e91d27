// Text for messages and reports, and the endings of file names.
#pragma once
#include <cstdint>
#include <string>

namespace bake {

/// printf into a string of at most 1023 characters.
[[gnu::format(printf, 1, 2)]] std::string format(const char* pattern, ...);

/// The ending of a file's name in lower case, with its dot: ".png" for "a/B.PNG". Empty if the name has none.
std::string ending(const std::string& path);

/// "1.21 GiB": to three digits, up or down, so that a need above a limit is not printed as the limit.
std::string in_binary_units(std::uint64_t bytes, bool up);

} // namespace bake
