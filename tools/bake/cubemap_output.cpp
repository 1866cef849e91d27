#include "cubemap_output.h"
#include "bake/base/error.h"
#include "bake/base/parallel.h"
#include "bake/base/progress.h"
#include "bake/environment/filter/mips.h"
#include "bake/picture/picture_name.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

namespace bake {
namespace {

constexpr float half_largest = 65504;

bool is_integer(Depth depth) noexcept { return depth == Depth::u8 || depth == Depth::u16; }

/// Rows of a picture, from row `top` on, as its samples can hold them; what these cannot is mended, or counted in `over`
/// to be refused.
void fit(Image<float>& image, int top, const CubemapTarget& target, const std::string& file, BadTexels& over,
         CubemapWritten& written) {
    if (is_integer(target.depth)) {
        const int channels = image.channels(), alpha = channels == 2 || channels == 4 ? channels - 1 : -1;
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
        return;
    }
    if (target.depth != Depth::half) return;
    BadTexels found = find_bad(image, half_largest);
    if (found.over == 0) return;
    found.y += top;
    if (target.bad != BadPolicy::refuse) mend(image, target.bad, file, half_largest);
    if (over.x < 0) over = found;
    else over.over += found.over, over.texels += found.texels;
}

/// Ends a file's fitting.
void settle(const BadTexels& over, const CubemapTarget& target, const std::string& file, CubemapWritten& written) {
    if (over.over == 0) return;
    if (target.bad == BadPolicy::refuse)
        throw Error(Refusal::unsuitable, file + ": half floats cannot hold its radiance: " +
                                             to_text(over, half_largest) + "; write --depth float, or say --bad clamp");
    if (written.over.x < 0) written.over = over;
    else written.over.over += over.over, written.over.texels += over.texels;
}

/// A whole picture.
void fit(Image<float>& image, const CubemapTarget& target, const std::string& file, CubemapWritten& written) {
    BadTexels over;
    fit(image, 0, target, file, over, written);
    settle(over, target, file, written);
}

WriteOptions write_options(const CubemapTarget& target, bool mips) {
    WriteOptions options{.depth = target.depth, .srgb = target.encode_srgb, .mips = mips};
    const bool exr = picture_format(target.out) == PictureFormat::exr;
    if (exr && target.to == SkyFormat::openexr_cube) options.environment = EnvironmentTag::cube;
    if (exr && target.to == SkyFormat::openexr_latlong) options.environment = EnvironmentTag::latlong;
    return options;
}

/// Files that appear under their names together, or not at all.
class Files {
public:
    void open(const std::string& file, int width, int height, int channels, const WriteOptions& options) {
        writers_.push_back(std::make_unique<ImageWriter>(file, width, height, channels, options));
        names_.push_back(file);
    }
    ImageWriter& operator[](std::size_t i) { return *writers_[i]; }
    void finish(CubemapWritten& written) {
        for (const auto& writer : writers_) writer->close();
        throw_if_interrupted();
        for (const auto& writer : writers_) writer->finish();
        written.files = names_;
    }

private:
    std::vector<std::unique_ptr<ImageWriter>> writers_;
    std::vector<std::string> names_;
};

FaceOrder order_of(const CubemapTarget& target) noexcept {
    return target.to == SkyFormat::openexr_cube ? FaceOrder::openexr : target.order;
}

void write_whole(ImageWriter& writer, const Image<float>& image) { writer.write(image.data(), image.height()); }

/// Six faces, or a strip of them, made and written band by band.
CubemapWritten write_by_band(const Environment& sky, const CubemapTarget& target, const ResampleOptions& resampling,
                             Progress* progress) {
    CubemapWritten written;
    Files files;
    const int n = target.size;
    const bool six = target.to == SkyFormat::faces;
    const WriteOptions options = write_options(target, false);
    std::array<std::string, 6> names;
    names.fill(target.out);
    if (six) names = cube_files(target.out);
    for (int k = 0; k < (six ? 6 : 1); ++k) files.open(names[k], n, six ? n : 6 * n, sky.channels(), options);
    std::array<TurnedFace, 6> places;
    for (int k = 0; k < 6; ++k) places[k] = face_at(order_of(target), k);
    BadTexels over;
    each_band(
        sky, {n, target.to == SkyFormat::openexr_cube}, resampling, places,
        [&](int k, int y, Image<float>& band) {
            fit(band, six ? y : k * n + y, target, names[k], over, written);
            write_whole(files[six ? k : 0], band);
            if (y + band.height() < n || (!six && k < 5)) return;
            settle(over, target, names[k], written);
            over = {};
        },
        progress);
    files.finish(written);
    written.width = n;
    written.height = six ? n : 6 * n;
    written.levels = 1;
    return written;
}

CubemapWritten write_picture(const CubemapTarget& target, Image<float> picture) {
    CubemapWritten written;
    Files files;
    fit(picture, target, target.out, written);
    files.open(target.out, picture.width(), picture.height(), picture.channels(), write_options(target, false));
    write_whole(files[0], picture);
    files.finish(written);
    written.width = picture.width();
    written.height = picture.height();
    written.levels = 1;
    return written;
}

Projection projection_of(SkyFormat to) noexcept {
    return to == SkyFormat::octahedral        ? Projection::octahedral
           : to == SkyFormat::openexr_latlong ? Projection::latlong_edges
                                              : Projection::latlong;
}

int picture_height(const CubemapTarget& target) noexcept {
    return target.to == SkyFormat::octahedral ? target.size : std::max(1, target.size / 2);
}

/// A level in the target's layout.
Image<float> laid_out(const Cube& cube, const CubemapTarget& target) {
    switch (target.to) {
    case SkyFormat::hcross: return paste_faces(cube, CubeLayout::hcross);
    case SkyFormat::vcross: return paste_faces(cube, CubeLayout::vcross);
    default: return paste_faces(cube, CubeLayout::strip, order_of(target));
    }
}

Image<float> halved(const Image<float>& image) {
    const int w = std::max(1, image.width() / 2), h = std::max(1, image.height() / 2);
    Image<float> half(w, h, image.channels());
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x)
            for (int c = 0; c < image.channels(); ++c) {
                const int x1 = std::min(2 * x + 1, image.width() - 1), y1 = std::min(2 * y + 1, image.height() - 1);
                half.at(x, y, c) =
                    0.25f * (image.at(2 * x < image.width() ? 2 * x : 0, 2 * y < image.height() ? 2 * y : 0, c) +
                             image.at(x1, 2 * y < image.height() ? 2 * y : 0, c) +
                             image.at(2 * x < image.width() ? 2 * x : 0, y1, c) + image.at(x1, y1, c));
            }
    return half;
}

/// Levels of one file, and halves of the last down to one texel, which file formats with mips ask for.
void write_chain(ImageWriter& writer, std::vector<Image<float>> levels, const CubemapTarget& target,
                 const std::string& file, CubemapWritten& written) {
    while (levels.size() > 1 && (levels.back().width() > 1 || levels.back().height() > 1))
        levels.push_back(halved(levels.back()));
    for (std::size_t k = 0; k < levels.size(); ++k) {
        if (k) writer.next_level();
        fit(levels[k], target, file, written);
        write_whole(writer, levels[k]);
    }
    written.levels = int(levels.size());
}

} // namespace

