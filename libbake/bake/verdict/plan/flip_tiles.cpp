#include "bake/verdict/plan/flip_tiles.h"
#include "bake/verdict/metric/flip.h"
#include <algorithm>
#include <map>

namespace bake {
namespace {

/// A tile without its margin: pixels of the lattice of tiles.
struct Tile {
    PixelRect inner, outer;
    std::vector<Pixel> object; ///< pixels of the object in it
};

/// Tiles of a lattice that hold pixels of the object: those of the first pixels, up to the number that is wanted.
std::vector<Tile> choose_tiles(std::span<const Pixel> pixels, const RenderSettings& settings,
                               const TileOptions& options) {
    std::map<std::pair<int, int>, std::size_t> known;
    std::vector<Tile> tiles;
    for (const Pixel& pixel : pixels) {
        const auto key = std::pair(pixel.y / options.size, pixel.x / options.size);
        const auto at = known.find(key);
        if (at != known.end()) {
            tiles[at->second].object.push_back(pixel);
            continue;
        }
        if (int(tiles.size()) >= options.tiles) continue;
        known[key] = tiles.size();
        Tile tile;
        const int x = key.second * options.size, y = key.first * options.size;
        const int right = std::min(x + options.size, settings.width),
                  below = std::min(y + options.size, settings.height);
        tile.inner = {x, y, right - x, below - y};
        const int x0 = std::max(0, x - options.margin), y0 = std::max(0, y - options.margin);
        tile.outer = {x0, y0, std::min(settings.width, right + options.margin) - x0,
                      std::min(settings.height, below + options.margin) - y0};
        tile.object.push_back(pixel);
        tiles.push_back(std::move(tile));
    }
    return tiles;
}

struct Rendered {
    Image<float> picture;
    std::vector<bool> object; ///< pixels some ray of which hits it
};

Rendered render_tile(const ProbedScene& scene, const PixelRect& part, const ProbeOptions& options) {
    std::vector<Pixel> pixels;
    for (int y = part.y; y < part.y + part.height; ++y)
        for (int x = part.x; x < part.x + part.width; ++x) pixels.push_back({x, y});
    const std::vector<ProbedPixel> probed = probe_pixels(scene, pixels, options);
    Rendered out{Image<float>(part.width, part.height, 3), std::vector<bool>(pixels.size())};
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const Vec3f mean = 0.5f * (probed[i].mean[0] + probed[i].mean[1]);
        for (int c = 0; c < 3; ++c) out.picture.data()[3 * i + std::size_t(c)] = mean[c];
        out.object[i] = (probed[i].covered[0] | probed[i].covered[1]) != 0;
    }
    return out;
}

} // namespace

SquareEstimate tile_flip(const ProbedScene& candidate, const ProbedScene& reference, std::span<const Pixel> pixels,
                         const ProbeOptions& options, const TileOptions& wanted) {
    ProbeOptions probe = options;
    probe.half = wanted.half;
    SquareEstimate estimate;
    std::size_t visited = 0;
    std::vector<std::pair<double, double>> sums; ///< of each tile: of FLIP, and number of pixels
    for (const Tile& tile : choose_tiles(pixels, options.settings, wanted)) {
        visited += tile.object.size();
        const Rendered test = render_tile(candidate, tile.outer, probe),
                       shown = render_tile(reference, tile.outer, probe);
        const Image<float> errors = flip(shown.picture, test.picture);
        auto& [sum, count] = sums.emplace_back(0.0, 0.0);
        for (const Pixel& pixel : tile.object) {
            const int x = pixel.x - tile.outer.x, y = pixel.y - tile.outer.y;
            const std::size_t at = std::size_t(y) * std::size_t(tile.outer.width) + std::size_t(x);
            if (test.object[at] || shown.object[at]) sum += double(errors.at(x, y)), ++count;
        }
    }
    double sum = 0, count = 0, squares = 0;
    for (const auto& [s, n] : sums) sum += s, count += n;
    estimate.all = visited == pixels.size();
    if (!(count > 0)) return estimate;
    const double mean = sum / count;
    for (const auto& [s, n] : sums) squares += (s - mean * n) * (s - mean * n);
    estimate.square = mean * mean;
    estimate.pixels = std::int64_t(count);
    // The tiles that were left out could differ as these do.
    if (!estimate.all) estimate.error = 2 * mean * std::sqrt(squares) / count;
    return estimate;
}

} // namespace bake
