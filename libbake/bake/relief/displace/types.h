// Inputs and results of displacement.
#pragma once
#include "bake/mesh/mesh.h"
#include "bake/relief/height/height.h"
#include <functional>
#include <optional>
#include <string>

namespace bake {

/// The height of a vertex on a UV seam, where each side has a value of its own.
enum class Seam {
    average, ///< their mean
    owner,   ///< that of the patch with the lowest number
    blend,   ///< their mean, which both sides approach smoothly over one patch
};

/// Displacement by a vector instead of a height: three channels x, y, z, each amplitude (value - midlevel).
enum class VectorSpace {
    tangent, ///< along T, B, n of the point: T unit p_u made perpendicular to n, B = sigma n x T
    object,
};

/// One channel (a height along n), or three channels with a vector space.
struct Relief {
    Image<float> values;
    HeightOptions height;
    Interpolation interpolation = Interpolation::c2;
    std::optional<VectorSpace> vector;
};

/// How many segments each edge of a patch gets, at least 1.
struct Rates {
    enum class Rule {
        uniform,   ///< 2^levels on every edge of the mesh
        edge_size, ///< segments no longer than `size` under `measure`
        error,     ///< result within `error` (object units) of the displaced surface
    };
    Rule rule = Rule::uniform;
    int levels = 0;
    double size = 0;
    /// Length of a short segment between two displaced points, in any unit, such as pixels in the picture of a camera.
    /// Empty: the distance in space.
    std::function<double(const Vec3d&, const Vec3d&)> measure;
    double error = 0;
    int most =
        1024; ///< largest number of segments of an edge; by error up to four times as many where only a part needs it
};

/// The size of the result, known before the work: exact but for bytes.
struct DisplaceCount {
    std::uint64_t points = 0, normals = 0, uvs = 0, faces = 0, corners = 0;
    std::uint64_t bytes = 0; ///< resident memory at its peak, with DisplaceOptions::taken and later
};

/// Work of the caller on the result, such as writing it.
struct LaterStep {
    std::string option; ///< that asks for it, to name in a refusal; empty: it is always done
    std::function<std::uint64_t(const DisplaceCount&)> bytes; ///< what it takes in memory beside the result
};

struct DisplaceOptions {
    Rates rates;
    Seam seam = Seam::blend;
    std::uint64_t max_bytes = 0;  ///< memory that may be taken; 0: memory_limit()
    std::uint64_t taken = 0;      ///< of that, what is taken before the call, base and relief included
    std::vector<LaterStep> later; ///< one after the other
    bool measure_error = false;   ///< fill report.error: distance of the result from the displaced surface
    bool attributes = false;      ///< give the result those of the base, see corner_attributes()
    bool margin = false;          ///< fill Displaced::margin
};

struct DisplaceReport {
    DisplaceCount count;
    std::uint64_t triangles = 0;
    double height_min = 0, height_max = 0; ///< range of b over the points

    std::uint64_t seam_points = 0;
    double seam_mismatch = 0; ///< largest difference of b across a seam, object units
    Vec3d seam_worst{0};      ///< where, on the base surface

    // The local test min(1 + b a_i) > 0, and for vectors the same of the stretch along the surface (fold_margin()).
    std::uint64_t folded = 0; ///< points that fail it
    double fold_margin = 1;   ///< smallest 1 + b a_i, or stretch
    Vec3d fold_worst{0};
    Vec2d fold_worst_uv{0};

    std::uint64_t no_tangents = 0; ///< points without tangent plane (poles): displaced, their normals from the faces
    std::uint64_t no_normal = 0;   ///< points without base normal: left where they are

    double error_max = 0, error_rms = 0; ///< with measure_error, at the faces' own parameters
    std::uint64_t uniform_triangles = 0; ///< rates by error: what a uniform rate of the same measured error needs

    std::uint64_t faces_without_uv = 0; ///< faces of the base, which have no relief
};

struct Displaced {
    Mesh mesh; ///< quads where the rates allow, triangles elsewhere; uvs, groups and materials of the base
    DisplaceReport report;
    std::vector<float> margin; ///< positions, or none: smallest 1 + b a_i, or stretch, there
};

} // namespace bake
