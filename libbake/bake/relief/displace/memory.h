// The memory that a displacement takes, counted before it is taken.
#pragma once
#include "bake/base/memory.h"
#include "bake/relief/displace/rates.h"
#include <algorithm>

namespace bake {

/// Rates and the layout that follows from them.
struct Plan {
    RatePlan rates;
    PatchLayout layout; ///< refers to rates

    Plan(const BaseSurface& base, RatePlan plan)
        : rates(std::move(plan)), layout(make_layout(rates.cells, rates.rates, !base.mesh().corner_uv.empty())) {}
    Plan(const Plan&) = delete;
};

/// What may be taken, what is taken already, and by what.
class DisplaceMemory {
public:
    /// All must outlive it.
    DisplaceMemory(const BaseSurface& base, const Relief& relief, const DisplaceOptions& options);

    const BaseSurface& base() const noexcept { return *base_; }
    const DisplaceOptions& options() const noexcept { return *options_; }
    const Relief& relief() const noexcept { return *relief_; }
    /// The lower of memory_limit() and options.max_bytes.
    std::uint64_t limit() const noexcept { return limit_.bytes; }
    std::string described_limit() const { return limit_.described(); }
    std::string advice() const { return limit_.advice(); }

    /// The result of a plan and the peak of the memory; without the later step number `without`, if given. The blend may
    /// not be there yet.
    DisplaceCount count(const Plan& plan, const SeamBlend* blend, std::size_t without = std::size_t(-1)) const;
    /// The least that a result of so many triangles takes at the peak.
    std::uint64_t least_bytes(double triangles) const noexcept;
    /// What the search for rates takes at its peak with so many cells along each patch.
    std::uint64_t search_bytes(std::uint32_t split) const noexcept;

private:
    std::uint64_t during_displacement(const Plan& plan, const SeamBlend* blend, std::uint64_t result) const;
    std::uint64_t during_measurement(const Plan& plan) const;

    const BaseSurface* base_;
    const Relief* relief_;
    const DisplaceOptions* options_;
    MemoryLimit limit_;
};

/// Whether the indices of a mesh can count the points and the corners of a result.
inline bool within_indices(const DisplaceCount& count) noexcept {
    return std::max(count.points, count.corners) < no_index;
}

/// Throws Error{Refusal::unsuitable} if the height alone needs more memory than it may use.
void refuse_large_height(const DisplaceMemory& memory);

/// Throws Error{Refusal::unsuitable} if the result needs more memory than it may use, or more indices than there are. The
/// message says what is needed and what would fit.
DisplaceCount refuse_too_large(const DisplaceMemory& memory, const Plan& plan, const SeamBlend* blend);

} // namespace bake
