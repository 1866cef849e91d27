// An environment in memory, six faces or one picture of the whole sky, and its values in given directions.
#pragma once
#include "bake/environment/sky/cube.h"
#include "bake/environment/sky/projection.h"

namespace bake {

struct Environment {
    Cube cube;                 ///< six faces; empty if the environment is a picture
    bool edge_samples = false; ///< the centres of the outer texels lie on the edges of the faces, OpenEXR's convention
    Image<float> picture;      ///< of the whole sky
    Projection projection = Projection::latlong;

    bool is_cube() const noexcept { return !cube.empty(); }
    int channels() const noexcept { return is_cube() ? cube.channels() : picture.channels(); }
    /// Texels per radian, on average over the sphere.
    double density() const noexcept;
    /// Edge, in texels, of the faces of an equally fine cube, at least 1: by width_per_edge of the table of formats, and by
    /// density() for a projection that is not written.
    int face_edge() const noexcept;
};

/// Bilinear values in `count` directions of any length, channels() values each. A direction within 1e-9 texel of a texel's
/// centre gives exactly that texel.
void sample(const Environment& sky, const Vec3d* directions, int count, float* values) noexcept;

} // namespace bake
