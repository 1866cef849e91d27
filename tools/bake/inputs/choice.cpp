#include "inputs/choice.h"

namespace bake {

CLI::Validator one_of(const std::vector<std::string>& names) { return CLI::IsMember(names).description(""); }

} // namespace bake
