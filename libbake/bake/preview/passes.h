// Renders a scene in passes over tiles, so that a picture exists after each of them.
#pragma once
#include "bake/preview/layers.h"
#include "bake/preview/tiles.h"
#include <atomic>
#include <chrono>
#include <functional>

namespace bake {

struct PassOptions {
    bool layers = false; ///< sums for the channels of layer_channels(), about 240 bytes more per pixel
    /// Two halves of the samples that are independent of each other: the even and the odd ones. settings.spp is rounded
    /// up to an even number.
    bool halves = false;
    /// Ends a tile where the standard error of its pixels is below this share of their radiance, see choose_tiles();
    /// settings.spp is the most samples then. 0: every pixel gets settings.spp samples. Above 0 the samples are taken in halves:
    /// the error is half the difference of two independent halves, which is neither too small nor too large on the
    /// average. Samples of one sequence are not independent of each other, so that their variance says nothing of the
    /// error of their mean.
    double noise = 0;
    double seconds = 0; ///< no pass after the first goes on for longer after the constructor; 0: no limit
    int first = 0;      ///< samples of the first pass; 0: 1, or 2 with halves
};

struct PixelBlock;

/// Pixels, and radiance of each of them, row by row, 3 channels.
using TileDone = std::function<void(const PixelRect& tile, const std::vector<float>& values)>;

/// After any pass, picture() has for a pixel of n > 1 samples the very bytes that a picture of n samples per pixel has
/// (with halves: another one with halves), and they do not depend on the number of threads. With a limit on the seconds n is a
/// matter of chance.
class Passes {
public:
    /// The scene is built and outlives the object.
    Passes(const Scene& scene, const RenderSettings& settings, const PassOptions& options = {});

    /// Renders one pass, and calls `done` from any thread for each tile in it. False if nothing is left to do: every
    /// tile is finished, or the time is over, or the user asked to stop (interrupted()), which may leave tiles as they
    /// were.
    bool next(const TileDone& done = {});

    /// Mean radiance, 3 channels; 0 where there are no samples yet.
    Image<float> picture() const;
    /// The channels of layer_channels(options.halves). Needs PassOptions::layers.
    Image<float> layers() const;
    /// Mean radiance of one of the halves, 0 or 1. Needs PassOptions::halves.
    Image<float> half(int which) const;
    RenderStats stats() const noexcept;
    SampleCounts samples() const noexcept { return sample_counts(grid_); }
    std::int64_t tile_count() const noexcept { return std::int64_t(grid_.tiles.size()); }
    std::int64_t pixel_count() const noexcept { return std::int64_t(sums_.size()); }
    /// Most samples of a pixel.
    int spp() const noexcept { return settings_.spp; }

    /// What was done up to now, for a display of the progress, from any thread.
    std::int64_t samples_done() const noexcept { return samples_done_.load(std::memory_order_relaxed); }
    std::int64_t rays_done() const noexcept { return rays_done_.load(std::memory_order_relaxed); }

private:
    void render_block(const PixelBlock& block, const Tile& tile, int samples, RenderStats& stats);
    void render_tile(std::size_t index, int samples, const TileDone& done);
    void measure(Tile& tile) const noexcept;
    Vec3d mean(std::size_t pixel, int samples) const noexcept;
    Vec3d half_mean(std::size_t pixel, int which, int samples) const noexcept;
    bool is_late() const noexcept;
    template <class Write> void for_pixels(const Write& write) const;

    const Scene& scene_;
    RenderSettings settings_;
    PassOptions options_;
    bool halves_; ///< whether samples are taken in halves, for the picture or for the noise
    PixelRect part_;
    CameraFrame frame_;
    TileGrid grid_;
    std::vector<std::uint32_t> materials_;
    std::vector<Vec3d> sums_,
        odd_sums_; ///< per pixel; with halves the even samples are in sums_, the odd ones in odd_sums_
    std::vector<LayerSums> layers_;
    std::vector<RenderStats> stats_; ///< per tile
    std::chrono::steady_clock::time_point start_;
    int samples_ = 0; ///< after the last pass, of tiles that took part in it
    std::atomic<std::int64_t> samples_done_ = 0, rays_done_ = 0;
};

} // namespace bake
