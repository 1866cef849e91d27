// A picture in tiles, each with its own number of samples, and which tiles need more.
#pragma once
#include "bake/preview/scene.h"
#include <vector>

namespace bake {

struct Tile {
    PixelRect rect;      ///< in the part of the picture that is rendered, whose upper left corner is (0, 0)
    int samples = 0;     ///< of each pixel
    bool more = true;    ///< whether the next pass adds samples
    double mean = 0;     ///< of the radiance, over pixels and colours
    double variance = 0; ///< of a pixel's estimate: its mean over pixels and colours
};

/// Edge of a tile. Also the size of what adaptive sampling decides upon.
inline constexpr int tile_size = 16;

struct TileGrid {
    int columns = 0, rows = 0;
    std::vector<Tile> tiles; ///< row by row
};
/// Tiles of a part of a picture. They start at multiples of tile_size in the picture; the outer ones can be smaller.
TileGrid make_tiles(const PixelRect& part);

/// The samples per pixel after the next pass of a picture that has `now`: 1, 2, 4, 8, 16, then a quarter of the last
/// power of two more, so that a pass takes at most a quarter of the time that was spent before it. At most `most`.
int next_samples(int now, int most) noexcept;

/// Fewest samples after which a tile may end: fewer give no trustworthy error.
inline constexpr int least_adaptive_samples = 16;

/// Sets Tile::more where the noise is above the limit.
///
/// A tile is noisy if the standard error of its pixels, the root of the mean variance over the pixels, is above `noise`
/// times the mean radiance of the tile, or of a tenth of that of the picture where the tile is darker. A tile goes on
/// while it, or one of its eight neighbours, is noisy.
///
/// To stop where the estimate happens to be small, biases the result: samples that miss a small bright light give both a
/// small value and a small error. Hence the least number of samples, the error of 256 pixels instead of one, and the
/// neighbours.
void choose_tiles(TileGrid& grid, double noise, int most) noexcept;

/// Samples per pixel over the whole picture.
struct SampleCounts {
    double mean = 0;
    int least = 0, most = 0;
    double without = 0; ///< share of the pixels that have no sample
};
SampleCounts sample_counts(const TileGrid& grid) noexcept;

} // namespace bake
