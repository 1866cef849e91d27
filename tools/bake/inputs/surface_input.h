// The surface that a verb works on: a mesh as it is, the limit surface of a cage, or an analytic shape.
#pragma once
#include "bake/surface/patch/base_surface.h"
#include "options.h"

namespace bake {

struct SurfaceInput {
    std::string mesh, shape;      ///< exactly one of the two is named
    std::optional<Scheme> scheme; ///< set: the mesh is a cage, and the surface is its limit
    UvSmoothing uv_smoothing = UvSmoothing::inside;
    MeshOptions reading;
    std::optional<Length> weld; ///< in per cent of the diagonal, or object units

    const std::string& name() const { return shape.empty() ? mesh : shape; }
};

/// Adds the mesh, --shape, --uv-smoothing, --weld, --flip-v and --uv-set. Each verb adds --subdivide with the choices
/// that it has.
void add_surface_input(CLI::App& sub, SurfaceInput& input);

/// Throws Error{Refusal::usage} for options that contradict each other, before any file is read.
void check_usage(const SurfaceInput& input, const std::string& verb);

/// A shape gets `cells` patches along u and v (0: as many as show the shape). A cage's equal positions are welded: PLY
/// and glTF store one vertex per distinct uv or normal, and a cage of such vertices would fall apart along its seams.
/// OBJ indexes positions separately, so equal positions in it are separate vertices by intent. Throws
/// Error{Refusal::unsuitable} for a cage that has no limit surface.
BaseSurface read_surface(const SurfaceInput& input, std::pair<int, int> cells = {0, 0});

} // namespace bake
