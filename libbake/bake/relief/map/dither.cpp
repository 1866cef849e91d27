#include "bake/relief/map/dither.h"
#include "bake/base/parallel.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

constexpr float levels = 255;

/// From 0 to 1, spread evenly over any few neighbours.
float threshold(int x, int y, int channel) noexcept {
    const auto fraction = [](double v) { return v - std::floor(v); };
    constexpr int apart = 41; // texels between the patterns of two channels, in x; in y a third as many
    const double u = x + apart * channel, v = y + apart / 3 * channel;
    return float(fraction(52.9829189 * fraction(0.06711056 * u + 0.00583715 * v)));
}

/// offset(x, y, channel): what is added before the fraction is cut off.
template <class Offset> Image<float> quantised(const Image<float>& map, const Offset& offset) {
    Image<float> out(map.width(), map.height(), map.channels());
    for_rows(map.height(), 16, [&](std::int64_t begin, std::int64_t end) {
        for (auto y = int(begin); y < int(end); ++y)
            for (int x = 0; x < map.width(); ++x)
                for (int c = 0; c < map.channels(); ++c)
                    out.at(x, y, c) =
                        std::clamp(std::floor(map.at(x, y, c) * levels + offset(x, y, c)), 0.0f, levels) / levels;
    });
    return out;
}

} // namespace

Image<float> dithered(const Image<float>& map) { return quantised(map, threshold); }

Image<float> rounded(const Image<float>& map) {
    return quantised(map, [](int, int, int) { return 0.5f; });
}

} // namespace bake
