// bake check: what is in each file, and what is wrong with it.
#include "bake/base/memory.h"
#include "bake/verdict/brdf_check.h"
#include "bake/verdict/decode_check.h"
#include "bake/verdict/relief_check.h"
#include "inputs/brdf_input.h"
#include "inputs/file_kind.h"
#include "options.h"
#include <new>

namespace bake {
namespace {

struct CheckArgs {
    std::vector<std::string> files;
    std::vector<std::pair<std::string, std::string>> pairs;
    std::vector<std::pair<std::string, std::string>> maps; ///< and their meshes
    std::vector<std::string> brdfs;
    std::string against;
    HeightInput height; ///< for the meshes; none unless it has a path
    InspectOptions options;
    bool strict = false;
};

// Files are independent: a bad one is reported, and the others are still inspected.
struct Results {
    nlohmann::ordered_json files = nlohmann::ordered_json::array();
    int code = 0;         ///< of the first bad file
    bool wrong = false;   ///< some file has a warning
    bool over = false;    ///< some distance is over --limit, or some green is not that of --expect
    bool printed = false; ///< a report has been printed as text
};

bool over_limit(const DistanceReport& report) { return report.over_limit(); }
bool over_limit(const PairReport& report) { return report.unexpected(); }
template <class Report> bool over_limit(const Report&) { return false; }

/// False if the file is refused.
template <class Inspect>
bool add_result(Results& results, const std::string& file, const CommonArgs& common, const Inspect& inspect) {
    const auto refuse = [&](const std::string& message, Refusal why) {
        const int code = fail(message, why);
        if (results.code == 0) results.code = code;
        results.files.push_back({{"file", file}, {"error", with_flags(message)}, {"code", code}});
    };
    try {
        Progress progress(common.quiet);
        progress.start("check " + printable(file), 0);
        auto report = inspect();
        progress.finish();
        for (auto* lines : {&report.findings.warnings, &report.findings.notes})
            for (std::string& line : *lines) line = with_flags(line);
        results.wrong = results.wrong || !report.findings.warnings.empty();
        results.over = results.over || over_limit(report);
        if (common.json) {
            nlohmann::ordered_json object = nlohmann::ordered_json::parse(to_json(report));
            if (auto found = object.find("bake_options"); found != object.end())
                *found = with_flags(found->get<std::string>());
            results.files.push_back(std::move(object));
        } else {
            print_text((results.printed ? "\n" : "") + with_flags(to_text(report)));
            results.printed = true;
        }
        return true;
    } catch (const Error& error) {
        if (error.refusal == Refusal::interrupted) throw;
        refuse(error.what(), error.refusal);
    } catch (const std::bad_alloc&) {
        const MemoryLimit memory = memory_limit();
        refuse(file + ": takes more memory than " + memory.described() + "; give a smaller one, or " + memory.advice(),
               Refusal::unsuitable);
    }
    return false;
}

/// What the methods do with the height on a mesh.
ReliefReport inspect_height(const std::string& file, const HeightTexture& height, const CheckArgs& args,
                            const CommonArgs& common) {
    const Mesh mesh = read_mesh(file, args.options.read);
    const double size = diagonal(bounds(mesh));
    const HeightOptions options = height_options(args.height, height.info, diagonal_of(size));
    check_steepness(args.height, options.amplitude, size);
    note(common, default_amplitude_note(args.height, height.info, options, diagonal_of(size)));
    return inspect_relief(file, mesh, args.height.path, height, args.height.filter, options);
}

int run(const CheckArgs& args, const CommonArgs& common) {
    Results results;
    std::optional<HeightTexture> relief;
    if (!args.height.path.empty()) relief = load_height(args.height, common);
    for (const std::string& file : args.files) {
        bool read = false;
        if (!args.against.empty())
            add_result(results, file, common, [&] { return inspect_distance(file, args.against, args.options); });
        else if (named_like_a_mesh(file))
            read = add_result(results, file, common, [&] { return inspect_mesh(file, args.options); });
        else
            add_result(results, file, common, [&] {
                expect_picture(file);
                return inspect_image(file, args.options);
            });
        if (relief && read)
            add_result(results, file, common, [&] { return inspect_height(file, *relief, args, common); });
    }
    for (const auto& [height, normals] : args.pairs)
        add_result(results, height, common,
                   [&, &h = height, &n = normals] { return inspect_pair(h, n, args.options); });
    for (const auto& [map, mesh] : args.maps)
        add_result(results, map, common, [&, &n = map, &m = mesh] {
            expect_picture(n);
            expect_mesh(m);
            return inspect_decoding(n, m, args.options.directx.value_or(false), args.options);
        });
    for (const std::string& spec : args.brdfs)
        add_result(results, spec, common, [&] { return check_brdf(spec, parse_brdf("--brdf", spec)); });
    if (common.json) print_json({{"files", results.files}}, -1);
    if (results.code != 0) return results.code;
    return results.over || (args.strict && results.wrong) ? int(Refusal::over_limit) : 0;
}

/// Adds --height, and the options of the other verbs that say how it is read.
CLI::Option* add_height_check(CLI::App& sub, HeightInput& input) {
    CLI::Option* height = add_height_path(sub, "--height", input);
    height->description(
        "Report what each method does wrong with the relief of this picture on the meshes, as predicted");
    add_relief_options(sub, input);
    add_height_options(sub, input);
    for (const char* flag : {"--amplitude", "--midlevel", "--filter", "--wrap", "--wrap-u", "--wrap-v", "--channel",
                             "--invert", "--dequantise"})
        sub.get_option(flag)->needs(height);
    return height;
}

/// Refuses meshes and pictures that --height does not go with.
void check_height_usage(const CheckArgs& args) {
    if (args.height.path.empty()) return;
    expect_picture(args.height.path);
    if (args.files.empty()) throw Error(Refusal::usage, "--height: needs a mesh that the relief is for; name it first");
    for (const std::string& file : args.files)
        if (!named_like_a_mesh(file))
            throw Error(Refusal::usage, file + ": is no mesh, which --height needs; check the picture separately");
}

} // namespace

std::function<int()> check_verb(CLI::App& sub, const CommonArgs& common) {
    const auto args = std::make_shared<CheckArgs>();
    const auto files = sub.add_option("files", args->files, "Meshes (.obj, .ply, .gltf, .glb) and images to inspect");
    const auto height = add_height_check(sub, args->height);
    const auto pair = sub.add_option("--pair", args->pairs,
                                     "A height texture and the normal map said to be of it; may be given again")
                          ->allow_extra_args(false) // a file may follow
                          ->type_name("HEIGHT NORMAL");
    add_channel_option(sub, "--height-channel", args->options.height_channel, "Grey of the pair's height");
    add_choice<std::optional<bool>>(sub, "--expect", args->options.directx, {{"opengl", false}, {"directx", true}},
                                    "With --pair: exit with 1 unless the green of the normal map points up (opengl) or "
                                    "down (directx); with --decode: the green that is right [opengl]");
    const auto maps = sub.add_option("--decode", args->maps,
                                     "A normal map and the mesh that it was baked for: what viewers that decode it in "
                                     "other ways make of it, in degrees; may be given again")
                          ->allow_extra_args(false)
                          ->type_name("NORMAL MESH");
    const auto brdf = sub.add_option("--brdf", args->brdfs,
                                     "A reflection model, or several joined by +: whether it is positive, conserves "
                                     "energy and is reciprocal; may be given again")
                          ->allow_extra_args(false)
                          ->type_name("NAME[:KEY=VALUE,...]");
    add_mesh_options(sub, args->options.read);
    add_integer_option(sub, "--overlap-size", args->options.uv.overlap_size, 0, 8192,
                       "Samples along a UV tile for measuring overlaps; 0: not measured")
        ->default_str(std::to_string(args->options.uv.overlap_size));
    sub.add_flag("--audit", args->options.audit,
                 "Meshes: report self-intersections, orientation and volume too, computed exactly (slow)");
    const auto against = sub.add_option("--against", args->against,
                                        "Report the distance of the meshes from this mesh instead of what is in them")
                             ->type_name("MESH");
    add_number_option(sub, "--limit", args->options.limit, 1e-30, 1e30,
                      "With --against: exit with 1 if the distance may be larger, object units")
        ->needs(against);
    add_integer_option(sub, "--samples", args->options.distance.samples, 1, 1000000000,
                       "With --against: points of equal area for means and normals, at least one per triangle")
        ->needs(against)
        ->default_str(std::to_string(args->options.distance.samples));
    sub.add_flag("--strict", args->strict, "Exit with 1 if anything is wrong (any warning)");
    add_examples(sub,
                 "  bake check meshes/torus.obj meshes/bricks.png\n"
                 "  bake check meshes/torus.obj --height meshes/bricks.png --amplitude 2%\n"
                 "  bake check --strict --json meshes/*.obj\n"
                 "  bake check --audit meshes/torus.obj\n"
                 "  bake check meshes/torus.obj --against meshes/sphere.obj --limit 2\n"
                 "  bake normal-map --height meshes/bricks.png -o bricks_normal.png\n"
                 "  bake check --pair meshes/bricks.png bricks_normal.png --expect opengl\n"
                 "  bake normal-map meshes/torus.obj --height meshes/bricks.png --amplitude 1% -o torus_normal.png\n"
                 "  bake check --decode torus_normal.png meshes/torus.obj\n"
                 "  bake check --brdf phong:n=3\n"
                 "  bake check --brdf lambert:albedo=.5+normalised-blinn:n=32,specular=.3\n\n"
                 "Reflection models of --brdf, their keys and defaults:\n" +
                     brdf_models());
    return [args, &common, files, pair, maps, brdf, height] {
        check_height_usage(*args);
        if (files->empty() && pair->empty() && maps->empty() && brdf->empty())
            throw Error(Refusal::usage, "check: no file given; name meshes, images, a --pair, a map to --decode or a "
                                        "--brdf; see bake check --help");
        if (args->options.directx && pair->empty() && maps->empty())
            throw Error(Refusal::usage,
                        "--expect: says which green a --pair or a map to --decode has; give one of them");
        const bool others = !pair->empty() || !maps->empty() || !brdf->empty() || !height->empty();
        if (!args->against.empty() && (files->empty() || others || args->options.audit))
            throw Error(Refusal::usage,
                        "check: --against takes meshes alone; run --audit, --height, --pair, --decode and "
                        "--brdf separately");
        for (const std::string& spec : args->brdfs) parse_brdf("--brdf", spec); // refused before a file is read
        return run(*args, common);
    };
}

} // namespace bake
