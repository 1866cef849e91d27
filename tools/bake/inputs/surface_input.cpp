#include "inputs/surface_input.h"
#include "bake/mesh/border_weld.h"
#include "bake/mesh/weld.h"
#include "inputs/file_kind.h"

namespace bake {
namespace {

Error usage(const std::string& message) { return Error(Refusal::usage, message); }

} // namespace

void add_surface_input(CLI::App& sub, SurfaceInput& input) {
    sub.add_option("mesh", input.mesh, "Mesh, or cage of a subdivision surface (.obj, .ply, .glb, .gltf)");
    sub.add_option("--shape", input.shape, "Analytic shape instead of a mesh, such as torus:R=2,r=0.7")
        ->type_name("NAME[:KEY=VALUE,...]");
    add_choice<UvSmoothing>(
        sub, "--uv-smoothing", input.uv_smoothing,
        {{"none", UvSmoothing::none}, {"inside", UvSmoothing::inside}, {"all", UvSmoothing::all}},
        "Of a cage: which uvs are smoothed with the surface; inside: all except the charts' borders");
    add_length_option(
        sub, "--weld", input.weld,
        "Join borders that touch within this distance: object units, or 0.001% of the diagonal [not joined]");
    add_mesh_options(sub, input.reading);
}

void check_usage(const SurfaceInput& input, const std::string& verb) {
    if (input.mesh.empty() && input.shape.empty())
        throw usage(verb + ": neither a mesh nor a --shape is named; give one of them");
    if (!input.mesh.empty() && !input.shape.empty()) throw usage("--shape: stands instead of a mesh; give one of them");
    if (!input.mesh.empty()) expect_mesh(input.mesh);
    if (!input.shape.empty() && input.scheme)
        throw usage("--subdivide: a shape is smooth already; leave it out with --shape");
    if (!input.shape.empty() && (input.reading.flip_v || input.reading.uv_set >= 0))
        throw usage(std::string(input.reading.flip_v ? "--flip-v" : "--uv-set") +
                    ": applies to mesh files; leave it out with --shape");
    if (!input.shape.empty() && input.weld) throw usage("--weld: applies to mesh files; leave it out with --shape");
    if (!input.scheme && input.uv_smoothing != UvSmoothing::inside)
        throw usage("--uv-smoothing: applies to --subdivide catmark and loop; leave it out");
}

BaseSurface read_surface(const SurfaceInput& input, std::pair<int, int> cells) {
    if (!input.shape.empty()) {
        const ParametricSurface shape(input.shape);
        if (cells.first == 0) cells = shape.default_resolution();
        return BaseSurface(shape, cells.first, cells.second);
    }
    Mesh mesh = read_mesh(input.mesh, input.reading);
    if (input.weld) weld_borders(mesh, input.weld->in_units(diagonal(bounds(mesh))), input.mesh);
    if (!input.scheme) return BaseSurface(std::move(mesh));
    if (mesh_format(input.mesh) != MeshFormat::obj) weld_positions(mesh);
    check_cage(mesh, *input.scheme, input.mesh);
    return BaseSurface(std::move(mesh), SubdivisionOptions{.scheme = *input.scheme, .uv = input.uv_smoothing},
                       input.mesh);
}

} // namespace bake
