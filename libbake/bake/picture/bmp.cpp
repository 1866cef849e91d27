// Microsoft, "BITMAPV5HEADER structure (wingdi.h)".
#include "bake/picture/bmp.h"
#include "bake/picture/icc.h"
#include "bake/picture/masked_texels.h"
#include <cstdlib>

namespace bake {
namespace {

enum Method : std::uint32_t { plain = 0, bit_fields = 3, alpha_bit_fields = 6 };

MaskedTexels texels_of(const PictureFile& file) {
    const std::string& head = file.head();
    const std::int64_t height = std::int32_t(little_endian(head, 22, 4)); // negative: rows from the top down
    MaskedTexels texels{.width = std::int32_t(little_endian(head, 18, 4)),
                        .height = std::abs(height),
                        .offset = little_endian(head, 10, 4),
                        .texel_bytes = little_endian(head, 28, 2) / 8,
                        .bottom_up = height > 0};
    texels.row_bytes = (texels.width * texels.texel_bytes + 3) / 4 * 4;
    const std::uint32_t method = little_endian(head, 30, 4), header_size = little_endian(head, 14, 4);
    if (method == plain) {
        texels.masks = texels.texel_bytes == 2 ? std::vector<std::uint32_t>{0x7c00, 0x3e0, 0x1f}
                                               : std::vector<std::uint32_t>{0xff0000, 0xff00, 0xff};
        return texels;
    }
    for (std::size_t c = 0; c < 3; ++c) texels.masks.push_back(little_endian(head, 54 + 4 * c, 4));
    if (method == alpha_bit_fields || header_size >= 56)
        if (const std::uint32_t alpha = little_endian(head, 66, 4); alpha != 0) texels.masks.push_back(alpha);
    return texels;
}

/// What a header of version 5 says of the colours.
ColourTag read_colour(const PictureFile& file) {
    const std::string& head = file.head();
    constexpr std::uint32_t embedded = 0x4d424544, srgb = 0x73524742;
    if (little_endian(head, 14, 4) < 124) return {};
    const std::uint32_t space = little_endian(head, 70, 4), offset = little_endian(head, 126, 4),
                        size = little_endian(head, 130, 4);
    if (space == srgb) return {.source = "header", .curves = {srgb_curve()}};
    if (space != embedded || size > file.size()) return {};
    std::string profile(size, '\0');
    profile.resize(std::size_t(file.read(14 + std::int64_t(offset), profile.data(), size)));
    return read_icc(profile);
}

bool is_masked(const PictureFile& file) noexcept {
    const std::string& head = file.head();
    if (little_endian(head, 14, 4) < 40) return false;
    const std::uint32_t bits = little_endian(head, 28, 2), method = little_endian(head, 30, 4);
    return (bits == 16 || bits == 32) && (method == plain || method == bit_fields || method == alpha_bit_fields);
}

} // namespace

bool read_masked_bmp(const PictureFile& file, const ReadLimits& limits, ImageInfo& info, Image<float>* image) {
    if (!is_masked(file)) return false;
    const MaskedTexels texels = texels_of(file);
    info.format = "bmp";
    info.channels = {"R", "G", "B", "A"};
    info.channels.resize(texels.masks.size());
    info.colours = 3;
    if (texels.masks.size() == 4) info.alpha_channel = 3;
    describe_masked(file, texels, limits, info);
    info.colour = read_colour(file);
    info.srgb_tagged = info.colour.is_srgb();
    if (!image) return true;
    *image = Image<float>(info.width, info.height, int(texels.masks.size()));
    read_masked(file, texels, image->data());
    return true;
}

} // namespace bake
