#include "bake/base/text_line.h"
#include "bake/base/printable.h"
#include <algorithm>
#include <charconv>
#include <limits>

namespace bake {
namespace {

/// The backslash at the end of [begin, newline), or null.
const char* final_backslash(const char* begin, const char* newline) noexcept {
    const char* last = newline;
    if (last > begin && last[-1] == '\r') --last;
    return last > begin && last[-1] == '\\' ? last - 1 : nullptr;
}

const char* find_newline(const char* from, const char* end) noexcept {
    return static_cast<const char*>(std::memchr(from, '\n', std::size_t(end - from)));
}

} // namespace

std::string shown(std::string_view text) {
    constexpr std::size_t most = 40;
    if (text.size() <= most) return "'" + printable(text) + "'";
    std::size_t end = most;
    while (end > most - 4 && (text[end] & 0xc0) == 0x80) --end; // not within a character of UTF-8
    return "'" + printable(text.substr(0, end)) + "...'";
}

float detail::round_extreme(std::string_view number) noexcept {
    const std::size_t e = std::min(number.find_first_of("eE"), number.size());
    const auto point = std::int64_t(std::min(number.find('.'), e));
    const auto first = std::int64_t(number.find_first_of("123456789"));
    std::int64_t power = 0;
    if (e < number.size()) {
        const char* digits = number.data() + e + 1;
        parse_integer(digits, power);
    }
    // The number is 10^magnitude times something between 0.1 and 1.
    const std::int64_t magnitude = point - first + (first > point) + power;
    const float value = magnitude > 0 ? std::numeric_limits<float>::infinity() : 0.0f;
    return number.front() == '-' ? -value : value;
}

bool detail::parse_float_slowly(const char*& p, float& value) noexcept {
    const bool plus = *p == '+'; // std::from_chars takes no plus
    if (plus && p[1] == '-') return false;
    const char* end = p;
    while (!ends_word(*end)) ++end;
    const auto read = std::from_chars(p + plus, end, value);
    if (read.ec == std::errc::invalid_argument) return false;
    if (read.ec != std::errc()) value = round_extreme({p + plus, read.ptr});
    p = read.ptr;
    return true;
}

std::size_t line_number(const char* begin, const char* at) noexcept {
    return 1 + std::size_t(std::count(begin, at, '\n'));
}

std::vector<const char*> split_lines(const char* begin, const char* end, std::size_t grain) {
    const auto size = std::size_t(end - begin);
    const std::size_t pieces = std::max<std::size_t>(1, (size + grain - 1) / grain);
    std::vector<const char*> bounds(pieces + 1, end);
    bounds[0] = begin;
    for (std::size_t i = 1; i < pieces; ++i) {
        const char* from = std::max(bounds[i - 1], begin + i * grain);
        if (from == bounds[i - 1]) {
            bounds[i] = from; // one long line filled the piece before
            continue;
        }
        const char* newline = find_newline(from - 1, end);
        while (newline + 1 < end && final_backslash(begin, newline)) newline = find_newline(newline + 1, end);
        bounds[i] = newline + 1;
    }
    return bounds;
}

bool detail::continues(const char* begin, const char* newline) noexcept {
    const char* first = begin;
    skip_blanks(first);
    return *first != '#' && final_backslash(begin, newline);
}

void detail::join_lines(LineCursor& cursor) {
    cursor.joined.clear();
    const char* begin = cursor.begin;
    const char* newline = cursor.end;
    for (;;) {
        const char* const backslash = final_backslash(begin, newline);
        cursor.joined.append(begin, backslash ? backslash : newline);
        if (!backslash || newline + 1 == cursor.stop) break;
        cursor.joined += ' ';
        begin = newline + 1;
        newline = find_newline(begin, cursor.stop);
    }
    cursor.next = newline + 1;
    cursor.joined += '\n';
    cursor.begin = cursor.joined.data();
    cursor.end = cursor.begin + cursor.joined.size() - 1;
}

} // namespace bake
