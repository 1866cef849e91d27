// Tiles of the uv plane, and the raster of charts that do not lie in the unit square. A viewer repeats a map over the plane,
// so a chart may lie in any tile; a map can only hold charts that do not overlap once they are moved into one tile.
#pragma once
#include "bake/surface/chart/uv_raster.h"
#include <compare>
#include <utility>

namespace bake {

/// The square [u, u + 1] x [v, v + 1].
struct UvTile {
    int u = 0, v = 0;
    bool operator==(const UvTile&) const = default;
    /// Rows from below, as UDIM counts.
    auto operator<=>(const UvTile& other) const { return std::pair(v, u) <=> std::pair(other.v, other.u); }
};

/// 1001 + u + 10 v where UDIM numbers the tile, else "(u, v)".
std::string name(const UvTile& tile);
/// Names, apart by commas; of many the first ones and how many more there are.
std::string names(const std::vector<UvTile>& tiles);

/// The tiles that a face lies in. A face that ends at the border of a tile, up to rounding, is not in the next tile.
struct TileRange {
    UvTile first, last;
    bool empty = true; ///< a corner without uv, or no area: on the border of two tiles the face would be in neither
    bool operator==(const TileRange&) const = default;
};
TileRange tiles_of_face(const Mesh& mesh, std::size_t face);

/// How a bake places the charts.
enum class ChartPlacement {
    as_they_are, ///< all in the unit square
    one_tile,    ///< all in one other tile: modulo 1
    modulo_1,    ///< in several tiles, but without overlap modulo 1
    several,     ///< in several tiles, and they overlap modulo 1: a bake takes one tile
};

struct UvTiles {
    std::vector<UvTile> tiles; ///< in use, ascending; those of faces that lie in very many tiles are left out
    ChartPlacement placement = ChartPlacement::as_they_are;
    double clash = 0; ///< part of the covered area, modulo 1, where charts of different tiles overlap
};
/// Overlaps are measured with `samples` samples along a tile's side, at least 64 and at most 1024.
UvTiles uv_tiles(const Mesh& mesh, const std::vector<Triangle>& triangles, int samples);

/// As uv_raster(), of all charts modulo 1. Where charts leak a little over the border of their tile and overlap others, those
/// in the unit square win. With `tile`, a UDIM number, only the charts of that tile are rastered; 0: all of them. `path` is for messages.
/// Throws Error{Refusal::unsuitable}, which names the tiles, for charts whose placement is `several` if no tile is given, and
/// for a mesh of which nothing lies in the tile.
UvRaster chart_raster(const Mesh& mesh, const std::vector<Triangle>& triangles, int width, int height, int tile,
                      const std::string& path, const UvRasterOptions& options = {});

} // namespace bake
