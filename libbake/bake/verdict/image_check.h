// Measurements of an image, and a guess at its purpose.
#pragma once
#include "bake/base/vec.h"
#include "bake/picture/image_io.h"
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

/// Per axis: ratio of the step across the border to the mean step between adjacent texels inside; 0 if the border has no step.
struct Tiling {
    double x = 0, y = 0;
};
/// Up to this ratio the border is not more visible than the texture.
inline constexpr double tiles_up_to = 1.6;

/// data: two channels or more than four.
enum class Looks { constant, grey, normal_map, colour, data };
const char* name(Looks looks) noexcept;

struct ImageCheck {
    ImageInfo info;
    std::vector<ChannelCheck> channels;
    int true_bits = 0;       ///< maximum over the channels
    int colour_channels = 0; ///< number of channels without alpha, at most 3
    ChannelCheck grey;       ///< the mean of the colour channels, without true_bits
    double tint = 0;         ///< largest difference between the colour channels of a texel, in 8-bit levels
    double mean_tint = 0;    ///< mean of that difference over the texels
    Tiling tiling;           ///< of the mean of the colour channels
    Looks looks = Looks::colour;

    /// Of the values decoded as normals n = 2 rgb - 1: mean length, fraction of texels more than 2 % off unit length, and
    /// fraction with n_z < 0. 0 if there are fewer than three channels.
    double normal_length = 0, not_unit = 0, inward = 0;
    Vec3d mean_normal{0};
    double grey_step = 0; ///< quantisation step: 1 / (2^true_bits - 1), for floats the step below the largest value
};

/// Tints up to these count as grey, in 8-bit levels. JPEG compression and rounding cause such tints.
inline constexpr double grey_tint = 8, grey_mean_tint = 1;

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
