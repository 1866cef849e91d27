#include "bake/preview/sampler.h"
#include <array>

namespace bake {
namespace {

std::uint32_t reversed(std::uint32_t x) noexcept {
    x = (x >> 16) | (x << 16);
    x = ((x & 0x00ff00ffu) << 8) | ((x & 0xff00ff00u) >> 8);
    x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
    x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
    return ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
}

/// Owen's scrambling: every bit is flipped by a hash of the bits above it. Multiplications by even numbers carry
/// information towards higher bits alone, hence the two reversals.
std::uint32_t scrambled(std::uint32_t x, std::uint32_t seed) noexcept {
    x = reversed(x) + seed;
    x ^= x * 0x6c50b47cu;
    x ^= x * 0xb82f1e52u;
    x ^= x * 0xc7afe638u;
    x ^= x * 0x8d22f6e6u;
    return reversed(x);
}

/// For each byte of an index and each value of it, what it contributes to the second dimension of Sobol's sequence: column k of
/// the matrix is row k of Pascal's triangle modulo 2.
constexpr auto second_columns = [] {
    std::array<std::array<std::uint32_t, 256>, 4> sums{};
    std::uint32_t column = 1u << 31;
    for (std::array<std::uint32_t, 256>& of_byte : sums)
        for (std::uint32_t bit = 1; bit < 256; bit <<= 1, column ^= column >> 1)
            for (std::uint32_t value = 0; value < 256; ++value)
                if (value & bit) of_byte[value] ^= column;
    return sums;
}();

std::uint32_t second_dimension(std::uint32_t index) noexcept {
    return second_columns[0][index & 255] ^ second_columns[1][index >> 8 & 255] ^ second_columns[2][index >> 16 & 255] ^
           second_columns[3][index >> 24];
}

float unit(std::uint32_t bits) noexcept { return float(bits >> 8) * 0x1p-24f; }

} // namespace

std::uint64_t hash(std::uint64_t z) noexcept {
    z += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

Sampler::Sampler(int x, int y, int index, std::uint32_t seed) noexcept
    : pixel_(hash((std::uint64_t(std::uint32_t(y)) << 32 | std::uint32_t(x)) ^ hash(seed))),
      index_(std::uint32_t(index)) {}

Vec2f Sampler::next2() noexcept {
    const std::uint64_t bits = hash(pixel_ + ++pair_);
    const auto low = std::uint32_t(bits), high = std::uint32_t(bits >> 32);
    // The order of the points differs between pairs, which would be correlated otherwise.
    const std::uint32_t index = scrambled(index_, low ^ high);
    return {unit(scrambled(reversed(index), low)), unit(scrambled(second_dimension(index), high))};
}

Sampler Sampler::branch() const noexcept { return {hash(pixel_ ^ hash(~std::uint64_t(pair_))), index_}; }

std::uint32_t second_seed(std::uint32_t seed) noexcept { return std::uint32_t(hash(std::uint64_t(1) << 32 | seed)); }

Vec2d pixel_sample(int spp, Sampler& sampler) noexcept {
    if (spp > 1) return Vec2d(sampler.next2());
    sampler.skip();
    return Vec2d(0.5);
}

} // namespace bake
