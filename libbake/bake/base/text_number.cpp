#include "bake/base/text_number.h"
#include <charconv>
#include <cmath>
#include <limits>

namespace bake {
namespace {

/// Whether the number in [p, end), known to be too large or too small for a double, is too large.
bool overflows(const char* p, const char* end) noexcept {
    const char* s = p;
    bool point = false, digit = false;
    std::int64_t magnitude = 0; // of the first digit that is not 0: 1 for units, 0 for tenths
    for (; s < end && *s != 'e' && *s != 'E'; ++s) {
        if (*s == '.') point = true;
        else if (*s != '0') digit = true;
        if (*s == '.') continue;
        if (!point && digit) ++magnitude;
        if (point && !digit) --magnitude;
    }
    std::int64_t power = 0;
    if (s < end) {
        ++s;
        parse_integer(s, power);
    }
    return magnitude + power > 0;
}

} // namespace

bool detail::parse_any_float(const char*& p, float& value) noexcept {
    const char* s = p;
    const bool negative = *s == '-';
    s += negative || *s == '+';
    if (*s == '-' || *s == '+') return false;
    const char* end = s;
    while (!ends_number(*end)) ++end;
    float magnitude = 0;
    const auto read = std::from_chars(s, end, magnitude);
    if (read.ec == std::errc::invalid_argument) return false;
    if (read.ec == std::errc::result_out_of_range) {
        // std::from_chars says the same of 1e99 and of 1e-99.
        double wide = 0;
        if (std::from_chars(s, end, wide).ec != std::errc())
            wide = overflows(s, read.ptr) ? std::numeric_limits<double>::infinity() : 0.0;
        magnitude = float(wide);
    }
    value = negative ? -magnitude : magnitude;
    p = read.ptr;
    return true;
}

} // namespace bake
