#include "bake/picture/png.h"
#include "bake/base/progress.h"
#include "bake/picture/png_colour.h"
#include "bake/picture/upright.h"
#include <algorithm>
#include <csetjmp>
#include <cstdlib>
#include <cstring>
#include <png.h>
#include <string_view>
#include <vector>

namespace bake {
namespace {

/// The bytes of the file in their order, through a buffer.
struct Source {
    const PictureFile& file;
    std::vector<char> buffer = std::vector<char>(1 << 16);
    std::int64_t offset = 0; ///< of the byte after the buffer's last
    std::size_t at = 0, end = 0;
    bool exhausted = false;

    bool take(png_bytep to, std::size_t size) {
        for (std::size_t part; size > 0; size -= part, to += part, at += part) {
            if (at == end) {
                end = std::size_t(file.read(offset, buffer.data(), std::int64_t(buffer.size())));
                at = 0, offset += std::int64_t(end);
                exhausted = end == 0;
                if (exhausted) return false;
            }
            part = std::min(size, end - at);
            std::memcpy(to, buffer.data() + at, part);
        }
        return true;
    }
};

void take(png_structp png, png_bytep to, std::size_t size) {
    if (!static_cast<Source*>(png_get_io_ptr(png))->take(to, size)) png_error(png, "is cut short");
}

/// Memory for libpng, which takes as many bytes as a chunk claims before it has read one of them. A chunk is no longer than
/// its file. The rest, rows of a million texels and profiles of at most 8 MB, is smaller than the allowance.
png_voidp allocate(png_structp png, png_alloc_size_t size) {
    constexpr png_alloc_size_t allowance = 16 << 20;
    const auto* const source = static_cast<const Source*>(png_get_mem_ptr(png));
    if (size > std::max(allowance, png_alloc_size_t(source->file.size()) + 1))
        png_error(png, "has a chunk that is longer than the file");
    return std::malloc(size);
}
void release(png_structp, png_voidp bytes) { std::free(bytes); }

void keep_error(png_structp png, png_const_charp message) {
    // A plain array: the jump may not pass over a destructor.
    auto* const said = static_cast<char*>(png_get_error_ptr(png));
    std::strncpy(said, message, 199);
    png_longjmp(png, 1);
}

/// Warnings are about what is not needed here.
void ignore_warning(png_structp, png_const_charp) {}

/// libpng's two objects, and what it reads from. A jump out of libpng passes over no object with a destructor: each
/// function that libpng may leave by a jump has none.
class Decoder {
public:
    explicit Decoder(const PictureFile& file)
        : source_{file}, png_(png_create_read_struct_2(PNG_LIBPNG_VER_STRING, said_, keep_error, ignore_warning,
                                                       &source_, allocate, release)) {
        if (png_) info_ = png_create_info_struct(png_);
        if (info_) png_set_read_fn(png_, &source_, take);
    }
    ~Decoder() { png_destroy_read_struct(&png_, &info_, nullptr); }
    Decoder(const Decoder&) = delete;
    Decoder& operator=(const Decoder&) = delete;

    /// Up to the first pixels, which are to come out as whole samples of 8 or 16 bits.
    bool read_header() noexcept {
        if (!info_ || setjmp(png_jmpbuf(png_))) return false;
        keep_unknown_chunks(png_);
        png_read_info(png_, info_);
        const bool palette = png_get_color_type(png_, info_) == PNG_COLOR_TYPE_PALETTE;
        palette_ = palette && has_own_palette();
        bits_ = palette ? 8 : png_get_bit_depth(png_, info_);
        stored_bits_ = png_get_bit_depth(png_, info_) * png_get_channels(png_, info_);
        png_set_expand(png_);
        passes_ = png_set_interlace_handling(png_);
        png_read_update_info(png_, info_);
        return true;
    }
    bool read_row(png_bytep row) noexcept {
        if (setjmp(png_jmpbuf(png_))) return false;
        png_read_row(png_, row, nullptr);
        return true;
    }
    bool read_interlaced(png_bytepp rows) noexcept {
        if (setjmp(png_jmpbuf(png_))) return false;
        png_read_image(png_, rows);
        return true;
    }
    /// What follows the pixels may be missing, but not damaged.
    bool read_end() noexcept {
        if (setjmp(png_jmpbuf(png_))) return source_.exhausted;
        png_read_end(png_, nullptr);
        return true;
    }

