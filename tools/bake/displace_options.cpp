#include "displace_options.h"
#include "inputs/byte_option.h"
#include "inputs/file_kind.h"

namespace bake {
namespace {

void add_rate_options(CLI::App& sub, DisplaceArgs& args) {
    add_integer_option(sub, "--levels", args.levels, 0, 10, "Every edge is cut into 2^N [3; 0 for the mesh as it is]");
    add_number_option(sub, "--edge-px", args.edge_px, 0.01, 1e6,
                      "Edges no longer than P pixels in the picture of --camera")
        ->type_name("P");
    sub.add_option("--camera", args.camera, "Scene file, or position=0,1,5:target=0,0,0:fov-deg=40:height=1080")
        ->type_name("CAMERA");
    add_length_option(
        sub, "--max-error", args.max_error,
        "Cut where it needs to be, to stay within this distance of the displaced surface: object units or a "
        "per cent of the mesh's diagonal");
}

} // namespace

void add_displace_options(CLI::App& sub, DisplaceArgs& args) {
    add_surface_input(sub, args.surface);
    add_size_option(sub, args.cells, "Cells of a shape along u and v, whose edges are cut [enough to look smooth]",
                    1024, "--resolution")
        ->type_name("NxM|N");
    add_height_path(sub, "--height", args.height)->required();
    add_output_option(sub, args.out, "Mesh to write: .obj, .ply, .glb or .gltf");
    add_relief_options(sub, args.height);
    add_choice<BaseKind>(sub, "--subdivide", args.kind,
                         {{"auto", BaseKind::automatic},
                          {"none", BaseKind::none},
                          {"linear", BaseKind::linear},
                          {"catmark", BaseKind::catmark},
                          {"loop", BaseKind::loop}},
                         "What is displaced: the mesh as it is, its faces cut finer, or the limit of Catmull-Clark or "
                         "Loop; auto: none, or linear once a rate is given");
    add_rate_options(sub, args);
    add_choice<Seam>(
        sub, "--seam", args.seam, {{"blend", Seam::blend}, {"average", Seam::average}, {"owner", Seam::owner}},
        "Height of a point on a uv seam: the mean of its sides with both sides led to it, the mean alone, or "
        "that of the first face");
    add_choice<std::optional<VectorSpace>>(sub, "--vector", args.vector,
                                           {{"tangent", VectorSpace::tangent}, {"object", VectorSpace::object}},
                                           "Displace by three channels instead of one: along T, B, n or along x, y, z");
    add_height_reading_options(sub, args.height);
    add_choice<Interpolation>(
        sub, "--interpolation", args.interpolation,
        {{"bilinear", Interpolation::bilinear}, {"catmull-rom", Interpolation::catmull_rom}, {"c2", Interpolation::c2}},
        "Between texels; c2: cubic spline, smooth to the second derivative");
    sub.add_flag("--measure", args.measure, "Measure the distance of the result from the displaced surface");
    sub.add_flag("--margin", args.margin,
                 "Write the fold margin, smallest 1 + b a or stretch, as an attribute (fold_margin)");
    sub.add_flag("--audit", args.audit, "Test the result for self-intersections and orientation, exactly (slow)");
    add_memory_option(sub, args.max_memory);
}

void complete(DisplaceArgs& args) {
    const auto usage = [](const std::string& message) { return Error(Refusal::usage, message); };
    if (args.kind == BaseKind::catmark) args.surface.scheme = Scheme::catmark;
    if (args.kind == BaseKind::loop) args.surface.scheme = Scheme::loop;
    check_usage(args.surface, "displace");
    if (args.cells && args.surface.shape.empty())
        throw usage("--resolution: is of a --shape; --levels cuts a mesh finer");
    expect_picture(args.height.path);
    if (mesh_format(args.out) == MeshFormat::unknown)
        throw usage("--out " + args.out + ": is not a mesh format known here; use .obj, .ply, .glb or .gltf");
    if (args.margin && mesh_format(args.out) == MeshFormat::obj)
        throw usage("--margin: .obj has no place for attributes; write .ply or .glb");
    if (!args.surface.shape.empty() && args.kind != BaseKind::automatic)
        throw usage("--subdivide: a shape is smooth already; leave it out with --shape");
    if (args.levels.has_value() + args.edge_px.has_value() + args.max_error.has_value() > 1)
        throw usage("--levels, --edge-px, --max-error: are three ways to say how fine; give one");
    const bool has_rates = args.levels || args.edge_px || args.max_error;
    if (args.kind == BaseKind::none && has_rates && args.levels != 0)
        throw usage("--subdivide none: leaves the faces as they are; take linear to cut them finer, catmark or loop "
                    "for the limit surface");
    if (args.edge_px.has_value() == args.camera.empty())
        throw usage(args.camera.empty() ? "--edge-px: needs the --camera whose pixels they are"
                                        : "--camera: is for --edge-px; give both or none");
    const bool repeats = args.height.repeat != std::pair(1, 1);
    if (args.vector && (args.height.grey != Grey::mean || args.height.invert || args.height.dequantise || repeats))
        throw usage("--vector: takes three channels as they are; leave out --channel, --invert, --dequantise and "
                    "--repeat");
    if (args.kind == BaseKind::automatic) args.kind = has_rates ? BaseKind::linear : BaseKind::none;
}

} // namespace bake
