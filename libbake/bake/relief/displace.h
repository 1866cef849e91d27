// True displacement p' = p + b n of a surface into a mesh: welded, crack-free, with exact normals.
//
// Every vertex of the result is displaced once, whatever number of patches meet there; rates (segments per edge) come
// from the edge's own data, so neighbours at different rates meet without T-junctions.
#pragma once
#include "bake/relief/displace_types.h"
#include "bake/surface/base_surface.h"

namespace bake {

class Progress;

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

    std::uint64_t no_tangents = 0; ///< points without tangent plane (poles): displaced, with a normal from the faces there
    std::uint64_t no_normal = 0; ///< points without base normal: left where they are

    double error_max = 0, error_rms = 0; ///< with measure_error, at the faces' own parameters
    std::uint64_t uniform_triangles = 0; ///< rates by error: what a uniform rate of the same measured error needs
};

struct Displaced {
    Mesh mesh; ///< quads where the rates let them, triangles elsewhere; uvs, groups and materials of the base
    DisplaceReport report;
    std::vector<float> margin; ///< positions, or none: smallest 1 + b a_i there
};

/// What displace() will make, without making it.
DisplaceCount count_displaced(const BaseSurface& base, const Relief& relief, const DisplaceOptions& options);

/// Throws Error{Refusal::unsuitable} when it needs more than max_bytes (saying how much, and the finest level that fits).
/// Any number of threads gives the same bytes.
Displaced displace(const BaseSurface& base, const Relief& relief, const DisplaceOptions& options = {},
                   Progress* progress = nullptr);

} // namespace bake
