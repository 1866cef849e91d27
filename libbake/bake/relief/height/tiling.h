// Whether a picture tiles: the step across its border against the steps between adjacent texels inside.
#pragma once
#include "bake/picture/image.h"

namespace bake {

/// Steps between adjacent columns (or rows) of a picture; the step of a pair is the mean over its texels.
struct BorderStep {
    double border = 0;  ///< between the last column and the first
    double mean = 0;    ///< mean over the pairs inside
    double largest = 0; ///< largest of the pairs inside

    /// Border step over the mean step inside; 0 if the border has no step.
    double ratio() const noexcept;
    /// The border is not more visible than the texture: ratio() is at most tiles_up_to.
    bool tiles() const noexcept;
    /// The border has a larger step than any pair inside, beyond tiles_up_to. Where neither holds, a line of the pattern may
    /// lie along the border: the steps do not decide.
    bool breaks() const noexcept;
};
/// Largest ratio() of a texture that tiles, and largest ratio of the border step to the largest step inside of a texture
/// that may tile.
inline constexpr double tiles_up_to = 1.6, may_tile_up_to = 1.2;

struct Tiling {
    BorderStep x, y;
};

/// Of the mean of the first `channels` channels. NaN and Inf count as 0. Of large pictures about 256
/// rows and columns are measured.
Tiling measure_tiling(const Image<float>& image, int channels = 1);

} // namespace bake
