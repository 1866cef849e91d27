// What is in an image, and what it looks made for.
#pragma once
#include "bake/base/vec.h"
#include "bake/picture/image_io.h"

namespace bake {

/// One channel, in the values read_image gives. NaN and Inf are counted and left out of the rest.
struct ChannelCheck {
    std::string name;
    float min = 0, max = 0;
    double mean = 0;
    std::size_t nan = 0, inf = 0;
    int levels = 0;        ///< distinct values; most_levels + 1: more than that
    int true_bits = 0;     ///< fewest bits whose levels hold every value; 0: floats that no 16 bits hold
    double least_step = 0; ///< smallest distance between two values in use; 0 with fewer than two, or too many, levels
};

/// Distinct values are counted up to here: all that 16 bits can have.
inline constexpr int most_levels = 65536;

/// Step across the border over the mean step between neighbours inside; 0 where nothing changes.
struct Tiling {
    double x = 0, y = 0;
};
/// A border step up to this ratio is no more visible than the texture itself.
inline constexpr double tiles_up_to = 1.6;

/// data: two channels, or more than four.
enum class Looks { constant, grey, normal_map, colour, data };
const char* name(Looks looks) noexcept;

struct ImageCheck {
    ImageInfo info;
    std::vector<ChannelCheck> channels;
    int true_bits = 0;       ///< most of any channel
    int colour_channels = 0; ///< the channels that are not alpha, at most 3 of them
    ChannelCheck grey;       ///< the mean of the colour channels; true_bits unset
    double tint = 0;         ///< largest difference between colour channels of one texel, in 8-bit levels
    double mean_tint = 0;    ///< mean of that difference over the texels
    Tiling tiling;           ///< of the mean of the colour channels
    Looks looks = Looks::colour;

    /// Read as normals n = 2 rgb - 1: mean length, share of texels more than 2 % off unit length, and share with
    /// n_z < 0. Unset (0) with fewer than three channels.
    double normal_length = 0, not_unit = 0, inward = 0;
    Vec3d mean_normal{0};
    double grey_step = 0; ///< height of one quantisation step: 1 / (2^true_bits - 1); of floats the coarsest in use
};

/// Tints that still count as grey, in 8-bit levels: what a JPEG or a rounding exporter leaves.
inline constexpr double grey_tint = 8, grey_mean_tint = 1;

ImageCheck check_image(const Image<float>& image, const ImageInfo& info);

/// What one quantisation step does to a slope, texels being extent / width apart.
struct StepSlope {
    double per_texel = 0;            ///< smallest two-sided difference, in height per texel: step / 2
    double slope = 0;                ///< amplitude * step * width / (2 * extent)
    double angle_deg = 0;            ///< atan(slope)
    double one_degree_amplitude = 0; ///< amplitude at which the angle is one degree
};
StepSlope step_slope(double step, int width, double amplitude = 1, double extent = 1) noexcept;

} // namespace bake
