// Height textures: read as data, and sampled with analytic derivatives.
//
//   b(u,v) = amplitude (value(u,v) - midlevel)      in object units
#pragma once
#include "bake/base/vec.h"
#include "bake/picture/image_io.h"
#include "bake/relief/height/border.h"

namespace bake {

/// Height above the surface and its slopes per unit of u and v, all in object units.
template <class T> struct Height { T b = 0, b_u = 0, b_v = 0; };

/// Which grey a picture's channels give.
enum class Grey { mean, r, g, b, a, luma };

/// A grayscale texture in memory and what its file says of it.
struct HeightTexture {
    Image<float> values; ///< one channel; [0,1] for integer files
    ImageInfo info;
    int levels = 0;  ///< different values used in one channel, counted up to 257
    double step = 0; ///< between neighbouring levels; 0: too fine to matter (float files)
};

/// Reads a height: never sRGB-decoded; `mean` averages the colour channels and leaves alpha out; luma weighs them by
/// Rec. 709. Throws as read_image, and Error{Refusal::unsuitable} for a channel the file does not have or for NaN, Inf and
/// values beyond 1e12 (with their count and first place).
HeightTexture read_height(const std::string& path, Grey grey = Grey::mean, const ReadLimits& limits = {});

/// 1 - value everywhere: for textures whose black is high.
void invert(HeightTexture& height);

/// The height box-filtered by whole factors to at least width x height: what a smaller map can show without aliasing.
Image<float> box_minify(const Image<float>& values, int width, int height);

struct HeightOptions {
    double amplitude = 1;  ///< height of white above black, object units
    double midlevel = 0.5; ///< the value that lies on the surface
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
    /// Copies what it needs of the one-channel image.
    HeightSampler(const Image<T>& values, Interpolation interpolation, const HeightOptions& options);

    /// Height and slopes per unit of u and v at any finite u, v. Beyond a clamped border the height is that of the
    /// border and its slope across the border 0.
    Height<T> at(T u, T v) const noexcept { return sample<T>(u, v); }
    /// The same with coordinates and weights of another precision than the values'.
    template <class U> Height<U> sample(U u, U v) const noexcept;

private:
    template <Interpolation interpolation, class U> Height<U> sample_by(U u, U v) const noexcept;

    Interpolation interpolation_;
    HeightOptions options_;
    int width_, height_;
    Image<T> padded_; ///< values or spline coefficients, two texels wider on every side
};

} // namespace bake
