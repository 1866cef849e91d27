// Renders chosen pixels of built scenes, and compares them.
#pragma once
#include "bake/preview/scene.h"
#include "bake/verdict/plan/error_tally.h"
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace bake {

struct Pixel {
    int x = 0, y = 0;
};

struct ProbeOptions {
    RenderSettings settings; ///< size, bounces, shadows ...; spp and part are not looked at
    Camera camera;           ///< in the scene's own coordinates
    int half = 16;           ///< samples of each half of a pixel, at most 32
    float exposure = 0;      ///< stops
    std::uint32_t seed = 0;
};

/// Of a pixel: the means of two independent halves of its samples, each sample exposed and clamped.
struct ProbedPixel {
    std::array<Vec3f, 2> mean{};
    std::array<std::uint32_t, 2> covered{}; ///< a bit per sample: its ray hits the object first
    int samples = 16;                       ///< of each half
    friend bool operator==(const ProbedPixel&, const ProbedPixel&) = default;
};

/// A scene and the instances that are the object, one entry per instance. Empty: every ray that hits anything or nothing
/// counts as covered, so that the error is over all pixels.
struct ProbedScene {
    const Scene* scene = nullptr;
    std::span<const std::uint8_t> of_object;
};

/// In the order of `pixels`; the samples of one pixel are traced as packets. The random numbers of a sample depend on the
/// pixel, the sample and the seed alone, and each purpose (place in the pixel, a light, the sky, a bounce) has numbers of
/// its own, so that another course of the path in one scene does not shift those of the other.
std::vector<ProbedPixel> probe_pixels(const ProbedScene& scene, std::span<const Pixel> pixels,
                                      const ProbeOptions& options);

/// m, a and v of one pixel in two scenes; zeros where no sample sees the object in either of them.
PixelSquare square_of(const ProbedPixel& candidate, const ProbedPixel& reference) noexcept;

/// Pixels in which some ray hits the object in one of the scenes (a lattice of rays_per_edge^2 rays each) and their
/// neighbours, in an order drawn from the seed. Rays are cast where the boxes of the object's instances can be seen. Where
/// that is a few pixels, more rays find an object smaller than a pixel; where it is more than 65000, one ray per pixel has
/// to do, and parts thinner than a pixel can be missed.
std::vector<Pixel> object_pixels(std::span<const ProbedScene> scenes, const ProbeOptions& options,
                                 int rays_per_edge = 2);

/// The error of a candidate against a reference, look by look until judge() settles it, or all pixels were visited
/// rule.rounds times, each time with new samples, or rule.most object pixels in all. What is rendered of the reference is
/// kept for further candidates. Without pixels, as of an object that is out of view, estimates have 0 pixels and an error of
/// 0, `all` is set, and every budget holds.
class ReferenceProbe {
public:
    /// The scene must outlive the object.
    ReferenceProbe(const ProbedScene& reference, std::vector<Pixel> pixels, const ProbeOptions& options);

    struct Result {
        SquareEstimate estimate;
        Settled settled = Settled::open;
    };
    /// An object of n pixels, more than 1000, can pass from 8 sqrt(n) object pixels on, or from rule.most.
    Result judge(const ProbedScene& candidate, double budget, double reference_error = 0, StoppingRule rule = {});
    /// Without a budget: at least `pixels` object pixels.
    SquareEstimate measure(const ProbedScene& candidate, int pixels = 2048);
    const std::vector<Pixel>& pixels() const noexcept { return pixels_; }

private:
    struct Visit {
        ErrorTally tally;
        std::size_t next = 0;           ///< of pixels_, counted on from round to round
        std::int64_t object_pixels = 0; ///< in the first round
    };
    /// Goes on until `wanted` object pixels are visited; false if no pixels are left in any round.
    bool visit(const ProbedScene& candidate, std::int64_t wanted, int rounds, Visit& visited);
    SquareEstimate estimate(const Visit& visited) const noexcept;

    ProbedScene reference_;
    std::vector<Pixel> pixels_;
    ProbeOptions options_;
    std::vector<ProbedPixel> rendered_; ///< of the first pixels, round by round
};

} // namespace bake
