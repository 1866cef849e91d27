#include "bake/picture/upright.h"
#include "bake/base/parallel.h"
#include "bake/picture/image_types.h"
#include <algorithm>
#include <cstdint>
#include <utility>

namespace bake {

Image<float> upright(Image<float> stored, int orientation) {
    if (orientation < 2 || orientation > 8) return stored;
    const bool swaps = swaps_axes(orientation);
    const bool from_right = orientation == 2 || orientation == 3 || orientation == 6 || orientation == 7;
    const bool from_bottom = orientation == 3 || orientation == 4 || orientation == 7 || orientation == 8;
    const int channels = stored.channels(), width = swaps ? stored.height() : stored.width(),
              height = swaps ? stored.width() : stored.height();
    Image<float> turned(width, height, channels);
    // Where the axes are swapped, rows of the result are columns of the source: by short runs, so that lines of the cache
    // are used more than once.
    for_rows(height, 64, [&](std::int64_t begin, std::int64_t end) {
        for (int left = 0; left < width; left += 64)
            for (auto y = int(begin); y < int(end); ++y)
                for (int x = left; x < std::min(width, left + 64); ++x) {
                    const int across = from_right ? width - 1 - x : x, down = from_bottom ? height - 1 - y : y;
                    std::copy_n(swaps ? &stored.at(down, across) : &stored.at(across, down), channels,
                                &turned.at(x, y));
                }
    });
    return turned;
}

void turn_upright(ImageInfo& info, int orientation) {
    if (orientation < 2 || orientation > 8) return;
    if (swaps_axes(orientation)) std::swap(info.width, info.height);
    info.notes.push_back("is stored turned or mirrored (orientation " + std::to_string(orientation) +
                         ") and was turned upright");
}

int exif_orientation(std::string_view exif) noexcept {
    const bool big_endian = exif.starts_with("MM");
    const auto number = [&](std::size_t at, std::size_t bytes) {
        std::uint32_t value = 0;
        for (std::size_t i = 0; i < bytes && at + bytes <= exif.size(); ++i)
            value |= std::uint32_t(static_cast<unsigned char>(exif[at + i])) << 8 * (big_endian ? bytes - 1 - i : i);
        return value;
    };
    const std::size_t directory = number(4, 4), count = number(directory, 2);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t entry = directory + 2 + 12 * i;
        if (entry + 12 > exif.size()) break;
        if (number(entry, 2) == 274) return std::clamp(int(number(entry + 8, 2)), 0, 9);
    }
    return 1;
}

} // namespace bake
