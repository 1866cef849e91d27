// Numbers in text, fast and correctly rounded.
//
// Text must end in '\n' (or another character no number has) before memory does: no function looks for an end.
#pragma once
#include <bit>
#include <cfloat>
#include <cstdint>

namespace bake {

// Without branches, so that loops over them become vectors.
/// What separates numbers within a line.
inline bool is_blank(char c) noexcept { return (c == ' ') | ((c >= '\t') & (c <= '\r') & (c != '\n')); }
/// What may follow a number.
inline bool ends_number(char c) noexcept { return (c == ' ') | ((c >= '\t') & (c <= '\r')); }
inline void skip_blanks(const char*& p) noexcept {
    while (is_blank(*p)) ++p;
}

namespace detail {
bool parse_any_float(const char*& p, float& value) noexcept;
inline constexpr double powers_of_ten[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                           1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
} // namespace detail

/// Reads the decimal number at p and moves p behind it; false, p unmoved, where there is none. The value is the float
/// nearest to the text (ties to even), infinite where the text is too large or says so, NaN where it says so.
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
        if (e == first) return detail::parse_any_float(p, value);
        exponent += down ? -power : power;
        s = e;
    }
    const bool exact =
        count >= 1 && count <= 19 && digits <= (std::uint64_t(1) << 53) && exponent >= -22 && exponent <= 22;
    if (!exact) return detail::parse_any_float(p, value);
    const double whole_value = double(digits);
    const double d =
        exponent < 0 ? whole_value / detail::powers_of_ten[-exponent] : whole_value * detail::powers_of_ten[exponent];
    const bool between = (std::bit_cast<std::uint64_t>(d) & 0x1fffffffu) == 0x10000000u;
    if (between || (!(d >= FLT_MIN && d <= FLT_MAX) && digits != 0)) return detail::parse_any_float(p, value);
    value = float(negative ? -d : d);
    p = s;
    return true;
}

/// Reads the decimal integer at p and moves p behind it; false, p unmoved, where there is none. Beyond 18 digits the
/// value is +-10^18.
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

} // namespace bake
