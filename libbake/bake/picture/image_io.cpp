#include "bake/picture/image_io.h"
#include "bake/base/error.h"
#include "bake/base/output_file.h"
#include "bake/base/parallel.h"
#include "bake/base/progress.h"
#include "bake/picture/picture_formats.h"
#include "bake/picture/plain_png.h"
#include "bake/picture/plain_tiff.h"
#include <algorithm>
#include <cmath>
#include <dlfcn.h>
#include <filesystem>
#include <limits>
#include <optional>

namespace bake {

namespace {

/// OpenImageIO's room, loaded when it is first needed.
const PictureFormats& picture_formats() {
    static const PictureFormats& formats = [&]() -> const PictureFormats& {
        // By its whole path: under the address sanitizer a search beside the program is one beside the sanitizer.
        std::error_code unknown;
        const auto program = std::filesystem::read_symlink("/proc/self/exe", unknown);
        const std::string path = unknown ? "bake_formats.so" : (program.parent_path() / "bake_formats.so").string();
        void* const library = dlopen(path.c_str(), RTLD_LAZY | RTLD_LOCAL);
        void* const entry = library ? dlsym(library, "bake_picture_formats") : nullptr;
        if (!entry)
            throw Error(Refusal::unreadable,
                        std::string(dlerror()) + "; put bake_formats.so beside the command, as it was built");
        return *reinterpret_cast<const PictureFormats* (*)()>(entry)();
    }();
    return formats;
}

} // namespace

const char* name(SampleType type) noexcept {
    switch (type) {
    case SampleType::u8: return "uint8";
    case SampleType::u16: return "uint16";
    case SampleType::u32: return "uint32";
    case SampleType::half: return "half";
    case SampleType::float32: return "float";
    case SampleType::other: break;
    }
    return "other";
}

ImageInfo read_image_info(const std::string& path, const ReadLimits& limits) {
    if (const auto tiff = find_plain_tiff(path, limits)) return tiff->info;
    return picture_formats().read_info(path, limits);
}

Image<float> read_image(const std::string& path, ImageInfo* info_out, const ReadLimits& limits) {
    ImageInfo info;
    Image<float> image;
    if (const auto tiff = find_plain_tiff(path, limits)) {
        info = tiff->info;
        image = read_plain_tiff(path, *tiff);
    } else if (auto png = read_plain_png(path, limits)) {
        info = std::move(png->info);
        image = std::move(png->image);
    } else {
        if (is_cut_short_tiff(path))
            throw Error(Refusal::unreadable, path + ": is cut short; the file is damaged; export it again");
        image = picture_formats().read(path, info, limits);
    }
    if (info_out) *info_out = std::move(info);
    return image;
}

void srgb_to_linear(Image<float>& image, int alpha_channel) {
    const int channels = image.channels();
    for_rows(image.height(), 64, [&](std::int64_t begin, std::int64_t end) {
        for (auto y = int(begin); y < int(end); ++y) {
            float* row = image.row(y);
            for (int i = 0; i < image.width() * channels; ++i)
                if (i % channels != alpha_channel)
                    row[i] = row[i] <= 0.04045f ? row[i] / 12.92f : std::pow((row[i] + 0.055f) / 1.055f, 2.4f);
        }
    });
}

float linear_to_srgb(float linear) noexcept {
    if (!(linear > 0)) return 0;
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

Depth resolve_depth(const std::string& path, Depth depth) {
    std::string ending = std::filesystem::path(path).extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    const auto refuse = [&](const char* why) -> Error { return Error(Refusal::usage, path + ": " + why); };
    if (ending == ".png") {
        if (depth == Depth::half || depth == Depth::float32)
            throw refuse("PNG holds 8 or 16 bits; write .exr or .tif for half and float");
        return depth == Depth::automatic ? Depth::u16 : depth;
    }
    if (ending == ".exr") {
        if (depth == Depth::u8 || depth == Depth::u16)
            throw refuse("EXR holds half or float; write .png or .tif for 8 and 16 bits");
        return depth == Depth::automatic ? Depth::half : depth;
    }
    if (ending == ".tif" || ending == ".tiff") {
        if (depth == Depth::half)
            throw refuse("half floats in TIFF are read by few programs; use float, or write .exr");
        return depth == Depth::automatic ? Depth::float32 : depth;
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
    std::optional<PlainTiffWriter> plain = {};
    std::shared_ptr<FormatWriter> format = {}; ///< of files that are not plain
    std::vector<unsigned char> levels = {};    ///< one band of integer samples
    bool closed = false;

    void write_rows(const void* values, int rows) {
        if (plain) plain->write(values, rows);
        else picture_formats().write(*format, values, rows);
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
    if (fits_plain_tiff(path, size, resolved)) impl_->plain.emplace(path, impl_->file.temporary(), size, resolved);
    else impl_->format = picture_formats().open(path, impl_->file.temporary(), size, resolved);
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
    picture_formats().next_level(*impl_->format);
}

void ImageWriter::close() {
    if (impl_->closed) return;
    if (impl_->plain) impl_->plain->finish();
    else picture_formats().finish(*impl_->format);
    impl_->closed = true;
}

void ImageWriter::finish() {
    close();
    impl_->file.commit();
}

void write_image(const std::string& path, const Image<float>& image, const WriteOptions& options) {
    ImageWriter writer(path, image.width(), image.height(), image.channels(), options);
    writer.write(image.data(), image.height());
    writer.finish();
}

} // namespace bake
