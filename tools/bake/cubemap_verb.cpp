// bake cubemap: environments assembled, converted, filtered and captured.
#include "bake/base/output_file.h"
#include "bake/base/text.h"
#include "bake/base/vec.h"
#include "bake/environment/filter/irradiance.h"
#include "bake/environment/filter/mips.h"
#include "bake/environment/filter/prefilter.h"
#include "bake/environment/sky/test_sky.h"
#include "bake/preview/capture.h"
#include "bake/preview/scene_io.h"
#include "cubemap_output.h"
#include "options.h"
#include "verb.h"
#include <algorithm>
#include <cmath>
#include <cstdio>

namespace bake {
namespace {

enum class Specular { none, ggx, phong };

struct CubemapArgs {
    std::vector<std::string> inputs;
    std::string out, irradiance, roughness, at, capture, depth = "auto";
    SkyFormat from = SkyFormat::automatic, to = SkyFormat::automatic;
    FaceOrder order = FaceOrder::gl;
    Samples samples = Samples::automatic;
    Specular specular = Specular::none;
    BadPolicy bad = BadPolicy::refuse;
    int size = 0;
    double yaw = 0, pitch = 0, roll = 0;
    bool mips = false, fix_orientation = false, linear = false;
};

Error usage(const std::string& message) { return Error(Refusal::usage, message); }

std::vector<double> numbers(const std::string& flag, const std::string& text) {
    std::vector<double> values;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        const std::string part = text.substr(begin, end - begin);
        char* rest = nullptr;
        const double value = std::strtod(part.c_str(), &rest);
        if (part.empty() || *rest || !std::isfinite(value))
            throw usage(flag + " " + text + ": is not a list of numbers; write such as 0.1,0.5,1");
        values.push_back(value);
        begin = end + 1;
    }
    return values;
}

/// "sh:3", "sh:9" or "direct"
IrradianceOptions parse_irradiance(const std::string& text) {
    IrradianceOptions options;
    if (text == "direct") return options;
    int end = 0;
    options.method = IrradianceMethod::sh;
    if (std::sscanf(text.c_str(), "sh:%2d%n", &options.bands, &end) != 1 || std::size_t(end) != text.size() ||
        options.bands < 1)
        throw usage("--irradiance " + text + ": is neither direct nor sh:N with N bands; write such as sh:3");
    return options;
}

void check(const CubemapArgs& args) {
    const int filters = int(!args.irradiance.empty()) + int(args.specular != Specular::none);
    if (filters > 1) throw usage("--irradiance: and --specular are two bakes; run one after the other");
    if (args.specular != Specular::none && args.roughness.empty())
        throw usage("--specular: needs --roughness, one for each level, such as 0,0.1,0.3,0.6,1");
    if (args.specular == Specular::none && !args.roughness.empty())
        throw usage("--roughness: is for --specular ggx or phong; add it");
    if (filters && args.mips)
        throw usage("--mips: gives the plain chain; --specular writes its own levels, --irradiance has one");
    if (!args.capture.empty() && !args.inputs.empty())
        throw usage(args.inputs[0] + ": is an input, but --capture makes the sky from a scene; give one of the two");
    if (args.capture.empty() && args.inputs.empty())
        throw usage("no input: give six faces, a pattern with %s, one image, labels, or --capture scene.toml");
    if (args.capture.empty() != args.at.empty())
        throw usage(args.at.empty() ? "--capture: needs --at x,y,z, the point to look from"
                                    : "--at: is for --capture; add a scene");
    const bool six = args.out.find("%s") != std::string::npos;
    if (args.to == SkyFormat::faces && !six)
        throw usage("--out " + args.out + ": names one file for six faces; put %s where px nx py ny pz nz is to stand");
    if (args.to != SkyFormat::faces && args.to != SkyFormat::automatic && six)
        throw usage("--out " + args.out + ": stands for six files, but --to " + name(args.to) +
                    " is one; leave out the %s");
    if (args.order == FaceOrder::openexr && args.to != SkyFormat::automatic && args.to != SkyFormat::faces &&
        args.to != SkyFormat::strip && args.to != SkyFormat::openexr_cube)
        throw usage(std::string("--order openexr: is for six faces and strips, not for ") + name(args.to));
    for (const std::string& input : args.inputs) check_not_input(args.out, input);
}

/// The environment and what was found on the way to it.
struct Loaded {
    Environment sky;
    EnvironmentReport report;
    std::string source;
};

Vec3f parse_point(const std::string& text) {
    const std::vector<double> values = numbers("--at", text);
    if (values.size() != 3) throw usage("--at " + text + ": is not a point; give three numbers, such as 0,1,0");
    return {float(values[0]), float(values[1]), float(values[2])};
}

Loaded load_sky(const CubemapArgs& args, const CommonArgs& common, Progress& progress) {
    Loaded loaded;
    if (!args.capture.empty()) {
        const Vec3f at = parse_point(args.at);
        const Scene scene = load(read_scene(args.capture));
        const bool cube = args.to == SkyFormat::automatic || is_cube_format(args.to);
        RenderStats stats;
        loaded.sky.cube = capture(scene, at, args.size > 0 ? (cube ? args.size : std::max(1, args.size / 4)) : 512,
                                  &stats, &progress);
        loaded.source = args.capture;
        if (stats.bad_samples > 0)
            note(common, std::to_string(stats.bad_samples) + " samples too bright to hold are black; dim the lights");
        return loaded;
    }
    loaded.source = args.inputs[0];
    if (args.inputs.size() == 1 && args.inputs[0] == "labels") {
        const bool cube = args.to == SkyFormat::automatic || is_cube_format(args.to);
        loaded.sky.cube = label_sky(args.size > 0 && cube ? args.size : std::max(512, args.size / 2));
        return loaded;
    }
    ReadEnvironmentOptions options;
    options.from = args.from;
    options.fix_orientation = args.fix_orientation;
    options.radiance = {.space = args.linear ? ColourSpace::linear : ColourSpace::automatic, .bad = args.bad};
    loaded.sky = read_environment(args.inputs, options, &loaded.report);
    return loaded;
}

CubemapTarget target_for(const CubemapArgs& args, const Loaded& loaded) {
    CubemapTarget target;
    target.out = args.out;
    target.to = args.to;
    if (target.to == SkyFormat::automatic)
        target.to = args.out.find("%s") != std::string::npos         ? SkyFormat::faces
                    : picture_format(args.out) == PictureFormat::exr ? SkyFormat::openexr_cube
                                                                     : SkyFormat::strip;
    target.order = args.order;
    target.size = args.size;
    if (target.size == 0) {
        const Environment& sky = loaded.sky;
        const int face =
            sky.is_cube() ? sky.cube.size() : std::max(1, int(std::lround(sky.density() * std::sqrt(4 * pi / 6))));
        const int edge = sky.is_cube() ? face
                         : sky.projection == Projection::latlong || sky.projection == Projection::latlong_edges
                             ? std::max(1, sky.picture.width() / 4)
                             : face;
        target.size = is_cube_format(target.to) ? edge : target.to == SkyFormat::octahedral ? 2 * edge : 4 * edge;
    }
    if (target.to == SkyFormat::openexr_cube && target.size < 2)
        throw usage("--size 1: an OpenEXR cube has samples on all four edges of a face; give 2 or more");
    if (target.to == SkyFormat::openexr_latlong && target.size < 4)
        throw usage("--size " + std::to_string(target.size) +
                    ": an OpenEXR lat-long has a row on each pole; give 4 or more");
    if (!is_cube_format(target.to) && target.to != SkyFormat::octahedral && target.size % 2)
        throw usage("--size " + std::to_string(target.size) +
                    ": a lat-long is twice as wide as high; give an even width");
    target.depth = cubemap_depth(args.out, args.depth, loaded.report.type);
    target.bad = args.bad;
    target.encode_srgb = !args.linear;
    return target;
}

/// The sky as texel-centred faces, which the filters work on.
Cube plain_cube(const Environment& sky, int size, const ResampleOptions& options, Progress& progress) {
    progress.start("convert", 0);
    return to_cube(sky, {size, false}, options, &progress);
}

CubemapWritten write_filtered(const CubemapArgs& args, const Loaded& loaded, CubemapTarget target,
                              const ResampleOptions& options, Progress& progress) {
    const Environment& sky = loaded.sky;
    const int given = args.size == 0 ? 0 : is_cube_format(target.to) ? args.size : std::max(1, args.size / 4);
    const int native = is_cube_format(target.to) ? target.size : std::max(1, target.size / 4);
    std::vector<Cube> levels;
    if (!args.irradiance.empty()) {
        IrradianceOptions wanted = parse_irradiance(args.irradiance);
        if (given > 0) wanted.size = given;
        // The source keeps its own size: the result's is another matter.
        const int source = sky.is_cube() ? sky.cube.size() : std::max(1, sky.picture.width() / 4);
        levels.push_back(irradiance(plain_cube(sky, source, options, progress), wanted));
        if (args.size == 0)
            target.size = is_cube_format(target.to)            ? wanted.size
                          : target.to == SkyFormat::octahedral ? 2 * wanted.size
                                                               : 4 * wanted.size;
    } else if (args.specular != Specular::none) {
        PrefilterOptions wanted;
        wanted.lobe = args.specular == Specular::ggx ? SpecularLobe::ggx : SpecularLobe::phong;
        wanted.roughness = numbers("--roughness", args.roughness);
        wanted.size = native;
        const int source = sky.is_cube() ? sky.cube.size() : std::max(1, sky.picture.width() / 4);
        levels = prefilter(plain_cube(sky, source, options, progress), wanted);
    } else {
        levels = mip_chain(plain_cube(sky, native, options, progress));
    }
    return write_levels(levels, target, &progress);
}

/// What the reading found that the user should know.
std::vector<std::string> findings(const CubemapArgs& args, const Loaded& loaded) {
    std::vector<std::string> lines;
    const EnvironmentReport& report = loaded.report;
    if (report.format == SkyFormat::faces && report.naming.empty())
        lines.push_back("the names tell no faces; taken in the order px nx py ny pz nz");
    if (report.mended.texels > 0)
        lines.push_back(format("%lld texels mended: ", static_cast<long long>(report.mended.texels)) +
                        to_text(report.mended));
    if (!report.checked || report.orientation.unknown) return lines;
    const OrientationCheck& check = report.orientation;
    if (!check.wrong) {
        if (args.fix_orientation) lines.push_back("the faces stand right as given; nothing to fix");
        else if (check.given > 1.5)
            lines.push_back(format(
                "seams are visible (%.2f times the steps inside the faces), and no turn or swap of faces closes them",
                check.given));
        return lines;
    }
    const std::string how = to_text(check.closes, report.files);
    if (report.fixed) lines.push_back(format("seams closed (%.2f to %.2f): ", check.given, check.best) + how);
    else
        lines.push_back(format("seams are open (%.2f times the steps inside the faces); they close (%.2f) with ",
                               check.given, check.best) +
                        how + "; --fix-orientation does so");
    return lines;
}

nlohmann::json to_json(const BadTexels& bad) {
    nlohmann::json json = {{"texels", bad.texels},
                           {"nan", bad.nan},
                           {"infinite", bad.infinite},
                           {"negative", bad.negative},
                           {"over", bad.over}};
    if (bad.x >= 0) json["first"] = {bad.x, bad.y};
    return json;
}

nlohmann::json to_json(const Loaded& loaded, const CubemapTarget& target, const CubemapWritten& written,
                       Samples samples) {
    const EnvironmentReport& report = loaded.report;
    constexpr const char* sample_names[] = {"auto", "1", "4x4", "exact"};
    nlohmann::json json = {{"out", written.files},
                           {"from", name(report.format)},
                           {"to", name(target.to)},
                           {"width", written.width},
                           {"height", written.height},
                           {"levels", written.levels},
                           {"channels", loaded.sky.channels()},
                           {"samples", sample_names[int(samples)]},
                           {"mended", to_json(report.mended)},
                           {"over_half", to_json(written.over)},
                           {"clipped", written.clipped}};
    if (!report.checked) return json;
    nlohmann::json faces = nlohmann::json::object();
    for (int k = 0; k < 6; ++k) {
        const Orientation& closes = report.orientation.closes;
        faces[cube_face_names[k]] = {{"file", report.files[closes.source[k]]}, {"turned_deg", 90 * closes.turns[k]}};
    }
    json["naming"] = report.naming;
    json["orientation"] = {{"seam_ratio", report.orientation.given}, {"best_seam_ratio", report.orientation.best},
                           {"wrong", report.orientation.wrong},      {"fixed", report.fixed},
                           {"unknown", report.orientation.unknown},  {"closes_with", faces}};
    return json;
}

int run_cubemap(const CubemapArgs& args, const CommonArgs& common) {
    check(args);
    Stopwatch watch;
    Progress progress(common.quiet || common.json);
    // A name that cannot be written is refused before the work.
    for (const std::string& file : args.out.find("%s") != std::string::npos ? [&] { const auto all = cube_files(args.out); return std::vector<std::string>(all.begin(), all.end()); }()
                                                                              : std::vector<std::string>{args.out})
        resolve_depth(file, Depth::automatic), OutputFile(file);
    Loaded loaded = load_sky(args, common, progress);
    watch.lap("read");
    const CubemapTarget target = target_for(args, loaded);
    ResampleOptions options;
    options.samples = args.samples;
    options.turn = turn_of(args.yaw, args.pitch, args.roll);
    const bool filtered = args.mips || args.specular != Specular::none || !args.irradiance.empty();
    const CubemapWritten written = filtered ? write_filtered(args, loaded, target, options, progress)
                                            : write_converted(loaded.sky, target, options, &progress);
    progress.finish();
    watch.lap("convert and write");

    std::vector<std::string> notes = findings(args, loaded);
    if (written.over.over > 0)
        notes.push_back(std::to_string(written.over.over) +
                        " texels above 65504, the largest of half floats, were mended");
    if (written.clipped > 0)
        notes.push_back(std::to_string(written.clipped) +
                        " values above 1 were clipped; write .exr or .tif to keep them");
    for (const std::string& line : notes) note(common, line);
    if (common.json) {
        nlohmann::json json = to_json(loaded, target, written, args.samples);
        json["notes"] = notes;
        json["seconds"] = watch.to_json();
        std::printf("%s\n", json.dump(2).c_str());
    } else {
        const std::string seams =
            loaded.report.checked && !loaded.report.orientation.unknown
                ? format(", seam ratio %.2f",
                         loaded.report.fixed ? loaded.report.orientation.best : loaded.report.orientation.given)
                : "";
        std::printf("%s: %s, %d x %d%s%s; %s\n", args.out.c_str(), name(target.to), written.width, written.height,
                    written.levels > 1 ? format(", %d levels", written.levels).c_str() : "", seams.c_str(),
                    watch.to_text().c_str());
    }
    return 0;
}

} // namespace

