// bake displace: a mesh, the limit surface of a cage or a shape, displaced by a height or by vectors.
#include "bake/base/output_file.h"
#include "bake/mesh/file/mesh_io.h"
#include "displace_report.h"
#include <filesystem>

namespace bake {
namespace {

/// The mean length of the edges of at most 65536 evenly chosen faces.
double mean_edge(const Mesh& mesh) {
    const std::size_t step = std::max<std::size_t>(1, (mesh.faces() + 65535) / 65536);
    double sum = 0;
    std::size_t edges = 0;
    for (std::size_t f = 0; f < mesh.faces(); f += step)
        for (std::uint32_t c = mesh.face_begin[f], last = mesh.face_begin[f + 1] - 1; c <= last; ++c, ++edges) {
            const std::uint32_t next = c < last ? c + 1 : mesh.face_begin[f];
            sum += glm::length(Vec3d(mesh.positions[mesh.corner_position[next]]) -
                               Vec3d(mesh.positions[mesh.corner_position[c]]));
        }
    return edges > 0 ? sum / double(edges) : 0;
}

/// Adds the fold margin as an attribute of the corners.
void add_margin(Displaced& displaced) {
    Attribute attribute{.name = "fold_margin", .components = 1, .values = {}};
    attribute.values.reserve(displaced.mesh.corners());
    for (const std::uint32_t p : displaced.mesh.corner_position) attribute.values.push_back(displaced.margin[p]);
    displaced.mesh.attributes.push_back(std::move(attribute));
}

std::string describe_base(const DisplaceArgs& args) {
    if (!args.surface.shape.empty()) return "a shape";
    if (args.kind == BaseKind::catmark) return "a Catmull-Clark limit";
    return args.kind == BaseKind::loop ? "a Loop limit" : "a mesh";
}

int run(DisplaceArgs& args, const CommonArgs& common) {
    complete(args);
    Stopwatch watch;
    Progress progress(common.quiet || common.json);
    progress.start("read", 0);
    const BaseSurface base = make_base(args);
    DisplaceOutcome o;
    o.mesh_notes = base.mesh().notes;
    o.size = diagonal(bounds(base.mesh()));
    o.base = describe_base(args);
    o.patches = base.complex().patches.size();
    watch.lap("base");
    const ReliefFile file = load_relief(args, o.size, common);
    const DisplaceOptions options = resolve_options(args, o.size, base.mesh().origin);
    o.max_error = options.rates.error;
    o.described = file.described;
    o.notes = file.notes;
    o.amplitude = file.relief.height.amplitude, o.midlevel = file.relief.height.midlevel;
    o.amplitude_note = file.amplitude_note;
    watch.lap("height");
    OutputFile(args.out); // a file that cannot be written is refused before the work
    Displaced displaced = displace(base, file.relief, options, &progress);
    progress.finish();
    o.report = displaced.report;
    o.edge = mean_edge(displaced.mesh);
    watch.lap("displace");
    if (args.margin) add_margin(displaced);
    o.file_bytes = std::uintmax_t(write_mesh(args.out, displaced.mesh));
    watch.lap("write");
    if (args.audit) {
        o.audit = audit(displaced.mesh, triangulate(displaced.mesh));
        watch.lap("audit");
    }
    print_result(common, to_text(args, o), to_json(args, o), watch);
    warn(args, common, o);
    return 0;
}

} // namespace

std::function<int()> displace_verb(CLI::App& sub, const CommonArgs& common) {
    const auto args = std::make_shared<DisplaceArgs>();
    add_displace_options(sub, *args);
    add_examples(
        sub,
        "  bake displace meshes/torus.obj --height meshes/bricks.png -o out.ply\n"
        "  bake displace meshes/torus.obj --height meshes/bricks.png --amplitude 1% --levels 4 -o out.glb\n"
        "  bake normal-map --height meshes/dots.png -o vectors.exr\n"
        "  bake displace meshes/torus.obj --height vectors.exr --vector tangent --midlevel 0.5 --levels 3 -o out.glb\n"
        "The limit of a cage; a shape:\n"
        "  bake displace meshes/torus.obj --subdivide catmark --levels 4 --height meshes/dots.png --amplitude 2% -o "
        "out.ply\n"
        "  bake displace --shape torus:R=2,r=0.7 --height meshes/bricks.png --amplitude 0.05 -o out.obj\n"
        "As fine as a picture, or the relief, needs:\n"
        "  bake displace meshes/torus.obj --height meshes/dots.png --edge-px 4 --camera meshes/scene.toml -o out.ply\n"
        "  bake displace meshes/torus.obj --subdivide catmark --height meshes/dots.png --max-error 0.5% -o out.ply\n"
        "See docs/displace.md for the rates, seams, creases and what folds.\n");
    return [args, &common] { return run(*args, common); };
}

} // namespace bake
