#include "bake/environment/engine/roughness_ladder.h"
#include "bake/base/error.h"
#include <algorithm>
#include <bit>
#include <cmath>

namespace bake {
namespace {

/// `last`: the last level.
double alpha_of_level(Consumer consumer, int level, int last, int edge) noexcept {
    if (level == 0) return 0;
    const double t = double(level) / last;
    if (consumer == Consumer::babylon) return std::min(1.0, std::exp2(level / 0.8) / edge);
    const double roughness = consumer == Consumer::bevy ? t : 1 - std::sqrt(1 - t);
    return roughness * roughness;
}

} // namespace

std::vector<double> roughness_ladder(Consumer consumer, int edge) {
    const ConsumerEntry& entry = entry_of(consumer);
    if (!entry.levels) return {};
    const int least_edge = entry.levels->least_edge, least = 2 * least_edge;
    if (!std::has_single_bit(unsigned(edge)) || edge < least)
        throw Error(Refusal::usage, "`size` " + std::to_string(edge) + ": levels for " + entry.name +
                                        " halve down to " + std::to_string(least_edge) +
                                        " texels; give a power of two, " + std::to_string(least) + " or more");
    const int last = std::bit_width(unsigned(edge / least_edge)) - 1;
    std::vector<double> ladder;
    for (int level = 0; level <= last; ++level) ladder.push_back(alpha_of_level(consumer, level, last, edge));
    return ladder;
}

} // namespace bake
