// Equal things found by hashing: each gets the number of its kind.
#pragma once
#include <bit>
#include <cstdint>
#include <vector>

namespace bake {

/// Numbers in order of first appearance.
struct Numbered {
    std::vector<std::uint32_t> number; ///< one per thing
    std::vector<std::uint32_t> first;  ///< per number, the first thing that has it
};

/// A good mix of the bits of a hash that is built word by word: start with any constant.
inline std::uint64_t mixed(std::uint64_t hash, std::uint64_t word) noexcept {
    hash = (hash ^ word) * 0x9e3779b97f4a7c15u;
    return hash ^ hash >> 32;
}
/// The bits of a float, those of 0 for -0.
inline std::uint32_t float_bits(float value) noexcept { return std::bit_cast<std::uint32_t>(value + 0.0f); }

/// `things` fewer than 2^32 - 1; hash(i) is a std::uint64_t, equal where equal(i, j) holds.
template <class Hash, class Equal> Numbered number_distinct(std::size_t things, Hash&& hash, Equal&& equal) {
    constexpr std::uint32_t free = 0xffffffffu;
    const std::size_t mask = std::bit_ceil(2 * things + 1) - 1;
    std::vector<std::uint32_t> table(mask + 1, free); // numbers, at the first free place from their hash on
    Numbered out;
    out.number.resize(things);
    for (std::uint32_t i = 0; i < things; ++i) {
        std::size_t place = hash(i) & mask;
        while (table[place] != free && !equal(out.first[table[place]], i)) place = (place + 1) & mask;
        if (table[place] == free) {
            table[place] = std::uint32_t(out.first.size());
            out.first.push_back(i);
        }
        out.number[i] = table[place];
    }
    return out;
}

} // namespace bake
