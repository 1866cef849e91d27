// Text as TOML writes it.
#pragma once
#include <string>
#include <string_view>

namespace bake {

/// In double quotes, with control characters escaped.
std::string toml_string(std::string_view text);

} // namespace bake
