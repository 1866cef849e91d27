// Rounding to 8 bits in a pattern, so that slow gradients keep their mean instead of falling into steps.
#pragma once
#include "bake/picture/image.h"

namespace bake {

/// Values in [0, 1] of any channels, each rounded up or down to a multiple of 1 / 255 so that the mean over neighbours is that of
/// the values. A value between two levels that is the same everywhere becomes a pattern of both. The pattern is the interleaved gradient noise of Jimenez, Next Generation Post Processing in Call of Duty:
/// Advanced Warfare, SIGGRAPH 2014, another part of it for each channel.
Image<float> dithered(const Image<float>& map);
/// Each value rounded to the nearest multiple, as a file of 8 bits stores it.
Image<float> rounded(const Image<float>& map);

} // namespace bake
