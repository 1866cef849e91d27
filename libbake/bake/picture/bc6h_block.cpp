#include "bake/picture/bc6h_block.h"
#include <bit>
#include <cstdlib>
#include <vector>

namespace bake {

// clang-format off
const std::array<Bc6hMode, 14> bc6h_modes = {{
    {0b00, 2, 2, 10, {5, 5, 5}, true,
     "g2[4] b2[4] b3[4] r0[9:0] g0[9:0] b0[9:0] r1[4:0] g3[4] g2[3:0] g1[4:0] b3[0] g3[3:0] b1[4:0] b3[1] b2[3:0] r2[4:0] b3[2] r3[4:0] b3[3]"},
    {0b01, 2, 2, 7, {6, 6, 6}, true,
     "g2[5] g3[4] g3[5] r0[6:0] b3[0] b3[1] b2[4] g0[6:0] b2[5] b3[2] g2[4] b0[6:0] b3[3] b3[5] b3[4] r1[5:0] g2[3:0] g1[5:0] g3[3:0] b1[5:0] b2[3:0] r2[5:0] r3[5:0]"},
    {0b00010, 5, 2, 11, {5, 4, 4}, true,
     "r0[9:0] g0[9:0] b0[9:0] r1[4:0] r0[10] g2[3:0] g1[3:0] g0[10] b3[0] g3[3:0] b1[3:0] b0[10] b3[1] b2[3:0] r2[4:0] b3[2] r3[4:0] b3[3]"},
    {0b00110, 5, 2, 11, {4, 5, 4}, true,
     "r0[9:0] g0[9:0] b0[9:0] r1[3:0] r0[10] g3[4] g2[3:0] g1[4:0] g0[10] g3[3:0] b1[3:0] b0[10] b3[1] b2[3:0] r2[3:0] b3[0] b3[2] r3[3:0] g2[4] b3[3]"},
    {0b01010, 5, 2, 11, {4, 4, 5}, true,
     "r0[9:0] g0[9:0] b0[9:0] r1[3:0] r0[10] b2[4] g2[3:0] g1[3:0] g0[10] b3[0] g3[3:0] b1[4:0] b0[10] b2[3:0] r2[3:0] b3[1] b3[2] r3[3:0] b3[4] b3[3]"},
    {0b01110, 5, 2, 9, {5, 5, 5}, true,
     "r0[8:0] b2[4] g0[8:0] g2[4] b0[8:0] b3[4] r1[4:0] g3[4] g2[3:0] g1[4:0] b3[0] g3[3:0] b1[4:0] b3[1] b2[3:0] r2[4:0] b3[2] r3[4:0] b3[3]"},
    {0b10010, 5, 2, 8, {6, 5, 5}, true,
     "r0[7:0] g3[4] b2[4] g0[7:0] b3[2] g2[4] b0[7:0] b3[3] b3[4] r1[5:0] g2[3:0] g1[4:0] b3[0] g3[3:0] b1[4:0] b3[1] b2[3:0] r2[5:0] r3[5:0]"},
    {0b10110, 5, 2, 8, {5, 6, 5}, true,
     "r0[7:0] b3[0] b2[4] g0[7:0] g2[5] g2[4] b0[7:0] g3[5] b3[4] r1[4:0] g3[4] g2[3:0] g1[5:0] g3[3:0] b1[4:0] b3[1] b2[3:0] r2[4:0] b3[2] r3[4:0] b3[3]"},
    {0b11010, 5, 2, 8, {5, 5, 6}, true,
     "r0[7:0] b3[1] b2[4] g0[7:0] b2[5] g2[4] b0[7:0] b3[5] b3[4] r1[4:0] g3[4] g2[3:0] g1[4:0] b3[0] g3[3:0] b1[5:0] b2[3:0] r2[4:0] b3[2] r3[4:0] b3[3]"},
    {0b11110, 5, 2, 6, {6, 6, 6}, false,
     "r0[5:0] g3[4] b3[0] b3[1] b2[4] g0[5:0] g2[5] b2[5] b3[2] g2[4] b0[5:0] g3[5] b3[3] b3[5] b3[4] r1[5:0] g2[3:0] g1[5:0] g3[3:0] b1[5:0] b2[3:0] r2[5:0] r3[5:0]"},
    {0b00011, 5, 1, 10, {10, 10, 10}, false, "r0[9:0] g0[9:0] b0[9:0] r1[9:0] g1[9:0] b1[9:0]"},
    {0b00111, 5, 1, 11, {9, 9, 9}, true, "r0[9:0] g0[9:0] b0[9:0] r1[8:0] r0[10] g1[8:0] g0[10] b1[8:0] b0[10]"},
    {0b01011, 5, 1, 12, {8, 8, 8}, true,
     "r0[9:0] g0[9:0] b0[9:0] r1[7:0] r0[10:11] g1[7:0] g0[10:11] b1[7:0] b0[10:11]"},
    {0b01111, 5, 1, 16, {4, 4, 4}, true,
     "r0[9:0] g0[9:0] b0[9:0] r1[3:0] r0[10:15] g1[3:0] g0[10:15] b1[3:0] b0[10:15]"},
}};
// clang-format on

namespace {

/// Texels of the second region row by row, each row's first texel in its lowest bit.
constexpr std::uint16_t shape(int a, int b, int c, int d) noexcept {
    // Rows are written with the first texel as their highest bit.
    const auto turned = [](int row) { return (row & 1) << 3 | (row & 2) << 1 | (row & 4) >> 1 | (row & 8) >> 3; };
    return std::uint16_t(turned(a) | turned(b) << 4 | turned(c) << 8 | turned(d) << 12);
}

/// A bit of an endpoint.
struct Place {
    std::uint8_t endpoint, channel, bit;
};

std::vector<Place> places_of(const char* fields) {
    std::vector<Place> places;
    for (const char* at = fields; *at;) {
        const int channel = *at == 'r' ? 0 : *at == 'g' ? 1 : 2, endpoint = at[1] - '0';
        char* end = nullptr;
        const int last = int(std::strtol(at + 3, &end, 10)),
                  first = *end == ':' ? int(std::strtol(end + 1, &end, 10)) : last;
        // What is listed from the higher bit down is stored from the lower bit up.
        for (int bit = first;; bit += first < last ? 1 : -1) {
            places.push_back({std::uint8_t(endpoint), std::uint8_t(channel), std::uint8_t(bit)});
            if (bit == last) break;
        }
        at = end + 1;
        if (*at == ' ') ++at;
    }
    return places;
}

const std::vector<Place>& places_of(int mode) {
    static const auto all = [] {
        std::array<std::vector<Place>, 14> lists;
        for (std::size_t i = 0; i < lists.size(); ++i) lists[i] = places_of(bc6h_modes[i].fields);
        return lists;
    }();
    return all[std::size_t(mode)];
}

int extended(int value, int bits) noexcept { return value >= 1 << (bits - 1) ? value - (1 << bits) : value; }

/// Bits of the index of a texel.
int index_bits(const Bc6hMode& mode, int shape_index, int texel) noexcept {
    const bool anchor = texel == 0 || (mode.regions == 2 && texel == bc6h_anchors[std::size_t(shape_index)]);
    return (mode.regions == 2 ? 3 : 4) - anchor;
}

} // namespace

// clang-format off
const std::array<std::uint16_t, 32> bc6h_shapes = {
    shape(0b0011, 0b0011, 0b0011, 0b0011), shape(0b0001, 0b0001, 0b0001, 0b0001), shape(0b0111, 0b0111, 0b0111, 0b0111),
    shape(0b0001, 0b0011, 0b0011, 0b0111), shape(0b0000, 0b0001, 0b0001, 0b0011), shape(0b0011, 0b0111, 0b0111, 0b1111),
    shape(0b0001, 0b0011, 0b0111, 0b1111), shape(0b0000, 0b0001, 0b0011, 0b0111), shape(0b0000, 0b0000, 0b0001, 0b0011),
    shape(0b0011, 0b0111, 0b1111, 0b1111), shape(0b0000, 0b0001, 0b0111, 0b1111), shape(0b0000, 0b0000, 0b0001, 0b0111),
    shape(0b0001, 0b0111, 0b1111, 0b1111), shape(0b0000, 0b0000, 0b1111, 0b1111), shape(0b0000, 0b1111, 0b1111, 0b1111),
    shape(0b0000, 0b0000, 0b0000, 0b1111), shape(0b0000, 0b1000, 0b1110, 0b1111), shape(0b0111, 0b0001, 0b0000, 0b0000),
    shape(0b0000, 0b0000, 0b1000, 0b1110), shape(0b0111, 0b0011, 0b0001, 0b0000), shape(0b0011, 0b0001, 0b0000, 0b0000),
    shape(0b0000, 0b1000, 0b1100, 0b1110), shape(0b0000, 0b0000, 0b1000, 0b1100), shape(0b0111, 0b0011, 0b0011, 0b0001),
    shape(0b0011, 0b0001, 0b0001, 0b0000), shape(0b0000, 0b1000, 0b1000, 0b1100), shape(0b0110, 0b0110, 0b0110, 0b0110),
    shape(0b0011, 0b0110, 0b0110, 0b1100), shape(0b0001, 0b0111, 0b1110, 0b1000), shape(0b0000, 0b1111, 0b1111, 0b0000),
    shape(0b0111, 0b0001, 0b1000, 0b1110), shape(0b0011, 0b1001, 0b1001, 0b1100),
};
const std::array<std::uint8_t, 32> bc6h_anchors = {15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15,
                                                   15, 2,  8,  2,  2,  8,  8,  15, 2,  8,  2,  2,  8,  8,  2,  2};
// clang-format on

int bc6h_expanded(int value, int bits) noexcept {
    if (bits >= 15 || value == 0) return value;
    if (value == (1 << bits) - 1) return 0xffff;
    return ((value << 16) + 0x8000) >> bits;
}

std::array<char, 16> pack(const Bc6hBlock& block) noexcept {
    const Bc6hMode& mode = bc6h_modes[std::size_t(block.mode)];
    std::array<char, 16> bytes{};
    int at = 0;
    const auto put = [&](int value, int bits) {
        for (int i = 0; i < bits; ++i, ++at) bytes[std::size_t(at / 8)] |= char((value >> i & 1) << at % 8);
    };
    put(mode.code, mode.code_bits);
    for (const Place& place : places_of(block.mode)) {
        const int first = block.endpoints[0][place.channel], own = block.endpoints[place.endpoint][place.channel];
        put((mode.deltas && place.endpoint > 0 ? own - first : own) >> place.bit, 1);
    }
    if (mode.regions == 2) put(block.shape, 5);
    for (int i = 0; i < 16; ++i) put(block.index[std::size_t(i)], index_bits(mode, block.shape, i));
    return bytes;
}

bool unpack(const char* bytes, Bc6hBlock& block) noexcept {
    int at = 0;
    const auto get = [&](int bits) {
        int value = 0;
        for (int i = 0; i < bits; ++i, ++at) value |= (bytes[at / 8] >> at % 8 & 1) << i;
        return value;
    };
    int code = get(2);
    if (code > 1) code |= get(3) << 2;
    block = {.mode = -1};
    for (int i = 0; i < 14; ++i)
        if (bc6h_modes[std::size_t(i)].code == code && bc6h_modes[std::size_t(i)].code_bits == at) block.mode = i;
    if (block.mode < 0) return false;
    const Bc6hMode& mode = bc6h_modes[std::size_t(block.mode)];
    for (const Place& place : places_of(block.mode))
        block.endpoints[place.endpoint][place.channel] |= get(1) << place.bit;
    if (mode.regions == 2) block.shape = get(5);
    for (int i = 0; i < 16; ++i) block.index[std::size_t(i)] = std::uint8_t(get(index_bits(mode, block.shape, i)));
    if (!mode.deltas) return true;
    for (std::size_t e = 1; e < 4; ++e)
        for (std::size_t c = 0; c < 3; ++c) {
            const int delta = extended(block.endpoints[e][c], mode.others[c]);
            block.endpoints[e][c] = (block.endpoints[0][c] + delta) & ((1 << mode.bits) - 1);
        }
    return true;
}

} // namespace bake
