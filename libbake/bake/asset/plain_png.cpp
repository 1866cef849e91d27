// PNG Specification (Third Edition): 5 datastream structure, 9 filtering, 10 compression by zlib, which is our only help.
#include "bake/asset/plain_png.h"
#include "bake/asset/file_bytes.h"
#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <new>
#include <zlib.h>

namespace bake {
namespace {

using Byte = unsigned char;

constexpr char signature[] = "\x89PNG\r\n\x1a\n";
constexpr std::size_t header_size = 33; // signature and IHDR

std::uint32_t big_endian(const Byte* b) noexcept {
    return std::uint32_t(b[0]) << 24 | std::uint32_t(b[1]) << 16 | std::uint32_t(b[2]) << 8 | b[3];
}

// Chunks that say nothing of the values.
bool is_remark(const char* type) noexcept {
    constexpr const char* remarks[] = {"gAMA", "cHRM", "sRGB", "iCCP", "pHYs", "oFFs", "tEXt",
                                       "zTXt", "iTXt", "tIME", "bKGD", "eXIf"};
    return std::any_of(std::begin(remarks), std::end(remarks), [&](const char* r) { return std::memcmp(r, type, 4) == 0; });
}

// Undoes the filter of one row in place; `above` is the row before it, zeros for the first.
bool unfilter(int filter, Byte* row, const Byte* above, std::size_t size, std::size_t texel) noexcept {
    switch (filter) {
    case 0: return true;
    case 1:
        for (std::size_t i = texel; i < size; ++i) row[i] = Byte(row[i] + row[i - texel]);
        return true;
    case 2:
        for (std::size_t i = 0; i < size; ++i) row[i] = Byte(row[i] + above[i]);
        return true;
    case 3:
        for (std::size_t i = 0; i < size; ++i) row[i] = Byte(row[i] + ((i < texel ? 0 : row[i - texel]) + above[i]) / 2);
        return true;
    case 4:
        for (std::size_t i = 0; i < size; ++i) {
            const int left = i < texel ? 0 : row[i - texel], up = above[i], corner = i < texel ? 0 : above[i - texel];
            const int guess = left + up - corner;
            const int to_left = std::abs(guess - left), to_up = std::abs(guess - up), to_corner = std::abs(guess - corner);
            row[i] = Byte(row[i] + (to_left <= to_up && to_left <= to_corner ? left : to_up <= to_corner ? up : corner));
        }
        return true;
    default: return false;
    }
}

// Inflates piece by piece.
class Inflater {
public:
    explicit Inflater(std::size_t size) : bytes(size + 1), size_(size) { // one more: a stream too long shows
        ready_ = inflateInit(&stream_) == Z_OK;
        stream_.next_out = bytes.data();
    }
    ~Inflater() {
        if (ready_) inflateEnd(&stream_);
    }
    Inflater(const Inflater&) = delete;
    Inflater& operator=(const Inflater&) = delete;

    bool add(const Byte* data, std::size_t size) noexcept {
        stream_.next_in = const_cast<Byte*>(data); // zlib does not write to it
        stream_.avail_in = uInt(size);
        while (ready_ && !ended_ && stream_.avail_in > 0) {
            stream_.avail_out = uInt(std::min<std::size_t>(bytes.size() - produced(), 1u << 30));
            const int result = inflate(&stream_, Z_NO_FLUSH);
            ended_ = result == Z_STREAM_END;
            if (!ended_ && result != Z_OK) return false;
        }
        return ready_ && stream_.avail_in == 0;
    }
    bool whole() const noexcept { return ended_ && produced() == size_; }

    std::vector<Byte> bytes;

private:
    std::size_t produced() const noexcept { return std::size_t(stream_.next_out - bytes.data()); }

