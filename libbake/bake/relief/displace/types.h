// What displacement takes and gives.
#pragma once
#include "bake/mesh/mesh.h"
#include "bake/relief/height/height.h"
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
    int most =
        1024; ///< segments an edge is never cut into more than; by error four times as many where only a part needs them
};

struct DisplaceOptions {
    Rates rates;
    Seam seam = Seam::average;
    std::uint64_t max_bytes = 0; ///< refuse what would need more; 0: what the machine has
    bool measure_error = false;  ///< fill report.error: distance of the result from the displaced surface
    bool margin = false;         ///< fill Displaced::margin
};

/// What it needs, known before the work: exact for points and faces, close from above for bytes.
struct DisplaceCount {
    std::uint64_t points = 0, faces = 0, corners = 0, bytes = 0;
};

struct DisplaceReport {
    DisplaceCount count;
    std::uint64_t triangles = 0;
    double height_min = 0, height_max = 0; ///< of b, met on the surface

    std::uint64_t seam_points = 0;
    double seam_mismatch = 0; ///< largest difference of b across a seam, object units
    Vec3d seam_worst{0};      ///< where, on the base surface

    // The local test min(1 + b a_i) > 0.
    std::uint64_t folded = 0; ///< points that fail it
    double fold_margin = 1;   ///< smallest 1 + b a_i
    Vec3d fold_worst{0};
    Vec2d fold_worst_uv{0};

    std::uint64_t no_tangents =
        0; ///< points without tangent plane (poles): displaced, with a normal from the faces there
    std::uint64_t no_normal = 0; ///< points without base normal: left where they are

    double error_max = 0, error_rms = 0; ///< with measure_error, at the faces' own parameters
    std::uint64_t uniform_triangles = 0; ///< rates by error: what a uniform rate of the same measured error needs
};

struct Displaced {
    Mesh mesh; ///< quads where the rates let them, triangles elsewhere; uvs, groups and materials of the base
    DisplaceReport report;
    std::vector<float> margin; ///< positions, or none: smallest 1 + b a_i there
};

} // namespace bake
