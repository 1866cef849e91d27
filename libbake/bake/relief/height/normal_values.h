// How a normal map holds its vectors: which channels are x and y, whether z is stored, and how values encode them.
#pragma once
#include "bake/base/vec.h"
#include "bake/picture/image.h"
#include "bake/picture/image_types.h"
#include <string>

namespace bake {

enum class NormalEncoding {
    automatic,    ///< the one under which the vectors over the map are nearest to unit length
    unorm,        ///< n = 2 rgb - 1
    signed_,      ///< n = rgb
    srgb_encoded, ///< unorm, wrongly encoded as sRGB colour: n = 2 linear(rgb) - 1
    srgb_decoded, ///< unorm, wrongly decoded as sRGB colour: n = 2 srgb(rgb) - 1
};

struct NormalValues {
    NormalEncoding encoding = NormalEncoding::unorm; ///< not automatic
    int x = 0, y = 1, z = 2;                         ///< channels; z = -1: z is not stored, and is sqrt(1 - x^2 - y^2)

    /// The vector of a texel, y as stored, not normalised.
    Vec3f decode(const float* texel) const noexcept;
    bool usual() const noexcept { return encoding == NormalEncoding::unorm && z == 2; }
};

/// The vectors of a picture, three channels, y as stored.
Image<float> decode_normals(const Image<float>& image, const NormalValues& values);

/// Measurements of a map's vectors. NaN and Inf count as 0.
struct NormalStats {
    double length = 0;       ///< mean length
    double length_error = 0; ///< mean of |length - 1|
    double not_unit = 0;     ///< fraction of texels more than 2 % off unit length
    double inward = 0;       ///< fraction of texels with n_z < 0
    Vec3d mean{0};           ///< mean vector
};
/// Of every texel, or of a lattice of at most `lattice` x `lattice` texels if that is positive.
NormalStats measure_normals(const Image<float>& image, const NormalValues& values, int lattice = 0);

/// The channels and the encoding of a tangent-space normal map. The image has at least two channels. x and y are red and
/// green, with z rebuilt if there are two channels, or if blue is constant while red or green varies; x is alpha if red is
/// constant and alpha varies, as in DXT5nm. The encoding is that whose vectors over the map have lengths nearest to 1 and
/// a mean nearest to the z axis. Integers are never signed, signed integers always; an sRGB encoding needs clear evidence.
NormalValues guess_normal_values(const Image<float>& image, const ImageInfo& info);

/// A note on unusual values, such as "two channels: z is rebuilt from x and y"; empty for usual values.
std::string describe(const NormalValues& values);

} // namespace bake
