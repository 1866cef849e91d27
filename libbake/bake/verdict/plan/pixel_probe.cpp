#include "bake/verdict/plan/pixel_probe.h"
#include "bake/base/parallel.h"
#include "bake/preview/pixel_samples.h"
#include <bit>

namespace bake {
namespace {

constexpr std::int64_t pixels_per_task = 4;

/// Object pixels from which an object of `pixels` pixels can pass. Many large errors lie along contours, and of n pixels a share
/// of about 1 / sqrt(n) lies there. With 8 sqrt(n) pixels as many of them are seen as with 256 pixels of an object of 1000.
int pass_from_of(std::size_t pixels) noexcept { return int(std::min(8 * std::sqrt(double(pixels)), 1e9)); }

std::uint32_t seed_of_round(std::uint32_t seed, std::size_t round) noexcept {
    return round == 0 ? seed : std::uint32_t(hash(std::uint64_t(round) << 32 | seed));
}

/// Renders pixels of one scene.
class Prober {
public:
    Prober(const ProbedScene& probed, const ProbeOptions& options)
        : scene_(*probed.scene), of_object_(probed.of_object), settings_(options.settings),
          half_(std::clamp(options.half, 1, 32)), frame_(camera_frame(options.camera)),
          // Beyond these limits 2^stops is 0 or infinite, and 0 times infinite is not a number.
          scale_(std::exp2(std::clamp(options.exposure, -126.0f, 126.0f))), seeds_{options.seed,
                                                                                   second_seed(options.seed)} {
        frame_.position -= scene_.origin;
        settings_.spp = 2 * half_; // textures are filtered as in a picture of two such halves
    }

    ProbedPixel operator()(const Pixel& pixel) const noexcept {
        ProbedPixel out;
        out.samples = half_;
        for (const int half : {0, 1}) {
            Vec3d sum(0);
            for (int first = 0; first < half_; first += packet_size) add_packet(pixel, half, first, sum, out);
            out.mean[std::size_t(half)] = Vec3f(sum / double(half_));
        }
        return out;
    }

private:
    void add_packet(const Pixel& pixel, int half, int first, Vec3d& sum, ProbedPixel& out) const noexcept {
        std::array<PrimaryRay, packet_size> rays;
        std::array<PrimaryHit, packet_size> hits;
        const int count = std::min(packet_size, half_ - first);
        for (int lane = 0; lane < count; ++lane) {
            PrimaryRay& ray = rays[std::size_t(lane)];
            ray.sampler = Sampler(pixel.x, pixel.y, first + lane, seeds_[half]);
            set_camera_ray(frame_, settings_, Vec2d(pixel.x, pixel.y) + pixel_sample(settings_.spp, ray.sampler), ray);
        }
        trace(scene_, rays, (PacketMask(1) << count) - 1, settings_.bounces, false, hits);
        for (int lane = 0; lane < count; ++lane) {
            const PrimaryHit& hit = hits[std::size_t(lane)];
            sum += Vec3d(shown(hit.radiance.total()));
            out.covered[std::size_t(half)] |= std::uint32_t(is_object(hit.first.hit)) << (first + lane);
        }
    }
    Vec3f shown(const Vec3f& radiance) const noexcept {
        if (!is_finite(radiance)) return Vec3f(0);
        return glm::clamp(scale_ * radiance, 0.0f, 1.0f);
    }
    bool is_object(const Hit& hit) const noexcept {
        return of_object_.empty() || (hit && hit.mesh < of_object_.size() && of_object_[hit.mesh]);
    }

