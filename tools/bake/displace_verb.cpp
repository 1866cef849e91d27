// bake displace: a mesh, the limit of a cage or a shape, really displaced.
#include "bake/base/output_file.h"
#include "bake/mesh/check/mesh_audit.h"
#include "bake/mesh/file/mesh_io.h"
#include "displace_options.h"
#include <cstdio>
#include <filesystem>

namespace bake {
namespace {

/// All that is known after the work.
struct Outcome {
    std::string described; ///< of the height
    std::string base;      ///< "mesh", "catmark limit", "shape"
    std::size_t patches = 0;
    double size = 0;      ///< diagonal of the base
    double edge = 0;      ///< mean edge of the result
    double max_error = 0; ///< that was asked for, object units
    double amplitude = 0, midlevel = 0;
    bool default_amplitude = false;
    DisplaceReport report;
    std::optional<MeshAudit> audit;
    std::uintmax_t file_bytes = 0;
};

/// Over at most 65536 faces taken evenly: a figure to compare others with.
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

/// The margin of every corner, where it can be written.
void add_margin(Displaced& displaced) {
    Attribute attribute{.name = "fold_margin", .components = 1, .values = {}};
    attribute.values.reserve(displaced.mesh.corners());
    for (const std::uint32_t p : displaced.mesh.corner_position) attribute.values.push_back(displaced.margin[p]);
    displaced.mesh.attributes.push_back(std::move(attribute));
}

std::string place(const Vec3d& p) { return format("(%.6g, %.6g, %.6g)", p.x, p.y, p.z); }

const char* name(Seam seam) { return seam == Seam::average ? "average" : seam == Seam::owner ? "owner" : "blend"; }

void print(const DisplaceArgs& args, const Outcome& o) {
    const DisplaceReport& r = o.report;
    std::printf("%s: %llu points, %llu faces (%llu triangles) over %zu patches of %s, %s\n", args.out.c_str(),
                static_cast<unsigned long long>(r.count.points), static_cast<unsigned long long>(r.count.faces),
                static_cast<unsigned long long>(r.triangles), o.patches, o.base.c_str(),
                describe_bytes(double(o.file_bytes)).c_str());
    std::printf("%s: amplitude %g, midlevel %g; b from %.6g to %.6g\n", o.described.c_str(), o.amplitude, o.midlevel,
                r.height_min, r.height_max);
    if (r.seam_points > 0)
        std::printf("uv seams: %llu points, largest mismatch %.6g at %s; %s\n",
                    static_cast<unsigned long long>(r.seam_points), r.seam_mismatch, place(r.seam_worst).c_str(),
                    name(args.seam));
    std::printf("fold margin (1 + b a, to stay above 0): %.4g at %s, uv (%.6g, %.6g); %llu points folded\n",
                r.fold_margin, place(r.fold_worst).c_str(), r.fold_worst_uv.x, r.fold_worst_uv.y,
                static_cast<unsigned long long>(r.folded));
    if (args.measure || !args.max_error.empty())
        std::printf("distance from the displaced surface: max %.4g, rms %.4g (%.4g %% of the diagonal)\n", r.error_max,
                    r.error_rms, 100 * r.error_max / o.size);
    if (r.uniform_triangles > 0)
        std::printf("%llu triangles where a uniform rate of the same error needs %llu (%.2f times as many)\n",
                    static_cast<unsigned long long>(r.triangles), static_cast<unsigned long long>(r.uniform_triangles),
                    double(r.uniform_triangles) / double(r.triangles));
    if (o.audit && o.audit->available) {
        const std::string cuts =
            o.audit->self_intersections > 0
                ? format("%zu pairs of triangles cut each other, the first at ", o.audit->self_intersections) +
                      place(o.audit->first_place)
                : "no triangles cut each other";
        const std::string inside = !o.audit->closed ? "not closed"
                                                    : (o.audit->outward ? "closed, outward" : "closed, inside out") +
                                                          format(", volume %.6g", o.audit->volume);
        std::printf("audit: %s; %s\n", cuts.c_str(), inside.c_str());
    }
}

void warn(const DisplaceArgs& args, const CommonArgs& common, const Outcome& o) {
    const DisplaceReport& r = o.report;
    const std::string& base = args.base_name();
    const auto count = [](std::uint64_t n) { return static_cast<unsigned long long>(n); };
    if (o.default_amplitude)
        note(common,
             format("amplitude %g, %s; --amplitude sets it", o.amplitude,
                    o.amplitude == 1 ? "the file's values being lengths" : "1 % of the bounding box's diagonal"));
    const double most = std::max(std::abs(r.height_min), std::abs(r.height_max));
    if (most > 0.25 * o.size)
        note(common, format("%s: displaced by up to %.4g, %.0f %% of its diagonal: more than relief can be on it; give "
                            "--amplitude in object units or as a per cent",
                            base.c_str(), most, 100 * most / o.size));
    if (args.seam != Seam::blend && r.seam_mismatch > 3 * o.edge)
        note(common, format("%s: the height differs by up to %.4g across a uv seam, %.1f edges of the result: a step "
                            "shows there; --seam blend spreads it",
                            base.c_str(), r.seam_mismatch, r.seam_mismatch / o.edge));
    if (o.max_error > 0 && r.error_max > o.max_error)
        note(common, format("%s: the result is up to %.4g away from the displaced surface, more than --max-error %.4g: "
                            "no edge is cut into more than %d "
                            "segments; a finer mesh, a smoother height or a larger --max-error",
                            base.c_str(), r.error_max, o.max_error, 4 * Rates{}.most));
    if (r.folded > 0)
        note(common, format("%s: %llu points are turned inside out, the displacement being beyond the radius of "
                            "curvature; a smaller --amplitude, "
                            "or a --midlevel that moves it the other way",
                            base.c_str(), count(r.folded)));
    if (r.no_normal > 0)
        note(common,
             format("%s: %llu points have no normal and stay where they are", base.c_str(), count(r.no_normal)));
    if (r.no_tangents > 0)
        note(common, format("%s: %llu points have no tangents (poles); their normals are those of the faces there",
                            base.c_str(), count(r.no_tangents)));
    if (o.audit && !o.audit->available) note(common, "no audit: this build has no CGAL");
}

nlohmann::json to_json(const Vec3d& p) { return {p.x, p.y, p.z}; }

nlohmann::json to_json(const DisplaceArgs& args, const Outcome& o) {
    const DisplaceReport& r = o.report;
    nlohmann::json object = {{"out", args.out},
                             {"base", args.base_name()},
                             {"kind", o.base},
                             {"patches", o.patches},
                             {"diagonal", o.size},
                             {"points", r.count.points},
                             {"faces", r.count.faces},
                             {"triangles", r.triangles},
                             {"mean_edge", o.edge},
                             {"bytes_needed", r.count.bytes},
                             {"file_bytes", o.file_bytes},
                             {"amplitude", o.amplitude},
                             {"midlevel", o.midlevel},
                             {"height", {{"file", args.height.path}, {"min", r.height_min}, {"max", r.height_max}}},
                             {"seam",
                              {{"policy", name(args.seam)},
                               {"points", r.seam_points},
                               {"mismatch", r.seam_mismatch},
                               {"worst", to_json(r.seam_worst)}}},
                             {"fold",
                              {{"points", r.folded},
                               {"margin", r.fold_margin},
                               {"worst", to_json(r.fold_worst)},
                               {"worst_uv", {r.fold_worst_uv.x, r.fold_worst_uv.y}}}},
                             {"no_normal", r.no_normal},
                             {"no_tangents", r.no_tangents}};
    if (args.measure || !args.max_error.empty()) object["error"] = {{"max", r.error_max}, {"rms", r.error_rms}};
    if (r.uniform_triangles > 0) object["uniform_triangles"] = r.uniform_triangles;
    if (o.audit) {
        object["audit"] = {{"available", o.audit->available}};
        if (o.audit->available) {
            object["audit"].update({{"self_intersections", o.audit->self_intersections},
                                    {"closed", o.audit->closed},
                                    {"outward", o.audit->outward},
                                    {"bounds_volume", o.audit->bounds_volume},
                                    {"volume", o.audit->volume}});
            if (o.audit->self_intersections > 0) object["audit"]["first_place"] = to_json(o.audit->first_place);
        }
    }
    return object;
}

std::string describe_base(const DisplaceArgs& args) {
    if (!args.shape.empty()) return "a shape";
    if (args.kind == BaseKind::catmark) return "a Catmull-Clark limit";
    return args.kind == BaseKind::loop ? "a Loop limit" : "a mesh";
}

int run(const DisplaceArgs& args, const CommonArgs& common) {
    check_usage(args);
    for (const std::string* input : {&args.height.path, &args.mesh})
        if (!input->empty()) check_not_input(args.out, *input);
    OutputFile(args.out); // refuses at once a name that cannot be written
    Stopwatch watch;
    Progress progress(common.quiet || common.json);
    const BaseSurface base = make_base(args);
    Outcome o;
    o.size = diagonal(bounds(base.mesh()));
    o.base = describe_base(args);
    o.patches = base.complex().patches.size();
    watch.lap("base");
    const ReliefFile file = load_relief(args, o.size);
    const DisplaceOptions options = resolve_options(args, o.size);
    o.max_error = options.rates.error;
    o.described = file.described;
    o.amplitude = file.relief.height.amplitude, o.midlevel = file.relief.height.midlevel;
    o.default_amplitude = file.default_amplitude;
    watch.lap("height");
    Displaced displaced = displace(base, file.relief, options, &progress);
    progress.finish();
    o.report = displaced.report;
    o.edge = mean_edge(displaced.mesh);
    watch.lap("displace");
    if (args.margin) add_margin(displaced);
    write_mesh(args.out, displaced.mesh);
    o.file_bytes = std::filesystem::file_size(args.out);
    watch.lap("write");
    if (args.audit) {
        o.audit = audit(displaced.mesh, triangulate(displaced.mesh));
        watch.lap("audit");
    }
    if (common.json) {
        nlohmann::json object = to_json(args, o);
        object["seconds"] = watch.to_json();
        std::printf("%s\n", object.dump(2, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
    } else {
        print(args, o);
        std::printf("%s\n", watch.to_text().c_str());
    }
    warn(args, common, o);
    return 0;
}

} // namespace

std::function<int()> displace_verb(CLI::App& sub, const CommonArgs& common) {
    const auto args = std::make_shared<DisplaceArgs>();
    add_displace_options(sub, *args);
    add_examples(
        sub,
        "The mesh as it is, and its faces cut into 2^4 x 2^4:\n"
        "  bake displace scan.ply --height scan_height.exr -o out.ply\n"
        "  bake displace torus.obj --height bricks.png --amplitude 1% --levels 4 -o out.glb\n"
        "  bake displace torus.obj --height vectors.exr --vector tangent --levels 4 -o out.glb\n"
        "The limit of a cage; a shape:\n"
        "  bake displace spot.obj --subdivide catmark --levels 5 --height rock.png --amplitude 2% -o out.ply\n"
        "  bake displace --shape torus:R=2,r=0.7 --height bricks.png --amplitude 0.05 -o out.obj\n"
        "As fine as a picture, or the relief, needs:\n"
        "  bake displace spot.obj --subdivide catmark --height rock.png --edge-px 2 --camera scene.toml -o out.ply\n"
        "  bake displace spot.obj --subdivide catmark --height rock.png --max-error 0.05% -o out.ply\n"
        "See docs/displace.md for the rates, seams, creases and what folds.\n");
    return [args, &common] { return run(*args, common); };
}

} // namespace bake
