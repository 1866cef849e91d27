#include "compare_options.h"
#include "bake/picture/image_io.h"
#include "inputs/file_kind.h"

namespace bake {
namespace {

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

Comparing kind_of(const CompareArgs& args) {
    const FileKind kind = file_kind(args.file);
    if (kind == FileKind::scene || (args.other.empty() && kind == FileKind::unknown)) return Comparing::methods;
    if (args.other.empty())
        throw Error(Refusal::usage, args.file +
                                        ": what is it compared with? Name a second file of the same kind, or one "
                                        "scene (.toml), whose methods of showing relief are compared");
    if (kind == FileKind::mesh && file_kind(args.other) == FileKind::mesh) return Comparing::meshes;
    return args.normals ? Comparing::normals : Comparing::pictures;
}

void expect_kinds(const CompareArgs& args, Comparing what) {
    if (what == Comparing::meshes) return;
    if (what == Comparing::methods) {
        if (!args.other.empty())
            throw Error(Refusal::usage,
                        args.other + ": the methods of one scene are compared; leave the second file out");
        return expect_scene(args.file);
    }
    const bool mesh = file_kind(args.file) == FileKind::mesh;
    if (mesh || file_kind(args.other) == FileKind::mesh) expect_mesh(mesh ? args.other : args.file);
    expect_picture(args.file);
    expect_picture(args.other);
}

void add_file_options(CLI::App& sub, CompareArgs& args) {
    add_choice<std::optional<Metric>>(sub, "--metric", args.pictures.metric,
                                      {{"all", {}},
                                       {"rmse", Metric::rmse},
                                       {"psnr", Metric::psnr},
                                       {"ssim", Metric::ssim},
                                       {"flip", Metric::flip},
                                       {"hdr-flip", Metric::hdr_flip}},
                                      "Pictures: what is computed; all leaves out hdr-flip for integer samples");
    add_number_option(
        sub, "--exposure", args.pictures.exposure, -64, 64,
        "Stops at which errors are seen [scene: its own, or automatic of the reference; pictures of float "
        "samples: automatic, of the first; else 0]");
    add_number_option(sub, "--ppd", args.pictures.flip.pixels_per_degree, 1, 1000,
                      "Pixels per degree of vision, for flip and hdr-flip")
        ->default_str("67.02");
    const auto normals =
        sub.add_flag("--normals", args.normals, "The pictures are normal maps: angles between them in degrees");
    add_choice(sub, "--space", args.space, {{"tangent", NormalSpace::tangent}, {"object", NormalSpace::object}},
               "Of the normals: in tangent space the two may differ in where green points")
        ->needs(normals);
    add_integer_option(sub, "--samples", args.distance.samples, 1, 1000000000,
                       "Meshes: points of equal area for means and normals, at least one per triangle")
        ->default_str(std::to_string(args.distance.samples));
}

void add_method_options(CLI::App& sub, MethodCompareArgs& args) {
    sub.add_option("--object", args.object, "Scene: name of the mesh whose methods are compared [all with a height]")
        ->type_name("NAME");
    sub.add_option(
           "--methods", args.methods,
           "Scene: methods with commas between them, as `shade` of a material [all, and displacements that suit "
           "the mesh]")
        ->type_name("plain|bump|...");
    sub.add_option("--reference", args.reference,
                   "Scene: the displacement that is right; auto: refined until that changes little")
        ->type_name("auto|displace:N|displace:max")
        ->capture_default_str();
    add_size_option(sub, args.size, "Scene: pixels, instead of its own", 8192);
    add_integer_option(sub, "--spp", args.spp, 2, 65536, "Scene: samples per pixel")->capture_default_str();
    sub.add_option("--camera", args.camera, "Scene: name of its camera [the first]")->type_name("NAME");
    add_integer_option(sub, "--repeats", args.repeats, 1, 1000,
                       "Scene: how often each method is prepared and rendered, for the median of the times")
        ->capture_default_str();
    sub.add_option("--report", args.report, "Scene: one HTML file with the pictures, the charts and the table")
        ->type_name("OUT.html");
    sub.add_flag("--no-causes", args.no_causes, "Scene: leave out the share of the error by cause, which takes time");
    sub.add_flag("--csv", args.csv, "Scene: print the table as CSV");
}

/// Flags of one kind of comparison alone.
struct KindFlags {
    Comparing kind;
    const char* of;
    std::initializer_list<const char*> flags;
};

} // namespace

void add_compare_options(CLI::App& sub, CompareArgs& args) {
    sub.add_option("file", args.file, "Picture, normal map or mesh: the reference; or a scene (.toml)")->required();
    sub.add_option("other", args.other, "What is compared with it, of the same kind and size; not for a scene");
    add_file_options(sub, args);
    add_method_options(sub, args.methods);
    sub.add_option(
        "-o,--out", args.out,
        "Picture of the errors, FLIP or degrees: .png in false colour, .exr and .tif as floats. Scene: folder "
        "for the pictures, the contact sheet, the charts and the tables");
    sub.add_option(
           "--limit", args.limit_texts,
           "Exit with 1 beyond it; may be given again. rmse, psnr, ssim, flip, hdr-flip, angle, outline, distance; "
           "flip-p95, flip-p99, flip-max and the same of hdr-flip and angle; outline-max")
        ->allow_extra_args(false)
        ->type_name("METRIC=VALUE");
}

Comparing check_compare_usage(CompareArgs& args, const CLI::App& sub) {
    args.limits = parse_limits(args.limit_texts);
    const Comparing what = kind_of(args);
    const auto refuse = [&](const char* flag, const std::string& why) {
        if (sub.count(flag) > 0) throw Error(Refusal::usage, std::string(flag) + ": " + why);
    };
    const auto is = [&](Comparing kind) { return what == kind; };
    if (!is(Comparing::pictures)) refuse("--metric", "belongs to pictures of colour; leave it out");
    if (!is(Comparing::pictures) && !is(Comparing::methods))
        for (const char* flag : {"--exposure", "--ppd"}) refuse(flag, "belongs to pictures of colour; leave it out");
    if (is(Comparing::meshes))
        for (const char* flag : {"--normals", "--out"}) refuse(flag, "belongs to pictures, and these are meshes");
    if (is(Comparing::methods)) refuse("--normals", "belongs to two pictures, and this is a scene");
    if (!is(Comparing::meshes)) refuse("--samples", "belongs to meshes; leave it out");
    if (!is(Comparing::methods))
        for (const char* flag : {"--object", "--methods", "--reference", "--size", "--spp", "--camera", "--repeats",
                                 "--no-causes", "--csv"})
            refuse(flag, "belongs to a scene; leave it out");
    expect_kinds(args, what);
    return what;
}

} // namespace bake
