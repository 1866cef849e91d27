#include "cubemap_engine.h"
#include "bake/base/text.h"
#include "bake/environment/engine/engine_picture.h"
#include "options.h"
#include <algorithm>
#include <filesystem>

namespace bake {
namespace {

/// A name without an ending, with a / at its end, or of a folder that is there.
bool names_folder(const std::string& out) {
    return !out.empty() && (out.back() == '/' || ending(out).empty() || std::filesystem::is_directory(out));
}

nlohmann::json to_json(const EngineFile& file) {
    nlohmann::json json = {{"file", file.path}, {"what", file.what}, {"bytes", file.bytes}};
    if (file.levels == 0) return json;
    json["size"] = file.edge, json["levels"] = file.levels;
    if (file.what == "panorama") return json;
    json["texels"] = file.what == "dfg" ? "half" : name(file.texels);
    if (file.what == "dfg") return json;
    json["rmse"] = file.error.rmse, json["relative_rmse"] = file.error.relative;
    json["flux_error"] = file.error.flux, json["clamped"] = file.error.over;
    return json;
}

std::string line_of(const EngineFile& file) {
    std::string line = printable(file.path) + ": " + file.what;
    if (file.what == "panorama") return line + format(", %d x %d", file.edge, file.edge / 2);
    if (file.levels == 0) return line;
    line += format(", %d x %d", file.edge, file.edge);
    if (file.levels > 1) line += format(", %d levels", file.levels);
    line += format(", %s, %.2f MB", file.what == "dfg" ? "half" : name(file.texels), double(file.bytes) / 1e6);
    if (file.what == "dfg") return line;
    line += format(", read back: error %.2g of the values, %.2g of the mean, flux %.1g", file.error.relative,
                   file.error.rmse, file.error.flux);
    if (file.error.over > 0)
        line +=
            format("; %lld values above the format's largest were clamped", static_cast<long long>(file.error.over));
    return line;
}

} // namespace

void add_engine_options(CLI::App& sub, CubemapArgs& args) {
    std::vector<std::pair<std::string, std::optional<Consumer>>> names;
    for (const ConsumerEntry& entry : consumers) names.emplace_back(entry.name, entry.consumer);
    add_choice<std::optional<Consumer>>(
        sub, "--for", args.engine.consumer, names,
        "Write what this engine loads, filtered by its own rule, to a file or a folder");
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
    if (!args.irradiance.empty() || args.specular != Specular::none || args.mips)
        usage(flag + ": decides what is filtered; leave out --irradiance, --specular and --mips");
    if (args.target.to != SkyFormat::automatic || args.target.order != FaceOrder::gl ||
        args.target.depth != Depth::automatic)
        usage(flag + ": decides the format; leave out --to, --order and --depth");
    const bool folder = names_folder(args.target.file);
    if (engine.levels_as_files && (!folder || !entry.prefiltered))
        usage("--levels-as-files: needs a folder and an engine that loads levels; give such as --for three -o sky/");
    if (engine.texels && !entry.prefiltered)
        usage("--texels: " + std::string(entry.name) + " takes a picture; leave it out");
    if (!args.sh_file.empty() && !entry.prefiltered)
        usage("--sh: " + std::string(entry.name) + " takes a picture alone");
}

EngineOutput::EngineOutput(const CubemapArgs& args)
    : args_(args), folder_(args.engine.consumer && names_folder(args.target.file) ? args.target.file : "") {}

std::string EngineOutput::ending() const {
    const ConsumerEntry& entry = entry_of(*args_.engine.consumer);
    return is_folder() ? entry.ending : bake::ending(args_.target.file);
}

std::string EngineOutput::path(const std::string& name) const {
    return is_folder() ? folder_.file(name) : args_.target.file;
}

void EngineOutput::check() const {
    const std::string file = path("environment" + ending());
    check_engine_file(file, args_.engine.options(args_.target.size, is_folder()));
    OutputFile{file};
    if (!args_.sh_file.empty()) OutputFile{args_.sh_file};
    if (entry_of(*args_.engine.consumer).prefiltered && args_.target.size > 0)
        roughness_ladder(*args_.engine.consumer, args_.target.size);
}

std::string write_for_engine(const CubemapArgs& args, const EngineOutput& output, const Environment& sky,
                             Progress& progress, nlohmann::json& json) {
    const EngineOptions options = args.engine.options(args.target.size, output.is_folder());
    json["for"] = entry_of(options.consumer).name;
    std::vector<EngineFile> files;
    std::string text;
    if (!entry_of(options.consumer).prefiltered) {
        progress.start("convert and write", 0);
        files.push_back(write_engine_picture(sky, options.size, output.path("panorama" + output.ending()),
                                             args.resampling, &progress));
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
        json["files"].push_back(to_json(file));
        if (!lines.empty()) lines += '\n';
        lines += line_of(file);
    }
    return text + lines;
}

nlohmann::json sh_json(const ShCoefficients& series) {
    nlohmann::json json = nlohmann::json::array();
    for (std::size_t i = 0; i < series.values.size(); i += std::size_t(series.channels))
        json.push_back(std::vector<double>(series.values.begin() + std::ptrdiff_t(i),
                                           series.values.begin() + std::ptrdiff_t(i) + series.channels));
    return json;
}

std::string sh_lines(const ShCoefficients& series) {
    std::string lines;
    for (int l = 0; l < series.bands; ++l)
        for (int m = -l; m <= l; ++m) {
            if (!lines.empty()) lines += '\n';
            lines += format("sh %d %2d:", l, m);
            for (int c = 0; c < series.channels; ++c)
                lines += format(" %.6g", series.values[std::size_t((l * l + l + m) * series.channels + c)]);
        }
    return lines;
}

} // namespace bake
