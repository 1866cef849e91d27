// What a picture holds, without what its file says of how it was made.
#pragma once
#include "bake/picture/image_io.h"
#include <string>

namespace bake::test {

/// The bytes of the texels that read_image() gives, behind width, height and channels.
inline std::string texels_of(const std::string& file) {
    const Image<float> image = read_image(file);
    std::string out = std::to_string(image.width()) + " " + std::to_string(image.height()) + " " +
                      std::to_string(image.channels()) + " ";
    return out.append(reinterpret_cast<const char*>(image.data()), image.size() * sizeof(float));
}

} // namespace bake::test
