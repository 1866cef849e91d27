#include "inputs/choice.h"

namespace bake {

CLI::Validator one_of(const std::vector<std::string>& names) { return CLI::IsMember(names).description(""); }

CLI::Validator not_empty() {
    return CLI::Validator([](std::string& text) { return std::string(text.empty() ? "is empty" : ""); }, "");
}

} // namespace bake
