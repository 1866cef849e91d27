#include "bake/picture/image_io.h"
#include "bake/base/error.h"
#include "bake/base/memory.h"
#include "bake/base/output_file.h"
#include "bake/base/parallel.h"
#include "bake/base/progress.h"
#include "bake/picture/bmp.h"
#include "bake/picture/dds.h"
#include "bake/picture/encode_png.h"
#include "bake/picture/exr.h"
#include "bake/picture/foreign_picture.h"
#include "bake/picture/picture_kind.h"
#include "bake/picture/picture_name.h"
#include "bake/picture/png.h"
#include "bake/picture/png_writer.h"
#include "bake/picture/rgbe.h"
#include "bake/picture/tiff.h"
#include "bake/picture/tiff_writer.h"
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <limits>
#include <optional>
#include <unistd.h>

namespace bake {

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
ImageInfo read_picture(const std::string& path, ReadLimits limits, Image<float>* image) try {
    if (image) limits = within_memory(std::move(limits));
    ImageInfo info;
    const PictureFile file(path);
    const PictureKind kind = picture_kind(file);
    bool read = true;
    switch (kind) {
    case PictureKind::png: read_png(file, limits, info, image); break;
    case PictureKind::tiff: read_tiff(file, limits, info, image); break;
    case PictureKind::hdr: read_rgbe(file, limits, info, image); break;
    case PictureKind::exr: read = read_exr(file, limits, info, image); break;
    case PictureKind::dds: read = read_dds(file, limits, info, image); break;
    case PictureKind::ktx2: read_ktx2(file, limits, info, image); break;
    case PictureKind::bmp: read = read_masked_bmp(file, limits, info, image); break;
    default: read = false;
    }
    if (!read) read_foreign(file, kind, limits, info, image);
    return info;
} catch (const std::bad_alloc&) {
    throw out_of_memory(path);
}

} // namespace

ImageInfo read_image_info(const std::string& path, const ReadLimits& limits) {
    return read_picture(path, limits, nullptr);
}

Image<float> read_image(const std::string& path, ImageInfo* info_out, const ReadLimits& limits) {
    Image<float> image;
    ImageInfo info = read_picture(path, limits, &image);
    if (info_out) *info_out = std::move(info);
    return image;
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

std::vector<std::uint8_t> encode_png(const Image<float>& image, Depth depth) {
    const std::string path = "a picture in memory";
    const OutputFile file(null_device); // nameless
    PngWriter writer(path, file, {image.width(), image.height(), image.channels()}, {.depth = depth});
    const auto write = [&]<class Level>(Level) {
        std::vector<Level> levels(image.size());
        quantise(image.data(), levels.data(), std::int64_t(levels.size()));
        writer.write(levels.data(), image.height());
    };
    if (depth == Depth::u8) write(std::uint8_t());
    else write(std::uint16_t());
    writer.finish();
    std::vector<std::uint8_t> bytes(std::size_t(file.size()));
    const int descriptor = file.open_descriptor();
    for (std::size_t got = 0; got < bytes.size();) {
        const ssize_t count = pread(descriptor, bytes.data() + got, bytes.size() - got, off_t(got));
        if (count > 0) got += std::size_t(count);
        else if (count == 0 || errno != EINTR) break;
    }
    close(descriptor);
    return bytes;
}

void write_image(const std::string& path, const Image<float>& image, const WriteOptions& options) {
    ImageWriter writer(path, image.width(), image.height(), image.channels(), options);
    writer.write(image.data(), image.height());
    writer.finish();
}

} // namespace bake
