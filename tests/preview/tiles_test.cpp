// Tiles, the sequence of passes, and which tiles go on.
#include "bake/preview/tiles.h"
#include <doctest/doctest.h>

using namespace bake;

namespace {

/// 5 x 4 tiles of one mean and no noise, all of which have 16 samples.
TileGrid quiet_grid() {
    TileGrid grid = make_tiles({0, 0, 5 * tile_size, 4 * tile_size});
    for (Tile& tile : grid.tiles) tile.samples = 16, tile.mean = 1;
    return grid;
}

int going_on(const TileGrid& grid) {
    int count = 0;
    for (const Tile& tile : grid.tiles) count += tile.more;
    return count;
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("tiles: every pixel is in one tile") {
        for (const auto& [x, y, width, height] : {PixelRect{0, 0, 1, 1},
                                                  {0, 0, 16, 16},
                                                  {0, 0, 17, 33},
                                                  {5, 0, 100, 3},
                                                  {31, 47, 2, 18},
                                                  {16, 15, 16, 1}}) {
            const TileGrid grid = make_tiles({x, y, width, height});
            CHECK(int(grid.tiles.size()) == grid.columns * grid.rows);
            std::vector<int> covered(std::size_t(width) * height);
            for (const Tile& tile : grid.tiles) {
                CHECK((x + tile.rect.x) / tile_size == (x + tile.rect.x + tile.rect.width - 1) / tile_size);
                CHECK((y + tile.rect.y) / tile_size == (y + tile.rect.y + tile.rect.height - 1) / tile_size);
                for (int row = tile.rect.y; row < tile.rect.y + tile.rect.height; ++row)
                    for (int column = tile.rect.x; column < tile.rect.x + tile.rect.width; ++column)
                        ++covered.at(std::size_t(row) * width + column);
            }
            for (const int count : covered) CHECK(count == 1);
        }
    }

    TEST_CASE("tiles: passes double the samples, then add a quarter, and end at the most") {
        std::vector<int> sequence;
        for (int n = 0; n < 70;) sequence.push_back(n = next_samples(n, 70));
        CHECK(sequence == std::vector<int>{1, 2, 4, 8, 16, 20, 24, 28, 32, 40, 48, 56, 64, 70});
        CHECK(next_samples(0, 1) == 1);
        CHECK(next_samples(65535, 65536) == 65536);
        CHECK(next_samples(2147483600, 2147483647) == 2147483647);
    }

    TEST_CASE("tiles: a noisy tile and its neighbours go on, the others end") {
        TileGrid grid = quiet_grid();
        choose_tiles(grid, 0.01, 64);
        CHECK(going_on(grid) == 0);
        grid.tiles[7].variance = 0.0101 * 0.0101; // column 2, row 1
        choose_tiles(grid, 0.01, 64);
        CHECK(going_on(grid) == 9);
        CHECK(grid.tiles[1].more);
        CHECK_FALSE(grid.tiles[4].more);
        choose_tiles(grid, 0.01, 16); // no more samples are allowed
        CHECK(going_on(grid) == 0);
        grid.tiles[7].variance = 0.0099 * 0.0099;
        choose_tiles(grid, 0.01, 64);
        CHECK(going_on(grid) == 0);
    }

    TEST_CASE("tiles: noise is relative to the tile, in the dark to a tenth of the picture's mean") {
        TileGrid grid = quiet_grid();
        grid.tiles[0].mean = 0, grid.tiles[0].variance = 0.0009 * 0.0009; // the mean of all is .95
        choose_tiles(grid, 0.01, 64);
        CHECK(going_on(grid) == 0);
        grid.tiles[0].variance = 0.001 * 0.001;
        choose_tiles(grid, 0.01, 64);
        CHECK(going_on(grid) == 4);
        for (Tile& tile : grid.tiles) tile.mean = tile.variance = 0; // a black picture has no noise
        choose_tiles(grid, 0.01, 64);
        CHECK(going_on(grid) == 0);
    }

    TEST_CASE("tiles: no tile ends with fewer samples than the least") {
        TileGrid grid = quiet_grid();
        for (Tile& tile : grid.tiles) tile.samples = least_adaptive_samples - 1;
        choose_tiles(grid, 1, 64);
        CHECK(going_on(grid) == 20);
    }

    TEST_CASE("tiles: counts of samples weigh tiles by their pixels") {
        TileGrid grid = make_tiles({0, 0, tile_size + 4, tile_size});
        grid.tiles[0].samples = 8;
        const SampleCounts counts = sample_counts(grid);
        CHECK(counts.least == 0);
        CHECK(counts.most == 8);
        CHECK(counts.mean == doctest::Approx(8 * 0.8));
        CHECK(counts.without == doctest::Approx(0.2));
    }

} // TEST_SUITE
