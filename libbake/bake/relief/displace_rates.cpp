#include "bake/relief/displace_rates.h"
#include "bake/base/error.h"

namespace bake {

RatePlan uniform_rates(int levels) {
    if (levels < 0 || levels > 14)
        throw Error(Refusal::usage, "--levels: " + std::to_string(levels) + " is out of range; take 0 to 14");
    RatePlan plan;
    plan.rates.uniform = 1u << levels;
    return plan;
}

RatePlan plan_rates(const BaseSurface&, const Relief&, const DisplaceOptions& options) {
    return uniform_rates(options.rates.levels);
}

} // namespace bake
