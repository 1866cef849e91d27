// How finely each edge of a patch and each lattice inside is cut: uniformly, by size, or by error.
#pragma once
#include "bake/relief/displace.h"
#include "bake/relief/displace_layout.h"

namespace bake {

struct RatePlan {
    std::uint32_t split = 1; ///< cells along each side of a patch
    CellRates rates;
};

RatePlan uniform_rates(int levels);
RatePlan plan_rates(const BaseSurface& base, const Relief& relief, const DisplaceOptions& options);

} // namespace bake
