#include "bake/base/text.h"
#include <cstdarg>
#include <cstdio>

namespace bake {

std::string format(const char* pattern, ...) {
    char buffer[1024];
    va_list values;
    va_start(values, pattern);
    std::vsnprintf(buffer, sizeof buffer, pattern, values);
    va_end(values);
    return buffer;
}

} // namespace bake
