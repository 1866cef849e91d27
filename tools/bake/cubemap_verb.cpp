// bake cubemap: environments assembled, converted, filtered and captured.
#include "bake/base/output_file.h"
#include "bake/base/text.h"
#include "bake/environment/file/face_files.h"
#include "bake/environment/filter/mips.h"
#include "bake/environment/sky/test_sky.h"
#include "bake/picture/image_io.h"
#include "bake/preview/capture.h"
#include "bake/preview/scene_io.h"
#include "cubemap_engine.h"
#include "cubemap_options.h"
#include "cubemap_report.h"
#include "options.h"
#include "verb.h"
#include <algorithm>

namespace bake {
namespace {

const SkyFormatEntry& format_of(const EnvironmentTarget& target) {
    return entry_of(target.to == SkyFormat::automatic ? format_of_name(target.file) : target.to);
}

/// Edge of the faces that the user's --size stands for; 0 without it.
int wanted_edge(const EnvironmentTarget& target) {
    return target.size == 0 ? 0 : std::max(1, target.size / format_of(target).width_per_edge);
}

Environment capture_sky(const CubemapArgs& args, const CommonArgs& common, Progress& progress) {
    const Scene scene = load(read_scene(args.capture));
    for (const std::string& line : scene.notes) note(common, line);
    const int edge = wanted_edge(args.target);
    RenderStats stats;
    Environment sky;
    sky.cube = capture(scene, args.position, edge > 0 ? edge : 512, &stats, &progress);
    if (stats.bad_samples > 0)
        note(common, std::to_string(stats.bad_samples) + " samples too bright to hold are black; dim the lights");
    return sky;
}

Environment load_sky(const CubemapArgs& args, const CommonArgs& common, Progress& progress, EnvironmentReport& report) {
    if (!args.capture.empty()) return capture_sky(args, common, progress);
    if (args.inputs.size() != 1 || args.inputs[0] != "labels")
        return read_environment(args.inputs, args.reading, &report);
    Environment sky;
    const int size = args.target.size;
    sky.cube = label_sky(size > 0 && format_of(args.target).is_cube() ? size : std::max(512, size / 2));
    return sky;
}

/// The sky as texel-centred faces, for the filters.
Cube plain_cube(const Environment& sky, int edge, const CubemapArgs& args, Progress& progress) {
    progress.start("convert", 0);
    Cube cube = to_cube(sky, {edge, false}, args.resampling, &progress);
    progress.start("filter", 0);
    return cube;
}

EnvironmentWritten write(CubemapArgs& args, const Environment& sky, Progress& progress,
                         std::optional<ShCoefficients>& sh) {
    const int source = sky.face_edge(), wanted = wanted_edge(args.target);
    std::vector<Cube> levels;
    if (args.wanted_irradiance) {
        if (wanted > 0) args.wanted_irradiance->size = wanted;
        const Cube cube = plain_cube(sky, source, args, progress);
        levels.push_back(irradiance(cube, *args.wanted_irradiance, &progress));
        if (args.wanted_irradiance->method == IrradianceMethod::sh)
            sh = engine_sh(cube, args.wanted_irradiance->bands, ShForm::irradiance);
        if (!args.sh_file.empty()) write_sh_text(args.sh_file, *sh);
    } else if (args.wanted_specular) {
        args.wanted_specular->size = wanted;
        levels = prefilter(plain_cube(sky, source, args, progress), *args.wanted_specular, &progress);
    } else if (args.mips) {
        levels = mip_chain(plain_cube(sky, wanted > 0 ? wanted : source, args, progress));
    } else {
        return write_environment(sky, args.target, args.resampling, &progress);
    }
    progress.start("write", 0);
    return write_levels(std::move(levels), args.target, &progress);
}

/// Refuses names that cannot be written, before the work.
void check_output(const CubemapArgs& args) {
    const EnvironmentTarget& target = args.target;
    std::vector<std::string> files = {target.file};
    if (is_face_pattern(target.file)) {
        const auto six = cube_files(target.file);
        files.assign(six.begin(), six.end());
    }
    for (const std::string& file : files) {
        resolve_depth(file, Depth::automatic);
        OutputFile{file};
    }
    complete_target(target, 512);
    const int edge = wanted_edge(target);
    check_levels(target,
                 args.wanted_specular     ? args.wanted_specular->roughness.size()
                 : args.mips && edge != 1 ? 2
                                          : 1,
                 edge);
}

int run_for_engine(const CubemapArgs& args, const CommonArgs& common, const EngineOutput& output,
                   const Environment& sky, const EnvironmentReport& report, Progress& progress, Stopwatch& watch) {
    nlohmann::json json = {{"from", name(report.format)}, {"notes", reading_notes(report)}};
    const std::string text = write_for_engine(args, output, sky, progress, json);
    progress.finish();
    watch.lap("convert, filter and write");
    for (const std::string& line : reading_notes(report)) note(common, line);
    print_result(common, text + "; ", json, watch);
    return 0;
}

int run_cubemap(CubemapArgs args, const CommonArgs& common) {
    check_cubemap_options(args);
    const EngineOutput engine(args);
    const auto check = [&] { args.engine.consumer ? engine.check() : check_output(args); };
    check();
    Stopwatch watch;
    Progress progress(common.quiet || common.json);
    progress.start("read", 0);
    EnvironmentReport report;
    const Environment sky = load_sky(args, common, progress, report);
    check(); // once more, as it may not replace what was read
    watch.lap("read");
    if (args.engine.consumer) return run_for_engine(args, common, engine, sky, report, progress, watch);
    args.target.source = report.type;
    std::optional<ShCoefficients> sh;
    const EnvironmentWritten written = write(args, sky, progress, sh);
    progress.finish();
    watch.lap("convert and write");

    const std::vector<std::string> notes = cubemap_notes(args, report, written);
    for (const std::string& line : notes) note(common, line);
    nlohmann::json json = cubemap_json(args, report, written, sky.channels());
    json["notes"] = notes;
    if (sh) json["sh"] = sh_json(*sh);
    print_result(common,
                 (sh && sh->bands <= 3 ? sh_lines(*sh) + "\n" : "") +
                     format("%s: %s, %d x %d%s%s; ", printable(args.target.file).c_str(), name(written.target.to),
                            written.width, written.height,
                            written.levels > 1 ? format(", %d levels", written.levels).c_str() : "",
                            seam_text(report).c_str()),
                 json, watch);
    return 0;
}

} // namespace

std::function<int()> cubemap_verb(CLI::App& sub, const CommonArgs& common) {
    const auto args = std::make_shared<CubemapArgs>();
    add_cubemap_options(sub, *args);
    add_examples(
        sub, "  bake cubemap meshes/sky_px.png meshes/sky_nx.png meshes/sky_py.png meshes/sky_ny.png meshes/sky_pz.png "
             "meshes/sky_nz.png -o sky.exr\n"
             "  bake cubemap 'meshes/sky_%s.png' --fix-orientation -o 'fixed_%s.png'\n"
             "  bake cubemap sky.exr --to latlong -o latlong.exr\n"
             "  bake cubemap latlong.exr --size 128 -o 'sky_%s.exr'\n"
             "  bake cubemap 'meshes/sky_%s.png' --to latlong --yaw 90 -o turned.exr\n"
             "  bake cubemap 'meshes/sky_%s.png' --specular ggx --roughness 0,0.1,0.3,0.6,1 --size 32 -o 'ggx_%s.exr'\n"
             "  bake cubemap 'meshes/sky_%s.png' --irradiance direct --size 32 -o 'diffuse_%s.exr'\n"
             "  bake cubemap --capture meshes/scene.toml --at 0,1,0 --size 64 -o probe.exr\n"
             "  bake cubemap labels --size 256 --to hcross -o which_way_is_up.png\n");
    return [args, &common] { return run_cubemap(*args, common); };
}

} // namespace bake
