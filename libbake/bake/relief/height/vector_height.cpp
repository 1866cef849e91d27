#include "bake/relief/height/vector_height.h"
#include "bake/base/error.h"
#include <cmath>

namespace bake {

Image<float> read_vector_height(const std::string& path, ImageInfo* info) {
    ImageInfo own;
    const Image<float> picture = read_image(path, &own);
    if (info) *info = own;
    std::vector<int> colours;
    for (int c = 0; c < picture.channels(); ++c)
        if (c != own.alpha_channel) colours.push_back(c);
    if (colours.size() < 3)
        throw Error(Refusal::unsuitable,
                    path + ": has " + std::to_string(colours.size()) + " colour channel" +
                        (colours.size() == 1 ? "" : "s") +
                        ", a vector needs three; give a picture with three, or read it as a height");
    Image<float> vectors(picture.width(), picture.height(), 3);
    std::int64_t bad = 0;
    int bad_x = 0, bad_y = 0;
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x)
            for (int c = 0; c < 3; ++c) {
                const float value = vectors.at(x, y, c) = picture.at(x, y, colours[c]);
                if (std::abs(value) <= 1e12f) continue;
                if (bad++ == 0) bad_x = x, bad_y = y;
            }
    if (bad > 0)
        throw Error(Refusal::unsuitable, path + ": " + std::to_string(bad) +
                                             " values are NaN, infinite or beyond 1e12, the first at texel (" +
                                             std::to_string(bad_x) + ", " + std::to_string(bad_y) +
                                             "); repair the picture");
    return vectors;
}

} // namespace bake
