// bake compare: two pictures, two normal maps or two meshes.
#include "bake/picture/image_io.h"
#include "bake/verdict/metric/false_colour.h"
#include "compare_options.h"

namespace bake {
namespace {

/// Degrees that have the last colour in a picture of angles.
constexpr float last_angle = 20;

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

int compare_meshes(const CompareArgs& args, const CommonArgs& common) {
    InspectOptions options;
    options.distance = args.distance;
    for (const Limit& limit : args.limits) {
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

} // namespace

int compare_files(const CompareArgs& args, Comparing what, const CommonArgs& common) {
    if (what == Comparing::meshes) return compare_meshes(args, common);
    if (!args.out.empty()) resolve_depth(args.out, Depth::automatic); // its ending is refused before any work
    Stopwatch watch;
    if (what == Comparing::normals)
        return finish(args, common,
                      compare_normals(args.file, args.other, {.space = args.space, .limits = args.limits}), last_angle,
                      watch);
    Progress progress(common.quiet);
    PictureCompareOptions options = args.pictures;
    options.limits = args.limits;
    options.error_picture = !args.out.empty();
    return finish(args, common, compare_pictures(args.file, args.other, options, &progress), 1, watch);
}

} // namespace bake
