// Mean FLIP over an object, from tiles of the picture.
//
// FLIP filters the picture, so that single pixels do not do: tiles with a margin as wide as its filters are rendered around
// pixels of the object that are drawn at random. Noise adds to FLIP; it takes at least 32 samples per pixel.
#pragma once
#include "bake/verdict/plan/pixel_probe.h"

namespace bake {

struct TileOptions {
    int tiles = 16, size = 32, margin = 9; ///< pixels
    int half = 16;                         ///< samples of each of the two halves of a pixel, at most 32
};

/// The square of the mean FLIP over the object's pixels in the tiles, its standard error from the differences between tiles.
/// `pixels`: those of the object in an order drawn at random, see object_pixels(). All of them are looked at where the
/// tiles around the first ones cover them.
SquareEstimate tile_flip(const ProbedScene& candidate, const ProbedScene& reference, std::span<const Pixel> pixels,
                         const ProbeOptions& options, const TileOptions& tiles = {});

} // namespace bake
