// The name that a mistyped one probably stands for.
#pragma once
#include <string>
#include <vector>

namespace bake {

/// Of `names` the one nearest to `word`, ignoring case, - and _: at most a third of its letters mistyped, left out,
/// doubled or swapped, or the beginning of one alone. Empty if none is near.
std::string nearest_key(const std::string& word, const std::vector<std::string>& names);
/// did you mean "NAME"? Empty if none is near.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& names);

} // namespace bake
