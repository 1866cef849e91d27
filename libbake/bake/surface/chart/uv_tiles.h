// Tiles of the uv plane, and the raster of charts that do not lie in the unit square. A viewer repeats a map over the plane,
// so a chart may lie in any tile; a map can only hold charts that do not overlap once they are moved into one tile.
#pragma once
#include "bake/surface/chart/uv_raster.h"
#include <compare>
#include <memory>
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

/// Charts that are moved into the unit square, for a raster.
struct PlacedCharts {
    const Mesh* mesh; ///< the given one, or own_mesh
    const std::vector<Triangle>* triangles;
    std::vector<std::uint32_t> source;    ///< the given triangle that each one is a copy of; empty: the same ones
    std::string tiles;                    ///< in which the charts lie, if not in the unit square alone
    std::unique_ptr<const Mesh> own_mesh; ///< uvs alone
    std::unique_ptr<const std::vector<Triangle>> own_triangles;
};
/// Of all charts modulo 1; with `tile`, a UDIM number, the charts of that tile. Where charts leak a little over the border of
/// their tile and overlap others, those in the unit square come first. The mesh must outlive the result. `path` is for
/// messages, `samples` as for uv_tiles(). Throws Error{Refusal::unsuitable}, which names the tiles, for charts whose placement is
/// `several` if no tile is given.
PlacedCharts place_charts(const Mesh& mesh, const std::vector<Triangle>& triangles, int tile, int samples,
                          const std::string& path);

/// As uv_raster(), of charts that place_charts() has moved; refuses what that does, and a mesh of which nothing lies in the tile.
UvRaster chart_raster(const Mesh& mesh, const std::vector<Triangle>& triangles, int width, int height, int tile,
                      const std::string& path);

} // namespace bake
