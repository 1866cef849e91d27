#include "bake/picture/image_io.h"
#include "bake/base/error.h"
#include "bake/base/output_file.h"
#include "bake/base/parallel.h"
#include "bake/base/progress.h"
#include "bake/picture/bmp.h"
#include "bake/picture/dds.h"
#include "bake/picture/exr.h"
#include "bake/picture/icc.h"
#include "bake/picture/picture_formats.h"
#include "bake/picture/picture_name.h"
#include "bake/picture/png.h"
#include "bake/picture/png_writer.h"
#include "bake/picture/rgbe.h"
#include "bake/picture/tiff.h"
#include "bake/picture/tiff_writer.h"
#include "bake/picture/upright.h"
#include <algorithm>
#include <cmath>
#include <dlfcn.h>
#include <filesystem>
#include <limits>
#include <link.h>
#include <optional>

namespace bake {

namespace {

/// The folder of the program or shared library that holds this function; empty when it is unknown.
std::filesystem::path own_folder() {
    Dl_info found;
    link_map* object = nullptr;
    if (!dladdr1(reinterpret_cast<void*>(&own_folder), &found, reinterpret_cast<void**>(&object), RTLD_DL_LINKMAP))
        return {};
    // The program itself has no name in the list of loaded objects.
    std::error_code failed;
    const std::filesystem::path file = *object->l_name ? object->l_name : "/proc/self/exe";
    return std::filesystem::canonical(file, failed).parent_path();
}

/// OpenImageIO's library, loaded when it is first needed.
const PictureFormats& picture_formats() {
    static const PictureFormats& formats = [&]() -> const PictureFormats& {
        std::string refused;
        for (const char* folder : {"", BAKE_FORMATS_FROM_PROGRAM, BAKE_FORMATS_FOLDER}) {
            // By its whole path: the linker's own search depends on who calls dlopen, which under the address sanitizer
            // is the sanitizer. An absolute folder replaces the one that it is appended to.
            const std::string path = (own_folder() / folder / "bake_formats.so").lexically_normal().string();
            if (void* const library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL))
                if (void* const entry = dlsym(library, "bake_picture_formats"))
                    return *reinterpret_cast<const PictureFormats* (*)()>(entry)();
            // A library that is there and cannot be loaded is the better reason.
            if (const char* const reason = dlerror(); refused.empty() || std::filesystem::exists(path))
                refused = reason;
        }
        throw Error(Refusal::unreadable,
                    refused + "; put bake_formats.so beside the program or into " BAKE_FORMATS_FOLDER);
    }();
    return formats;
}

FormatHost format_host() { return {.threads = thread_count(), .interrupted = interrupted}; }

/// All decoders that are not ours to choose are behind this call.
void read_by_openimageio(const PictureFile& file, const ReadLimits& limits, ImageInfo& info, Image<float>* image) {
    FormatPicture picture;
    const PictureFormats& formats = picture_formats();
    if (const FormatResult failure = formats.read(format_host(), file, limits, image != nullptr, picture))
        throw Error(failure->refusal, failure->message);
    info = std::move(picture.info);
    if (!picture.icc.empty()) info.colour = read_icc(picture.icc);
    if (!info.colour.curves.empty()) info.srgb_tagged = info.colour.is_srgb();
    turn_upright(info, picture.orientation);
    if (image) *image = upright(std::move(picture.image), picture.orientation);
}

} // namespace

const char* name(SampleType type) noexcept {
    switch (type) {
    case SampleType::u8: return "uint8";
    case SampleType::u16: return "uint16";
    case SampleType::u32: return "uint32";
    case SampleType::i8: return "int8";
    case SampleType::i16: return "int16";
    case SampleType::i32: return "int32";
    case SampleType::half: return "half";
    case SampleType::float32: return "float";
    case SampleType::other: break;
    }
    return "other";
}

bool is_integer(SampleType type) noexcept {
    return type != SampleType::half && type != SampleType::float32 && type != SampleType::other;
}

double level_step(const ImageInfo& info) noexcept {
    if (!is_integer(info.type) || info.bits < 1) return 0;
    const bool with_sign = info.type == SampleType::i8 || info.type == SampleType::i16 || info.type == SampleType::i32;
    return 1 / (std::ldexp(1.0, info.bits - with_sign) - 1);
}

namespace {

/// Reads the header, and the texels into `image` when that is given.
ImageInfo read_picture(const std::string& path, const ReadLimits& limits, Image<float>* image) {
    ImageInfo info;
    const PictureFile file(path);
    if (is_png(file)) read_png(file, limits, info, image);
    else if (is_tiff(file)) read_tiff(file, limits, info, image);
    else if (is_rgbe(file)) read_rgbe(file, limits, info, image);
    else if (is_masked_bmp(file)) read_masked_bmp(file, limits, info, image);
    else if (is_wide_dds(file)) read_wide_dds(file, limits, info, image);
    else if (!is_exr(file) || !read_exr(file, limits, info, image)) read_by_openimageio(file, limits, info, image);
    return info;
}

} // namespace

ImageInfo read_image_info(const std::string& path, const ReadLimits& limits) {
    return read_picture(path, limits, nullptr);
}

