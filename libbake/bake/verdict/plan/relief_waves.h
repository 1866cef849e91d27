// The wavelengths of a height that matter for its slopes.
//
// The mean squared slope along an axis is the sum over frequencies w (radians per texel) of w^2 times the power at w. The
// shortest wave that matters is the one below whose frequency a given share of this sum lies.
#pragma once
#include "bake/relief/height/height.h"

namespace bake {

/// Along u and v, in texels: 2 at the least, the size of the picture where all slopes are 0.
struct ReliefWaves {
    double u = 0, v = 0;
};

/// `share` of the mean squared slope belongs to waves that are not shorter. What the quantisation of the values adds to the
/// power (white noise of step / sqrt 12) is subtracted. At most 128 rows and 128 columns are looked at. Where the height does
/// not repeat, or its size is not a power of two, segments of 2^k texels have to be windowed: their waves come out shorter, by a
/// factor of 1 + wavelength / 2^k or less.
ReliefWaves relief_waves(const HeightTexture& height, Wrap wrap_u = Wrap::repeat, Wrap wrap_v = Wrap::repeat,
                         double share = 0.95);

} // namespace bake
