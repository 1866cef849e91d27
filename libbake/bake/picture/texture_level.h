// What a texture for graphics cards consists of.
#pragma once
#include <string>

namespace bake {

/// How texels are stored, as linear data.
enum class TexelFormat {
    r8,     ///< one channel in [0,1]
    rgba8,  ///< three channels in [0,1], and 1
    rgba16, ///< the same
    bc5,    ///< two channels in [-1,1], by bc5_encode()
};

struct TextureLevel {
    int width = 0, height = 0;
    std::string bytes = {}; ///< rows from the top down
};

} // namespace bake
