#include "bake/base/text.h"
#include <cstdarg>
#include <cstdio>
#include <filesystem>

namespace bake {

std::string format(const char* pattern, ...) {
    char buffer[1024];
    va_list values;
    va_start(values, pattern);
    std::vsnprintf(buffer, sizeof buffer, pattern, values);
    va_end(values);
    return buffer;
}

std::string ending(const std::string& path) {
    std::string text = std::filesystem::path(path).extension().string();
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
    return text;
}

} // namespace bake
