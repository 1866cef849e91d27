// Messages of the library name the fields of its options between backquotes; the command's users know flags.
#include "verb.h"
#include <algorithm>
#include <string_view>

namespace bake {
namespace {

/// Fields whose flag has another name.
constexpr std::pair<std::string_view, std::string_view> renamed[] = {
    {"grey", "channel"},       {"max_bytes", "max-memory"},  {"position", "at"},         {"rate", "resolution"},
    {"rates.size", "edge-px"}, {"rates.error", "max-error"}, {"rates.levels", "levels"},
};

std::string flag_of(std::string field) {
    for (const auto& [name, flag] : renamed)
        if (field == name) return "--" + std::string(flag);
    std::replace(field.begin(), field.end(), '_', '-');
    return "--" + field;
}

} // namespace

std::string with_flags(const std::string& message) {
    std::string out;
    for (std::size_t begin = 0; begin < message.size();) {
        const std::size_t open = std::min(message.find('`', begin), message.size());
        out.append(message, begin, open - begin);
        const std::size_t close = message.find_first_not_of("abcdefghijklmnopqrstuvwxyz_.", open + 1);
        const bool field = close != std::string::npos && message[close] == '`' && close > open + 1;
        if (field) out += flag_of(message.substr(open + 1, close - open - 1));
        else out.append(message, open, 1);
        begin = field ? close + 1 : open + 1;
    }
    return out;
}

} // namespace bake
