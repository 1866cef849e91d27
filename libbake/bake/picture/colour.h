// The encoding of colours as stated by a picture's file, and conversion to linear light.
#pragma once
#include "bake/picture/image.h"
#include <string>
#include <vector>

namespace bake {

struct ImageInfo;

/// From a stored value x to linear light: (a x + b)^g + e for x >= d, c x + f below d. These are the parametric curves of
/// ICC profiles. A curve with samples is piecewise linear over [0, 1] instead.
struct ToneCurve {
    double g = 1, a = 1, b = 0, c = 0, d = 0, e = 0, f = 0;
    std::vector<float> samples = {};

    double operator()(double x) const noexcept;
    /// Whether the curve is that of sRGB, or the identity, to half a level of 8 bits.
    bool is_srgb() const noexcept;
    bool is_linear() const noexcept;
};

/// The curve x^exponent.
ToneCurve power_curve(double exponent);
/// IEC 61966-2-1.
ToneCurve srgb_curve();

/// The encoding of colours that a file states.
struct ColourTag {
    std::string source = {}; ///< "sRGB chunk", "ICC profile", ...; empty: the file says nothing
    std::vector<ToneCurve> curves =
        {};                ///< one for all channels, or one each for red, green and blue; empty: not stated
    std::string note = {}; ///< what is stated but not applied, such as primaries other than those of sRGB

    bool is_srgb() const noexcept;
};

/// How the values of a colour picture are stored. automatic: as the file is tagged; without a tag 8-bit samples are sRGB
/// and all others linear.
enum class ColourSpace { automatic, srgb, linear };

/// Converts a picture of colour to linear light, except alpha. Adds to info.notes what the file states about its colours
/// but is not applied, and that integers of more than 8 bits without a tag were taken as linear.
void linearise(Image<float>& image, ColourSpace space, ImageInfo& info);

/// Decodes sRGB (IEC 61966-2-1) in place, except alpha. For colour textures and skies, not for data.
void srgb_to_linear(Image<float>& image, int alpha_channel = -1);
/// Encodes a linear value as sRGB, for pictures that people look at.
float linear_to_srgb(float linear) noexcept;

} // namespace bake
