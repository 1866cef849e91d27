// The forms in which a texture can be stored: size, channels and depth, with the texels that are read back.
//
// Sizes are the source and its halvings by area (halve()), down to one texel. Normals are averaged as vectors and made unit
// vectors again; slopes and colours, in linear light, are averaged.
//   normal   (x, y, z) or (x, y) with z = sqrt(1 - x^2 - y^2), (n + 1) / 2 in 8 or 16 bits; (x, y) in BC5 blocks
//   bump     two channels in 16 bits by SlopeCode, or half
//   albedo   three channels, or one of a grey picture: sRGB in 8 or 16 bits, or linear half
#pragma once
#include "bake/picture/image.h"
#include "bake/verdict/plan/scene_twin.h"
#include <cstdint>
#include <string>
#include <vector>

namespace bake {

/// TextureForm::bits of BC5: what a texel has of its block per channel.
inline constexpr int bc5_bits = 4;

struct TextureForm {
    int halvings = 0; ///< of the source
    int width = 0, height = 0, channels = 0, bits = 0;
    bool half = false; ///< of floats, not integers
    bool in_bc5() const noexcept { return bits == bc5_bits; }

    /// In memory, with all smaller levels. Blocks of BC5 that reach beyond a level count in full.
    std::int64_t bytes() const noexcept;
    /// "256 x 256, two channels of 8 bits", "256 x 256, BC5".
    std::string text() const;
    bool operator==(const TextureForm&) const = default;
};

/// All forms of a source of this size, in ascending order of bytes; of equal bytes the larger size first. `grey`: an albedo whose
/// channels are equal.
std::vector<TextureForm> texture_forms(TextureUse use, int width, int height, bool grey = false);

/// The source and its halvings, as averaged: normals are not unit vectors yet.
std::vector<Image<float>> halvings_of(const Image<float>& source);

/// The texels of a form as they are read back from a file: as many channels as `halving`, which is that of the form.
Image<float> stored(const Image<float>& halving, TextureUse use, const TextureForm& form);

bool is_grey(const Image<float>& image) noexcept;

/// The smallest form at full size that holds the source without loss; 32 bits if no other one does. `blocks`: BC5 is
/// tried too.
TextureForm lossless_form(const Image<float>& source, TextureUse use, bool blocks = false);

} // namespace bake
