// What displacement is told: the relief, what happens at seams, how fine the result is.
#pragma once
#include "bake/base/vec.h"
#include "bake/relief/height.h"
#include <functional>
#include <optional>

namespace bake {

/// What becomes of a vertex on a UV seam, where the height has a value on each side.
enum class Seam {
    average, ///< their mean
    owner,   ///< that of the patch with the lowest number
    blend,   ///< their mean, and both sides are led to it smoothly over one patch
};

/// Displacement by a vector instead of a height: three channels x, y, z, each amplitude (value - midlevel).
enum class VectorSpace {
    tangent, ///< along T, B, n of the point: T unit p_u made perpendicular to n, B = sigma n x T
    object,
};

/// What is laid over the surface: one channel (along n), or three with a vector space.
struct Relief {
    Image<float> values;
    HeightOptions height;
    Interpolation interpolation = Interpolation::c2;
    std::optional<VectorSpace> vector;
};

/// How finely each patch edge is cut, as segments: 1 and more.
struct Rates {
    enum class Rule {
        uniform,   ///< 2^levels on every edge of the mesh
        edge_size, ///< segments no longer than `size` under `measure`
        error,     ///< result within `error` (object units) of the displaced surface
    };
    Rule rule = Rule::uniform;
    int levels = 0;
    double size = 0;
    /// Length of a short segment between two displaced points, in any unit; space itself where it is empty. The picture
    /// of a camera makes it pixels.
    std::function<double(const Vec3d&, const Vec3d&)> measure;
    double error = 0;
    int most = 1024; ///< segments an edge is never cut into more than
};

} // namespace bake
