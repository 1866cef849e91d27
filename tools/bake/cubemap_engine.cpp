#include "cubemap_engine.h"
#include "bake/base/text.h"
#include "bake/environment/engine/engine_picture.h"
#include "bake/environment/engine/roughness_ladder.h"
#include "cubemap_report.h"
#include "options.h"
#include <algorithm>
#include <filesystem>

namespace bake {
namespace {

/// A name without an ending, with a / at its end, or of a folder that is there.
bool names_folder(const std::string& out) {
    return !out.empty() && (out.back() == '/' || ending(out).empty() || std::filesystem::is_directory(out));
}

} // namespace

void add_engine_options(CLI::App& sub, CubemapArgs& args) {
    std::vector<std::pair<std::string, std::optional<Consumer>>> names;
    for (const ConsumerEntry& entry : consumers) names.emplace_back(entry.name, entry.consumer);
    add_choice<std::optional<Consumer>>(
        sub, "--for", args.engine.consumer, names,
        "Write what this program loads, to a file or a folder: levels filtered by its own rule, or a lat-long (.hdr, "
        ".exr) turned so that the sky stands as in bake");
    add_choice<std::optional<TexelFormat>>(
        sub, "--texels", args.engine.texels,
        {{"rgb9e5", TexelFormat::rgb9e5}, {"half", TexelFormat::rgba16f}, {"bc6h", TexelFormat::bc6h}},
        "How --for stores radiance, instead of the engine's usual form");
    sub.add_flag("--levels-as-files", args.engine.levels_as_files, "With --for and a folder: a cube map per level");
    sub.add_option("--sh", args.sh_file,
                   "Text to write: the coefficients of --irradiance sh:N, or those for the engine");
}

void check_engine_options(const CubemapArgs& args) {
    const auto usage = [](const std::string& message) { throw Error(Refusal::usage, message); };
    const EngineArgs& engine = args.engine;
    if (!engine.consumer) {
        if (engine.texels) usage("--texels: is for --for; add an engine");
        if (engine.levels_as_files) usage("--levels-as-files: is for --for; add an engine");
        if (!args.sh_file.empty() && !args.irradiance.starts_with("sh:"))
            usage("--sh: is for --irradiance sh:N and --for; add one of them");
        return;
    }
    const ConsumerEntry& entry = entry_of(*engine.consumer);
    const std::string flag = std::string("--for ") + entry.name;
    const bool folder = names_folder(args.target.file);
    const bool levels = entry.levels && (folder || !is_latlong_file(args.target.file));
    if (!args.irradiance.empty() || args.specular != Specular::none || args.mips)
        usage(flag + ": decides what is filtered; leave out --irradiance, --specular and --mips");
    if (args.target.to != SkyFormat::automatic || args.target.order != FaceOrder::gl ||
        args.target.depth != Depth::automatic)
        usage(flag + ": decides the format; leave out --to, --order and --depth");
    if (engine.levels_as_files && (!folder || !levels))
        usage("--levels-as-files: needs a folder and an engine that loads levels; give such as --for three -o sky/");
    if (engine.texels && !levels) usage("--texels: " + flag + " gets a lat-long picture; leave it out");
    if (!args.sh_file.empty() && !levels) usage("--sh: " + flag + " gets a lat-long picture alone; leave it out");
}

EngineOutput::EngineOutput(const CubemapArgs& args)
    : args_(args), folder_(args.engine.consumer && names_folder(args.target.file) ? args.target.file : "") {}

std::string EngineOutput::ending() const {
    const ConsumerEntry& entry = entry_of(*args_.engine.consumer);
    if (!is_folder()) return bake::ending(args_.target.file);
    return entry.levels ? entry.levels->ending : entry.latlong->ending;
}

std::string EngineOutput::path(const std::string& name) const {
    return is_folder() ? folder_.file(name) : args_.target.file;
}

void EngineOutput::check() const {
    const std::string file = path("environment" + ending());
    check_engine_file(file, args_.engine.options(args_.target.size, is_folder()));
    OutputFile{file};
    if (!args_.sh_file.empty()) OutputFile{args_.sh_file};
    if (!is_latlong_file(file) && args_.target.size > 0) roughness_ladder(*args_.engine.consumer, args_.target.size);
}

namespace {

/// Filters and writes. Returns what is printed.
std::string write_for_engine(const CubemapArgs& args, const EngineOutput& output, const Environment& sky,
                             Progress& progress, nlohmann::json& json) {
    const EngineOptions options = args.engine.options(args.target.size, output.is_folder());
    json["for"] = entry_of(options.consumer).name;
    std::vector<EngineFile> files;
    std::string text;
    if (const std::string picture = output.path("panorama" + output.ending()); is_latlong_file(picture)) {
        progress.start("convert and write", 0);
        files.push_back(write_engine_picture(sky, options, picture, args.resampling, &progress));
        json["yaw_deg"] = 90 * entry_of(options.consumer).latlong->quarter_turns;
    } else {
        progress.start("convert", 0);
        const int edge = std::max(sky.face_edge(), engine_edge(options, sky.face_edge()));
        Cube cube = to_cube(sky, {edge, false}, args.resampling, &progress);
        progress.start("filter", 0);
        const EngineLevels made = engine_levels(std::move(cube), options, &progress);
        progress.start("write", 0);
        files =
            write_engine_files(made, options, output.ending(), [&](const std::string& n) { return output.path(n); });
        if (!args.sh_file.empty()) write_sh_text(args.sh_file, made.sh);
        json["roughness"] = made.roughness, json["sh"] = sh_json(made.sh);
        text = sh_lines(made.sh) + "\n";
    }
    std::string lines;
    for (const EngineFile& file : files) {
        json["files"].push_back(file_json(file));
        if (!lines.empty()) lines += '\n';
        lines += file_line(file);
        if (file.what == "panorama") lines += latlong_text(entry_of(options.consumer));
    }
    return text + lines;
}

} // namespace

int run_for_engine(const CubemapArgs& args, const CommonArgs& common, const EngineOutput& output, const ReadSky& read,
                   Progress& progress, Stopwatch& watch) {
    const std::vector<std::string> notes = input_notes(args, read.report);
    nlohmann::json json = {{"from", name(read.report.format)}, {"notes", notes}};
    add_orientation(read.report, json);
    const std::string text = write_for_engine(args, output, read.sky, progress, json);
    progress.finish();
    watch.lap("convert, filter and write");
    for (const std::string& line : notes) note(common, line);
    print_result(common, text + "; ", json, watch);
    return 0;
}

} // namespace bake