std::function<int()> cubemap_verb(CLI::App& sub, const CommonArgs& common) {
    const auto args = std::make_shared<CubemapArgs>();
    using F = SkyFormat;
    sub.add_option("input", args->inputs,
                   "Six faces in any order, a pattern with %s, one image, or labels: the built-in test sky")
        ->check(not_empty());
    sub.add_option("-o,--out", args->out, "File to write (.exr, .tif, .png); with %s: six, named px nx py ny pz nz")
        ->required()
        ->check(not_empty());
    add_choice<F>(sub, "--from", args->from,
                  {{"auto", F::automatic},
                   {"faces", F::faces},
                   {"latlong", F::latlong},
                   {"hcross", F::hcross},
                   {"vcross", F::vcross},
                   {"strip", F::strip},
                   {"ball", F::ball},
                   {"probe", F::probe},
                   {"octahedral", F::octahedral},
                   {"openexr-cube", F::openexr_cube},
                   {"openexr-latlong", F::openexr_latlong}},
                  "What the input is; auto: by its tag or its shape");
    add_choice<F>(sub, "--to", args->to,
                  {{"auto", F::automatic},
                   {"faces", F::faces},
                   {"latlong", F::latlong},
                   {"hcross", F::hcross},
                   {"vcross", F::vcross},
                   {"strip", F::strip},
                   {"octahedral", F::octahedral},
                   {"openexr-cube", F::openexr_cube},
                   {"openexr-latlong", F::openexr_latlong}},
                  "What to write; auto: faces for a %s, openexr-cube for .exr, else a strip");
    sub.add_option("--size", args->size,
                   "Texels: the edge of a face, the width of a lat-long or octahedral map; 0: as fine as the input")
        ->check(CLI::Range(0, 32768))
        ->capture_default_str();
    add_choice<Samples>(
        sub, "--samples", args->samples,
        {{"auto", Samples::automatic}, {"1", Samples::one}, {"4x4", Samples::grid4}, {"exact", Samples::exact}},
        "Looks at the input per texel; exact: by overlap of solid angles, no light is lost");
    sub.add_flag("--mips", args->mips, "Write a chain of levels, weighted by solid angle, filtered across edges");
    sub.add_option("--irradiance", args->irradiance,
                   "Irradiance instead: sh:N, spherical harmonics of N bands, or direct")
        ->type_name("sh:N|direct");
    add_choice<Specular>(sub, "--specular", args->specular,
                         {{"none", Specular::none}, {"phong", Specular::phong}, {"ggx", Specular::ggx}},
                         "Levels blurred by a specular lobe instead");
    sub.add_option("--roughness", args->roughness, "Of each level: alpha for ggx, exponent for phong; a,b,...");
    add_choice<FaceOrder>(
        sub, "--order", args->order, {{"gl", FaceOrder::gl}, {"openexr", FaceOrder::openexr}},
        "Order and turn of faces and strips written; gl is also Direct3D's, Vulkan's and RenderMan's");
    sub.add_option("--yaw", args->yaw, "Turn the sky, degrees: what is ahead moves to the right")
        ->capture_default_str();
    sub.add_option("--pitch", args->pitch, "Then what is ahead moves up")->capture_default_str();
    sub.add_option("--roll", args->roll, "Then the picture ahead turns clockwise")->capture_default_str();
    sub.add_flag("--fix-orientation", args->fix_orientation, "Turn and swap faces so that their seams close");
    add_choice<BadPolicy>(sub, "--bad", args->bad,
                          {{"refuse", BadPolicy::refuse}, {"zero", BadPolicy::zero}, {"clamp", BadPolicy::clamp}},
                          "NaN, infinite and negative texels, and those that half floats cannot hold");
    sub.add_flag("--linear", args->linear, "8-bit input is linear, not sRGB; 8- and 16-bit output then is too");
    sub.add_option("--capture", args->capture, "Scene (TOML) to look at instead of an input, with --at");
    sub.add_option("--at", args->at, "Point to look from, in world space: X,Y,Z");
    sub.add_option("--depth", args->depth, "auto: half for .exr, float for .tif, 8 for .png from 8-bit input, else 16")
        ->check(one_of({"auto", "8", "16", "half", "float"}))
        ->capture_default_str();
    add_examples(sub, "  bake cubemap sky_px.png sky_nx.png sky_py.png sky_ny.png sky_pz.png sky_nz.png -o sky.exr\n"
                      "  bake cubemap 'sky_%s.jpg' --fix-orientation -o 'fixed_%s.png'\n"
                      "  bake cubemap studio.hdr --size 512 -o 'studio_%s.exr'\n"
                      "  bake cubemap 'sky_%s.exr' --to latlong --yaw 90 -o sky_latlong.exr\n"
                      "  bake cubemap studio.hdr --specular ggx --roughness 0,0.1,0.3,0.6,1 -o 'studio_ggx_%s.exr'\n"
                      "  bake cubemap studio.hdr --irradiance direct --size 32 -o 'studio_diffuse_%s.exr'\n"
                      "  bake cubemap --capture scene.toml --at 0,1,0 -o probe.exr\n"
                      "  bake cubemap labels --size 256 --to hcross -o which_way_is_up.png\n");
    return [args, &common] { return run_cubemap(*args, common); };
}

} // namespace bake
