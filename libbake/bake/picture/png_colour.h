// The encoding of colours that a PNG file states.
#pragma once
#include "bake/picture/colour.h"
#include <png.h>

namespace bake {

/// To be called before the header is read: has chunks kept that libpng does not know, cICP and acTL.
void keep_unknown_chunks(png_structp png);
/// Whether the file has the chunk acTL: it is an animation, and its first picture is one that any reader shows.
bool is_animation(png_structp png, png_infop info);

/// By the first of: cICP, sRGB, an ICC profile (by its curves, whatever its name), gAMA.
ColourTag read_png_colour(png_structp png, png_infop info);

} // namespace bake
