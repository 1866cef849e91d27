// Decimal numbers in double, whatever the locale is. parse_float() of text_line.h is faster.
#pragma once
#include "bake/base/text_line.h"
#include <charconv>
#include <cmath>
#include <optional>

namespace bake {

/// Reads the decimal number at p and moves p behind it; false, p unmoved, if there is none. A number too small for double is
/// 0, one too large is infinite.
inline bool parse_double(const char*& p, double& value) noexcept {
    const bool plus = *p == '+'; // std::from_chars takes no plus
    if (plus && p[1] == '-') return false;
    const char* end = p;
    while (!ends_word(*end)) ++end;
    const auto read = std::from_chars(p + plus, end, value);
    if (read.ec == std::errc::invalid_argument) return false;
    if (read.ec != std::errc()) value = detail::round_extreme({p + plus, read.ptr});
    p = read.ptr;
    return true;
}

/// The whole of `text` as a decimal number, if it is one and finite: no blanks, no hexadecimal digits, no decimal comma.
inline std::optional<double> parse_finite(std::string_view text) {
    const std::string word = std::string(text) + '\n'; // ends the word
    const char* p = word.data();
    double value = 0;
    if (!parse_double(p, value) || p != word.data() + text.size() || !std::isfinite(value)) return {};
    return value;
}

} // namespace bake
