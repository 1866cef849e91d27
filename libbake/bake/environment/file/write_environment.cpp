#include "bake/environment/file/write_environment.h"
#include "bake/base/error.h"
#include "bake/base/output_file.h"
#include "bake/base/parallel.h"
#include "bake/base/progress.h"
#include "bake/environment/file/face_files.h"
#include "bake/environment/filter/mips.h"
#include "bake/picture/image_io.h"
#include "bake/picture/picture_name.h"
#include <algorithm>
#include <array>
#include <bit>
#include <climits>
#include <cmath>
#include <memory>

namespace bake {
namespace {

constexpr float half_largest = 65504;
/// The largest float that is rounded to a finite half float: resampling may exceed half_largest by a rounding error.
constexpr float rounds_to_half = 65519.996f;

Error usage(const std::string& message) { return Error(Refusal::usage, message); }

/// The channel that pictures of two and of four channels are written with as alpha; -1 in others.
int alpha_of(int channels) noexcept { return channels == 2 || channels == 4 ? channels - 1 : -1; }

/// Values above 1 are counted as clipped; colour is sRGB-encoded if the target asks for that.
void encode_integers(Image<float>& image, const EnvironmentTarget& target, EnvironmentWritten& written) {
    const int channels = image.channels(), alpha = alpha_of(channels);
    std::vector<std::int64_t> clipped(image.height(), 0);
    for_rows(image.height(), 32, [&](std::int64_t begin, std::int64_t end) {
        for (auto y = int(begin); y < int(end); ++y) {
            float* row = image.row(y);
            for (int i = 0; i < image.width() * channels; ++i) {
                clipped[y] += row[i] > 1;
                if (target.encode_srgb && i % channels != alpha) row[i] = linear_to_srgb(std::min(row[i], 1.0f));
            }
        }
    });
    for (const std::int64_t count : clipped) written.clipped += count;
}

/// Prepares rows from row `top` on for the target's samples. Values that half floats cannot hold are added to `over`, and
/// mended unless they are to be refused.
void encode(Image<float>& rows, int top, const EnvironmentTarget& target, const std::string& file, BadTexels& over,
            EnvironmentWritten& written) {
    if (target.depth == Depth::u8 || target.depth == Depth::u16) return encode_integers(rows, target, written);
    if (target.depth != Depth::half) return;
    const int alpha = alpha_of(rows.channels());
    BadTexels found = find_bad(rows, rounds_to_half, alpha);
    if (found.over == 0) return;
    found.y += top;
    over += found;
    if (target.bad != BadPolicy::refuse) mend(rows, target.bad, file, half_largest, alpha);
}

/// To be called when a picture has been encoded.
void report_over(const BadTexels& over, const EnvironmentTarget& target, const std::string& file,
                 EnvironmentWritten& written) {
    if (over.over > 0 && target.bad == BadPolicy::refuse)
        throw Error(Refusal::unsuitable, file + ": half floats cannot hold its radiance: " +
                                             to_text(over, half_largest) + "; set `depth` to float, or `bad` to clamp");
    written.over += over;
}

WriteOptions write_options(const EnvironmentTarget& target, bool mips) {
    WriteOptions options{
        .depth = target.depth, .colour = target.encode_srgb ? ColourSpace::srgb : ColourSpace::linear, .mips = mips};
    if (picture_format(target.file) == PictureFormat::exr) options.environment = entry_of(target.to).tag;
    const bool encoded = target.encode_srgb && (target.depth == Depth::u8 || target.depth == Depth::u16);
    options.facts = {{"content", std::string("environment")},
                     {"layout", std::string(entry_of(target.to).name)},
                     {"encoding", std::string(encoded ? "sRGB" : "linear")}};
    return options;
}

/// Files that appear under their names together, or not at all.
class Files {
public:
    Files(const std::vector<std::string>& names, int width, int height, int channels, const WriteOptions& options)
        : names_(names) {
        for (const std::string& name : names_)
            writers_.push_back(std::make_unique<ImageWriter>(name, width, height, channels, options));
    }
    std::size_t count() const noexcept { return names_.size(); }
    const std::string& name(std::size_t i) const noexcept { return names_[i]; }
    void write(std::size_t i, const Image<float>& rows) { writers_[i]->write(rows.data(), rows.height()); }
    void write_encoded(std::size_t i, Image<float>& picture, const EnvironmentTarget& target,
                       EnvironmentWritten& written) {
        BadTexels over;
        encode(picture, 0, target, names_[i], over, written);
        report_over(over, target, names_[i], written);
        write(i, picture);
    }
    void next_level() {
        for (const auto& writer : writers_) writer->next_level();
    }
    void finish() {
        OutputSet together;
        for (const auto& writer : writers_) writer->finish();
        together.commit();
    }

private:
    std::vector<std::string> names_;
    std::vector<std::unique_ptr<ImageWriter>> writers_;
};

std::vector<std::string> file_names(const EnvironmentTarget& target) {
    if (target.to != SkyFormat::faces) return {target.file};
    const auto names = cube_files(target.file);
    return {names.begin(), names.end()};
}

FaceOrder order_of(const EnvironmentTarget& target) noexcept {
    return entry_of(target.to).is_openexr() ? FaceOrder::openexr : target.order;
}

int height_of(const SkyFormatEntry& format, int width) noexcept {
    return int(std::int64_t(width) * format.rows / format.columns);
}

EnvironmentWritten start(const EnvironmentTarget& target, int width, int height) {
    return {.target = target, .files = file_names(target), .width = width, .height = height, .levels = 1};
}

/// Six faces or a strip, made and written band by band.
EnvironmentWritten write_by_band(const Environment& sky, const EnvironmentTarget& target,
                                 const ResampleOptions& resampling, Progress* progress) {
    const int n = target.size;
    const bool six = target.to == SkyFormat::faces;
    EnvironmentWritten written = start(target, n, six ? n : 6 * n);
    Files files(written.files, written.width, written.height, sky.channels(), write_options(target, false));
    std::array<TurnedFace, 6> places;
    for (int k = 0; k < 6; ++k) places[k] = face_at(order_of(target), k);
    BadTexels over;
    each_band(
        sky, {n, entry_of(target.to).is_openexr()}, resampling, places,
        [&](int k, int y, Image<float>& band) {
            const int file = six ? k : 0;
            encode(band, six ? y : k * n + y, target, files.name(file), over, written);
            files.write(file, band);
            if (y + band.height() < n || (!six && k < 5)) return;
            report_over(over, target, files.name(file), written);
            over = {};
        },
        progress);
    files.finish();
    return written;
}

EnvironmentWritten write_picture(const EnvironmentTarget& target, Image<float> picture) {
    EnvironmentWritten written = start(target, picture.width(), picture.height());
    Files files(written.files, picture.width(), picture.height(), picture.channels(), write_options(target, false));
    files.write_encoded(0, picture, target, written);
    files.finish();
    return written;
}

/// A strip of six texels reduced to `height` texels, 3 or 1.
Image<float> reduced(const Image<float>& strip, int height) {
    Image<float> means(1, height, strip.channels());
    std::fill_n(means.data(), means.size(), 0.0f);
    for (int y = 0; y < 6; ++y)
        for (int c = 0; c < strip.channels(); ++c)
            means.at(0, y * height / 6, c) += strip.at(0, y, c) * float(height) / 6;
    return means;
}

/// Level k of a file that holds one picture; `sky`: the level as a cube, of one texel once faces cannot be halved further.
Image<float> level_picture(const Environment& sky, int k, const EnvironmentTarget& target, Progress* progress) {
    const SkyFormatEntry& format = entry_of(target.to);
    if (format.projection) {
        const int width = std::max(1, target.size >> k), height = std::max(1, height_of(format, target.size) >> k);
        // A single row cannot have its samples on both poles.
        const Projection projection = format.is_openexr() && height < 2 ? Projection::latlong : *format.projection;
        return to_picture(sky, projection, width, height, {}, progress);
    }
    const int n = sky.cube.size();
    if (format.is_openexr() && n > 1)
        return paste_faces(to_cube(sky, {n, true}, {}, progress), *format.layout, order_of(target));
    Image<float> picture = paste_faces(sky.cube, *format.layout, order_of(target));
    const int height = std::max(1, format.rows * target.size >> k);
    return height < picture.height() ? reduced(picture, height) : std::move(picture);
}

/// The largest magnitude: alpha may be negative.
float largest_of(const Image<float>& image) {
    std::vector<float> rows(image.height(), 0.0f);
    for_rows(image.height(), 64, [&](std::int64_t begin, std::int64_t end) {
        for (auto y = int(begin); y < int(end); ++y) {
            const float* const row = image.row(y);
            for (int i = 0; i < image.width() * image.channels(); ++i) rows[y] = std::max(rows[y], std::abs(row[i]));
        }
    });
    return *std::max_element(rows.begin(), rows.end());
}
float largest_of(const Cube& cube) {
    float largest = 0;
    for (const Image<float>& face : cube.faces) largest = std::max(largest, largest_of(face));
    return largest;
}

/// Completes a target. Half floats that nobody asked for become floats if they cannot hold `largest`.
EnvironmentTarget complete_for(const EnvironmentTarget& wanted, int edge, float largest) {
    EnvironmentTarget target = complete_target(wanted, edge);
    const bool automatic = wanted.depth == Depth::automatic && target.depth == Depth::half;
    if (automatic && largest > half_largest) target.depth = Depth::float32;
    return target;
}

} // namespace

SkyFormat format_of_name(const std::string& file) {
    if (is_face_pattern(file)) return SkyFormat::faces;
    return picture_format(file) == PictureFormat::exr ? SkyFormat::openexr_cube : SkyFormat::strip;
}

EnvironmentTarget complete_target(EnvironmentTarget target, int edge) {
    if (target.to == SkyFormat::automatic) target.to = format_of_name(target.file);
    const SkyFormatEntry& format = entry_of(target.to);
    if (format.width_per_edge == 0) throw usage(std::string("`to` ") + format.name + ": can be read but not written");
    const bool six = is_face_pattern(target.file);
    if (target.to == SkyFormat::faces && !six)
        throw usage(target.file + ": names one file for six faces; put a %s where px nx py ny pz nz is to be");
    if (target.to != SkyFormat::faces && six)
        throw usage(target.file + ": stands for six files, but " + format.name + " is one; leave out the %s");
    if (target.order != FaceOrder::gl && !format.has_order())
        throw usage(std::string("`order` openexr: is for six faces and strips, not for ") + format.name);
    if (target.size == 0) target.size = edge * format.width_per_edge;
    const std::string size = "`size` " + std::to_string(target.size) + ": ";
    if (format.projection && target.size * std::int64_t(format.rows) % format.columns != 0)
        throw usage(size + "width to height of " + format.name + " is " + std::to_string(format.columns) + ":" +
                    std::to_string(format.rows) + "; give a multiple of " + std::to_string(format.columns));
    if (format.is_openexr() && (format.projection ? height_of(format, target.size) : target.size) < 2)
        throw usage(size + format.name + " has samples on both ends of each axis; give " +
                    std::to_string(format.projection ? 2 * format.columns : 2) + " or more");
    const Depth automatic = resolve_depth(target.file, Depth::automatic);
    if (target.depth != Depth::automatic) resolve_depth(target.file, target.depth);
    else target.depth = automatic == Depth::u16 && target.source == SampleType::u8 ? Depth::u8 : automatic;
    return target;
}

void check_levels(const EnvironmentTarget& target, std::size_t levels, int edge) {
    if (levels < 2) return;
    const int most = edge > 0 ? std::bit_width(unsigned(edge)) : INT_MAX;
    if (levels > std::size_t(most))
        throw usage(target.file + ": " + std::to_string(levels) + " levels are more than the " + std::to_string(most) +
                    " that faces of " + std::to_string(edge) + " texels have; give fewer, or a larger `size`");
    if (picture_format(target.file) == PictureFormat::png)
        throw usage(target.file + ": PNG has no mips; write .exr or .tif");
    const SkyFormat to = target.to == SkyFormat::automatic ? format_of_name(target.file) : target.to;
    if (to == SkyFormat::faces) return;
    if (!entry_of(to).mips) {
        std::string able;
        for (const SkyFormatEntry& format : sky_formats)
            if (format.mips) able += (able.empty() ? "" : ", ") + std::string(format.name);
        throw usage(target.file + ": " + name(to) +
                    " cannot be written with mip levels; give one of these formats in `to`: " + able);
    }
    if (edge > 0 && !std::has_single_bit(unsigned(edge)))
        throw usage(target.file + ": mip levels of six faces of " + std::to_string(edge) +
                    " texels in one picture do not halve evenly; give a `size` that is a power of two");
}

EnvironmentWritten write_environment(const Environment& sky, const EnvironmentTarget& wanted,
                                     const ResampleOptions& options, Progress* progress) {
    // Resampling gives no value beyond those of the source.
    const float largest = sky.is_cube() ? largest_of(sky.cube) : largest_of(sky.picture);
    const EnvironmentTarget target = complete_for(wanted, sky.face_edge(), largest);
    const SkyFormatEntry& format = entry_of(target.to);
    if (format.projection)
        return write_picture(target, to_picture(sky, *format.projection, target.size, height_of(format, target.size),
                                                options, progress));
    if (format.layout.value_or(CubeLayout::strip) == CubeLayout::strip)
        return write_by_band(sky, target, options, progress);
    return write_picture(target, paste_faces(to_cube(sky, {target.size, false}, options, progress), *format.layout));
}

EnvironmentWritten write_levels(std::vector<Cube> levels, const EnvironmentTarget& wanted, Progress* progress) {
    float largest = 0;
    for (const Cube& level : levels) largest = std::max(largest, largest_of(level));
    const EnvironmentTarget target = complete_for(wanted, levels[0].size(), largest);
    check_levels(target, levels.size(), levels[0].size());
    const bool mips = levels.size() > 1, six = target.to == SkyFormat::faces;
    while (mips && levels.back().size() > 1) levels.push_back(next_mip(levels.back()));
    const SkyFormatEntry& format = entry_of(target.to);
    const int width = format.projection ? target.size : format.columns * levels[0].size();
    EnvironmentWritten written = start(target, width, height_of(format, width));
    const int channels = levels[0].channels();
    Files files(written.files, width, written.height, channels, write_options(target, mips));
    const int count = mips ? int(std::bit_width(unsigned(std::max(width, written.height)))) : 1;
    Environment level;
    for (int k = 0; k < count; ++k) {
        if (k > 0) files.next_level();
        if (k < int(levels.size())) level.cube = std::move(levels[k]);
        for (std::size_t i = 0; i < files.count(); ++i) {
            const TurnedFace place = face_at(target.order, int(i));
            Image<float> picture =
                six ? turned(level.cube[place.face], place.turns) : level_picture(level, k, target, progress);
            files.write_encoded(i, picture, target, written);
        }
    }
    written.levels = count;
    files.finish();
    return written;
}

} // namespace bake
