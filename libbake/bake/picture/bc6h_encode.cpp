#include "bake/base/parallel.h"
#include "bake/picture/bc6h.h"
#include "bake/picture/bc6h_fit.h"
#include <algorithm>

namespace bake {

std::string bc6h_encode(const Image<float>& radiance) {
    const int across = (radiance.width() + 3) / 4;
    std::string out(bc6h_bytes(radiance.width(), radiance.height()), '\0');
    for_rows((radiance.height() + 3) / 4, 4, [&](std::int64_t begin, std::int64_t end) {
        for (auto by = int(begin); by < int(end); ++by)
            for (int bx = 0; bx < across; ++bx) {
                Bc6hTexels texels;
                for (int i = 0; i < 16; ++i) {
                    const int x = std::min(4 * bx + i % 4, radiance.width() - 1),
                              y = std::min(4 * by + i / 4, radiance.height() - 1);
                    for (int c = 0; c < 3; ++c) {
                        const float value = radiance.at(x, y, c);
                        // Written so that NaN becomes 0.
                        texels[std::size_t(i)][std::size_t(c)] = value > 0 ? std::min(value, 65504.0f) : 0.0f;
                    }
                }
                const std::array<char, 16> bytes = pack(fit_bc6h(texels));
                std::copy(bytes.begin(), bytes.end(),
                          out.begin() + 16 * (std::ptrdiff_t(by) * across + std::ptrdiff_t(bx)));
            }
    });
    return out;
}

} // namespace bake
