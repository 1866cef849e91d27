#include "bake/environment/sky/frame.h"
#include <algorithm>

namespace bake {

Image<float> framed(const Cube& cube, CubeFace face_of) {
    const Image<float>& face = cube[face_of];
    const int n = face.width(), channels = face.channels();
    Image<float> wide(n + 2, n + 2, channels);
    for (int y = 0; y < n; ++y)
        std::copy(face.row(y), face.row(y) + std::size_t(n) * channels, wide.row(y + 1) + channels);
    const auto copy_across = [&](int x, int y) {
        const CubeTexel there = texel_across(n, face_of, x, y);
        const float* from = &cube[there.face].at(there.x, there.y);
        std::copy(from, from + channels, &wide.at(x + 1, y + 1));
    };
    for (int i = 0; i < n; ++i)
        for (const int outside : {-1, n}) copy_across(outside, i), copy_across(i, outside);
    for (const int x : {0, n + 1})
        for (const int y : {0, n + 1})
            for (int c = 0; c < channels; ++c) {
                const int x_in = std::clamp(x, 1, n), y_in = std::clamp(y, 1, n);
                wide.at(x, y, c) = (wide.at(x_in, y_in, c) + wide.at(x, y_in, c) + wide.at(x_in, y, c)) / 3;
            }
    return wide;
}

} // namespace bake
