// Lines of a text file in memory, whole and in parallel pieces, and the numbers in them.
//
// Every text ends in '\n': functions that take no end stop there.
#pragma once
#include <bit>
#include <cfloat>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace bake {

/// `text` as an error message shows it: in quotes, printable(), at most 40 bytes of it.
std::string shown(std::string_view text);

// These two have no branches, so that the compiler vectorises loops over them.
/// Whether c separates words within a line.
inline bool is_blank(char c) noexcept { return (c == ' ') | ((c >= '\t') & (c <= '\r') & (c != '\n')); }
/// Whether c ends a word: a blank or the end of the line.
inline bool ends_word(char c) noexcept { return (c == ' ') | ((c >= '\t') & (c <= '\r')); }
inline void skip_blanks(const char*& p) noexcept {
    while (is_blank(*p)) ++p;
}

namespace detail {
bool parse_float_slowly(const char*& p, float& value) noexcept;
/// What a decimal number outside the range of its type rounds to: infinity or 0, with its sign.
float round_extreme(std::string_view number) noexcept;
inline constexpr double powers_of_ten[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                           1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
} // namespace detail

/// Reads the decimal number at p and moves p behind it; false, p unmoved, if there is none. The value is the float nearest
/// to the text (ties to even), infinite if the text is too large or says so, NaN if it says so. std::from_chars alone
/// makes the reading of an OBJ take a fifth longer.
///
/// Clinger, How to read floating point numbers accurately, PLDI 1990: digits below 2^53 and a power of ten up to 22
/// are exact in double, so one multiplication or division rounds once. The second rounding, to float, is wrong only
/// where the double lies exactly between two floats (a float midpoint is a double, and rounding is monotone); there,
/// and outside the normal floats, the slow way decides.
inline bool parse_float(const char*& p, float& value) noexcept {
    const char* s = p;
    const bool negative = *s == '-';
    s += negative || *s == '+';
    std::uint64_t digits = 0;
    const char* const whole = s;
    for (unsigned d; (d = unsigned(*s) - '0') < 10; ++s) digits = 10 * digits + d;
    std::int64_t count = s - whole, exponent = 0;
    if (*s == '.') {
        const char* const fraction = ++s;
        for (unsigned d; (d = unsigned(*s) - '0') < 10; ++s) digits = 10 * digits + d;
        exponent = fraction - s;
        count -= exponent;
    }
    if ((*s | 0x20) == 'e') {
        const char* e = s + 1;
        const bool down = *e == '-';
        e += down || *e == '+';
        const char* const first = e;
        std::int64_t power = 0;
        for (unsigned d; (d = unsigned(*e) - '0') < 10; ++e) power = power < 10000 ? 10 * power + d : power;
        if (e == first) return detail::parse_float_slowly(p, value);
        exponent += down ? -power : power;
        s = e;
    }
    const bool exact =
        count >= 1 && count <= 19 && digits <= (std::uint64_t(1) << 53) && exponent >= -22 && exponent <= 22;
    if (!exact) return detail::parse_float_slowly(p, value);
    const double whole_value = double(digits);
    const double d =
        exponent < 0 ? whole_value / detail::powers_of_ten[-exponent] : whole_value * detail::powers_of_ten[exponent];
    const bool between = (std::bit_cast<std::uint64_t>(d) & 0x1fffffffu) == 0x10000000u;
    if (between || (!(d >= FLT_MIN && d <= FLT_MAX) && digits != 0)) return detail::parse_float_slowly(p, value);
    value = float(negative ? -d : d);
    p = s;
    return true;
}

/// Reads the decimal integer at p and moves p behind it; false, p unmoved, if there is none. Beyond 18 digits the value is
/// +-10^18.
inline bool parse_integer(const char*& p, std::int64_t& value) noexcept {
    const char* s = p;
    const bool negative = *s == '-';
    s += negative || *s == '+';
    const char* const first = s;
    std::uint64_t v = 0;
    for (unsigned d; (d = unsigned(*s) - '0') < 10; ++s) v = 10 * v + d;
    if (s == first) return false;
    if (s - first > 18) {
        const char* digit = first;
        while (*digit == '0') ++digit;
        if (s - digit > 18) v = 1000000000000000000u;
    }
    value = negative ? -std::int64_t(v) : std::int64_t(v);
    p = s;
    return true;
}

/// Number of the line that `at` is in, the first being 1.
std::size_t line_number(const char* begin, const char* at) noexcept;

/// Boundaries of pieces of about `grain` bytes of the text [begin, end): pieces + 1 pointers, each at the start of a
/// line that does not continue another. A piece may be empty. end[-1] must be '\n'.
std::vector<const char*> split_lines(const char* begin, const char* end, std::size_t grain);

/// The current line and where the next one starts. Lines that end in a backslash continue in the next line, unless
/// they are comments (# C:\meshes\ is a comment, not a continuation).
struct LineCursor {
    const char* next = nullptr;  ///< start of the next line
    const char* stop = nullptr;  ///< end of the text, behind a '\n'
    const char* at = nullptr;    ///< where the line starts in the file
    const char* begin = nullptr; ///< its text, with continuations joined
    const char* end = nullptr;   ///< the '\n' behind it
    std::string joined;
};

namespace detail {
bool continues(const char* begin, const char* newline) noexcept;
void join_lines(LineCursor& cursor);
} // namespace detail

/// Moves to the next line; false at the end.
inline bool next_line(LineCursor& cursor) {
    if (cursor.next == cursor.stop) return false;
    const auto length = std::size_t(cursor.stop - cursor.next);
    const char* const newline = static_cast<const char*>(std::memchr(cursor.next, '\n', length));
    cursor.at = cursor.begin = cursor.next;
    cursor.end = newline;
    cursor.next = newline + 1;
    // A backslash or a carriage return: the last character of no other line that goes on.
    if (newline != cursor.begin && (newline[-1] == '\\' || newline[-1] == '\r') &&
        detail::continues(cursor.begin, newline))
        detail::join_lines(cursor);
    return true;
}

} // namespace bake
