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

bool has_shape(const SkyFormatEntry& format, int width, int height) noexcept {
    return std::int64_t(width) * format.rows == std::int64_t(height) * format.columns;
}

/// Whether a picture can have the shape of both formats; a strip may also lie on its side.
consteval bool share_shape(const SkyFormatEntry& a, const SkyFormatEntry& b) {
    const bool lies = (a.layout == CubeLayout::strip) != (b.layout == CubeLayout::strip);
    return a.columns * b.rows == a.rows * b.columns || (lies && a.columns * b.columns == a.rows * b.rows);
}
consteval bool are_distinct_shapes() {
    for (std::size_t i = 0; i < sky_formats.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (sky_formats[i].known_by_shape && sky_formats[j].known_by_shape &&
                share_shape(sky_formats[i], sky_formats[j]))
                return false;
    return true;
}
static_assert(are_distinct_shapes(),
              "sky_formats: two entries of the same shape cannot both be known_by_shape, because "
              "the second would never be chosen");

/// Whether a file's tag names this format. Only OpenEXR's own files have its edge samples and its order of faces; other
/// files with the same tag, such as DDS cube maps and textures in TIFF, are plain strips and lat-longs.
bool is_tagged(const SkyFormatEntry& format, const ImageInfo& info) noexcept {
    if (info.environment == EnvironmentTag::none) return false;
    if (info.format == "openexr") return format.tag == info.environment;
    return format.format == (info.environment == EnvironmentTag::cube ? SkyFormat::strip : SkyFormat::latlong);
}

const SkyFormatEntry& format_of(const std::string& file, const Image<float>& image, const ImageInfo& info) {
    const int w = image.width(), h = image.height();
    std::string alike;
    for (const SkyFormatEntry& format : sky_formats) {
        if (is_tagged(format, info) && has_shape(format, w, h)) return format;
        if (format.layout || format.projection)
            if (has_shape(format, w, h)) alike += (alike.empty() ? "" : ", ") + std::string(format.name);
    }
    for (const SkyFormatEntry& format : sky_formats) {
        const bool side_by_side = format.layout == CubeLayout::strip && has_shape(format, h, w);
        if (format.known_by_shape && (has_shape(format, w, h) || side_by_side)) return format;
    }
    if (!alike.empty())
        throw unsuitable(file,
                         "is " + size_of(image) +
                             ", a shape that several formats have; name one of these formats in `from`: " + alike);
    const bool six_cells = 2 * w == 3 * h || 3 * w == 2 * h;
    throw unsuitable(file, "is " + size_of(image) +
                               ", no shape of a sky that can be read: 2:1 lat-long, 4:3 or 3:4 cross, 6:1 or 1:6 "
                               "strip; " +
                               (six_cells ? "programs place six faces of 3 x 2 cells in different orders: cut the "
                                            "picture into six files with a face's name each"
                                          : "crop the picture, or name its format in `from`"));
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

void check_projection(const std::string& file, const Image<float>& image, const SkyFormatEntry& format) {
    if (!has_shape(format, image.width(), image.height()))
        throw unsuitable(file, "is " + size_of(image) + "; width to height of " + format.name + " is " +
                                   std::to_string(format.columns) + ":" + std::to_string(format.rows) +
                                   "; crop or scale the picture");
    if (image.width() < 2)
        throw unsuitable(file, "is a single texel, which shows nothing of a sky; give a larger picture");
    if (format.is_openexr() && image.height() < 2)
        throw unsuitable(file, "has one row, which cannot be both poles; give a larger picture");
    if (format.format != SkyFormat::probe) return;
    const DiscMeans means = disc_means(image);
    if (means.outside > 0.02 * means.inside)
        throw unsuitable(file,
                         bake::format("is not black outside the disc (mean %.3g there, %.3g inside), so it is not an "
                                      "angular map; if it is a photograph of a ball, set `from` to ball, or else to "
                                      "octahedral",
                                      means.outside, means.inside));
}

Cube cut(const std::string& file, const Image<float>& image, const SkyFormatEntry& format, EnvironmentReport& report) {
    const CubeLayout layout = *format.layout;
    if ((layout == CubeLayout::hcross || layout == CubeLayout::vcross) &&
        has_shape(format, image.width(), image.height())) {
        report.cross = find_cross(image, layout);
        return cut_cross(image, layout, report.cross, file);
    }
    const bool side_by_side = layout == CubeLayout::strip && !format.is_openexr() && image.width() > image.height();
    Cube cube = cut_faces(image, side_by_side ? CubeLayout::hstrip : layout, format.order(), file);
    if (format.is_openexr() && cube.size() < 2)
        throw unsuitable(file, "has faces of one texel, which cannot lie on all four edges; give a larger picture");
    return cube;
}

/// Mends the values first: the seams of faces with NaN or infinite texels tell nothing.
void mend_and_check(Environment& sky, const ReadEnvironmentOptions& options, int alpha, EnvironmentReport& report) {
    std::array<std::string, 6> files = report.files;
    if (!report.picture.empty()) files.fill(report.picture);
    report.faults = mend_sky(sky, files, options.bad, alpha);
    if (!sky.is_cube() || !options.check_seams) return;
    report.checked = true;
    report.orientation = check_orientation(sky.cube);
    if (!options.fix_orientation || !report.orientation.wrong) return;
    sky.cube = reorient(sky.cube, report.orientation.closes);
    report.fixed = true;
}

void read_six(const FaceFiles& found, const ReadEnvironmentOptions& options, Environment& sky,
              EnvironmentReport& report) {
    ImageInfo first;
    sky.cube = read_faces(found.files, options.space, &first);
    report.format = SkyFormat::faces;
    report.files = found.files;
    report.naming = found.naming;
    report.notes = first.notes;
    report.type = first.type;
    mend_and_check(sky, options, first.alpha_channel, report);
}

void read_picture(const std::string& file, const ReadEnvironmentOptions& options, Environment& sky,
                  EnvironmentReport& report) {
    ImageInfo info;
    Image<float> image = read_radiance(file, options.space, &info);
    const SkyFormatEntry& format =
        options.from == SkyFormat::automatic ? format_of(file, image, info) : entry_of(options.from);
    report.type = info.type;
    for (const std::string& line : info.notes) report.notes.push_back(file + ": " + line);
    report.format = format.format;
    report.picture = file;
    if (format.projection) {
        check_projection(file, image, format);
        sky.projection = *format.projection;
        sky.picture = std::move(image);
    } else {
        sky.cube = cut(file, image, format, report);
        sky.edge_samples = format.is_openexr();
        for (int k = 0; k < 6; ++k) report.files[k] = std::string("its ") + cube_face_names[k];
    }
    mend_and_check(sky, options, info.alpha_channel, report);
}

std::string cross_note(const EnvironmentReport& report) {
    const bool wide = entry_of(report.format).layout == CubeLayout::hcross;
    return format(wide ? "the cell above the row of the cross is in column %d and the cell below it in column %d; the "
                         "face under the upper one is taken as pz"
                       : "the cell left of the column of the cross is in row %d and the cell right of it in row %d; "
                         "the face beside the left one is taken as pz",
                  report.cross.first + 1, report.cross.second + 1);
}

} // namespace

Environment read_environment(const std::vector<std::string>& inputs, const ReadEnvironmentOptions& options,
                             EnvironmentReport* report_out) {
    EnvironmentReport own;
    EnvironmentReport& report = report_out ? *report_out : own;
    Environment sky;
    const bool pattern = inputs.size() == 1 && is_face_pattern(inputs[0]);
    if (inputs.size() == 1 && !pattern) {
        if (options.from == SkyFormat::faces)
            throw Error(Refusal::usage, inputs[0] + ": is one file; give six faces, or a pattern with %s");
        read_picture(inputs[0], options, sky, report);
        return sky;
    }
    if (options.from != SkyFormat::automatic && options.from != SkyFormat::faces)
        throw Error(Refusal::usage, std::string("`from` ") + name(options.from) + ": is the format of one image, but " +
                                        inputs[0] +
                                        (pattern ? " stands for six" : " is one of " + std::to_string(inputs.size())) +
                                        "; leave `from` out");
    if (!pattern && !options.by_name && inputs.size() != 6)
        throw Error(Refusal::usage, inputs[0] + ": is one of " + std::to_string(inputs.size()) + " faces; give six");
    read_six(pattern           ? find_faces(inputs[0])
             : options.by_name ? name_faces(inputs)
                               : faces_in_order(inputs),
             options, sky, report);
    return sky;
}

std::vector<std::string> reading_notes(const EnvironmentReport& report, bool by_name) {
    std::vector<std::string> notes = report.notes;
    if (report.format == SkyFormat::faces && by_name && report.naming.empty())
        notes.push_back("the names do not say which file is which face; taken in the order px nx py ny pz nz");
    if (report.cross != CrossShape{}) notes.push_back(report.picture + ": " + cross_note(report));
    if (report.faults.negative > 0)
        notes.push_back(format("%lld texels with negative values, %.1e of the sky's flux: these values were replaced "
                               "by 0",
                               static_cast<long long>(report.faults.negative), report.faults.negative_share));
    if (report.faults.bad.texels > 0)
        notes.push_back(std::to_string(report.faults.bad.texels) + " texels mended: " + to_text(report.faults.bad));
    return notes;
}

} // namespace bake
