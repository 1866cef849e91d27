#include "bake/picture/pad_texels.h"
#include "bake/base/parallel.h"
#include <algorithm>
#include <atomic>

namespace bake {

std::int64_t pad_texels(Image<float>& image, const Image<unsigned char>& owner, int padding) {
    if (padding <= 0) return 0;
    const int width = image.width(), height = image.height(), channels = image.channels();
    // Per texel, the nearest owned texel of its own row within the padding, as an x; -1 where there is none.
    Image<std::int32_t> nearest(width, height, 1);
    for_rows(height, 64, [&](std::int64_t begin, std::int64_t end) {
        for (auto y = int(begin); y < int(end); ++y) {
            const unsigned char* own = owner.row(y);
            std::int32_t* to = nearest.row(y);
            for (int x = 0, last = -1; x < width; ++x) {
                if (own[x]) last = x;
                to[x] = last >= 0 && x - last <= padding ? last : -1;
            }
            for (int x = width - 1, next = -1; x >= 0; --x) {
                if (own[x]) next = x;
                if (next >= 0 && next - x <= padding && (to[x] < 0 || next - x < x - to[x])) to[x] = next;
            }
        }
    });
    std::atomic<std::int64_t> filled{0};
    for_rows(height, 16, [&](std::int64_t begin, std::int64_t end) {
        std::int64_t filled_here = 0;
        for (auto y = int(begin); y < int(end); ++y)
            for (int x = 0; x < width; ++x) {
                if (owner.at(x, y)) continue;
                std::int64_t best = std::int64_t(padding) * padding + 1;
                int from_x = -1, from_y = -1;
                for (int j = std::max(0, y - padding); j <= std::min(height - 1, y + padding); ++j) {
                    const int i = nearest.at(x, j);
                    if (i < 0) continue;
                    const std::int64_t dx = i - x, dy = j - y, distance = dx * dx + dy * dy;
                    if (distance < best) best = distance, from_x = i, from_y = j;
                }
                if (from_x < 0) continue;
                // Owned texels are never written here, so reading them is safe on any thread.
                std::copy_n(&image.at(from_x, from_y), channels, &image.at(x, y));
                ++filled_here;
            }
        filled += filled_here;
    });
    return filled;
}

} // namespace bake
