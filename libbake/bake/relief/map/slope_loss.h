// How much of a height's slopes a derivative filter loses.
#pragma once
#include "bake/relief/height/height.h"
#include "bake/relief/height/slope_filter.h"

namespace bake {

/// The part of the slopes, as their root mean square, that `filter` loses at the frequencies of this height: 1 - gain at a
/// single frequency. The yardstick is sharp_stencil(), and the noise of quantisation by height.step is taken out of
/// both. Over at most 128 x 128 texels. `filter` must not be automatic. Negative where a filter exaggerates; 0 without slopes.
double slope_loss(const HeightTexture& height, Filter filter, Wrap wrap_u, Wrap wrap_v);

} // namespace bake
