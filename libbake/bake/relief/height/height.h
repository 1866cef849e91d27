// Height textures: read as data, and sampled with analytic derivatives.
//
//   b(u,v) = amplitude (value(u,v) - midlevel)      in object units
#pragma once
#include "bake/base/vec.h"
#include "bake/picture/image_io.h"
#include "bake/relief/height/border.h"
#include "bake/relief/height/picture_kind.h"
#include <optional>

namespace bake {

/// Height above the surface and its slopes per unit of u and v, all in object units.
template <class T> struct Height { T b = 0, b_u = 0, b_v = 0; };

/// How the channels of a picture become one grey value.
enum class Grey { mean, r, g, b, a, luma };

/// A grayscale texture in memory and the description of its file.
struct HeightTexture {
    Image<float> values; ///< one channel; [0,1] for integer files
    ImageInfo info;
    int levels = 0;   ///< number of different values in one channel, counted up to 257
    double step = 0;  ///< difference of neighbouring levels; 0: too small to matter (float files)
    PictureKind kind; ///< of the picture, if its colour channels were averaged; grey otherwise
};

/// Reads a height picture, without decoding sRGB. `mean` averages the colour channels, without alpha; `luma` weights
/// them by Rec. 709. Throws as read_image, and Error{Refusal::unsuitable} if the file lacks the channel or has NaN, Inf
/// or values beyond 1e12 (the message has their count and the position of the first).
HeightTexture read_height(const std::string& path, Grey grey = Grey::mean, const ReadLimits& limits = {});

/// Replaces every value by 2 midlevel - value, which is 1 - value for integers: for textures in which black is high. Unless
/// given, the midlevel is default_midlevel().
void invert(HeightTexture& height, std::optional<double> midlevel = {});

/// Box-filters the height by integer factors to at least width x height texels, against aliasing in smaller maps.
Image<float> box_minify(const Image<float>& values, int width, int height);

struct HeightOptions {
    double amplitude = 1;  ///< height of white above black, object units
    double midlevel = 0.5; ///< value whose height is 0
    Wrap wrap_u = Wrap::repeat;
    Wrap wrap_v = Wrap::repeat;
};

enum class Interpolation {
    bilinear,
    catmull_rom,
    c2, ///< the interpolating cubic B-spline: twice continuously differentiable
};

/// Values between texel centres, and their analytic derivatives.
template <class T> class HeightSampler {
public:
    /// Copies the values of the one-channel image, or computes their spline coefficients.
    HeightSampler(const Image<T>& values, Interpolation interpolation, const HeightOptions& options);

    /// Height and slopes per unit of u and v at any finite u, v. Beyond a clamped border the height is that at
    /// the border, and the slope across the border is 0.
    Height<T> at(T u, T v) const noexcept { return sample<T>(u, v); }
    /// The same, computed in the precision of U.
    template <class U> Height<U> sample(U u, U v) const noexcept;

private:
    template <Interpolation interpolation, class U> Height<U> sample_by(U u, U v) const noexcept;

    Interpolation interpolation_;
    HeightOptions options_;
    int width_, height_;
    Image<T> padded_; ///< values or spline coefficients, two texels wider on every side
};

} // namespace bake