bool is_cube_format(SkyFormat format) noexcept {
    switch (format) {
    case SkyFormat::faces:
    case SkyFormat::hcross:
    case SkyFormat::vcross:
    case SkyFormat::strip:
    case SkyFormat::openexr_cube: return true;
    default: return false;
    }
}

Depth cubemap_depth(const std::string& out, const std::string& name, SampleType source) {
    const std::pair<const char*, Depth> names[] = {
        {"8", Depth::u8}, {"16", Depth::u16}, {"half", Depth::half}, {"float", Depth::float32}};
    for (const auto& [known, depth] : names)
        if (name == known) return resolve_depth(out, depth);
    const Depth automatic = resolve_depth(out, Depth::automatic);
    return automatic == Depth::u16 && source == SampleType::u8 ? Depth::u8 : automatic;
}

CubemapWritten write_converted(const Environment& sky, const CubemapTarget& target, const ResampleOptions& options,
                               Progress* progress) {
    if (!is_cube_format(target.to))
        return write_picture(
            target, to_picture(sky, projection_of(target.to), target.size, picture_height(target), options, progress));
    // A cross interleaves the faces.
    if (target.to == SkyFormat::hcross || target.to == SkyFormat::vcross)
        return write_picture(target, laid_out(to_cube(sky, {target.size, false}, options, progress), target));
    return write_by_band(sky, target, options, progress);
}

CubemapWritten write_levels(const std::vector<Cube>& cubes, const CubemapTarget& target, Progress* progress) {
    const bool mips = cubes.size() > 1;
    if (mips &&
        (target.to == SkyFormat::hcross || target.to == SkyFormat::vcross || target.to == SkyFormat::octahedral))
        throw Error(
            Refusal::usage,
            target.out +
                ": crosses and octahedral maps have no mips here; write faces, a strip, openexr-cube or a lat-long");
    const int n = cubes[0].size();
    if (mips && target.to != SkyFormat::faces && (n & (n - 1)) != 0)
        throw Error(Refusal::usage,
                    target.out + ": mips of six faces of " + std::to_string(n) +
                        " texels in one picture do not halve evenly; give a --size that is a power of two");
    CubemapWritten written;
    Files files;
    const WriteOptions options = write_options(target, mips);
    if (target.to == SkyFormat::faces) {
        const auto names = cube_files(target.out);
        for (int k = 0; k < 6; ++k) files.open(names[k], n, n, cubes[0].channels(), options);
        for (int k = 0; k < 6; ++k) {
            const TurnedFace place = face_at(target.order, k);
            std::vector<Image<float>> levels;
            for (const Cube& cube : cubes) levels.push_back(turned(cube[place.face], place.turns));
            write_chain(files[k], std::move(levels), target, names[k], written);
        }
        written.width = written.height = n;
    } else {
        std::vector<Image<float>> levels;
        for (std::size_t k = 0; k < cubes.size(); ++k) {
            Environment sky;
            for (int f = 0; f < 6; ++f) sky.cube.faces[f] = turned(cubes[k].faces[f], 0);
            if (!is_cube_format(target.to)) {
                const int width = std::max(1, target.size >> k), height = std::max(1, picture_height(target) >> k);
                levels.push_back(to_picture(sky, projection_of(target.to), width, height, {}, progress));
            } else if (target.to == SkyFormat::openexr_cube && cubes[k].size() > 1) {
                levels.push_back(laid_out(to_cube(sky, {cubes[k].size(), true}, {}, progress), target));
            } else {
                levels.push_back(laid_out(sky.cube, target));
            }
        }
        written.width = levels[0].width();
        written.height = levels[0].height();
        files.open(target.out, written.width, written.height, levels[0].channels(), options);
        write_chain(files[0], std::move(levels), target, target.out, written);
    }
    files.finish(written);
    return written;
}

} // namespace bake
