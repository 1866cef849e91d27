// Measurements of an image, and a guess at its purpose.
#pragma once
#include "bake/picture/image_io.h"
#include "bake/relief/height/picture_kind.h"
#include "bake/relief/height/tiling.h"
#include "bake/verdict/image_levels.h"

namespace bake {

/// One channel, in the values of read_image(). NaN and Inf are counted and excluded from the other members.
struct ChannelCheck {
    std::string name;
    float min = 0, max = 0;
    double mean = 0;
    std::size_t nan = 0, inf = 0;
    int levels = 0, true_bits = 0; ///< see Levels
    double least_step = 0;         ///< see Levels
};

struct ImageCheck {
    ImageInfo info;
    std::vector<ChannelCheck> channels;
    int true_bits = 0;       ///< maximum over the channels
    int colour_channels = 0; ///< number of channels without alpha, at most 3
    ChannelCheck grey;       ///< the mean of the colour channels, without true_bits
    PictureKind kind;        ///< what it looks like
    Tiling tiling;           ///< of the mean of the colour channels
    /// Quantisation step: that of true_bits, for signed integers that of the file, for floats the step below the largest
    /// value.
    double grey_step = 0;
};

ImageCheck check_image(const Image<float>& image, const ImageInfo& info);

/// Effect of one quantisation step on a slope; the distance of texels is extent / width.
struct StepSlope {
    double per_texel = 0;            ///< smallest central difference, in height per texel: step / 2
    double slope = 0;                ///< amplitude * step * width / (2 * extent)
    double angle_deg = 0;            ///< atan(slope)
    double one_degree_amplitude = 0; ///< amplitude at which the angle is one degree
};
StepSlope step_slope(double step, int width, double amplitude = 1, double extent = 1) noexcept;

} // namespace bake
