#include "normal_map_output.h"
#include "normal_map_preview.h"
#include <algorithm>
#include <cmath>

namespace bake {

void set_stored(NormalMapResult& result, std::optional<StoredNormalMap> stored) {
    result.stored = stored;
    if (!stored || !(stored->blocks || stored->undithered)) return;
    ErrorBudget& budget = result.budget; // of a file that stores floats: its total is 1.5 times the root of all squares
    budget.encoding_deg = stored->error.rms_deg;
    budget.total_deg = std::min(180.0, std::hypot(budget.total_deg, 1.5 * budget.encoding_deg));
}

std::string to_text(const NormalMapArgs& args, const HeightTexture& height, const NormalMapResult& result) {
    const NormalMapOptions& options = result.options;
    const NormalMapReport& r = result.report;
    const double share = 100.0 / (double(options.width) * options.height);
    std::string text = format(
        "%s: %d x %d, %s space, green %s, method %s, filter %s (%s)\namplitude %g, midlevel %g",
        printable(args.out).c_str(), options.width, options.height,
        options.space == Space::tangent ? "tangent" : "object", options.directx ? "down (DirectX)" : "up (OpenGL)",
        std::string(name(options.method)).c_str(), std::string(name(result.filter)).c_str(),
        describe_levels(height).c_str(), options.height_options.amplitude, options.height_options.midlevel);
    if (height.step > 0)
        text += format("; one level of the height tilts the normal by %.3f deg along u", result.tilt_deg);
    if (!args.mesh.empty())
        text += format("\ncharts cover %.1f %% and %.1f %% at their borders; %.1f %% padded, %.1f %% left flat",
                       share * double(r.covered), share * double(r.border), share * double(r.padded),
                       share * double(r.empty));
    if (result.stored) text += "\n" + to_text(*result.stored);
    if (!args.preview.empty()) text += "\n" + preview_text(args);
    return text + "\n" + to_text(result.budget) + "\n";
}

nlohmann::json to_json(const NormalMapArgs& args, const HeightTexture& height, const NormalMapResult& result) {
    const NormalMapOptions& options = result.options;
    const NormalMapReport& r = result.report;
    nlohmann::json object = {{"out", args.out},
                             {"width", options.width},
                             {"height", options.height},
                             {"space", options.space == Space::tangent ? "tangent" : "object"},
                             {"green", options.directx ? "down" : "up"},
                             {"method", name(options.method)},
                             {"filter", name(result.filter)},
                             {"amplitude", options.height_options.amplitude},
                             {"midlevel", options.height_options.midlevel},
                             {"levels", height.levels},
                             {"step", height.step},
                             {"step_tilt_deg", result.tilt_deg},
                             {"error_budget", to_json(result.budget)}};
    if (!result.notes.empty()) object["notes"] = result.notes;
    if (result.advice) object["better_filter"] = to_json(*result.advice);
    if (options.method != NormalMethod::exact) object["method_error"] = to_json(result.method_error, options.method);
    if (result.stored) object["stored"] = to_json(*result.stored);
    if (!args.roughness_map.empty()) object["roughness_map"] = args.roughness_map;
    if (!args.preview.empty()) object["preview"] = args.preview;
    if (!args.mesh.empty())
        object["texels"] = {{"covered", r.covered},
                            {"uncovered", r.uncovered},
                            {"border", r.border},
                            {"overlapped", r.overlapped},
                            {"padded", r.padded},
                            {"empty", r.empty},
                            {"degenerate", r.degenerate},
                            {"folded", r.folded},
                            {"outside_faces", r.outside_faces},
                            {"crossing_faces", r.crossing_faces},
                            {"tiles", r.tiles},
                            {"flat_triangles", r.flat_triangles},
                            {"triangles_without_uv", r.triangles_without_uv}};
    return object;
}

void warn(const CommonArgs& common, const NormalMapArgs& args, const NormalMapReport& r) {
    const auto say = [&](std::int64_t count, const char* what) {
        if (count > 0) note(common, format("%s: %lld %s", args.mesh.c_str(), static_cast<long long>(count), what));
    };
    if (!r.tiles.empty())
        note(common, args.mesh + ": its charts lie in " + r.tiles + " of the uvs' tiles and are baked modulo 1");
    say(r.overlapped, "texels lie in more than one face; the lowest face was baked");
    say(r.outside_faces, "faces lie outside the tile and were not baked");
    say(r.crossing_faces, "faces leave the tile; only their part inside was baked");
    say(r.uncovered, "texels are not covered by the mesh of --residual-of; is it this mesh, displaced, with its uvs?");
    say(r.degenerate, "texels have no normal of their own (pole, or chart without area) and are flat");
    say(r.flat_triangles, "triangles have no area in uv and were not baked");
    say(r.triangles_without_uv, "triangles have no uvs and were not baked");
    say(r.folded, "texels turn inside out, because the amplitude exceeds the radius of curvature; blinn was used for "
                  "them instead of exact");
}

} // namespace bake
