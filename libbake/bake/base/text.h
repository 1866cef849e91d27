// printf into a string, for messages and reports.
#pragma once
#include <string>

namespace bake {

/// At most 1023 characters.
[[gnu::format(printf, 1, 2)]] std::string format(const char* pattern, ...);

} // namespace bake
