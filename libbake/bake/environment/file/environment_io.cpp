#include "bake/environment/file/environment_io.h"
#include "bake/base/error.h"
#include "bake/base/text.h"
#include <algorithm>
#include <cmath>

namespace bake {
namespace {

Error unsuitable(const std::string& file, const std::string& why) {
    return Error(Refusal::unsuitable, file + ": " + why);
}

std::string size_of(const Image<float>& image) {
    return std::to_string(image.width()) + "x" + std::to_string(image.height());
}

SkyFormat format_of(const std::string& file, const Image<float>& image, const ImageInfo& info) {
    if (info.environment == EnvironmentTag::cube) return SkyFormat::openexr_cube;
    if (info.environment == EnvironmentTag::latlong) return SkyFormat::openexr_latlong;
    if (image.width() == 2 * std::int64_t(image.height())) return SkyFormat::latlong;
    if (const auto layout = layout_of_size(image.width(), image.height())) {
        if (*layout == CubeLayout::hcross) return SkyFormat::hcross;
        return *layout == CubeLayout::vcross ? SkyFormat::vcross : SkyFormat::strip;
    }
    if (image.width() == image.height())
        throw unsuitable(file, "is square, as mirror balls, angular maps and octahedral maps are; say which with "
                               "`from` ball, probe or octahedral");
    throw unsuitable(
        file,
        "is " + size_of(image) +
            ", which is no shape of a sky: 2:1 lat-long, 4:3 or 3:4 cross, 6:1 or 1:6 strip; crop it, or say `from`");
}

/// Mean of the colour channels of the texels inside and outside the disc.
struct DiscMeans {
    double inside = 0, outside = 0;
};
DiscMeans disc_means(const Image<float>& image) {
    const int n = image.width(), channels = std::min(3, image.channels());
    double sums[2] = {}, counts[2] = {};
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            const double r = std::hypot((2 * x + 1.0) / n - 1, (2 * y + 1.0) / n - 1);
            if (std::abs(r - 1) < 1.5 / n) continue; // the rim itself may be either
            for (int c = 0; c < channels; ++c) sums[r > 1] += image.at(x, y, c);
            counts[r > 1] += channels;
        }
    return {counts[0] > 0 ? sums[0] / counts[0] : 0, counts[1] > 0 ? sums[1] / counts[1] : 0};
}

void check_shape(const std::string& file, const Image<float>& image, SkyFormat kind) {
    const std::int64_t w = image.width(), h = image.height();
    switch (kind) {
    case SkyFormat::latlong:
    case SkyFormat::openexr_latlong:
        if (w != 2 * h || w < 2)
            throw unsuitable(file, "is " + size_of(image) + "; a lat-long is twice as wide as high; crop or scale it");
        break;
    case SkyFormat::octahedral:
    case SkyFormat::ball:
    case SkyFormat::probe:
        if (w != h) throw unsuitable(file, "is " + size_of(image) + "; " + name(kind) + " is a square; crop it");
        if (w < 2) throw unsuitable(file, "is a single texel, which shows nothing of a sky; give a larger picture");
        break;
    default: break;
    }
    if (kind == SkyFormat::probe) {
        const DiscMeans means = disc_means(image);
        if (means.outside > 0.02 * means.inside)
            throw unsuitable(
                file,
                format(
                    "is not black outside the disc (mean %.3g there, %.3g inside), so it is no angular map; perhaps a "
                    "photograph of a ball (`from` ball) or octahedral",
                    means.outside, means.inside));
    }
}

Projection projection_of(SkyFormat format) noexcept {
    switch (format) {
    case SkyFormat::openexr_latlong: return Projection::latlong_edges;
    case SkyFormat::octahedral: return Projection::octahedral;
    case SkyFormat::ball: return Projection::ball;
    case SkyFormat::probe: return Projection::probe;
    default: return Projection::latlong;
    }
}

Cube cut(const std::string& file, const Image<float>& image, SkyFormat format) {
    const bool flat = image.width() > image.height();
    switch (format) {
    case SkyFormat::hcross: return cut_faces(image, CubeLayout::hcross, FaceOrder::gl, file);
    case SkyFormat::vcross: return cut_faces(image, CubeLayout::vcross, FaceOrder::gl, file);
    case SkyFormat::openexr_cube: {
        Cube cube = cut_faces(image, CubeLayout::strip, FaceOrder::openexr, file);
        if (cube.size() < 2)
            throw unsuitable(file, "has faces of one texel, which cannot lie on all four edges; give a larger one");
        return cube;
    }
    default: return cut_faces(image, flat ? CubeLayout::hstrip : CubeLayout::strip, FaceOrder::gl, file);
    }
}

void prove_orientation(Environment& sky, const ReadEnvironmentOptions& options, EnvironmentReport& report) {
    report.checked = true;
    report.orientation = check_orientation(sky.cube);
    if (!options.fix_orientation || !report.orientation.wrong) return;
    sky.cube = reorient(sky.cube, report.orientation.closes);
    report.fixed = true;
}

} // namespace

