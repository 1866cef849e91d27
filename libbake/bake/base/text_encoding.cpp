#include "bake/base/text_encoding.h"
#include "bake/base/parallel.h"
#include <atomic>
#include <cstdint>
#include <cstring>
#include <new>
#include <string>

namespace bake {
namespace {

struct Encoding {
    int width = 1;    ///< bytes of a unit; 1: as it is
    bool big = false; ///< the byte of the highest value first
    int mark = 0;     ///< bytes of the byte order mark
};

Encoding encoding_of(const unsigned char* p, std::size_t size) noexcept {
    const auto begins = [&](const char* bytes, std::size_t n) { return size >= n && std::memcmp(p, bytes, n) == 0; };
    if (begins("\xef\xbb\xbf", 3)) return {1, false, 3};
    if (begins("\xff\xfe\0\0", 4)) return {4, false, 4};
    if (begins("\0\0\xfe\xff", 4)) return {4, true, 4};
    if (begins("\xff\xfe", 2)) return {2, false, 2};
    if (begins("\xfe\xff", 2)) return {2, true, 2};
    if (size < 4) return {};
    const int zeros = (p[0] == 0) | (p[1] == 0) << 1 | (p[2] == 0) << 2 | (p[3] == 0) << 3;
    switch (zeros) {
    case 0b1010: return {2, false, 0};
    case 0b0101: return {2, true, 0};
    case 0b1110: return {4, false, 0};
    case 0b0111: return {4, true, 0};
    default: return {};
    }
}

void append_utf8(std::string& out, std::uint32_t c) {
    if (c < 0x80) {
        out += char(c);
    } else if (c < 0x800) {
        out += {char(0xc0 | c >> 6), char(0x80 | (c & 0x3f))};
    } else if (c < 0x10000) {
        out += {char(0xe0 | c >> 12), char(0x80 | (c >> 6 & 0x3f)), char(0x80 | (c & 0x3f))};
    } else {
        out += {char(0xf0 | c >> 18), char(0x80 | (c >> 12 & 0x3f)), char(0x80 | (c >> 6 & 0x3f)),
                char(0x80 | (c & 0x3f))};
    }
}

std::string to_utf8(const unsigned char* p, const unsigned char* end, const Encoding& encoding) {
    std::string out;
    const std::ptrdiff_t width = encoding.width;
    out.reserve(std::size_t(end - p) / std::size_t(width) + 16);
    const auto unit = [&](const unsigned char* at) {
        std::uint32_t value = 0;
        for (int k = 0; k < encoding.width; ++k) value = value << 8 | at[encoding.big ? k : encoding.width - 1 - k];
        return value;
    };
    for (; end - p >= width; p += width) {
        std::uint32_t c = unit(p);
        const bool high = encoding.width == 2 && c >= 0xd800 && c < 0xdc00;
        const std::uint32_t low = high && end - p >= 2 * width ? unit(p + width) : 0;
        if (low >= 0xdc00 && low < 0xe000) {
            c = 0x10000 + ((c - 0xd800) << 10) + (low - 0xdc00);
            p += width;
        }
        append_utf8(out, c > 0x10ffff || (c >= 0xd800 && c < 0xe000) ? 0xfffd : c);
    }
    return out;
}

} // namespace

void decode_text(FileBytes& file) {
    const auto* const begin = reinterpret_cast<const unsigned char*>(file.begin());
    const Encoding encoding = encoding_of(begin, file.size);
    if (encoding.width == 1) {
        file.size -= std::size_t(encoding.mark);
        if (encoding.mark > 0) std::memmove(file.data.get(), begin + encoding.mark, file.size + 1);
        return;
    }
    const std::string text = to_utf8(begin + encoding.mark, begin + file.size, encoding);
    file.data.reset(static_cast<char*>(std::malloc(text.size() + 1)));
    if (!file.data) throw std::bad_alloc();
    file.size = text.size();
    std::memcpy(file.data.get(), text.data(), file.size);
    file.data[file.size] = '\n';
}

void end_lines_by_newline(FileBytes& file) {
    std::atomic<bool> found = false;
    for_rows(std::int64_t(file.size), std::int64_t(1) << 20, [&](std::int64_t begin, std::int64_t end) {
        const char *p = file.begin() + begin, *const stop = file.begin() + end;
        while (p < stop && (p = static_cast<const char*>(std::memchr(p, '\r', std::size_t(stop - p))))) {
            if (*++p == '\n') continue;
            found = true;
            return;
        }
    });
    if (!found) return;
    for (char* p = file.data.get(); p < file.end(); ++p)
        if (*p == '\r' && p[1] != '\n') *p = '\n';
}

} // namespace bake
