// Decimal numbers in double. parse_float() of text_line.h is faster.
#pragma once
#include "bake/base/text_line.h"
#include <charconv>
#include <cstdlib>

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
    if (read.ec != std::errc()) value = std::strtod(p, nullptr);
    p = read.ptr;
    return true;
}

} // namespace bake