Image<float> read_image(const std::string& path, ImageInfo* info_out, const ReadLimits& limits) try {
    Image<float> image;
    ImageInfo info = read_picture(path, limits, &image);
    if (info_out) *info_out = std::move(info);
    return image;
} catch (const std::bad_alloc&) {
    throw Error(Refusal::unsuitable, path + ": needs more memory than there is; scale it down");
}

Depth resolve_depth(const std::string& path, Depth depth) {
    const auto refuse = [&](const char* why) -> Error { return Error(Refusal::usage, path + ": " + why); };
    switch (picture_format(path)) {
    case PictureFormat::png:
        if (depth == Depth::half || depth == Depth::float32)
            throw refuse("PNG holds 8 or 16 bits; write .exr or .tif for half and float");
        return depth == Depth::automatic ? Depth::u16 : depth;
    case PictureFormat::exr:
        if (depth == Depth::u8 || depth == Depth::u16)
            throw refuse("EXR holds half or float; write .png or .tif for 8 and 16 bits");
        return depth == Depth::automatic ? Depth::half : depth;
    case PictureFormat::tiff:
        if (depth == Depth::half)
            throw refuse("half floats in TIFF are read by few programs; use float, or write .exr");
        return depth == Depth::automatic ? Depth::float32 : depth;
    case PictureFormat::unknown: break;
    }
    throw refuse("unknown ending; write .png, .exr or .tif");
}

namespace {

constexpr int band_rows = 256; // a multiple of every compression's block of scanlines

std::vector<std::string> default_channels(int count) {
    switch (count) {
    case 1: return {"Y"};
    case 2: return {"Y", "A"};
    case 3: return {"R", "G", "B"};
    case 4: return {"R", "G", "B", "A"};
    default: break;
    }
    std::vector<std::string> names;
    for (int c = 0; c < count; ++c) names.push_back("channel" + std::to_string(c));
    return names;
}

template <class Level> void quantise(const float* values, Level* levels, std::int64_t count) noexcept {
    constexpr float largest = std::numeric_limits<Level>::max();
    for (std::int64_t i = 0; i < count; ++i) {
        // Written so that NaN becomes 0.
        const float clamped = values[i] > 0 ? std::min(values[i], 1.0f) : 0.0f;
        levels[i] = static_cast<Level>(int(clamped * largest + 0.5f));
    }
}

} // namespace

struct ImageWriter::Impl {
    std::string path;
    OutputFile file;
    Depth depth;
    int width, channels;
    std::optional<PngWriter> png = {};
    std::optional<ExrWriter> exr = {};
    std::optional<TiffWriter> tiff = {};
    std::vector<unsigned char> levels = {}; ///< one band of integer samples

    void write_rows(const void* values, int rows) {
        if (png) png->write(values, rows);
        else if (exr) exr->write(static_cast<const float*>(values), rows);
        else tiff->write(values, rows);
    }

    template <class Level> void write_levels(const float* values, int rows) {
        const std::int64_t row_size = std::int64_t(width) * channels;
        levels.resize(rows * row_size * sizeof(Level));
        Level* to = reinterpret_cast<Level*>(levels.data());
        for_rows(rows, 64, [&](std::int64_t begin, std::int64_t end) {
            quantise(values + begin * row_size, to + begin * row_size, (end - begin) * row_size);
        });
        write_rows(to, rows);
    }
};

ImageWriter::ImageWriter(const std::string& path, int width, int height, int channels, const WriteOptions& options) {
    WriteOptions resolved = options;
    resolved.depth = resolve_depth(path, options.depth);
    if (resolved.channels.empty()) resolved.channels = default_channels(channels);
    impl_.reset(new Impl{path, OutputFile(path), resolved.depth, width, channels});
    const PictureSize size{width, height, channels};
    const PictureFormat format = picture_format(path);
    if (format == PictureFormat::png) impl_->png.emplace(path, impl_->file, size, resolved);
    else if (format == PictureFormat::exr) impl_->exr.emplace(path, impl_->file, size, resolved);
    else impl_->tiff.emplace(path, impl_->file, size, resolved);
}

ImageWriter::~ImageWriter() = default;

void ImageWriter::write(const float* values, int rows) {
    const std::int64_t row_size = std::int64_t(impl_->width) * impl_->channels;
    for (int y = 0; y < rows; y += band_rows) {
        throw_if_interrupted();
        const int count = std::min(band_rows, rows - y);
        const float* band = values + y * row_size;
        switch (impl_->depth) {
        case Depth::u8: impl_->write_levels<std::uint8_t>(band, count); break;
        case Depth::u16: impl_->write_levels<std::uint16_t>(band, count); break;
        default: impl_->write_rows(band, count);
        }
    }
}

void ImageWriter::next_level() {
    impl_->width = std::max(1, impl_->width / 2);
    if (impl_->exr) impl_->exr->next_level();
    else if (impl_->tiff) impl_->tiff->next_level();
}

void ImageWriter::finish() {
    if (impl_->png) impl_->png->finish();
    else if (impl_->exr) impl_->exr->finish();
    else impl_->tiff->finish();
    impl_->file.commit();
}

void write_image(const std::string& path, const Image<float>& image, const WriteOptions& options) {
    ImageWriter writer(path, image.width(), image.height(), image.channels(), options);
    writer.write(image.data(), image.height());
    writer.finish();
}

} // namespace bake
