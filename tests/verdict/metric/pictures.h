// Pictures for tests of metrics.
#pragma once
#include "bake/picture/image.h"
#include <cstddef>

namespace bake::test {

/// value(x, y, c) at each pixel and channel.
template <class Value> Image<float> picture(int width, int height, int channels, const Value& value) {
    Image<float> image(width, height, channels);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < channels; ++c) image.at(x, y, c) = float(value(x, y, c));
    return image;
}

/// A value in [0, 1) that looks random.
inline double noise(int x, int y, int c, unsigned seed = 0) {
    unsigned h = 2654435769u * unsigned(x) + 2246822519u * unsigned(y) + 3266489917u * unsigned(c) + 668265263u * seed;
    h = (h ^ (h >> 15)) * 2246822519u;
    h = (h ^ (h >> 13)) * 3266489917u;
    return double((h ^ (h >> 16)) >> 8) / (1 << 24);
}

/// Three channels of noise.
inline Image<float> noisy(int width, int height, unsigned seed) {
    return picture(width, height, 3, [seed](int x, int y, int c) { return noise(x, y, c, seed); });
}

inline bool equal(const Image<float>& a, const Image<float>& b) {
    if (a.width() != b.width() || a.height() != b.height() || a.channels() != b.channels()) return false;
    for (std::size_t i = 0; i < a.size(); ++i)
        if (a.data()[i] != b.data()[i]) return false;
    return true;
}

} // namespace bake::test
