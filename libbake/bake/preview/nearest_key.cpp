#include "bake/preview/nearest_key.h"
#include "bake/base/edit_distance.h"
#include <algorithm>
#include <cctype>

namespace bake {
namespace {

std::string simplified(const std::string& word) {
    std::string out;
    for (const char c : word)
        if (c != '-' && c != '_') out += char(std::tolower(static_cast<unsigned char>(c)));
    return out;
}

} // namespace

std::string nearest_key(const std::string& word, const std::vector<std::string>& names) {
    const std::string wanted = simplified(word);
    std::string best;
    std::size_t least = (wanted.size() + 1) / 3 + 1; // a distance below this is near
    for (const std::string& name : names)
        if (const std::size_t d = edit_distance(wanted, simplified(name)); d < least) best = name, least = d;
    for (const std::string& name : names)
        if (const std::string other = simplified(name); best.empty() && std::min(wanted.size(), other.size()) > 1)
            if (other.starts_with(wanted) || wanted.starts_with(other)) best = name;
    return best;
}

std::string did_you_mean(const std::string& word, const std::vector<std::string>& names) {
    const std::string meant = nearest_key(word, names);
    return meant.empty() ? "" : "did you mean \"" + meant + "\"?";
}

} // namespace bake
