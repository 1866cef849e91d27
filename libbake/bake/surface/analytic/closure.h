// Identification of opposite edges of the unit parameter square.
#pragma once

namespace bake {

enum class Closure {
    open,     ///< the edges are different curves
    periodic, ///< u (or v) = 0 and u (or v) = 1 are the same curve
    twisted,  ///< the same curve in opposite directions: Moebius strip, Klein bottle
};

} // namespace bake
