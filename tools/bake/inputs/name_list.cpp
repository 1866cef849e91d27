#include "inputs/name_list.h"
#include <algorithm>

namespace bake {

std::vector<std::size_t> parse_names(const std::string& flag, const std::string& text, const std::string& kind,
                                     const std::vector<std::string>& known) {
    const auto usage = [&](const std::string& message) {
        return Error(Refusal::usage, flag + " " + text + ": " + message);
    };
    std::vector<std::size_t> out;
    for (std::size_t from = 0; from <= text.size();) {
        const std::size_t to = std::min(text.find(',', from), text.size());
        const std::string word = text.substr(from, to - from);
        from = to + 1;
        const auto found = std::find(known.begin(), known.end(), word);
        if (found == known.end()) {
            std::string all;
            for (const std::string& each : known) all += (all.empty() ? "" : ",") + each;
            throw usage("'" + word + "' is no " + kind + "; choose from " + all);
        }
        const auto place = std::size_t(found - known.begin());
        if (std::find(out.begin(), out.end(), place) != out.end())
            throw usage("'" + word + "' twice; name each " + kind + " once");
        out.push_back(place);
    }
    return out;
}

} // namespace bake
