// The encoding of colours that a PNG file states.
#pragma once
#include "bake/picture/colour.h"
#include <png.h>

namespace bake {

/// Makes libpng keep the chunks that it does not know. Call it before the header is read.
void keep_colour_chunks(png_structp png);

/// By the first of: cICP, sRGB, an ICC profile (by its curves, whatever its name), gAMA.
ColourTag read_png_colour(png_structp png, png_infop info);

} // namespace bake
