// Converts the samples of TIFF files to floats: all depths and formats, palettes, inverted greys, inks.
#pragma once
#include "bake/picture/image_types.h"
#include <cstdint>
#include <vector>

namespace bake {

/// How one texel is stored.
struct TiffSamples {
    int bits = 8, format = 1;        ///< of each sample, as the tags BitsPerSample and SampleFormat say
    int photometric = 1;             ///< as the tag says
    int per_texel = 1;               ///< samples
    std::vector<float> palette = {}; ///< red, green and blue of each index
};

/// Whether samples of this depth and format are read.
bool is_known(const TiffSamples& samples) noexcept;
SampleType sample_type(const TiffSamples& samples) noexcept;

/// Channels that the samples of a texel become.
int channel_count(const TiffSamples& samples) noexcept;

/// `count` stored samples as floats: unsigned ones in [0, 1], signed ones in [-1, 1]; indices of a palette as they are.
/// `swapped`: the byte order of the samples is not that of this machine.
void to_floats(const TiffSamples& samples, const unsigned char* from, float* to, std::int64_t count, bool swapped);

/// Whether the floats of a texel's samples are its channels.
bool are_channels(const TiffSamples& samples) noexcept;
/// The channels of `count` texels out of the floats of their samples.
void to_channels(const TiffSamples& samples, const float* from, float* to, std::int64_t count) noexcept;

} // namespace bake
