#include "bake/surface/chart/uv_tiles.h"
#include "bake/base/error.h"
#include "bake/mesh/topology.h"
#include <algorithm>
#include <glm/common.hpp>
#include <set>

namespace bake {
namespace {

// Of the covered area. Whole charts that overlap mean that each tile has a map of its own, or that charts were moved aside
// on purpose; charts that leak over a border by a few texels mean neither.
constexpr double most_clash = 0.001, most_leak = 0.05;
constexpr std::size_t most_tiles = 4096;

/// Tiles beyond this are of no use to anyone, and their numbers stay exact in float.
double bounded(double v) noexcept { return std::clamp(v, -1e6, 1e6); }

std::size_t count_of(const TileRange& range) noexcept {
    return std::size_t(range.last.u - range.first.u + 1) * std::size_t(range.last.v - range.first.v + 1);
}

/// Calls work(tile) for each tile of the range.
template <class Work> void for_tiles(const TileRange& range, Work&& work) {
    for (int v = range.first.v; v <= range.last.v; ++v)
        for (int u = range.first.u; u <= range.last.u; ++u) work(UvTile{u, v});
}

Vec2f uv_of(const Mesh& mesh, std::uint32_t corner) noexcept { return mesh.uvs[mesh.corner_uv[corner]]; }

bool is_charted(const Mesh& mesh, std::size_t face) noexcept {
    if (mesh.corner_uv.empty()) return false;
    for (std::uint32_t c = mesh.face_begin[face]; c < mesh.face_begin[face + 1]; ++c)
        if (mesh.corner_uv[c] == no_index) return false;
    return true;
}

/// Triangles moved by whole tiles, for uv_raster(): a triangle in several tiles is there once for each of them.
struct FoldedCharts {
    Mesh mesh; ///< uvs alone
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> source; ///< the triangle that each one is a copy of
};

void add(const Mesh& mesh, const Triangle& triangle, std::uint32_t number, const UvTile& tile, FoldedCharts& out) {
    const auto first = std::uint32_t(out.mesh.uvs.size());
    for (const std::uint32_t corner : triangle.corner) {
        out.mesh.corner_uv.push_back(std::uint32_t(out.mesh.uvs.size()));
        out.mesh.uvs.push_back(Vec2f(Vec2d(uv_of(mesh, corner)) - Vec2d(tile.u, tile.v)));
    }
    out.triangles.push_back({{first, first + 1, first + 2}, std::uint32_t(out.mesh.faces())});
    out.source.push_back(number);
}

/// Ends a face of the folded charts, if it has triangles.
void end_face(FoldedCharts& out) {
    const auto end = std::uint32_t(out.mesh.uvs.size());
    if (out.mesh.face_begin.back() != end) out.mesh.face_begin.push_back(end);
}

/// Per face the tile in which the middle of its chart lies. A chart is what faces with common uvs form.
std::vector<UvTile> home_tiles(const Mesh& mesh) {
    DisjointSets sets(mesh.uvs.size());
    const auto each_face = [&](auto&& work) {
        for (std::size_t f = 0; f < mesh.faces(); ++f)
            if (is_charted(mesh, f)) work(f, mesh.face_begin[f]);
    };
    each_face([&](std::size_t f, std::uint32_t first) {
        for (std::uint32_t c = first; c < mesh.face_begin[f + 1]; ++c)
            sets.join(mesh.corner_uv[first], mesh.corner_uv[c]);
    });
    std::vector<Vec2f> low(mesh.uvs), high(mesh.uvs); // of the representatives
    for (std::uint32_t i = 0; i < mesh.uvs.size(); ++i) {
        const std::uint32_t set = sets.find(i);
        low[set] = glm::min(low[set], mesh.uvs[i]);
        high[set] = glm::max(high[set], mesh.uvs[i]);
    }
    std::vector<UvTile> home(mesh.faces());
    each_face([&](std::size_t f, std::uint32_t first) {
        const std::uint32_t set = sets.find(mesh.corner_uv[first]);
        const Vec2d middle = 0.5 * (Vec2d(low[set]) + Vec2d(high[set]));
        home[f] = {int(bounded(std::floor(middle.x))), int(bounded(std::floor(middle.y)))};
    });
    return home;
}

/// All triangles of each tile as one face: overlaps are then those of different tiles. With `home`, every face is in that
/// tile alone.
FoldedCharts fold_tiles(const Mesh& mesh, const std::vector<Triangle>& triangles, const std::vector<UvTile>* home) {
    std::vector<std::pair<UvTile, std::uint32_t>> items;
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
        for_tiles(tiles_of_face(mesh, triangles[t].face), [&](const UvTile& tile) {
            if (!home || (*home)[triangles[t].face] == tile) items.emplace_back(tile, t);
        });
    std::sort(items.begin(), items.end());
    FoldedCharts out;
    for (std::size_t i = 0; i < items.size(); ++i) {
        if (i > 0 && items[i].first != items[i - 1].first) end_face(out);
        add(mesh, triangles[items[i].second], items[i].second, items[i].first, out);
    }
    end_face(out);
    return out;
}

/// Every face in every of its tiles as a face, those in the unit square first.
FoldedCharts fold_faces(const Mesh& mesh, const std::vector<Triangle>& triangles) {
    FoldedCharts out;
    for (const bool unit : {true, false})
        for (std::size_t t = 0, end; t < triangles.size(); t = end) {
            const std::uint32_t face = triangles[t].face;
            for (end = t; end < triangles.size() && triangles[end].face == face;) ++end;
            if (!is_charted(mesh, face)) continue;
            TileRange range = tiles_of_face(mesh, face);
            if (range.empty) {
                const Vec2f at = uv_of(mesh, mesh.face_begin[face]);
                range.first = range.last = {int(bounded(std::floor(at.x))), int(bounded(std::floor(at.y)))};
            }
            for_tiles(range, [&](const UvTile& tile) {
                if ((tile == UvTile{}) != unit) return;
                for (std::size_t i = t; i < end; ++i) add(mesh, triangles[i], std::uint32_t(i), tile, out);
                end_face(out);
            });
        }
    return out;
}

/// Part of the covered area where charts of different tiles overlap modulo 1.
double clash_of(const Mesh& mesh, const std::vector<Triangle>& triangles, int samples,
                const std::vector<UvTile>* home) {
    const FoldedCharts folded = fold_tiles(mesh, triangles, home);
    const UvRaster raster = uv_raster(folded.mesh, folded.triangles, samples, samples);
    return raster.covered > 0 ? double(raster.overlapped) / double(raster.covered) : 0;
}

/// The uvs of a mesh, moved so that the tile becomes the unit square.
std::unique_ptr<const Mesh> moved_charts(const Mesh& mesh, const UvTile& tile) {
    auto charts = std::make_unique<Mesh>();
    charts->face_begin = mesh.face_begin;
    charts->corner_uv = mesh.corner_uv;
    for (const Vec2f& uv : mesh.uvs) charts->uvs.push_back(Vec2f(Vec2d(uv) - Vec2d(tile.u, tile.v)));
    return charts;
}

UvTile tile_of(int udim) noexcept { return {(udim - 1001) % 10, (udim - 1001) / 10}; }

/// Counts the faces of the tile, which it returns, and the others; those that end at the border of the tile are outside.
std::int64_t count_faces(const Mesh& mesh, const UvTile& tile, UvRaster& out) {
    std::int64_t inside_faces = 0;
    out.outside_faces = out.crossing_faces = 0;
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
        const TileRange range = tiles_of_face(mesh, f);
        if (range.empty) continue;
        const bool inside =
            range.first.u <= tile.u && tile.u <= range.last.u && range.first.v <= tile.v && tile.v <= range.last.v;
        ++(inside ? inside_faces : out.outside_faces);
        out.crossing_faces += inside && range.first != range.last;
    }
    return inside_faces;
}

} // namespace

