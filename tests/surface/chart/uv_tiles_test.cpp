#include "bake/base/error.h"
#include "bake/surface/chart/uv_tiles.h"
#include "surface/chart/charts.h"
#include <cstring>

using namespace bake;
using namespace bake_tests;

namespace {

UvTiles tiles_of(const Mesh& mesh, int samples = 256) { return uv_tiles(mesh, triangulate(mesh), samples); }

UvRaster raster(const Mesh& mesh, int tile = 0, int size = 64) {
    return chart_raster(mesh, triangulate(mesh), size, size, tile, "mesh");
}

std::string refusal(const Mesh& mesh, int tile = 0) {
    try {
        raster(mesh, tile);
    } catch (const Error& error) {
        return error.refusal == Refusal::unsuitable ? error.what() : "another refusal";
    }
    return "baked";
}

bool same_hits(const UvRaster& a, const UvRaster& b) {
    return a.hits.size() == b.hits.size() &&
           std::memcmp(a.hits.data(), b.hits.data(), a.hits.size() * sizeof(TexelHit)) == 0;
}

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("uv_tiles: charts in one whole tile are rastered as they are in the unit square") {
        // Sides that floats hold exactly, so that moving them rounds nothing.
        const Mesh unit = charts({{{0.125f, 0.25f}, 0.5f, 0.5f}, {{0.75f, 0.25f}, 0.25f, 0.75f}});
        for (const Vec2f move : {Vec2f(0, 1), Vec2f(3, 0), Vec2f(0, -1), Vec2f(-2, -5), Vec2f(40, 1000)}) {
            Mesh moved = unit;
            for (Vec2f& uv : moved.uvs) uv += move;
            CHECK(tiles_of(moved).placement == ChartPlacement::one_tile);
            const UvRaster got = raster(moved);
            CHECK(same_hits(got, raster(unit)));
            CHECK(got.outside_faces + got.crossing_faces == 0);
            CHECK(got.tiles == name(UvTile{int(move.x), int(move.y)}));
        }
        CHECK(tiles_of(unit).placement == ChartPlacement::as_they_are);
        CHECK(raster(unit).tiles == "");
        // A border that rounding moves is not in the next tile.
        CHECK(tiles_of(charts({{{0, 0}, 1.000004f, 1}})).placement == ChartPlacement::as_they_are);
    }

    TEST_CASE("uv_tiles: charts that do not overlap modulo 1 are rastered in any tile, also across a border") {
        const Mesh unit = charts({{{0.125f, 0.25f}, 0.25f, 0.5f}, {{0.5f, 0.25f}, 0.25f, 0.75f}});
        Mesh moved = unit;
        for (std::size_t i = 4; i < 8; ++i) moved.uvs[i] += Vec2f(1, -1);
        CHECK(tiles_of(moved).placement == ChartPlacement::modulo_1);
        CHECK(same_hits(raster(moved), raster(unit)));
        CHECK(raster(moved).outside_faces == 0);
        CHECK(raster(moved).tiles == "(1, -1), 1001");

        // One chart from u = 3/4 to 5/4 fills both ends of the square.
        const Mesh chart = charts({{{0.75f, 0}, 0.5f, 1}});
        const UvRaster across = raster(chart);
        CHECK(across.covered == 64 * 64 / 2);
        CHECK(across.crossing_faces == 0);
        CHECK(across.hits.at(0, 5).triangle != no_index);
        CHECK(across.hits.at(63, 5).triangle != no_index);
        CHECK(across.hits.at(32, 5).triangle == no_index);
        // The hit is the point of the triangle where it lies.
        const TexelHit hit = across.hits.at(0, 63);
        const auto u = [&](int k) {
            return double(chart.uvs[chart.corner_uv[triangulate(chart)[hit.triangle].corner[k]]].x);
        };
        CHECK(u(0) + hit.b1 * (u(1) - u(0)) + hit.b2 * (u(2) - u(0)) == doctest::Approx(1 + 1.0 / 128));
    }

    TEST_CASE(
        "uv_tiles: charts that overlap modulo 1 are refused, with the tiles named; a tile is baked by its number") {
        const Mesh udim = charts({{{0, 0}, 1, 1}, {{1, 0}, 0.5f, 1}, {{3, 2}, 1, 1}});
        CHECK(tiles_of(udim).placement == ChartPlacement::several);
        CHECK(refusal(udim) ==
              "mesh: its charts lie in several tiles of the uvs (1001, 1002, 1024) and overlap modulo 1; "
              "name the tile to bake (`tile`), or write <UDIM> in the name of the map for one map per tile");
        const UvRaster second = raster(udim, 1002);
        CHECK(second.covered == 64 * 64 / 2);
        CHECK(second.outside_faces == 2);
        CHECK(second.hits.at(0, 0).triangle / 2 == 1);
        CHECK(raster(udim, 1024).hits.at(0, 0).triangle / 2 == 2);
        CHECK(refusal(udim, 1003).find("no face has area in tile 1003") != std::string::npos);
        // A texture that repeats four times, and one that nobody can count.
        CHECK(refusal(charts({{{0, 0}, 4, 4}})).find("and 8 more") != std::string::npos);
        CHECK(tiles_of(charts({{{0, 0}, 1e20f, 1e20f}})).placement == ChartPlacement::several);
        CHECK(raster(charts({{{0, 0}, 4, 4}}), 1001).covered == 64 * 64);
    }

    TEST_CASE("uv_tiles: where two tiles overlap a little, the unit square's charts win; overlaps within a tile do not "
              "matter") {
        const Mesh leaking = charts({{{0.5f, 0}, 0.501f, 1}, {{0, 0}, 0.25f, 1}});
        CHECK(tiles_of(leaking, 1024).placement == ChartPlacement::modulo_1);
        CHECK(raster(leaking, 0, 1024).hits.at(0, 5).triangle / 2 == 1);
        // A whole chart in another tile is no leak, however small it is.
        CHECK(tiles_of(charts({{{0, 0}, 1, 1}, {{1.5f, 0.5f}, 0.0625f, 0.125f}})).placement == ChartPlacement::several);
        const Mesh stacked = charts({{{0, 0}, 0.5f, 1}, {{0, 0}, 0.5f, 1}, {{1.5f, 0}, 0.25f, 1}});
        CHECK(tiles_of(stacked).placement == ChartPlacement::modulo_1);
        CHECK(raster(stacked).overlapped == 64 * 32);
    }

    TEST_CASE("uv_tiles: faces without uvs or area lie in no tile") {
        Mesh mesh = charts({{{1, 0}, 1, 1}, {{5, 5}, 1, 0}, {{7, 0}, 1, 1}});
        mesh.corner_uv[9] = no_index;
        CHECK(tiles_of(mesh).tiles == std::vector<UvTile>{{1, 0}});
        CHECK(raster(mesh).covered == 64 * 64);
        CHECK(refusal(charts({{{5, 5}, 1, 0}})).find("no face has area") != std::string::npos);
    }
} // unit
