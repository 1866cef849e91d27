// Microsoft, "BITMAPV5HEADER structure (wingdi.h)".
#include "bake/picture/bmp.h"
#include "bake/base/progress.h"
#include "bake/picture/icc.h"
#include <algorithm>
#include <bit>
#include <string_view>
#include <vector>

namespace bake {
namespace {

/// A little-endian number of the header; 0 beyond its end.
std::uint32_t number(const std::string& head, std::size_t at, std::size_t bytes) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < bytes && at + bytes <= head.size(); ++i)
        value |= std::uint32_t(static_cast<unsigned char>(head[at + i])) << 8 * i;
    return value;
}

enum Method : std::uint32_t { plain = 0, bit_fields = 3, alpha_bit_fields = 6 };

struct Header {
    std::int64_t width, height; ///< negative height: rows from the top down
    std::int64_t offset, texel_bytes;
    std::vector<std::uint32_t> masks; ///< of red, green, blue and perhaps alpha
};

Header read_header(const PictureFile& file) {
    const std::string& head = file.head();
    Header header{std::int32_t(number(head, 18, 4)),
                  std::int32_t(number(head, 22, 4)),
                  number(head, 10, 4),
                  number(head, 28, 2) / 8,
                  {}};
    const std::uint32_t method = number(head, 30, 4), header_size = number(head, 14, 4);
    if (method == plain) {
        header.masks = header.texel_bytes == 2 ? std::vector<std::uint32_t>{0x7c00, 0x3e0, 0x1f}
                                               : std::vector<std::uint32_t>{0xff0000, 0xff00, 0xff};
        return header;
    }
    for (std::size_t c = 0; c < 3; ++c) header.masks.push_back(number(head, 54 + 4 * c, 4));
    if (method == alpha_bit_fields || header_size >= 56)
        if (const std::uint32_t alpha = number(head, 66, 4); alpha != 0) header.masks.push_back(alpha);
    for (const std::uint32_t mask : header.masks) {
        const std::uint32_t bits = mask >> (mask ? std::countr_zero(mask) : 0);
        if (mask == 0 || (bits & (bits + 1)) != 0)
            throw unreadable(file.path(), "has a channel whose mask is empty or has gaps");
    }
    return header;
}

/// What a header of version 5 says of the colours.
ColourTag read_colour(const PictureFile& file) {
    const std::string& head = file.head();
    constexpr std::uint32_t embedded = 0x4d424544, srgb = 0x73524742;
    if (number(head, 14, 4) < 124) return {};
    const std::uint32_t space = number(head, 70, 4), offset = number(head, 126, 4), size = number(head, 130, 4);
    if (space == srgb) return {.source = "header", .curves = {srgb_curve()}};
    if (space != embedded || size > file.size()) return {};
    std::string profile(size, '\0');
    profile.resize(std::size_t(file.read(14 + std::int64_t(offset), profile.data(), size)));
    return read_icc(profile);
}

} // namespace

bool is_masked_bmp(const PictureFile& file) noexcept {
    const std::string& head = file.head();
    if (!head.starts_with("BM") || number(head, 14, 4) < 40) return false;
    const std::uint32_t bits = number(head, 28, 2), method = number(head, 30, 4);
    return (bits == 16 || bits == 32) && (method == plain || method == bit_fields || method == alpha_bit_fields);
}

void read_masked_bmp(const PictureFile& file, const ReadLimits& limits, ImageInfo& info, Image<float>* image) {
    const Header header = read_header(file);
    const std::int64_t width = header.width, height = std::abs(header.height);
    const int channels = int(header.masks.size());
    if (width > (1 << 24) || height > (1 << 24)) throw unreadable(file.path(), "claims more texels than it can hold");
    const Window window{0, 0, int(width), int(height)};
    check_size(file.path(), file.size(), {window, window, channels}, limits);
    info.format = "bmp";
    info.width = int(width), info.height = int(height);
    info.channels = {"R", "G", "B", "A"};
    info.channels.resize(std::size_t(channels));
    info.colours = 3;
    if (channels == 4) info.alpha_channel = 3;
    for (int c = 0; c < 3; ++c) info.bits = std::max(info.bits, std::popcount(header.masks[std::size_t(c)]));
    info.type = info.bits <= 8 ? SampleType::u8 : info.bits <= 16 ? SampleType::u16 : SampleType::u32;
    info.colour = read_colour(file);
    info.srgb_tagged = info.colour.is_srgb();
    const std::int64_t row_bytes = (width * header.texel_bytes + 3) / 4 * 4;
    if (header.offset + height * row_bytes - (row_bytes - width * header.texel_bytes) > file.size())
        throw unreadable(file.path(), "is cut short");
    if (!image) return;
    *image = Image<float>(int(width), int(height), channels);
    std::string row(std::size_t(width * header.texel_bytes), '\0');
    for (std::int64_t y = 0; y < height; ++y) {
        if (y % 256 == 0) throw_if_interrupted();
        if (file.read(header.offset + y * row_bytes, row.data(), std::int64_t(row.size())) != std::int64_t(row.size()))
            throw unreadable(file.path(), "is cut short");
        float* to = image->row(int(header.height > 0 ? height - 1 - y : y));
        for (std::int64_t x = 0; x < width; ++x) {
            const std::uint32_t texel =
                number(row, std::size_t(x * header.texel_bytes), std::size_t(header.texel_bytes));
            for (const std::uint32_t mask : header.masks) {
                const int shift = std::countr_zero(mask);
                *to++ = float(double((texel & mask) >> shift) / double(mask >> shift));
            }
        }
    }
}

} // namespace bake
