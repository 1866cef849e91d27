// bake check: what is in each file, and what is wrong with it.
#include "bake/mesh/asset/asset.h"
#include "bake/verdict/asset_report.h"
#include "bake/verdict/brdf_check.h"
#include "check_decode.h"
#include "check_height.h"
#include "inputs/brdf_input.h"
#include "inputs/file_kind.h"

namespace bake {
namespace {

struct CheckArgs {
    std::vector<std::string> files;
    std::vector<std::pair<std::string, std::string>> pairs;
    DecodeArgs decode;
    std::vector<std::string> brdfs;
    std::string against;
    HeightInput height; ///< for the meshes; none unless it has a path
    InspectOptions options;
    bool strict = false;
};

int run(const CheckArgs& args, const CommonArgs& common) {
    CheckResults results;
    std::optional<HeightTexture> relief;
    if (!args.height.path.empty()) relief = load_height(args.height, common);
    for (const std::string& file : args.files) {
        bool read = false;
        if (!args.against.empty())
            add_result(results, file, common, [&] { return inspect_distance(file, args.against, args.options); });
        else if (asset_text(file)) add_result(results, file, common, [&] { return inspect_asset(file); });
        else if (named_like_a_mesh(file))
            read = add_result(results, file, common, [&] { return inspect_mesh(file, args.options); });
        else
            add_result(results, file, common, [&] {
                expect_picture(file);
                return inspect_image(file, args.options);
            });
        if (relief && read)
            add_result(results, file, common,
                       [&] { return inspect_height(file, args.height, *relief, args.options, common); });
    }
    for (const auto& [height, normals] : args.pairs)
        add_result(results, height, common,
                   [&, &h = height, &n = normals] { return inspect_pair(h, n, args.options); });
    check_decode(results, args.decode, args.options.directx.value_or(false), args.options, common);
    for (const std::string& spec : args.brdfs)
        add_result(results, spec, common, [&] { return check_brdf(spec, parse_brdf("--brdf", spec)); });
    if (common.json) common.report->object = {{"files", results.files}}, common.report->indent = -1;
    if (results.code != 0) return results.code;
    return results.over || (args.strict && results.wrong) ? int(Refusal::over_limit) : 0;
}

void check_usage(const CheckArgs& args) {
    const auto usage = [](const std::string& message) { return Error(Refusal::usage, message); };
    check_height_usage(args.height, args.files);
    check_usage(args.decode);
    const bool green = !args.pairs.empty() || !args.decode.maps.empty();
    if (args.files.empty() && !green && args.brdfs.empty())
        throw usage("check: no file given; name meshes, images, a --pair, a map to --decode or a --brdf; see bake "
                    "check --help");
    if (args.options.directx && !green)
        throw usage("--expect: says which green a --pair or a map to --decode has; give one of them");
    const bool others = green || !args.brdfs.empty() || !args.height.path.empty();
    if (!args.against.empty() && (args.files.empty() || others || args.options.audit))
        throw usage("check: --against takes meshes alone; run --audit, --height, --pair, --decode and --brdf "
                    "separately");
    for (const std::string& spec : args.brdfs) parse_brdf("--brdf", spec); // refused before a file is read
}

} // namespace

std::function<int()> check_verb(CLI::App& sub, const CommonArgs& common) {
    const auto args = std::make_shared<CheckArgs>();
    sub.add_option(
        "files", args->files,
        "Meshes (.obj, .ply, .gltf, .glb) and images to inspect; of .usda and .mtlx the record and the pictures");
    add_height_check(sub, args->height);
    sub.add_option("--pair", args->pairs,
                   "A height texture and the normal map said to be of it; may be given again")
        ->allow_extra_args(false) // a file may follow
        ->type_name("HEIGHT NORMAL");
    add_channel_option(sub, "--height-channel", args->options.height_channel, "Grey of the pair's height");
    add_choice<std::optional<bool>>(sub, "--expect", args->options.directx, {{"opengl", false}, {"directx", true}},
                                    "With --pair: exit with 1 unless the green of the normal map points up (opengl) or "
                                    "down (directx); with --decode: the green that is right [opengl]");
    add_decode_options(sub, args->decode);
    sub.add_option("--brdf", args->brdfs,
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
    return [args, &common] {
        check_usage(*args);
        return run(*args, common);
    };
}

} // namespace bake