const char* name(SkyFormat format) noexcept {
    switch (format) {
    case SkyFormat::automatic: return "auto";
    case SkyFormat::faces: return "faces";
    case SkyFormat::latlong: return "latlong";
    case SkyFormat::hcross: return "hcross";
    case SkyFormat::vcross: return "vcross";
    case SkyFormat::strip: return "strip";
    case SkyFormat::ball: return "ball";
    case SkyFormat::probe: return "probe";
    case SkyFormat::octahedral: return "octahedral";
    case SkyFormat::openexr_cube: return "openexr-cube";
    case SkyFormat::openexr_latlong: return "openexr-latlong";
    }
    return "";
}

Environment read_environment(const std::vector<std::string>& inputs, const ReadEnvironmentOptions& options,
                             EnvironmentReport* report_out) {
    EnvironmentReport own;
    EnvironmentReport& report = report_out ? *report_out : own;
    Environment sky;
    const bool pattern = inputs.size() == 1 && inputs[0].find("%s") != std::string::npos;
    if (inputs.size() != 1 || pattern) {
        if (options.from != SkyFormat::automatic && options.from != SkyFormat::faces)
            throw Error(Refusal::usage,
                        std::string("`from` ") + name(options.from) + ": is one image, but " + inputs[0] +
                            (pattern ? " stands for six" : " is one of " + std::to_string(inputs.size())) +
                            "; leave `from` out");
        const FaceFiles found = pattern ? find_faces(inputs[0]) : name_faces(inputs);
        FacesReport faces;
        sky.cube = read_faces(found.files, options.radiance, &faces);
        report.format = SkyFormat::faces;
        report.files = found.files;
        report.naming = found.naming;
        report.type = faces.first.type;
        for (const BadTexels& bad : faces.mended) {
            if (report.mended.x < 0) report.mended.x = bad.x, report.mended.y = bad.y, report.mended.value = bad.value;
            report.mended.nan += bad.nan;
            report.mended.infinite += bad.infinite;
            report.mended.negative += bad.negative;
            report.mended.over += bad.over;
            report.mended.texels += bad.texels;
        }
        prove_orientation(sky, options, report);
        return sky;
    }
    const std::string& file = inputs[0];
    if (options.from == SkyFormat::faces)
        throw Error(Refusal::usage, file + ": is one file; give six faces, or a pattern with %s");
    ImageInfo info;
    Image<float> image = read_radiance(file, options.radiance, &info, &report.mended);
    report.type = info.type;
    report.format = options.from == SkyFormat::automatic ? format_of(file, image, info) : options.from;
    check_shape(file, image, report.format);
    switch (report.format) {
    case SkyFormat::hcross:
    case SkyFormat::vcross:
    case SkyFormat::strip:
    case SkyFormat::openexr_cube:
        sky.cube = cut(file, image, report.format);
        sky.edge_samples = report.format == SkyFormat::openexr_cube;
        for (int k = 0; k < 6; ++k) report.files[k] = std::string("its ") + cube_face_names[k];
        prove_orientation(sky, options, report);
        break;
    default:
        sky.projection = projection_of(report.format);
        if (sky.projection == Projection::latlong_edges && image.height() < 2)
            throw unsuitable(file, "has one row, which cannot be both poles; give a larger one");
        sky.picture = std::move(image);
    }
    return sky;
}

} // namespace bake
