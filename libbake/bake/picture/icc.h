// ICC profiles, as far as a picture's curves need them: those of profiles made of curves and a matrix.
#pragma once
#include "bake/picture/colour.h"
#include <string>
#include <string_view>

namespace bake {

/// The colour encoding that an ICC profile states. Curves are those of its tags rTRC, gTRC, bTRC or kTRC, whatever
/// the profile is called. A profile of tables, or a damaged one, gives a note and no curve.
ColourTag read_icc(std::string_view profile);

/// A profile of sRGB's primaries with the curve of sRGB, or with a linear one; grey for one channel.
std::string make_icc(bool srgb, bool grey);

} // namespace bake
