// The parts of a BC6H block, for its encoder and its decoder.
#pragma once
#include <array>
#include <cstdint>

namespace bake {

/// Endpoints 0 and 1 belong to the first region, 2 and 3 to the second.
using Bc6hEndpoints = std::array<std::array<int, 3>, 4>; // [endpoint][channel]

struct Bc6hMode {
    int code, code_bits;
    int regions;
    int bits;                  ///< of endpoint 0
    std::array<int, 3> others; ///< bits of the other endpoints, by channel
    bool deltas;               ///< the others are differences from endpoint 0
    /// The bits of the endpoints in the order of the block, after the code, as the specification lists them:
    /// "r0[9:0]" are ten bits of red of endpoint 0, the last first; "r0[10:11]" are two, the first first.
    const char* fields;
};

/// In the order of the specification: ten modes with two regions, four with one.
extern const std::array<Bc6hMode, 14> bc6h_modes;

/// The second region of a shape: bit y * 4 + x of a texel.
extern const std::array<std::uint16_t, 32> bc6h_shapes;
/// The texel of the second region whose index lacks its highest bit, which is 0. That of the first region is texel 0.
extern const std::array<std::uint8_t, 32> bc6h_anchors;

/// Of a line's second endpoint, of 64.
inline constexpr std::array<int, 16> bc6h_weights4 = {0, 4, 9, 13, 17, 21, 26, 30, 34, 38, 43, 47, 51, 55, 60, 64};
inline constexpr std::array<int, 8> bc6h_weights3 = {0, 9, 18, 27, 37, 46, 55, 64};

struct Bc6hBlock {
    int mode = 0; ///< index in bc6h_modes
    int shape = 0;
    Bc6hEndpoints endpoints{};            ///< without differences, of bc6h_modes[mode].bits bits
    std::array<std::uint8_t, 16> index{}; ///< of each texel
};

std::array<char, 16> pack(const Bc6hBlock& block) noexcept;
/// False for an unknown mode.
bool unpack(const char* bytes, Bc6hBlock& block) noexcept;

/// The 16 bits that an endpoint of `bits` bits stands for.
int bc6h_expanded(int value, int bits) noexcept;
/// The half float, as its bits, of a point of a line between two expanded endpoints.
inline int bc6h_point(int a, int b, int weight) noexcept {
    return ((a * (64 - weight) + b * weight + 32) >> 6) * 31 >> 6;
}

} // namespace bake
