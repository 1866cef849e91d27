#include "bake/preview/tiles.h"
#include <algorithm>
#include <bit>
#include <utility>

namespace bake {
namespace {

double area(const Tile& tile) noexcept { return double(tile.rect.width) * tile.rect.height; }

bool is_any_near(const TileGrid& grid, const std::vector<char>& flags, int column, int row) noexcept {
    for (int y = std::max(0, row - 1); y <= std::min(grid.rows - 1, row + 1); ++y)
        for (int x = std::max(0, column - 1); x <= std::min(grid.columns - 1, column + 1); ++x)
            if (flags[std::size_t(y) * grid.columns + x]) return true;
    return false;
}

} // namespace

TileGrid make_tiles(const PixelRect& part) {
    const auto split = [](int begin, int length) {
        std::vector<std::pair<int, int>> spans; // begin in the part, length
        for (int at = begin; at < begin + length;) {
            const int end = std::min(begin + length, at - at % tile_size + tile_size);
            spans.emplace_back(at - begin, end - at);
            at = end;
        }
        return spans;
    };
    const auto columns = split(part.x, part.width), rows = split(part.y, part.height);
    TileGrid grid{int(columns.size()), int(rows.size()), {}};
    for (const auto& [y, height] : rows)
        for (const auto& [x, width] : columns) grid.tiles.push_back({{x, y, width, height}});
    return grid;
}

int next_samples(int now, int most) noexcept {
    const int step = now < 16 ? std::max(1, now) : int(std::bit_floor(unsigned(now)) / 4);
    return now > most - step ? most : now + step;
}

void choose_tiles(TileGrid& grid, double noise, int most) noexcept {
    double sum = 0, pixels = 0;
    for (const Tile& tile : grid.tiles) sum += tile.mean * area(tile), pixels += area(tile);
    const double darkest = pixels > 0 ? 0.1 * sum / pixels : 0;
    std::vector<char> noisy;
    for (const Tile& tile : grid.tiles) {
        const double limit = noise * std::max(tile.mean, darkest);
        noisy.push_back(tile.samples < least_adaptive_samples || tile.variance > limit * limit);
    }
    for (int row = 0; row < grid.rows; ++row)
        for (int column = 0; column < grid.columns; ++column) {
            Tile& tile = grid.tiles[std::size_t(row) * grid.columns + column];
            tile.more = tile.samples < most && is_any_near(grid, noisy, column, row);
        }
}

SampleCounts sample_counts(const TileGrid& grid) noexcept {
    if (grid.tiles.empty()) return {};
    SampleCounts counts{0, grid.tiles[0].samples, 0, 0};
    double pixels = 0;
    for (const Tile& tile : grid.tiles) {
        counts.mean += tile.samples * area(tile);
        counts.least = std::min(counts.least, tile.samples);
        counts.most = std::max(counts.most, tile.samples);
        counts.without += tile.samples == 0 ? area(tile) : 0;
        pixels += area(tile);
    }
    counts.mean /= pixels, counts.without /= pixels;
    return counts;
}

} // namespace bake
