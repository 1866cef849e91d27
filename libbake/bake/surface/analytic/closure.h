// How the edges of the unit square of parameters meet in space.
#pragma once

namespace bake {

enum class Closure {
    open,     ///< they do not
    periodic, ///< u (or v) = 0 and 1 are the same curve
    twisted,  ///< the same curve run the other way: Moebius strip, Klein bottle
};

} // namespace bake
