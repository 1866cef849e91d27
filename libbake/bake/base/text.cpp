#include "bake/base/text.h"
#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <filesystem>

namespace bake {

std::string format(const char* pattern, ...) {
    va_list values, again;
    va_start(values, pattern);
    va_copy(again, values);
    std::string text(std::size_t(std::max(0, std::vsnprintf(nullptr, 0, pattern, values))), '\0');
    std::vsnprintf(text.data(), text.size() + 1, pattern, again);
    va_end(again);
    va_end(values);
    return text;
}

std::string ending(const std::string& path) {
    std::string text = std::filesystem::path(path).extension().string();
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
    return text;
}

std::string in_binary_units(std::uint64_t bytes, bool up) {
    const char* const units[] = {"KiB", "MiB", "GiB", "TiB", "PiB"};
    double value = double(bytes) / 1024;
    int unit = 0;
    for (; value >= 1000 && unit < 4; ++unit) value /= 1024;
    const double digit = value < 10 ? 100 : value < 100 ? 10 : 1;
    return format("%g ", (up ? std::ceil(value * digit) : std::floor(value * digit)) / digit) + units[unit];
}

} // namespace bake