    std::size_t size_;
    z_stream stream_ = {};
    bool ready_ = false, ended_ = false;
};

void to_floats(const Byte* row, float* values, std::size_t count, int bits) noexcept {
    if (bits == 8)
        for (std::size_t i = 0; i < count; ++i) values[i] = float(row[i]) * (1.0f / 255);
    else
        for (std::size_t i = 0; i < count; ++i) values[i] = float(row[2 * i] << 8 | row[2 * i + 1]) * (1.0f / 65535);
}

// Calls chunk(type, data, size) for each up to IEND, data being within [begin, end). False when they do not add up, or
// chunk says so.
template <class Chunk> bool each_chunk(const Byte* begin, const Byte* end, const Chunk& chunk) {
    for (const Byte* at = begin; end - at >= 12;) {
        const std::uint32_t size = big_endian(at);
        if (size > std::uint64_t(end - at) - 12) return false;
        const Byte* const data = at + 8;
        if (big_endian(data + size) != crc32(crc32(0, nullptr, 0), at + 4, uInt(size + 4))) return false;
        const char* const type = reinterpret_cast<const char*>(at + 4);
        if (std::memcmp(type, "IEND", 4) == 0) return true;
        if (!chunk(type, data, size)) return false;
        at = data + size + 4;
    }
    return false;
}

} // namespace

std::optional<ImageInfo> find_plain_png(const std::string& path, const ReadLimits& limits) {
    std::ifstream file(path, std::ios::binary);
    Byte head[header_size];
    if (!file.read(reinterpret_cast<char*>(head), header_size) || std::memcmp(head, signature, 8) != 0 ||
        big_endian(head + 8) != 13 || std::memcmp(head + 12, "IHDR", 4) != 0)
        return {};
    const std::uint32_t width = big_endian(head + 16), height = big_endian(head + 20);
    const int bits = head[24], colours = head[25];
    if ((bits != 8 && bits != 16) || head[26] != 0 || head[27] != 0 || head[28] != 0) return {};
    ImageInfo info;
    info.format = "png";
    switch (colours) {
    case 0: info.channels = {"Y"}; break;
    case 2: info.channels = {"R", "G", "B"}; break;
    case 4: info.channels = {"Y", "A"}; break;
    case 6: info.channels = {"R", "G", "B", "A"}; break;
    default: return {};
    }
    if (width < 1 || height < 1 || width > (1 << 20) || height > (1 << 20)) return {};
    const double samples = double(width) * height * double(info.channels.size());
    std::error_code failed;
    const double stored = double(std::filesystem::file_size(path, failed));
    // Deflate makes at most 1032 bytes of one.
    if (failed || 4 * samples > double(limits.max_bytes) || samples * bits / 8 > 1032 * stored) return {};
    info.width = int(width);
    info.height = int(height);
    info.type = bits == 8 ? SampleType::u8 : SampleType::u16;
    info.bits = bits;
    if (colours == 4 || colours == 6) info.alpha_channel = int(info.channels.size()) - 1;
    // The chunks before the pixels.
    for (Byte chunk[8]; file.read(reinterpret_cast<char*>(chunk), 8);) {
        const char* const type = reinterpret_cast<const char*>(chunk + 4);
        if (std::memcmp(type, "IDAT", 4) == 0) return info;
        if (!is_remark(type)) return {};
        const std::streamoff next = std::streamoff(file.tellg()) + std::streamoff(big_endian(chunk)) + 4;
        char begin[80] = {};
        file.read(begin, std::min<std::streamsize>(79, big_endian(chunk)));
        // A place other than the corner moves the picture.
        if (std::memcmp(type, "oFFs", 4) == 0 && std::any_of(begin, begin + 8, [](char c) { return c != 0; })) return {};
        // A profile begins with its name.
        if (std::memcmp(type, "sRGB", 4) == 0 || (std::memcmp(type, "iCCP", 4) == 0 && std::strstr(begin, "sRGB")))
            info.srgb_tagged = true;
        file.seekg(next);
    }
    return {};
}

std::optional<Image<float>> read_plain_png(const std::string& path, const ImageInfo& info) try {
    const FileBytes file = read_file(path);
    if (file.size < header_size) return {};
    const auto* const begin = reinterpret_cast<const Byte*>(file.begin());
    const std::size_t texel = info.channels.size() * std::size_t(info.bits / 8), row = texel * std::size_t(info.width);
    Inflater inflater((row + 1) * std::size_t(info.height));
    const bool read = each_chunk(begin + 8, begin + file.size, [&](const char* type, const Byte* data, std::size_t size) {
        if (std::memcmp(type, "IDAT", 4) == 0) return inflater.add(data, size);
        return is_remark(type) || std::memcmp(type, "IHDR", 4) == 0;
    });
    if (!read || !inflater.whole()) return {};

    Image<float> image(info.width, info.height, int(info.channels.size()));
    const std::vector<Byte> none(row, 0);
    const Byte* above = none.data();
    for (int y = 0; y < info.height; ++y) {
        Byte* const line = inflater.bytes.data() + std::size_t(y) * (row + 1);
        if (!unfilter(line[0], line + 1, above, row, texel)) return {};
        above = line + 1;
        to_floats(line + 1, image.row(y), row / std::size_t(info.bits / 8), info.bits);
    }
    return image;
} catch (const std::bad_alloc&) {
    return {}; // OpenImageIO's room says so
}

} // namespace bake
