#include "bake/verdict/plan/toml_string.h"

namespace bake {

std::string toml_string(std::string_view text) {
    static constexpr char digits[] = "0123456789abcdef";
    std::string out = "\"";
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') out += '\\', out += c;
        else if (byte < 0x20 || byte == 0x7f) out += std::string("\\u00") + digits[byte >> 4] + digits[byte & 15];
        else out += c;
    }
    return out + '"';
}

} // namespace bake
