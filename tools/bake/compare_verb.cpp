// bake compare: how much two pictures, two normal maps or two meshes differ.
#include "bake/picture/image_io.h"
#include "bake/verdict/compare/normals_report.h"
#include "bake/verdict/compare/picture_report.h"
#include "bake/verdict/metric/false_colour.h"
#include "inputs/file_kind.h"
#include "options.h"

namespace bake {
namespace {

/// Degrees that have the last colour in a picture of angles.
constexpr float last_angle = 20;

struct CompareArgs {
    std::string file, other, out;
    bool normals = false;
    PictureCompareOptions pictures;
    NormalSpace space = NormalSpace::tangent;
    std::vector<std::string> limits;
    MeshDistanceOptions distance;
};

/// METRIC=VALUE.
std::vector<Limit> parse_limits(const std::vector<std::string>& texts) {
    std::vector<Limit> limits;
    for (const std::string& text : texts) {
        const std::size_t equals = text.find('=');
        if (equals == 0 || equals == std::string::npos)
            throw Error(Refusal::usage, "--limit " + text + ": is not METRIC=VALUE, such as flip=0.05");
        const std::string metric = text.substr(0, equals);
        limits.push_back({metric, number_of("--limit " + metric, text.substr(equals + 1), -1e30, 1e30)});
    }
    return limits;
}

/// Errors as floats in .exr and .tif, in false colour in .png.
void write_errors(const std::string& path, const Image<float>& errors, float largest) {
    if (picture_format(path) != PictureFormat::png) return write_image(path, errors, {.depth = Depth::float32});
    write_image(path, false_colour(errors, largest), {.depth = Depth::u8, .colour = ColourSpace::srgb});
}

/// Prints the report, makes the error picture appear, and returns the exit code.
template <class Report>
int finish(const CompareArgs& args, const CommonArgs& common, const Report& report, float largest, Stopwatch& watch) {
    watch.lap("compare");
    if (!args.out.empty()) {
        write_errors(args.out, report.errors, largest);
        watch.lap("write");
    }
    print_result(common, with_flags(to_text(report)), nlohmann::json::parse(with_flags(to_json(report))), watch);
    return report.over_limit ? int(Refusal::over_limit) : 0;
}

int run_meshes(const CompareArgs& args, const CommonArgs& common, const std::vector<Limit>& limits) {
    InspectOptions options;
    options.distance = args.distance;
    for (const Limit& limit : limits) {
        if (limit.name != "distance")
            throw Error(Refusal::usage, "--limit " + limit.name + ": is not computed of meshes; distance is");
        if (limit.value <= 0) throw Error(Refusal::usage, "--limit distance: must be above 0");
        options.limit = options.limit > 0 ? std::min(options.limit, limit.value) : limit.value;
    }
    Stopwatch watch;
    const DistanceReport report = inspect_distance(args.file, args.other, options);
    watch.lap("compare");
    print_result(common, with_flags(to_text(report)), nlohmann::json::parse(with_flags(to_json(report))), watch);
    return report.over_limit() ? int(Refusal::over_limit) : 0;
}

int run(CompareArgs& args, const CommonArgs& common) {
    const std::vector<Limit> limits = parse_limits(args.limits);
    if (file_kind(args.file) == FileKind::mesh && file_kind(args.other) == FileKind::mesh)
        return run_meshes(args, common, limits);
    const bool mesh = file_kind(args.file) == FileKind::mesh;
    const std::string& expected_mesh = mesh ? args.other : args.file;
    if (mesh || file_kind(args.other) == FileKind::mesh) expect_mesh(expected_mesh);
    expect_picture(args.file);
    expect_picture(args.other);
    if (!args.out.empty()) resolve_depth(args.out, Depth::automatic); // its ending is refused before any work
    Stopwatch watch;
    if (args.normals)
        return finish(args, common, compare_normals(args.file, args.other, {.space = args.space, .limits = limits}),
                      last_angle, watch);
    Progress progress(common.quiet);
    args.pictures.limits = limits;
    args.pictures.error_picture = !args.out.empty();
    return finish(args, common, compare_pictures(args.file, args.other, args.pictures, &progress), 1, watch);
}

/// Refuses options that the kind of comparison does not have.
void refuse_idle(const CompareArgs& args, const CLI::App& sub, bool normals) {
    const bool meshes = file_kind(args.file) == FileKind::mesh && file_kind(args.other) == FileKind::mesh;
    const auto refuse = [&](const char* flag, const char* why) {
        if (sub.count(flag) > 0) throw Error(Refusal::usage, std::string(flag) + ": " + why);
    };
    for (const char* flag : {"--metric", "--exposure", "--ppd"})
        if (meshes || normals) refuse(flag, "belongs to pictures of colour; leave it out");
    if (meshes)
        for (const char* flag : {"--normals", "--out"}) refuse(flag, "belongs to pictures, and these are meshes");
    if (!meshes) refuse("--samples", "belongs to meshes; leave it out");
}

} // namespace

std::function<int()> compare_verb(CLI::App& sub, const CommonArgs& common) {
    const auto args = std::make_shared<CompareArgs>();
    sub.add_option("file", args->file, "Picture, normal map or mesh: the reference")->required();
    sub.add_option("other", args->other, "What is compared with it, of the same kind and size")->required();
    add_choice<std::optional<Metric>>(sub, "--metric", args->pictures.metric,
                                      {{"all", {}},
                                       {"rmse", Metric::rmse},
                                       {"psnr", Metric::psnr},
                                       {"ssim", Metric::ssim},
                                       {"flip", Metric::flip},
                                       {"hdr-flip", Metric::hdr_flip}},
                                      "Pictures: what is computed; all leaves out hdr-flip for integer samples");
    add_number_option(sub, "--exposure", args->pictures.exposure, -64, 64,
                      "Stops at which psnr, ssim and flip see the pictures [float samples: automatic, of the first "
                      "picture; else 0]");
    add_number_option(sub, "--ppd", args->pictures.flip.pixels_per_degree, 1, 1000,
                      "Pixels per degree of vision, for flip and hdr-flip")
        ->default_str("67.02");
    const auto normals =
        sub.add_flag("--normals", args->normals, "The pictures are normal maps: angles between them in degrees");
    add_choice(sub, "--space", args->space, {{"tangent", NormalSpace::tangent}, {"object", NormalSpace::object}},
               "Of the normals: in tangent space the two may differ in where green points")
        ->needs(normals);
    sub.add_option("-o,--out", args->out,
                   "Picture of the errors, FLIP or degrees: .png in false colour, .exr and .tif as floats");
    sub.add_option("--limit", args->limits,
                   "Exit with 1 beyond it; may be given again. rmse, psnr, ssim, flip, hdr-flip, angle, distance; "
                   "flip-p95, flip-p99, flip-max and the same of hdr-flip and angle")
        ->allow_extra_args(false)
        ->type_name("METRIC=VALUE");
    add_integer_option(sub, "--samples", args->distance.samples, 1, 1000000000,
                       "Meshes: points of equal area for means and normals, at least one per triangle")
        ->default_str(std::to_string(args->distance.samples));
    add_examples(sub, "  bake render meshes/torus.obj --size 128 --spp 16 -o fine.exr\n"
                      "  bake render meshes/torus.obj --size 128 --spp 1 -o coarse.exr\n"
                      "  bake compare fine.exr coarse.exr\n"
                      "  bake compare fine.exr coarse.exr --metric flip --limit flip=0.2 -o diff.png\n"
                      "  bake normal-map meshes/bricks.png -o up.png\n"
                      "  bake normal-map meshes/bricks.png --directx -o down.png\n"
                      "  bake compare --normals up.png down.png --limit angle-max=1\n"
                      "  bake compare meshes/torus.obj meshes/sphere.obj --limit distance=2\n");
    return [args, &common, &sub] {
        refuse_idle(*args, sub, args->normals);
        return run(*args, common);
    };
}

} // namespace bake
