#include "bake/picture/image_guard.h"
#include <algorithm>
#include <fstream>
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
    // The top level alone; every format has at least one bit per texel.
    if (width > (1 << 20) || height > (1 << 20)) return "claims more pixels than DDS has room for";
    const std::int64_t needed = small || large ? (width + 3) / 4 * ((height + 3) / 4) * (small ? 8 : 16)
                                               : width * height * std::clamp<std::int64_t>(bits, 0, 128) / 8;
    return stored < 128 + (extended ? 20 : 0) + needed ? "is cut short" : "";
}

/// Numbers of a TIFF file at any place, in its byte order; 0 beyond its end.
struct TiffBytes {
    std::istream& file;
    bool big_endian;

    std::uint64_t number(std::uint64_t at, int bytes) {
        unsigned char raw[8] = {};
        file.clear();
        file.seekg(std::streamoff(at));
        if (!file.read(reinterpret_cast<char*>(raw), bytes)) return 0;
        std::uint64_t value = 0;
        for (int i = 0; i < bytes; ++i) value |= std::uint64_t(raw[i]) << 8 * (big_endian ? bytes - 1 - i : i);
        return value;
    }
};

/// A field of a TIFF directory: where its values lie, how many they are and how long each is.
struct TiffField {
    std::uint64_t at = 0, count = 0;
    int bytes = 0;
};

// Adobe, "TIFF Revision 6.0", and BigTIFF. libtiff fills strips beyond the end with what was there before.
std::string tiff_fault(std::istream& file, const std::string& head, std::int64_t stored_bytes) {
    const auto stored = std::uint64_t(stored_bytes);
    TiffBytes tiff{file, head[0] == 'M'};
    const bool big = tiff.number(2, 2) == 43; // BigTIFF
    const int wide = big ? 8 : 4;
    const std::uint64_t directory = tiff.number(big ? 8 : 4, wide), count_bytes = big ? 8 : 2;
    const std::uint64_t fields = tiff.number(directory, int(count_bytes)), field_bytes = big ? 20 : 12;
    if (directory < 8 || directory > stored || fields == 0 || fields > (stored - directory) / field_bytes)
        return "is cut short";
    TiffField offsets, sizes;
    for (std::uint64_t i = 0; i < fields; ++i) {
        const std::uint64_t at = directory + count_bytes + i * field_bytes, tag = tiff.number(at, 2),
                            type = tiff.number(at + 2, 2);
        if (tag != 273 && tag != 279 && tag != 324 && tag != 325) continue; // strips' or tiles' offsets and sizes
        TiffField field{at + 4 + wide, tiff.number(at + 4, wide), type == 3 ? 2 : type == 4 ? 4 : 8};
        if (field.count > stored / field.bytes) return "is cut short";
        if (field.count * field.bytes > std::uint64_t(wide)) field.at = tiff.number(field.at, wide);
        (tag == 273 || tag == 324 ? offsets : sizes) = field;
    }
    for (std::uint64_t i = 0; i < offsets.count; ++i) {
        const std::uint64_t offset = tiff.number(offsets.at + i * offsets.bytes, offsets.bytes);
        const std::uint64_t size = i < sizes.count ? tiff.number(sizes.at + i * sizes.bytes, sizes.bytes) : 0;
        if (offset > stored || size > stored - offset) return "is cut short";
    }
    return "";
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

std::string image_fault(const std::string& path, std::int64_t stored) {
    std::ifstream file(path, std::ios::binary);
    std::string head(148, '\0');
    file.read(head.data(), std::streamsize(head.size()));
    head.resize(std::size_t(file.gcount()));
    file.clear();
    if (head.starts_with("DDS ")) return dds_fault(head, stored);
    if (head.starts_with(std::string_view("II*\0", 4)) || head.starts_with(std::string_view("MM\0*", 4)) ||
        head.starts_with(std::string_view("II+\0", 4)) || head.starts_with(std::string_view("MM\0+", 4)))
        return tiff_fault(file, head, stored);
    for (const auto& [magic, format] : unsafe_formats)
        if (head.starts_with(magic))
            return std::string(format) + " is not read: damaged files of that format crash its decoder";
    return "";
}

} // namespace bake
