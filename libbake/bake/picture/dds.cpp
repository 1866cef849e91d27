// Microsoft, "Programming Guide for DDS".
#include "bake/picture/dds.h"
#include "bake/picture/masked_texels.h"
#include <algorithm>
#include <bit>

namespace bake {
namespace {

constexpr std::uint32_t alpha_pixels = 0x1, four_characters = 0x4, rgb = 0x40, luminance = 0x20000;
constexpr std::uint32_t cube_or_volume = 0x200200; // in the second word of capabilities

std::uint32_t flags_of(const PictureFile& file) noexcept { return little_endian(file.head(), 80, 4); }

/// Masks of red, green and blue, or of grey, and of alpha; those that are 0 name no channel.
MaskedTexels texels_of(const PictureFile& file, ImageInfo& info) {
    const std::string& head = file.head();
    MaskedTexels texels{.width = little_endian(head, 16, 4), .height = little_endian(head, 12, 4), .offset = 128};
    texels.texel_bytes = little_endian(head, 88, 4) / 8;
    texels.row_bytes = texels.width * texels.texel_bytes;
    const bool grey = flags_of(file) & luminance;
    constexpr const char* names[] = {"R", "G", "B"};
    for (std::size_t c = 0; c < (grey ? 1 : 3); ++c)
        if (const std::uint32_t mask = little_endian(head, 92 + 4 * c, 4); mask != 0) {
            texels.masks.push_back(mask);
            info.channels.emplace_back(grey ? "Y" : names[c]);
        }
    info.colours = int(texels.masks.size());
    if (const std::uint32_t alpha = little_endian(head, 104, 4); (flags_of(file) & alpha_pixels) && alpha != 0) {
        info.alpha_channel = int(texels.masks.size());
        texels.masks.push_back(alpha);
        info.channels.emplace_back("A");
    }
    return texels;
}

} // namespace

bool is_wide_dds(const PictureFile& file) noexcept {
    const std::string& head = file.head();
    const std::uint32_t flags = flags_of(file), bits = little_endian(head, 88, 4);
    if (!head.starts_with("DDS ") || head.size() < 128 || (flags & four_characters) || !(flags & (rgb | luminance)) ||
        (little_endian(head, 112, 4) & cube_or_volume) || (bits != 16 && bits != 32))
        return false;
    for (std::size_t at = 92; at <= 100; at += 4)
        if (std::popcount(little_endian(head, at, 4)) > 8) return true;
    return false;
}

void read_wide_dds(const PictureFile& file, const ReadLimits& limits, ImageInfo& info, Image<float>* image) {
    info.format = "dds";
    const MaskedTexels texels = texels_of(file, info);
    describe_masked(file, texels, limits, info);
    if (image) *image = read_masked(file, texels);
}

} // namespace bake
