// Orientation of pictures that are stored rotated or mirrored.
#pragma once
#include "bake/picture/image.h"
#include <cstddef>
#include <string_view>

namespace bake {

struct ImageInfo;

/// Where the first stored row and column belong, as TIFF and Exif number it: 1 top and left, 2 top and right (mirrored),
/// 3 bottom and right (turned by 180 degrees), 4 bottom and left (mirrored), 5 left and top, 6 right and top, 7 right and
/// bottom, 8 left and bottom. In 5 to 8 the stored rows are columns of the picture.
constexpr bool swaps_axes(int orientation) noexcept { return orientation >= 5 && orientation <= 8; }

/// The picture in its upright orientation; unchanged for 1 and for numbers other than these eight.
Image<float> upright(Image<float> stored, int orientation);
/// Swaps info's width and height where the orientation swaps the axes, and adds a note to it.
void turn_upright(ImageInfo& info, int orientation);

/// The orientation in Exif data, which begin with their TIFF header; 1 if there is none.
int exif_orientation(std::string_view exif) noexcept;

} // namespace bake
