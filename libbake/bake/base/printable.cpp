#include "bake/base/printable.h"
#include <cstdint>

namespace bake {
namespace {

/// A character of UTF-8 and its bytes; no bytes where there is none.
struct Utf8 {
    std::uint32_t code = 0;
    std::size_t bytes = 0;
};

/// The first character of `text`, which is not empty.
Utf8 first_utf8(std::string_view text) noexcept {
    const auto lead = static_cast<unsigned char>(text[0]);
    if (lead < 0x80) return {lead, 1};
    const std::size_t bytes = lead < 0xc2 ? 0 : lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : lead < 0xf5 ? 4 : 0;
    if (bytes == 0 || text.size() < bytes) return {};
    std::uint32_t code = lead & (0x7fu >> bytes);
    for (std::size_t i = 1; i < bytes; ++i) {
        const auto next = static_cast<unsigned char>(text[i]);
        if ((next & 0xc0) != 0x80) return {};
        code = code << 6 | (next & 0x3f);
    }
    const bool overlong = (bytes == 3 && code < 0x800) || (bytes == 4 && code < 0x10000);
    const bool surrogate = code >= 0xd800 && code < 0xe000;
    return overlong || surrogate || code > 0x10ffff ? Utf8{} : Utf8{code, bytes};
}

/// Whether a terminal shows the character in its place and does nothing else.
bool is_plain(std::uint32_t code) noexcept {
    const bool control = code < 0x20 || (code >= 0x7f && code < 0xa0);
    const bool separator = code == 0x2028 || code == 0x2029;
    const bool reorders = code == 0x200e || code == 0x200f || code == 0x61c || (code >= 0x202a && code <= 0x202e) ||
                          (code >= 0x2066 && code <= 0x2069);
    return !control && !separator && !reorders;
}

void append_escape(std::string& out, char byte) {
    const auto code = static_cast<unsigned char>(byte);
    if (byte == '\n') out += "\\n";
    else if (byte == '\t') out += "\\t";
    else if (byte == '\r') out += "\\r";
    else out += {'\\', 'x', "0123456789abcdef"[code >> 4], "0123456789abcdef"[code & 15]};
}

std::string escaped(std::string_view text, bool keep_newlines) {
    std::string out;
    out.reserve(text.size());
    while (!text.empty()) {
        const Utf8 c = first_utf8(text);
        const std::string_view bytes = text.substr(0, c.bytes > 0 ? c.bytes : 1);
        if (c.bytes > 0 && (is_plain(c.code) || (keep_newlines && c.code == '\n'))) out += bytes;
        else
            for (const char byte : bytes) append_escape(out, byte);
        text.remove_prefix(bytes.size());
    }
    return out;
}

} // namespace

std::string printable(std::string_view text) { return escaped(text, false); }
std::string printable_lines(std::string_view text) { return escaped(text, true); }

} // namespace bake
