#include "bake/base/parallel.h"
#include "bake/picture/bc6h.h"
#include "bake/picture/bc6h_block.h"
#include <algorithm>
#include <half.h>

namespace bake {
namespace {

/// Half floats, as their bits, of the 4 x 4 texels.
void decode(const char* bytes, std::array<std::array<int, 3>, 16>& texels) noexcept {
    Bc6hBlock block;
    if (!unpack(bytes, block)) return texels.fill({0, 0, 0});
    const Bc6hMode& mode = bc6h_modes[std::size_t(block.mode)];
    for (std::size_t i = 0; i < 16; ++i) {
        const bool second = mode.regions == 2 && (bc6h_shapes[std::size_t(block.shape)] >> i & 1);
        const int weight = mode.regions == 2 ? bc6h_weights3[block.index[i]] : bc6h_weights4[block.index[i]];
        for (std::size_t c = 0; c < 3; ++c)
            texels[i][c] = bc6h_point(bc6h_expanded(block.endpoints[second ? 2 : 0][c], mode.bits),
                                      bc6h_expanded(block.endpoints[second ? 3 : 1][c], mode.bits), weight);
    }
}

} // namespace

std::size_t bc6h_bytes(int width, int height) noexcept {
    return std::size_t((width + 3) / 4) * std::size_t((height + 3) / 4) * 16;
}

void bc6h_decode(const char* blocks, Image<float>& radiance) {
    const int across = (radiance.width() + 3) / 4;
    for_rows((radiance.height() + 3) / 4, 8, [&](std::int64_t begin, std::int64_t end) {
        std::array<std::array<int, 3>, 16> texels;
        for (auto by = int(begin); by < int(end); ++by)
            for (int bx = 0; bx < across; ++bx) {
                decode(blocks + (std::size_t(by) * std::size_t(across) + std::size_t(bx)) * 16, texels);
                for (int y = 4 * by; y < std::min(4 * by + 4, radiance.height()); ++y)
                    for (int x = 4 * bx; x < std::min(4 * bx + 4, radiance.width()); ++x)
                        for (int c = 0; c < 3; ++c) {
                            Imath::half value;
                            value.setBits(std::uint16_t(texels[std::size_t(4 * (y % 4) + x % 4)][std::size_t(c)]));
                            radiance.at(x, y, c) = value;
                        }
            }
    });
}

} // namespace bake
