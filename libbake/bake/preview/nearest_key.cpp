#include "bake/preview/nearest_key.h"
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

/// Letters to insert, delete, replace or swap with their neighbour: the optimal string alignment distance.
std::size_t distance(const std::string& a, const std::string& b) {
    std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i)
        for (std::size_t j = 0; j <= b.size(); ++j) {
            if (i == 0 || j == 0) {
                d[i][j] = i + j;
                continue;
            }
            d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] != b[j - 1])});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
        }
    return d[a.size()][b.size()];
}

} // namespace

std::string nearest_key(const std::string& word, const std::vector<std::string>& names) {
    const std::string wanted = simplified(word);
    std::string best;
    std::size_t least = (wanted.size() + 1) / 3 + 1; // a distance below this is near
    for (const std::string& name : names)
        if (const std::size_t d = distance(wanted, simplified(name)); d < least) best = name, least = d;
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
