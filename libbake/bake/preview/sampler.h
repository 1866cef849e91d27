// Numbers of a pixel's samples: points of a Sobol sequence, scrambled differently for each pixel and each pair of numbers.
//
// Burley, Practical Hash-based Owen Scrambling, Journal of Computer Graphics Techniques 9(4), 2020. The first 2^k
// samples of a pixel have one point in every elementary interval of area 2^-k, so that the error of a smooth mean falls
// faster than that of random numbers. Two samplers with different seeds are independent.
#pragma once
#include "bake/base/vec.h"
#include <cstdint>

namespace bake {

/// The finaliser of splitmix64 (Steele, Lea, Flood 2014).
std::uint64_t hash(std::uint64_t z) noexcept;

/// The numbers of one sample of one pixel, in [0, 1).
class Sampler {
public:
    explicit Sampler(int x = 0, int y = 0, int index = 0, std::uint32_t seed = 0) noexcept;
    /// The next pair of numbers. Calls have to come in the same order for every sample of a pixel.
    Vec2f next2() noexcept;
    float next() noexcept { return next2().x; }
    /// Leaves out a pair.
    void skip() noexcept { ++pair_; }
    /// Numbers for a path that splits off here, independent of all that this sampler gives. However many the path takes,
    /// those that follow here keep their place in the sequence, and with it their even distribution.
    Sampler branch() const noexcept;

private:
    Sampler(std::uint64_t pixel, std::uint32_t index) noexcept : pixel_(pixel), index_(index) {}

    std::uint64_t pixel_;
    std::uint32_t index_, pair_ = 0;
};

/// The seed of the second half of the samples where two independent halves are wanted.
std::uint32_t second_seed(std::uint32_t seed) noexcept;

/// Sample `index` of `spp` in the unit square of pixel (x, y): its centre for spp = 1.
Vec2d pixel_sample(int spp, Sampler& sampler) noexcept;

} // namespace bake
