// Base64 (RFC 4648, section 4), for binary parts of text files.
#pragma once
#include <string>
#include <string_view>

namespace bake {

/// With padding, without line breaks.
std::string base64(std::string_view bytes);

} // namespace bake