std::string name(const UvTile& tile) {
    if (tile.u >= 0 && tile.u < 10 && tile.v >= 0 && tile.v < 900) return std::to_string(1001 + tile.u + 10 * tile.v);
    return "(" + std::to_string(tile.u) + ", " + std::to_string(tile.v) + ")";
}

std::string names(const std::vector<UvTile>& tiles) {
    constexpr std::size_t most = 8;
    std::string out;
    for (std::size_t i = 0; i < std::min(most, tiles.size()); ++i) out += (i > 0 ? ", " : "") + name(tiles[i]);
    return tiles.size() > most ? out + " and " + std::to_string(tiles.size() - most) + " more" : out;
}

TileRange tiles_of_face(const Mesh& mesh, std::size_t face) {
    TileRange range;
    if (!is_charted(mesh, face)) return range;
    Vec2d low(1e30), high(-1e30);
    for (std::uint32_t c = mesh.face_begin[face]; c < mesh.face_begin[face + 1]; ++c) {
        const Vec2d uv(uv_of(mesh, c));
        low = {std::min(low.x, uv.x), std::min(low.y, uv.y)};
        high = {std::max(high.x, uv.x), std::max(high.y, uv.y)};
    }
    if (!(low.x < high.x && low.y < high.y)) return range;
    constexpr double slack = 1e-5;
    const auto first = [](double a, double b) { return std::floor(std::min(a + slack, 0.5 * (a + b))); };
    const auto last = [&](double a, double b) { return std::max(first(a, b), std::ceil(b - slack) - 1); };
    range.first = {int(bounded(first(low.x, high.x))), int(bounded(first(low.y, high.y)))};
    range.last = {int(bounded(last(low.x, high.x))), int(bounded(last(low.y, high.y)))};
    range.empty = false;
    return range;
}

