#include "bake/verdict/finding_text.h"
#include <cstdio>

namespace bake {

std::string number(double v) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", v);
    return text;
}

std::string percent(double part) {
    char text[32];
    std::snprintf(text, sizeof text, part < 0.0095 ? "%.2g %%" : "%.3g %%", 100 * part);
    return text;
}

std::string counted(std::size_t count, const std::string& what) {
    const std::size_t bar = what.find('|');
    std::string noun = what.substr(0, bar);
    if (count != 1) noun = noun.ends_with("vertex") ? noun.substr(0, noun.size() - 2) + "ices" : noun + "s";
    return std::to_string(count) + " " + noun + (bar == std::string::npos ? "" : " " + what.substr(bar + 1));
}

void add_if(std::vector<std::string>& list, std::size_t count, const std::string& what, const std::string& rest) {
    if (count > 0) list.push_back(counted(count, what) + ": " + rest);
}

} // namespace bake
