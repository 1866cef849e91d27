#include "bake/picture/image_guard.h"
#include <algorithm>
#include <bit>
#include <string_view>
#include <utility>

namespace bake {
namespace {

/// A number of 4 bytes, 0 beyond the end.
std::uint32_t u32(const std::string& bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (int i = 0; at + 4 <= bytes.size() && i < 4; ++i)
        value |= std::uint32_t(static_cast<unsigned char>(bytes[at + i])) << 8 * i;
    return value;
}

/// Whether an uncompressed DDS has channels of more than 8 bits. OpenImageIO keeps 8 of them.
bool has_wide_masks(const std::string& head) {
    constexpr std::uint32_t four_characters = 4, alpha_pixels = 1;
    const std::uint32_t flags = u32(head, 80);
    if (flags & four_characters) return false;
    for (std::size_t at = 92; at <= (flags & alpha_pixels ? 104 : 100); at += 4)
        if (std::popcount(u32(head, at)) > 8) return true;
    return false;
}

// Microsoft, "Programming Guide for DDS". OIIO fills what is missing with black.
std::string dds_fault(const std::string& head, std::int64_t stored) {
    if (head.size() < 128) return "is cut short";
    const std::int64_t height = u32(head, 12), width = u32(head, 16), bits = u32(head, 88);
    const std::uint32_t format = u32(head, 128);
    const std::string code = head.substr(84, 4);
    const bool extended = code == "DX10";
    const bool small = code == "DXT1" || code == "ATI1" || code == "BC4U" || code == "BC4S" ||
                       (extended && ((format >= 70 && format <= 72) || (format >= 79 && format <= 81)));
    const bool large = code == "DXT2" || code == "DXT3" || code == "DXT4" || code == "DXT5" || code == "ATI2" ||
                       code == "BC5U" || code == "BC5S" ||
                       (extended && ((format >= 73 && format <= 78) || (format >= 82 && format <= 84) ||
                                     (format >= 94 && format <= 99)));
    if (has_wide_masks(head)) return "has channels of more than 8 bits, of which its decoder would keep 8";
    // The top level alone; every format has at least one bit per texel.
    if (width > (1 << 20) || height > (1 << 20)) return "claims more pixels than DDS has room for";
    const std::int64_t needed = small || large ? (width + 3) / 4 * ((height + 3) / 4) * (small ? 8 : 16)
                                               : width * height * std::clamp<std::int64_t>(bits, 0, 128) / 8;
    return stored < 128 + (extended ? 20 : 0) + needed ? "is cut short" : "";
}

// OpenImageIO's decoders of these write past their buffers, or abort, on files with a few bytes changed, or cannot tell
// that a file was cut.
constexpr std::pair<std::string_view, const char*> unsafe_formats[] = {{"SDPX", "DPX"},
                                                                       {"XPDS", "DPX"},
                                                                       {"\x80\x2a\x5f\xd7", "Cineon"},
                                                                       {"\xd7\x5f\x2a\x80", "Cineon"},
                                                                       {"FOR4", "IFF"},
                                                                       {"FORM", "IFF"},
                                                                       {"\x53\x80\xf6\x34", "Softimage"},
                                                                       {"\x2f\x08\x67\xab", "zfile"},
                                                                       {"\xab\x67\x08\x2f", "zfile"}};

} // namespace

std::string image_fault(const PictureFile& file) {
    const std::string& head = file.head();
    if (head.starts_with("DDS ")) return dds_fault(head, file.size());
    for (const auto& [magic, format] : unsafe_formats)
        if (head.starts_with(magic))
            return std::string(format) + " is not read: damaged files of that format crash its decoder";
    return "";
}

} // namespace bake