UvTiles uv_tiles(const Mesh& mesh, const std::vector<Triangle>& triangles, int samples) {
    UvTiles out;
    std::set<UvTile> used;
    bool too_many = false;
    TileRange last; // most faces lie in the tile of the face before
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
        const TileRange range = tiles_of_face(mesh, f);
        if (range.empty) continue;
        if (count_of(range) > most_tiles || used.size() > most_tiles) too_many = true, used.insert(range.first);
        else if (!(range == last)) for_tiles(range, [&](const UvTile& tile) { used.insert(tile); });
        last = range;
    }
    out.tiles.assign(used.begin(), used.end());
    if (too_many) {
        out.placement = ChartPlacement::several, out.clash = 1;
    } else if (used.size() == 1) {
        out.placement = out.tiles[0] == UvTile{} ? ChartPlacement::as_they_are : ChartPlacement::one_tile;
    } else if (used.size() > 1) {
        samples = std::clamp(samples, 64, 1024);
        const std::vector<UvTile> home = home_tiles(mesh);
        out.clash = clash_of(mesh, triangles, samples, nullptr);
        const bool apart = out.clash > most_leak || clash_of(mesh, triangles, samples, &home) > most_clash;
        out.placement = apart ? ChartPlacement::several : ChartPlacement::modulo_1;
    }
    return out;
}

PlacedCharts place_charts(const Mesh& mesh, const std::vector<Triangle>& triangles, int tile, int samples,
                          const std::string& path) {
    PlacedCharts out{&mesh, &triangles, {}, {}, nullptr, nullptr};
    const auto move_to = [&](const UvTile& from) {
        if (from == UvTile{}) return;
        out.own_mesh = moved_charts(mesh, from), out.mesh = out.own_mesh.get();
    };
    if (tile != 0) {
        move_to(tile_of(tile));
        return out;
    }
    const UvTiles tiles = uv_tiles(mesh, triangles, samples);
    if (tiles.placement == ChartPlacement::several)
        throw Error(Refusal::unsuitable,
                    path + ": its charts lie in several tiles of the uvs (" + names(tiles.tiles) +
                        ") and overlap modulo 1; name the tile to bake (`tile`), or write <UDIM> in "
                        "the name of the map for one map per tile");
    if (tiles.placement == ChartPlacement::one_tile) move_to(tiles.tiles[0]);
    if (tiles.placement == ChartPlacement::modulo_1) {
        FoldedCharts folded = fold_faces(mesh, triangles);
        out.own_mesh = std::make_unique<const Mesh>(std::move(folded.mesh)), out.mesh = out.own_mesh.get();
        out.own_triangles = std::make_unique<const std::vector<Triangle>>(std::move(folded.triangles));
        out.triangles = out.own_triangles.get(), out.source = std::move(folded.source);
    }
    if (tiles.placement != ChartPlacement::as_they_are) out.tiles = names(tiles.tiles);
    return out;
}

UvRaster chart_raster(const Mesh& mesh, const std::vector<Triangle>& triangles, int width, int height, int tile,
                      const std::string& path) {
    const PlacedCharts charts = place_charts(mesh, triangles, tile, std::max(width, height), path);
    UvRaster out = uv_raster(*charts.mesh, *charts.triangles, width, height);
    out.tiles = charts.tiles;
    if (!charts.source.empty()) {
        for (std::size_t i = 0; i < out.hits.size(); ++i)
            if (TexelHit& hit = out.hits.data()[i]; hit.triangle != no_index)
                hit.triangle = charts.source[hit.triangle];
        out.outside_faces = out.crossing_faces = 0; // the part of a face that one copy leaves out is in another
    }
    if (tile != 0 && count_faces(mesh, tile_of(tile), out) == 0)
        throw Error(Refusal::unsuitable, path + ": no face has area in tile " + std::to_string(tile) +
                                             " of its uvs; name another one (`tile`)");
    if (tile == 0 && out.covered + out.border == 0)
        throw Error(Refusal::unsuitable, path + ": no face has area in its uvs; unwrap the mesh");
    return out;
}

} // namespace bake
