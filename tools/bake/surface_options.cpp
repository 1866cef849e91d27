#include "surface_options.h"
#include "inputs/name_list.h"
#include "inputs/tile_names.h"
#include "surface_map_files.h"

namespace bake {
namespace {

Error usage(const std::string& message) { return Error(Refusal::usage, message); }

SurfaceAttributes parse_attributes(const std::string& text) {
    SurfaceAttributes out{false, false, false};
    bool SurfaceAttributes::*const members[] = {&SurfaceAttributes::normal, &SurfaceAttributes::tangent,
                                                &SurfaceAttributes::curvature};
    for (const std::size_t i : parse_names("--attributes", text, "attribute", {"normal", "tangent", "curvature"}))
        out.*members[i] = true;
    return out;
}

/// "  torus:R=1,r=0.4   a ring" for every shape.
std::string shapes_text() {
    std::string out = "Shapes, their keys and defaults:\n  ";
    for (const char c : parametric_shapes()) out += c == '\n' ? std::string("\n  ") : std::string(1, c);
    return out + "\n";
}

} // namespace

void add_surface_options(CLI::App& sub, SurfaceArgs& args) {
    add_surface_input(sub, args.surface);
    add_choice<std::optional<Scheme>>(sub, "--subdivide", args.surface.scheme,
                                      {{"catmark", Scheme::catmark}, {"loop", Scheme::loop}},
                                      "The mesh is a cage: take its limit surface");
    add_size_option(sub, args.resolution, "Cells of a shape along u and v, or along every edge of a cage's patches [4]",
                    65536, "--resolution")
        ->type_name("NxM|N");
    add_output_option(sub, args.out, "Mesh to write (.ply, .glb, .gltf, .obj); of a glTF file all else is kept")
        ->required(false);
    sub.add_option_function<std::string>(
           "--attributes", [&args](const std::string& text) { args.attributes = parse_attributes(text); },
           "What the mesh has, apart by commas [normal,tangent; of .obj normal]: normal, tangent, curvature")
        ->type_name("NAMES");
    sub.add_option_function<std::string>(
           "--maps", [&args](const std::string& text) { args.maps = parse_maps(text); },
           "Maps to write, apart by commas [all]: position, normal, pu, pv, tangent, mean-curvature, gauss-curvature")
        ->type_name("NAMES");
    sub.add_option("--maps-out", args.maps_out, "What the maps' names begin with: PREFIX_normal.exr and so on")
        ->type_name("PREFIX");
    add_size_option(sub, args.size, "Texels of the maps [1024]");
    add_tile_option(sub, args.tile);
    add_integer_option(sub, "--padding", args.padding, 0, 4096, "Texels filled beyond the charts' borders")
        ->default_str(std::to_string(args.padding));
    sub.footer(shapes_text() +
               "Examples:\n"
               "  bake surface --shape torus:R=2,r=0.7 --resolution 128x64 -o torus.ply\n"
               "  bake surface meshes/torus.obj --subdivide catmark --resolution 8 -o limit.glb\n"
               "  bake surface meshes/torus.obj --maps normal,mean-curvature --size 512 --maps-out torus\n");
}

void check_usage(const SurfaceArgs& args) {
    check_usage(args.surface, "surface");
    if (args.out.empty() && args.maps_out.empty())
        throw usage("surface: nothing to write; give -o for a mesh, --maps-out for maps, or both");
    if (args.out.empty() && args.attributes) throw usage("--attributes: are those of the mesh that -o writes; name it");
    if (args.maps_out.empty() && !args.maps.empty())
        throw usage("--maps: needs --maps-out, what the maps' names begin with");
    expect_tile_or_all("the maps", args.maps_out, args.tile);
    if (args.resolution && args.surface.shape.empty() && !args.surface.scheme)
        throw usage("--resolution: a mesh is taken as it is, with its own faces; --subdivide makes a smooth surface of "
                    "it");
    if (args.surface.scheme && args.resolution)
        if (const auto [n, m] = *args.resolution; n != m || n > 1024)
            throw usage("--resolution: cells along every edge of the cage's patches; write one number up to 1024");
    if (args.out.empty()) return;
    const MeshFormat format = mesh_format(args.out);
    if (format == MeshFormat::unknown)
        throw usage("--out " + args.out + ": is no mesh by its ending; choose a name that ends in .ply, .glb or .obj");
    if (format == MeshFormat::obj && args.attributes && (args.attributes->tangent || args.attributes->curvature))
        throw usage("--attributes: .obj has no place for tangents and curvatures; write .ply or .glb");
}

} // namespace bake
