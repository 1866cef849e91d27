#include "bake/picture/plain_png.h"
#include "bake/base/file_bytes.h"
#include <algorithm>
#include <csetjmp>
#include <cstring>
#include <fstream>
#include <new>
#include <png.h>
#include <vector>

namespace bake {
namespace {

/// The bytes of a file, as libpng takes them.
struct Source {
    const char *at, *end;
};

void take(png_structp png, png_bytep to, std::size_t size) {
    Source& source = *static_cast<Source*>(png_get_io_ptr(png));
    if (size > std::size_t(source.end - source.at)) png_error(png, "cut short");
    std::memcpy(to, source.at, size);
    source.at += size;
}

/// Errors and warnings alike: a file that gives cause for either is left to OpenImageIO.
void give_up(png_structp png, png_const_charp) { png_longjmp(png, 1); }

/// libpng's two objects, and what it reads from. A jump out of libpng passes over no object with a destructor.
class Decoder {
public:
    explicit Decoder(Source source)
        : source_(source), png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, give_up, give_up)) {
        if (png_) info_ = png_create_info_struct(png_);
        if (!info_) return;
        png_set_read_fn(png_, &source_, take);
        png_set_crc_action(png_, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
    }
    ~Decoder() { png_destroy_read_struct(&png_, &info_, nullptr); }
    Decoder(const Decoder&) = delete;
    Decoder& operator=(const Decoder&) = delete;

    /// Up to the first pixels.
    bool read_header() noexcept {
        if (!info_ || setjmp(png_jmpbuf(png_))) return false;
        png_read_info(png_, info_);
        return true;
    }
    bool read_rows(png_bytepp rows) noexcept {
        if (setjmp(png_jmpbuf(png_))) return false;
        png_read_image(png_, rows);
        png_read_end(png_, nullptr);
        return true;
    }

    /// What the header says, nothing when the file is not plain.
    std::optional<ImageInfo> plain_info() const {
        const int bits = png_get_bit_depth(png_, info_), colours = png_get_color_type(png_, info_);
        if (bits < 8 || png_get_interlace_type(png_, info_) != PNG_INTERLACE_NONE ||
            png_get_valid(png_, info_, PNG_INFO_tRNS | PNG_INFO_sBIT))
            return {};
        // A place other than the corner moves the picture.
        if (png_get_x_offset_pixels(png_, info_) != 0 || png_get_y_offset_pixels(png_, info_) != 0) return {};
        ImageInfo info;
        switch (colours) {
        case PNG_COLOR_TYPE_GRAY: info.channels = {"Y"}; break;
        case PNG_COLOR_TYPE_RGB: info.channels = {"R", "G", "B"}; break;
        case PNG_COLOR_TYPE_GRAY_ALPHA: info.channels = {"Y", "A"}; break;
        case PNG_COLOR_TYPE_RGB_ALPHA: info.channels = {"R", "G", "B", "A"}; break;
        default: return {};
        }
        info.format = "png";
        info.width = int(png_get_image_width(png_, info_)), info.height = int(png_get_image_height(png_, info_));
        info.type = bits == 8 ? SampleType::u8 : SampleType::u16;
        info.bits = bits;
        info.srgb_tagged = png_get_valid(png_, info_, PNG_INFO_sRGB) != 0 || std::strstr(profile_name(), "sRGB");
        png_textp texts = nullptr;
        for (int i = png_get_text(png_, info_, &texts, nullptr); i-- > 0;)
            if (!std::strcmp(texts[i].key, "Description")) info.description = texts[i].text;
        if (colours & PNG_COLOR_MASK_ALPHA) info.alpha_channel = int(info.channels.size()) - 1;
        return info;
    }

private:
    const char* profile_name() const noexcept {
        png_charp name = nullptr;
        png_bytep profile = nullptr;
        int compression = 0;
        png_uint_32 size = 0;
        return png_get_iCCP(png_, info_, &name, &compression, &profile, &size) ? name : "";
    }

    Source source_;
    png_structp png_;
    png_infop info_ = nullptr;
};

void to_floats(const png_byte* row, float* values, std::size_t count, int bits) noexcept {
    if (bits == 8)
        for (std::size_t i = 0; i < count; ++i) values[i] = float(row[i]) * (1.0f / 255);
    else
        for (std::size_t i = 0; i < count; ++i) values[i] = float(row[2 * i] << 8 | row[2 * i + 1]) * (1.0f / 65535);
}

/// The first bytes say PNG: no other file is read whole for nothing.
bool is_png(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    png_byte signature[8];
    return file.read(reinterpret_cast<char*>(signature), 8) && png_sig_cmp(signature, 0, 8) == 0;
}

} // namespace

std::optional<PlainPng> read_plain_png(const std::string& path, const ReadLimits& limits) try {
    if (!is_png(path)) return {};
    const FileBytes file = read_file(path);
    Decoder decoder({file.begin(), file.end()});
    if (!decoder.read_header()) return {};
    const std::optional<ImageInfo> info = decoder.plain_info();
    if (!info) return {};
    const std::size_t row = std::size_t(info->width) * info->channels.size();
    // Deflate makes at most 1032 bytes of one.
    const double samples = double(row) * info->height;
    if (4 * samples > double(limits.max_bytes) || samples * info->bits / 8 > 1032 * double(file.size)) return {};
    Image<float> image(info->width, info->height, int(info->channels.size()));
    std::vector<png_byte> bytes(row * std::size_t(info->bits / 8) * std::size_t(info->height));
    std::vector<png_bytep> rows(std::size_t(info->height));
    for (std::size_t y = 0; y < rows.size(); ++y) rows[y] = bytes.data() + bytes.size() / rows.size() * y;
    if (!decoder.read_rows(rows.data())) return {};
    for (int y = 0; y < info->height; ++y) to_floats(rows[std::size_t(y)], image.row(y), row, info->bits);
    return PlainPng{*info, std::move(image)};
} catch (const std::bad_alloc&) {
    return {}; // OpenImageIO's room says so
}

} // namespace bake