    const Scene& scene_;
    std::span<const std::uint8_t> of_object_;
    RenderSettings settings_;
    int half_;
    CameraFrame frame_; ///< relative to the origin of the scene
    float scale_;
    std::uint32_t seeds_[2];
};

} // namespace

std::vector<ProbedPixel> probe_pixels(const ProbedScene& scene, std::span<const Pixel> pixels,
                                      const ProbeOptions& options) {
    const Prober probe(scene, options);
    std::vector<ProbedPixel> out(pixels.size());
    for_rows(std::int64_t(pixels.size()), pixels_per_task, [&](std::int64_t begin, std::int64_t end) {
        for (auto i = std::size_t(begin); i < std::size_t(end); ++i) out[i] = probe(pixels[i]);
    });
    return out;
}

PixelSquare square_of(const ProbedPixel& candidate, const ProbedPixel& reference) noexcept {
    const int covered = std::popcount(candidate.covered[0] | reference.covered[0]) +
                        std::popcount(candidate.covered[1] | reference.covered[1]);
    if (covered == 0) return {};
    const Vec3d a(candidate.mean[0] - reference.mean[0]), b(candidate.mean[1] - reference.mean[1]);
    const double product = (glm::dot(a, a) - glm::dot(b, b)) / 6;
    return {glm::dot(a, b) / 3, double(covered) / (2.0 * reference.samples), product * product};
}

ReferenceProbe::ReferenceProbe(const ProbedScene& reference, std::vector<Pixel> pixels, const ProbeOptions& options)
    : reference_(reference), pixels_(std::move(pixels)), options_(options) {}

bool ReferenceProbe::visit(const ProbedScene& candidate, std::int64_t wanted, int rounds, Visit& visited) {
    const std::size_t count = pixels_.size(), last = count * std::size_t(rounds);
    SquareEstimate now = visited.tally.estimate();
    while (now.pixels < wanted && visited.next < last) {
        // As many as are missing, so that hardly any are rendered in vain; some more for the sake of the threads.
        const std::size_t step = std::size_t(std::max<std::int64_t>(wanted - now.pixels, 4 * pixels_per_task));
        const std::size_t round = visited.next / count, end = std::min(visited.next + step, (round + 1) * count);
        const auto part = [&](std::size_t from) {
            return std::span(pixels_).subspan(from - round * count, end - from);
        };
        ProbeOptions options = options_;
        options.seed = seed_of_round(options_.seed, round);
        if (rendered_.size() < end) {
            const auto more = probe_pixels(reference_, part(rendered_.size()), options);
            rendered_.insert(rendered_.end(), more.begin(), more.end());
        }
        const auto shown = probe_pixels(candidate, part(visited.next), options);
        for (std::size_t i = 0; i < shown.size(); ++i)
            visited.tally.add(square_of(shown[i], rendered_[visited.next + i]));
        visited.next = end;
        now = visited.tally.estimate();
        if (end == count) visited.object_pixels = now.pixels;
    }
    return visited.next < last;
}

SquareEstimate ReferenceProbe::estimate(const Visit& visited) const noexcept {
    const double share = pixels_.empty() ? 1 : double(visited.next) / double(pixels_.size());
    SquareEstimate out = visited.tally.estimate(std::min(share, 1.0));
    out.all = visited.next >= pixels_.size();
    if (out.all) out.pixels = visited.object_pixels;
    return out;
}

ReferenceProbe::Result ReferenceProbe::judge(const ProbedScene& candidate, double budget, double reference_error,
                                             StoppingRule rule) {
    rule.pass_from = std::max(rule.pass_from, std::min(rule.most, pass_from_of(pixels_.size())));
    Visit visited;
    double wanted = std::max(1, rule.first);
    for (;;) {
        const bool more = visit(candidate, std::int64_t(std::min(wanted, double(rule.most))), rule.rounds, visited);
        Result result{estimate(visited)};
        result.settled = bake::judge(result.estimate, budget, reference_error, rule);
        if (result.settled != Settled::open || !more || wanted >= rule.most) return result;
        if (rule.until_reference && bake::judge(result.estimate, budget, 0, rule) != Settled::open) return result;
        wanted = std::max(wanted + 1, std::floor(wanted * rule.growth));
    }
}

SquareEstimate ReferenceProbe::measure(const ProbedScene& candidate, int pixels) {
    Visit visited;
    visit(candidate, pixels, 1, visited);
    return estimate(visited);
}

} // namespace bake
