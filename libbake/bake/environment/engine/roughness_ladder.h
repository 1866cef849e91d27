// Which roughness each level of a filtered sky is for, by the rule of the program that reads it: see picture/consumer.h.
#pragma once
#include "bake/picture/consumer.h"
#include <vector>

namespace bake {

/// alpha of every level, level 0 first, which is 0: the sky itself. `edge`: a power of two, at least twice the last level's.
/// Empty for a consumer that filters the sky itself. Throws Error{Refusal::usage} for another `edge`.
std::vector<double> roughness_ladder(Consumer consumer, int edge);

} // namespace bake
