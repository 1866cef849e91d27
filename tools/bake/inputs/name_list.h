// An option whose value is a list of names, separated by commas.
#pragma once
#include "verb.h"
#include <vector>

namespace bake {

/// The places of the names in `known`, in the order in which they were given. Throws Error{Refusal::usage} for a name that is
/// not known or stands there twice; `flag` and `kind` ("map") are for its message.
std::vector<std::size_t> parse_names(const std::string& flag, const std::string& text, const std::string& kind,
                                     const std::vector<std::string>& known);

} // namespace bake
