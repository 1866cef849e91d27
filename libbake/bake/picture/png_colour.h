// What a PNG says of its colours.
#pragma once
#include "bake/picture/colour.h"
#include <png.h>

namespace bake {

/// To be called before the header is read: has chunks kept that libpng does not know.
void keep_colour_chunks(png_structp png);

/// By the first of: cICP, sRGB, an ICC profile (by its curves, whatever its name), gAMA.
ColourTag read_png_colour(png_structp png, png_infop info);

} // namespace bake
