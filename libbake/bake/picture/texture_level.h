// What a texture for graphics cards consists of.
#pragma once
#include <string>

namespace bake {

/// How texels are stored, as linear data.
enum class TexelFormat {
    r8,      ///< one channel in [0,1]
    rgba8,   ///< three channels in [0,1], and 1
    rgba16,  ///< the same
    bc5,     ///< two channels in [-1,1], by bc5_encode()
    rgb9e5,  ///< three channels of radiance with a common exponent, by rgb9e5_encode()
    rgba16f, ///< three channels as half floats, and 1
    rg16f,   ///< two channels as half floats
    bc6h,    ///< three channels of radiance, by bc6h_encode()
};

struct TextureLevel {
    int width = 0, height = 0; ///< of one face
    std::string bytes = {};    ///< rows from the top down; of a cube map px nx py ny pz nz, one after the other
};

} // namespace bake