    ImageInfo describe() const {
        static constexpr const char* names[] = {"", "Y", "YA", "RGB", "RGBA"};
        ImageInfo info;
        for (const char* name = names[png_get_channels(png_, info_)]; *name; ++name)
            info.channels.emplace_back(1, *name);
        info.format = "png";
        info.width = int(png_get_image_width(png_, info_)), info.height = int(png_get_image_height(png_, info_));
        info.type = bits_ == 16 ? SampleType::u16 : SampleType::u8;
        info.bits = bits_;
        info.palette = palette_;
        info.colour = read_png_colour(png_, info_);
        info.srgb_tagged = info.colour.is_srgb();
        if (const int orientation = exif_orientation(exif()); orientation > 1 && orientation <= 8)
            info.notes.push_back("has an eXIf chunk that asks for orientation " + std::to_string(orientation) +
                                 ", which most programs ignore in PNG: read as stored");
        png_textp texts = nullptr;
        for (int i = png_get_text(png_, info_, &texts, nullptr); i-- > 0;)
            if (!std::strcmp(texts[i].key, "Description")) info.description = texts[i].text;
            else if (!std::strcmp(texts[i].key, record_key)) info.record = valid_record(texts[i].text);
        if (is_animation(png_, info_)) info.notes.push_back("is an animation: its first picture is read");
        if (info.channels.back() == "A") info.alpha_channel = int(info.channels.size()) - 1;
        info.colours = info.channels.size() < 3 ? 1 : 3;
        return info;
    }
    bool interlaced() const noexcept { return passes_ > 1; }
    int stored_bits() const noexcept { return stored_bits_; }
    const char* said() const noexcept { return *said_ ? said_ : "cannot be decoded"; }

private:
    std::string_view exif() const noexcept {
        png_uint_32 size = 0;
        png_bytep bytes = nullptr;
        if (!png_get_eXIf_1(png_, info_, &size, &bytes) || !bytes) return {};
        return {reinterpret_cast<const char*>(bytes), size};
    }
    /// Whether there are colours in the palette, or greys that are not the index.
    bool has_own_palette() const noexcept {
        png_colorp entries = nullptr;
        int count = 0;
        if (!png_get_PLTE(png_, info_, &entries, &count)) return false;
        const int most = (1 << png_get_bit_depth(png_, info_)) - 1;
        for (int i = 0; i < count; ++i) {
            const int grey = (255 * i + most / 2) / most;
            if (entries[i].red != grey || entries[i].green != grey || entries[i].blue != grey) return true;
        }
        return false;
    }

    Source source_;
    char said_[200] = {};
    png_structp png_;
    png_infop info_ = nullptr;
    int bits_ = 0, stored_bits_ = 0, passes_ = 1;
    bool palette_ = false;
};

void to_floats(const png_byte* row, float* values, std::size_t count, bool wide) noexcept {
    if (wide)
        for (std::size_t i = 0; i < count; ++i) values[i] = float(row[2 * i] << 8 | row[2 * i + 1]) * (1.0f / 65535);
    else
        for (std::size_t i = 0; i < count; ++i) values[i] = float(row[i]) * (1.0f / 255);
}

Image<float> read_pixels(Decoder& decoder, const PictureFile& file, const ImageInfo& info) {
    const bool wide = info.type == SampleType::u16;
    Image<float> image(info.width, info.height, int(info.channels.size()));
    const std::size_t samples = std::size_t(info.width) * info.channels.size(), row_bytes = samples * (wide ? 2 : 1);
    // Interlaced rows are complete only after the last pass.
    const bool whole = decoder.interlaced();
    std::vector<png_byte> bytes(row_bytes * std::size_t(whole ? info.height : 1));
    std::vector<png_bytep> rows(std::size_t(info.height), bytes.data());
    for (std::size_t y = 0; whole && y < rows.size(); ++y) rows[y] += row_bytes * y;
    if (whole && !decoder.read_interlaced(rows.data())) throw unreadable(file.path(), decoder.said());
    for (int y = 0; y < info.height; ++y) {
        if (y % 256 == 0) throw_if_interrupted();
        if (!whole && !decoder.read_row(bytes.data())) throw unreadable(file.path(), decoder.said());
        to_floats(rows[std::size_t(y)], image.row(y), samples, wide);
    }
    if (!decoder.read_end()) throw unreadable(file.path(), decoder.said());
    return image;
}

} // namespace

void read_png(const PictureFile& file, const ReadLimits& limits, ImageInfo& info, Image<float>* image) {
    Decoder decoder(file);
    if (!decoder.read_header()) throw unreadable(file.path(), decoder.said());
    info = decoder.describe();
    // oFFs says where the picture lies on a page: its texels are all here, wherever that is.
    const Window picture{0, 0, info.width, info.height};
    // Deflate makes at most 1032 bytes of one.
    const int channels = int(info.channels.size());
    check_size(file.path(), file.size(),
               {picture, picture, channels, 1032.0 * 8 * channels / std::max(1, decoder.stored_bits())}, limits);
    if (image) *image = read_pixels(decoder, file, info);
}

} // namespace bake
