#include "bake/picture/image_guard.h"
#include <algorithm>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <unistd.h>
#include <utility>

namespace bake {
namespace {

/// A number of 4 bytes, 0 beyond the end.
std::uint32_t u32(const std::string& bytes, std::size_t at, bool big_endian = false) {
    std::uint32_t value = 0;
    for (int i = 0; at + 4 <= bytes.size() && i < 4; ++i)
        value |= std::uint32_t(static_cast<unsigned char>(bytes[at + i])) << 8 * (big_endian ? 3 - i : i);
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

constexpr std::string_view exr_magic = "\x76\x2f\x31\x01";

/// The attributes of one part of an OpenEXR file that its pixels depend on.
struct ExrPart {
    bool channels = false, compression = false, data_window = false, display_window = false;
    int method = 0;
    double width = 0, height = 0, tile_width = 0, tile_height = 0;

    /// Scan lines or tiles of the finest level, each of which has at least an offset of 8 bytes and a header of 8.
    double chunks() const {
        const auto parts = [](double n, double size) { return double(std::int64_t((n + size - 1) / size)); };
        if (tile_width > 0 && tile_height > 0) return parts(width, tile_width) * parts(height, tile_height);
        constexpr int lines[] = {1, 1, 1, 16, 32, 16, 32, 32, 32, 256};
        return parts(height, lines[std::clamp(method, 0, 9)]);
    }
};

/// A zero-terminated name; false when it runs past the end or past what OpenEXR allows.
bool read_name(std::istream& file, std::string& name) {
    name.clear();
    for (int c; (c = file.get()) > 0;) {
        if (name.size() == 255) return false;
        name += char(c);
    }
    return bool(file);
}

bool printable_channels(const std::string& list) {
    for (std::size_t at = 0; at < list.size() && list[at];) {
        const std::size_t end = std::min(list.find('\0', at), list.size());
        for (; at < end; ++at)
            if (static_cast<unsigned char>(list[at]) < 32 || list[at] == 127) return false;
        at += 1 + 16; // the terminator, type, linearity and sampling
    }
    return true;
}

/// Reads attributes up to the empty name that ends them.
std::string read_part(std::istream& file, std::int64_t stored, ExrPart& part) {
    std::string name, type, value;
    for (;;) {
        if (!read_name(file, name)) return "has a header that is cut short";
        if (name.empty()) return "";
        char size_bytes[4];
        if (!read_name(file, type) || !file.read(size_bytes, 4)) return "has a header that is cut short";
        const std::int64_t size = std::int32_t(u32(std::string(size_bytes, 4), 0)), at = file.tellg();
        if (size < 0 || at + size > stored) return "has a header that runs past the end of the file";
        value.resize(std::size_t(std::min<std::int64_t>(size, 1 << 16)));
        file.read(value.data(), std::streamsize(value.size()));
        file.seekg(at + size);
        const auto span = [&](std::size_t low, std::size_t high) {
            return double(std::int32_t(u32(value, high))) - double(std::int32_t(u32(value, low))) + 1;
        };
        if (name == "channels") {
            part.channels = true;
            if (!printable_channels(value)) return "has a channel whose name cannot be printed";
        }
        if (name == "compression" && size == 1) part.compression = true, part.method = value[0];
        if (name == "dataWindow" && size == 16)
            part.data_window = true, part.width = span(0, 8), part.height = span(4, 12);
        if (name == "displayWindow" && size == 16) part.display_window = true;
        if (name == "tiles" && size == 9) part.tile_width = u32(value, 0), part.tile_height = u32(value, 4);
    }
}

// openexr.com, "OpenEXR File Layout". The library falls back to a data window of 64 x 64 where there is none, and gives
// zeros for chunks of no bytes.
std::string exr_fault(std::istream& file, const std::string& head, std::int64_t stored) {
    const std::uint32_t version = u32(head, 4);
    file.seekg(8);
    ExrPart first;
    std::string fault = read_part(file, stored, first);
    const bool many_parts = version & 0x1000;
    while (fault.empty() && many_parts && file.peek() > 0) {
        ExrPart other;
        fault = read_part(file, stored, other);
    }
    if (!fault.empty()) return fault;
    for (const auto& [there, name] : {std::pair(first.channels, "channels"),
                                      {first.compression, "compression"},
                                      {first.data_window, "dataWindow"},
                                      {first.display_window, "displayWindow"}})
        if (!there) return "has a header without " + std::string(name);
    if (16 * first.chunks() > double(stored))
        return "claims " + std::to_string(std::int64_t(first.width)) + " x " +
               std::to_string(std::int64_t(first.height)) + " pixels in " + std::to_string(stored) + " bytes";
    return "";
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
    if (head.starts_with(exr_magic)) return exr_fault(file, head, stored);
    if (head.starts_with(std::string_view("II*\0", 4)) || head.starts_with(std::string_view("MM\0*", 4)) ||
        head.starts_with(std::string_view("II+\0", 4)) || head.starts_with(std::string_view("MM\0+", 4)))
        return tiff_fault(file, head, stored);
    for (const auto& [magic, format] : unsafe_formats)
        if (head.starts_with(magic))
            return std::string(format) + " is not read: damaged files of that format crash its decoder";
    return "";
}

namespace {

/// Reads at any place without reading what lies between.
class RandomAccess {
public:
    explicit RandomAccess(const std::string& path) : file_(open(path.c_str(), O_RDONLY | O_CLOEXEC)) {}
    ~RandomAccess() {
        if (file_ >= 0) close(file_);
    }
    RandomAccess(const RandomAccess&) = delete;
    RandomAccess& operator=(const RandomAccess&) = delete;

    std::string bytes(std::int64_t at, int count) const {
        std::string all(std::size_t(count), '\0');
        const auto got = pread(file_, all.data(), all.size(), at);
        all.resize(std::size_t(std::max<ssize_t>(0, got)));
        return all;
    }
    std::int64_t offset(std::int64_t at) const {
        const std::string all = bytes(at, 8);
        return all.size() < 8 ? -1 : std::int64_t(u32(all, 0)) | std::int64_t(u32(all, 4)) << 32;
    }

private:
    int file_;
};

// Each chunk leads to the next; a lost byte breaks the chain.
bool png_reaches_its_end(const RandomAccess& file, std::int64_t stored) {
    for (std::int64_t at = 8; at < stored;) {
        const std::string chunk = file.bytes(at, 8);
        if (chunk.size() < 8) return false;
        at += 12 + std::int64_t(u32(chunk, 0, true));
        if (chunk.ends_with("IEND")) return at == stored;
    }
    return false;
}

// The table of offsets ends where the first chunk begins, and the chunk that lies last ends with the file.
bool exr_reaches_its_end(const RandomAccess& file, std::int64_t table, bool tiled, std::int64_t stored) {
    std::int64_t first = stored, last = 0;
    for (std::int64_t at = table; at < first; at += 8) {
        const std::int64_t chunk = file.offset(at);
        if (chunk <= table || chunk >= stored) return false;
        first = std::min(first, chunk);
        last = std::max(last, chunk);
    }
    const int header = tiled ? 20 : 8; // ends with the size of what follows
    const std::string chunk = file.bytes(last, header);
    return int(chunk.size()) == header && last + header + std::int64_t(u32(chunk, std::size_t(header) - 4)) == stored;
}

} // namespace

bool reaches_its_end(const std::string& path) {
    std::error_code failed;
    const auto stored = std::int64_t(std::filesystem::file_size(path, failed));
    if (failed || !image_fault(path, stored).empty()) return false;
    const RandomAccess file(path);
    const std::string head = file.bytes(0, 8);
    if (head.starts_with("\x89PNG")) return png_reaches_its_end(file, stored);
    if (!head.starts_with(exr_magic)) return true;
    std::ifstream stream(path, std::ios::binary);
    stream.seekg(8);
    ExrPart part;
    return read_part(stream, stored, part).empty() &&
           exr_reaches_its_end(file, stream.tellg(), part.tile_width > 0, stored);
}

} // namespace bake
