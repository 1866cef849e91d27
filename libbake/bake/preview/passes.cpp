#include "bake/preview/passes.h"
#include "bake/base/error.h"
#include "bake/base/parallel.h"
#include "bake/base/progress.h"
#include "bake/preview/pixel_samples.h"
#include <algorithm>

namespace bake {
namespace {

bool contains(const PixelRect& rect, int x, int y) noexcept {
    return x >= rect.x && x < rect.x + rect.width && y >= rect.y && y < rect.y + rect.height;
}

void put3(const Vec3d& value, float* to) noexcept {
    for (int c = 0; c < 3; ++c) to[c] = float(value[c]);
}

} // namespace

Passes::Passes(const Scene& scene, const RenderSettings& settings, const PassOptions& options)
    : scene_(scene), settings_(settings), options_(options), halves_(options.halves || options.noise > 0),
      part_(settings.part.value_or(PixelRect{0, 0, settings.width, settings.height})), frame_(camera_frame(scene)),
      grid_(make_tiles(part_)), start_(std::chrono::steady_clock::now()) {
    settings_.spp = std::max(1, settings_.spp);
    if (halves_) settings_.spp += settings_.spp % 2;
    const std::size_t pixels = std::size_t(part_.width) * part_.height;
    sums_.resize(pixels, Vec3d(0));
    if (halves_) odd_sums_.resize(pixels, Vec3d(0));
    if (options_.layers) layers_.resize(pixels), materials_ = material_numbers(scene);
    stats_.resize(grid_.tiles.size());
}

bool Passes::is_late() const noexcept {
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start_;
    return options_.seconds > 0 && spent.count() >= options_.seconds;
}

Vec3d Passes::mean(std::size_t pixel, int samples) const noexcept {
    const Vec3d sum = halves_ ? sums_[pixel] + odd_sums_[pixel] : sums_[pixel];
    return samples > 0 ? sum / double(samples) : Vec3d(0);
}

Vec3d Passes::half_mean(std::size_t pixel, int which, int samples) const noexcept {
    return samples > 1 ? (which ? odd_sums_ : sums_)[pixel] / double(samples / 2) : Vec3d(0);
}

void Passes::measure(Tile& tile) const noexcept {
    double sum = 0, squares = 0;
    for (int y = tile.rect.y; y < tile.rect.y + tile.rect.height; ++y)
        for (int x = tile.rect.x; x < tile.rect.x + tile.rect.width; ++x) {
            const std::size_t pixel = std::size_t(y) * part_.width + x;
            const Vec3d a = half_mean(pixel, 0, tile.samples), b = half_mean(pixel, 1, tile.samples);
            sum += a.x + a.y + a.z + b.x + b.y + b.z;
            squares += glm::dot(a - b, a - b);
        }
    // Of independent a and b the square of their difference is on the average the sum of their variances, and the
    // variance of their mean is a quarter of that sum.
    const double values = 3.0 * tile.rect.width * tile.rect.height;
    tile.mean = sum / (2 * values), tile.variance = squares / (4 * values);
}

void Passes::render_block(const PixelBlock& block, const Tile& tile, int samples, RenderStats& stats) {
    const auto set_ray = [&](const Vec2d& at, PrimaryRay& to) { set_camera_ray(frame_, settings_, at, to); };
    const auto add = [&](int lane, int i, const Ray&, const Radiance* value, const PrimaryHit& hit) {
        const int column = block.column(lane) - part_.x, row = block.row(lane) - part_.y;
        if (!contains(tile.rect, column, row)) return; // of another part of the picture
        const std::size_t pixel = std::size_t(row) * part_.width + column;
        if (value) (halves_ && i % 2 ? odd_sums_ : sums_)[pixel] += Vec3d(value->total());
        stats += hit.stats;
        if (!options_.layers) return;
        LayerSums& layers = layers_[pixel];
        if (value) layers.add(*value, hit.first);
        if (i == 0) layers.set_first(hit.first, materials_);
        layers.rays += double(hit.stats.rays);
    };
    add_samples(scene_, settings_, block, {tile.samples, samples, halves_}, set_ray, add, options_.layers);
}

void Passes::render_tile(std::size_t index, int samples, const TileDone& done) {
    Tile& tile = grid_.tiles[index];
    const std::int64_t rays_before = stats_[index].rays;
    const PixelRect& rect = tile.rect;
    const int x = part_.x + rect.x, y = part_.y + rect.y; // of the tile in the picture
    for (int row = y - y % block_edge; row < y + rect.height; row += block_edge)
        for (int column = x - x % block_edge; column < x + rect.width; column += block_edge)
            render_block(block_at(column, row, settings_.width, settings_.height), tile, samples, stats_[index]);
    samples_done_.fetch_add(std::int64_t(samples - tile.samples) * tile.rect.width * tile.rect.height,
                            std::memory_order_relaxed);
    rays_done_.fetch_add(stats_[index].rays - rays_before, std::memory_order_relaxed);
    tile.samples = samples;
    if (options_.noise > 0) measure(tile);
    if (!done) return;
    std::vector<float> values;
    for (int row = rect.y; row < rect.y + rect.height; ++row)
        for (int column = rect.x; column < rect.x + rect.width; ++column) {
            const Vec3f shown(mean(std::size_t(row) * part_.width + column, samples));
            values.insert(values.end(), {shown.x, shown.y, shown.z});
        }
    done(rect, values);
}

bool Passes::next(const TileDone& done) {
    const int step = halves_ ? 2 : 1;
    const bool first = samples_ == 0;
    const int target =
        std::min(settings_.spp, first ? std::max(options_.first, step) : next_samples(samples_, settings_.spp));
    const auto wants = [](const Tile& tile) { return tile.more; };
    if (interrupted() || (!first && is_late()) || std::none_of(grid_.tiles.begin(), grid_.tiles.end(), wants))
        return false;
    try {
        for_rows(std::int64_t(grid_.tiles.size()), 1, [&](std::int64_t begin, std::int64_t end) {
            for (std::size_t i = std::size_t(begin); i < std::size_t(end); ++i)
                if (grid_.tiles[i].more && (first || !is_late())) render_tile(i, target, done);
        });
    } catch (const Error& error) {
        if (error.refusal != Refusal::interrupted) throw;
        return false;
    }
    samples_ = target;
    if (options_.noise > 0) choose_tiles(grid_, options_.noise, settings_.spp);
    else
        for (Tile& tile : grid_.tiles) tile.more = tile.samples < settings_.spp;
    return true;
}

template <class Write> void Passes::for_pixels(const Write& write) const {
    for (const Tile& tile : grid_.tiles)
        for (int y = tile.rect.y; y < tile.rect.y + tile.rect.height; ++y)
            for (int x = tile.rect.x; x < tile.rect.x + tile.rect.width; ++x)
                write(std::size_t(y) * part_.width + x, tile.samples, x, y);
}

Image<float> Passes::picture() const {
    Image<float> image(part_.width, part_.height, 3);
    for_pixels([&](std::size_t pixel, int samples, int x, int y) { put3(mean(pixel, samples), &image.at(x, y)); });
    return image;
}

Image<float> Passes::half(int which) const {
    Image<float> image(part_.width, part_.height, 3);
    for_pixels(
        [&](std::size_t pixel, int samples, int x, int y) { put3(half_mean(pixel, which, samples), &image.at(x, y)); });
    return image;
}

Image<float> Passes::layers() const {
    Image<float> image(part_.width, part_.height, int(layer_channels(options_.halves).size()));
    for_pixels([&](std::size_t pixel, int samples, int x, int y) {
        const Vec3d total = halves_ ? sums_[pixel] + odd_sums_[pixel] : sums_[pixel];
        float* const end = write_layers(layers_[pixel], total, samples, &image.at(x, y));
        if (!options_.halves) return;
        for (const int which : {0, 1}) put3(half_mean(pixel, which, samples), end + 3 * which);
    });
    return image;
}

RenderStats Passes::stats() const noexcept {
    RenderStats sum;
    for (const RenderStats& tile : stats_) sum += tile;
    return sum;
}

} // namespace bake
