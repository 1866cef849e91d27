// bake compare SCENE: the methods that show a relief.
#include "bake/base/block_writer.h"
#include "bake/base/job.h"
#include "bake/picture/image_io.h"
#include "bake/preview/scene_io.h"
#include "bake/verdict/compare/comparison_pictures.h"
#include "bake/verdict/report/report_page.h"
#include "compare_options.h"
#include "inputs/output_folder.h"
#include "render_progress.h"
#include <sstream>

namespace bake {
namespace {

ShadeMethod parse_method(const std::string& flag, const std::string& word) {
    if (const auto method = parse_shade(word)) return *method;
    throw Error(Refusal::usage, flag + " " + word + ": is not a method; these are " + shade_names);
}

std::vector<ShadeMethod> parse_methods(const std::string& list) {
    std::vector<ShadeMethod> methods;
    std::istringstream words(list);
    for (std::string word; std::getline(words, word, ',');) methods.push_back(parse_method("--methods", word));
    return methods;
}

std::optional<ShadeMethod> parse_reference(const std::string& word) {
    if (word == "auto") return {};
    const ShadeMethod method = parse_method("--reference", word);
    if (!displaces(method.shade))
        throw Error(Refusal::usage,
                    "--reference " + word + ": shows no true relief; write auto, displace:N or displace:max");
    return method;
}

SceneEntries read_entries(const CompareArgs& args) {
    SceneEntries entries = read_scene(args.file);
    const MethodCompareArgs& own = args.methods;
    if (!own.camera.empty()) entries.camera = find_camera(entries.cameras, own.camera, args.file);
    if (own.size) std::tie(entries.settings.width, entries.settings.height) = *own.size;
    entries.settings.spp = own.spp;
    if (args.pictures.exposure) entries.settings.exposure = float(*args.pictures.exposure);
    return entries;
}

/// A command line that compares the same scene in the same way, for one method alone if it is given.
std::string command_of(const CompareArgs& args, const std::string& method) {
    const MethodCompareArgs& own = args.methods;
    std::string text = "bake compare " + args.file;
    if (!own.object.empty()) text += " --object " + own.object;
    if (!own.camera.empty()) text += " --camera " + own.camera;
    if (own.size) text += format(" --size %dx%d", own.size->first, own.size->second);
    text += format(" --spp %d", own.spp);
    if (args.pictures.exposure) text += format(" --exposure %g", *args.pictures.exposure);
    if (own.reference != "auto") text += " --reference " + own.reference;
    const std::string& methods = method.empty() ? own.methods : method;
    return methods.empty() ? text : text + " --methods " + methods;
}

void write_text(const std::string& path, const std::string& text) {
    BlockWriter out(path);
    out.write(text);
    out.commit();
}

void write_picture(const std::string& path, const Image<float>& picture) {
    write_image(path, picture, {.depth = Depth::u8, .colour = ColourSpace::srgb});
}

void write_outputs(const SceneComparison& comparison, const OutputFolder& folder, const std::string& json) {
    for (const NamedPicture& picture : method_pictures(comparison))
        write_picture(folder.file(picture.name), picture.picture);
    write_picture(folder.file("contact.png"), comparison_sheet(comparison));
    write_text(folder.file("chart.svg"), time_chart(comparison));
    write_text(folder.file("chart_bytes.svg"), bytes_chart(comparison));
    write_text(folder.file("compare.csv"), to_csv(comparison));
    write_text(folder.file("compare.json"), json + "\n");
}

std::vector<ReportPicture> report_pictures(const SceneComparison& comparison) {
    std::vector<ReportPicture> pictures;
    pictures.push_back({comparison.reference.method, mean_picture(comparison.reference.picture.halves), {}});
    for (const MethodRow& row : comparison.rows)
        pictures.push_back({row.method, mean_picture(row.picture.halves), copied(row.errors.flip)});
    return pictures;
}

} // namespace

int compare_methods(const CompareArgs& args, const CommonArgs& common) {
    if (args.methods.csv && common.json)
        throw Error(Refusal::usage, "--csv: and --json are two forms; give one of them");
    SceneCompareOptions options{.methods = parse_methods(args.methods.methods),
                                .reference = parse_reference(args.methods.reference),
                                .repeats = args.methods.repeats,
                                .causes = !args.methods.no_causes,
                                .flip = args.pictures.flip,
                                .limits = args.limits,
                                .told = {}};
    if (!args.methods.report.empty()) {
        require_report_page();
        OutputFile(args.methods.report); // a file that cannot be written is refused before the work
    }
    Stopwatch watch;
    const SceneEntries entries = read_entries(args);
    const OutputFolder folder(args.out);
    if (is_visible(common) && draws_on_terminal()) options.told = [&](const std::string& line) { note(common, line); };
    Progress progress(common.quiet);
    const SceneComparison comparison = compare_scene(entries, args.methods.object, options, &progress);
    watch.lap("compare");
    const std::string json =
        with_flags(to_json(comparison, args.file, [&](const std::string& method) { return command_of(args, method); }));
    if (folder) write_outputs(comparison, folder, json);
    if (!args.methods.report.empty()) write_text(args.methods.report, report_page(json, report_pictures(comparison)));
    if (folder || !args.methods.report.empty()) watch.lap("write");
    const std::string text = args.methods.csv ? to_csv(comparison) : to_text(comparison);
    if (args.methods.csv) {
        common.outputs->commit();
        if (!common.quiet) print_text(text);
    } else {
        print_result(common, with_flags(text), nlohmann::json::parse(json), watch);
    }
    if (comparison.interrupted)
        return fail(args.file + ": interrupted; compared are the methods that were rendered", Refusal::interrupted);
    return comparison.over_limit ? int(Refusal::over_limit) : 0;
}

} // namespace bake
