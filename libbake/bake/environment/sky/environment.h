// An environment in memory: six faces, or one picture of the whole sky; and its values at directions.
#pragma once
#include "bake/environment/sky/cube.h"
#include "bake/environment/sky/projection.h"

namespace bake {

struct Environment {
    Cube cube;                 ///< six faces; empty: `picture`
    bool edge_samples = false; ///< the outer texels' centres lie on the faces' edges, as OpenEXR has it
    Image<float> picture;
    Projection projection = Projection::latlong;

    bool is_cube() const noexcept { return !cube.empty(); }
    int channels() const noexcept { return is_cube() ? cube.channels() : picture.channels(); }
    /// Texels per radian, on average over the sphere.
    double density() const noexcept;
};

/// The texel that stands for (x, y), which may lie up to one step outside the picture: round the sphere, over the poles,
/// across octahedral folds.
struct PictureTexel {
    int x, y;
};
PictureTexel wrapped(Projection projection, int width, int height, int x, int y) noexcept;

/// Bilinear values at `count` directions of any length, channels() each. Directions within 1e-9 texel of a texel's centre
/// give that texel to the bit.
void sample(const Environment& sky, const Vec3d* directions, int count, float* values) noexcept;

} // namespace bake
