// Ward, "Real Pixels", Graphics Gems II; the run-length encoding of Radiance's color.c.
#include "bake/picture/rgbe_writer.h"
#include <algorithm>
#include <array>
#include <cmath>

namespace bake {
namespace {

std::array<unsigned char, 4> texel_of(const float* rgb) noexcept {
    float v[3], largest = 0;
    for (int c = 0; c < 3; ++c) v[c] = rgb[c] > 0 ? std::min(rgb[c], 1e38f) : 0.0f, largest = std::max(largest, v[c]);
    if (largest < 1e-38f) return {0, 0, 0, 0};
    int exponent = std::ilogb(largest) + 1; // largest = f 2^exponent, f in [.5, 1)
    if (std::floor(std::ldexp(largest, 8 - exponent) + 0.5f) > 255) ++exponent;
    std::array<unsigned char, 4> texel;
    for (std::size_t c = 0; c < 3; ++c)
        texel[c] = static_cast<unsigned char>(std::floor(std::ldexp(v[c], 8 - exponent) + 0.5f));
    texel[3] = static_cast<unsigned char>(exponent + 128);
    return texel;
}

/// Runs of 4 and more equal bytes as a count above 128 and the byte, others as a count up to 128 and the bytes.
void append_runs(std::string& to, const std::string& bytes) {
    for (std::size_t at = 0; at < bytes.size();) {
        const auto run_at = [&](std::size_t i) {
            std::size_t n = 1;
            while (i + n < bytes.size() && n < 127 && bytes[i + n] == bytes[i]) ++n;
            return n;
        };
        if (const std::size_t run = run_at(at); run >= 4) {
            to += char(128 + run), to += bytes[at];
            at += run;
            continue;
        }
        std::size_t count = 1;
        while (at + count < bytes.size() && count < 128 && run_at(at + count) < 4) ++count;
        to += char(count), to.append(bytes, at, count);
        at += count;
    }
}

} // namespace

void write_rgbe(BlockWriter& out, const Image<float>& radiance) {
    const int width = radiance.width();
    const bool runs = width >= 8 && width <= 32767;
    out.write("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(radiance.height()) + " +X " +
              std::to_string(width) + "\n");
    write_rows(out, std::size_t(radiance.height()), [&](std::string& block, std::size_t y) {
        std::array<std::string, 4> planes;
        for (int x = 0; x < width; ++x) {
            const auto texel = texel_of(&radiance.at(x, int(y)));
            for (std::size_t c = 0; c < 4; ++c) planes[c] += char(texel[c]);
        }
        if (runs) {
            block += {2, 2, char(width >> 8), char(width)};
            for (const std::string& plane : planes) append_runs(block, plane);
            return;
        }
        for (std::size_t x = 0; x < std::size_t(width); ++x)
            for (const std::string& plane : planes) block += plane[x];
    });
}

} // namespace bake
