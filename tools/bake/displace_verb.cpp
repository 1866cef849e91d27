// bake displace: a mesh, the limit surface of a cage or a shape, displaced by a height or by vectors.
#include "bake/base/memory.h"
#include "bake/base/output_file.h"
#include "bake/base/parallel.h"
#include "displace_output.h"
#include "displace_report.h"
#include "inputs/byte_option.h"
#include <filesystem>
#include <new>

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

std::string describe_base(const DisplaceArgs& args) {
    if (!args.surface.shape.empty()) return "a shape";
    if (args.kind == BaseKind::catmark) return "a Catmull-Clark limit";
    return args.kind == BaseKind::loop ? "a Loop limit" : "a mesh";
}

/// Work that must stay within the memory. Where its need is not known beforehand, MemoryCap stops it.
template <class Work> auto within_memory(const std::string& name, const char* what, const Work& work) {
    try {
        return work();
    } catch (const std::bad_alloc&) {
        const MemoryLimit limit = memory_limit();
        throw Error(Refusal::unsuitable, name + ": " + what + " takes more memory than " + limit.described() +
                                             "; take a smaller one, or " + limit.advice());
    }
}

int run(DisplaceArgs& args, const CommonArgs& common) {
    complete(args);
    Stopwatch watch;
    Progress progress(common.quiet || common.json);
    progress.start("read", 0);
    std::optional<MemoryCap> cap;
    if (args.max_memory) cap.emplace(MemoryLimit{*args.max_memory, "`max_bytes`"}, thread_count());
    const BaseSurface base =
        within_memory(args.surface.name(), "reading it and finding its edges", [&] { return make_base(args); });
    return_free_memory();
    DisplaceOutcome o;
    o.mesh_notes = base.mesh().notes;
    o.size = diagonal(bounds(base.mesh()));
    o.base = describe_base(args);
    o.patches = base.complex().patches.size(), o.base_faces = base.mesh().faces();
    watch.lap("base");
    const ReliefFile file =
        within_memory(args.height.path, "reading it", [&] { return load_relief(args, o.size, common); });
    return_free_memory();
    DisplaceOptions options = resolve_options(args, o.size, base.mesh().origin);
    options.taken = process_memory().resident;
    options.later = later_steps(args, base);
    o.max_error = options.rates.error;
    o.described = file.described;
    o.notes = file.notes;
    o.amplitude = file.relief.height.amplitude, o.midlevel = file.relief.height.midlevel;
    o.amplitude_note = file.amplitude_note;
    watch.lap("height");
    OutputFile(args.out); // a file that cannot be written is refused before the work
    const std::uint64_t before = peak_memory();
    Displaced displaced = within_memory(args.surface.name(), "displacing it",
                                        [&] { return displace(base, file.relief, options, &progress); });
    return_free_memory();
    o.report = displaced.report;
    o.report.count.bytes = std::max(o.report.count.bytes, before);
    o.edge = mean_edge(displaced.mesh);
    o.facets = facet_loss(displaced.mesh, file.relief);
    watch.lap("displace");
    progress.start("write", 0);
    const Facts facts = {{"content", std::string("displaced mesh")},
                         {"amplitude", o.amplitude},
                         {"midlevel", o.midlevel},
                         {"units", std::string("object units")}};
    o.file_bytes = std::uintmax_t(write_displaced(args, !base.mesh().tangents.empty(), displaced, facts, o.mesh_notes));
    watch.lap("write");
    if (args.audit) {
        progress.start("audit", 0);
        return_free_memory();
        o.audit = audit(displaced.mesh, triangulate(displaced.mesh));
        watch.lap("audit");
    }
    progress.finish();
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
