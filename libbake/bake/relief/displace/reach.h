// Which errors rates can reach: known from samples, before the search for the rates.
#pragma once
#include "bake/relief/displace/memory.h"

namespace bake {

/// What an error needs, by lines across at most 1024 patches, in both directions. Between two samples the surface is taken
/// as a parabola, whose error falls with the square of the number of segments.
struct ErrorNeed {
    double triangles = 0; ///< at least so many, with rates that follow the relief
    double segments = 1;  ///< along a patch, with even segments: half of the lines need more
    double most = 1;      ///< likewise: a tenth of the lines needs more
    double scale = 0;     ///< triangles times error, once the error is far below that of the texels
};
ErrorNeed need_of(const SeamedRelief& scene, double error, Progress* progress);

/// The distance by which positions of the result are rounded to floats: a smaller error cannot be reached.
double rounding_of_floats(const Mesh& mesh) noexcept;

/// Rates by size or by error. Throws Error{Refusal::unsuitable} early for an error that cannot be reached, because of the
/// floats, of the memory or of the largest number of segments; the message has the smallest one that can.
RatePlan plan_rates(const SeamedRelief& scene, const Rates& rates, const DisplaceMemory& memory, Progress* progress);

} // namespace bake
