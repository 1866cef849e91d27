#include "bake/picture/claimed_size.h"
#include "bake/picture/masked_texels.h"
#include <algorithm>
#include <limits>
#include <string_view>

namespace bake {
namespace {

using namespace std::string_view_literals;

/// A number of at most 4 bytes, the highest first; 0 beyond the end.
std::int64_t big_endian(std::string_view bytes, std::size_t at, std::size_t count) noexcept {
    std::int64_t value = 0;
    for (std::size_t i = 0; i < count && at + count <= bytes.size(); ++i)
        value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
    return value;
}

int as_int(std::int64_t size) noexcept {
    return int(std::clamp<std::int64_t>(size, 0, std::numeric_limits<int>::max()));
}

/// ITU-T T.81: segments up to the one that begins a frame.
std::optional<PictureSize> jpeg_size(const PictureFile& file) {
    std::int64_t offset = 2;
    for (int segment = 0; segment < 4096; ++segment) {
        char bytes[10];
        if (file.read(offset, bytes, sizeof bytes) != sizeof bytes) return {};
        const std::string_view head(bytes, sizeof bytes);
        const std::int64_t marker = big_endian(head, 1, 1);
        if (head[0] != '\xff') return {};
        const bool padding = marker == 0xff, tables = marker == 0xc4 || marker == 0xc8 || marker == 0xcc;
        if (marker >= 0xc0 && marker <= 0xcf && !tables)
            return PictureSize{as_int(big_endian(head, 7, 2)), as_int(big_endian(head, 5, 2)),
                               as_int(big_endian(head, 9, 1))};
        offset += padding ? 1 : 2 + big_endian(head, 2, 2);
    }
    return {};
}

/// ISO/IEC 15444-1, A.5.1: the segment SIZ, the first of the codestream, which is looked for in the boxes before it.
std::optional<PictureSize> jpeg2000_size(const PictureFile& file) {
    constexpr std::string_view start = "\xff\x4f\xff\x51"sv;
    std::string bytes(std::size_t(std::min<std::int64_t>(file.size(), 1 << 20)), '\0');
    bytes.resize(std::size_t(file.read(0, bytes.data(), std::int64_t(bytes.size()))));
    const std::size_t at = bytes.find(start);
    if (at == std::string::npos || at + 42 > bytes.size()) return {};
    const auto number = [&](std::size_t offset, std::size_t count) { return big_endian(bytes, at + offset, count); };
    return PictureSize{as_int(number(8, 4) - number(16, 4)), as_int(number(12, 4) - number(20, 4)),
                       as_int(number(40, 2))};
}

/// Google, "WebP Container Specification", RFC 6386 and "WebP Lossless Bitstream".
std::optional<PictureSize> webp_size(const PictureFile& file) {
    const std::string& head = file.head();
    const auto number = [&](std::size_t at, std::size_t bytes) { return int(little_endian(head, at, bytes)); };
    if (head.size() < 30) return {};
    if (head.compare(12, 4, "VP8X") == 0) return PictureSize{number(24, 3) + 1, number(27, 3) + 1, 4};
    if (head.compare(12, 4, "VP8L") == 0)
        return PictureSize{(number(21, 2) & 0x3fff) + 1, (number(22, 3) >> 6 & 0x3fff) + 1, 4};
    if (head.compare(12, 4, "VP8 ") == 0) return PictureSize{number(26, 2) & 0x3fff, number(28, 2) & 0x3fff, 3};
    return {};
}

} // namespace

std::optional<PictureSize> claimed_size(const PictureFile& file, PictureKind kind) {
    switch (kind) {
    case PictureKind::jpeg: return jpeg_size(file);
    case PictureKind::jpeg2000: return jpeg2000_size(file);
    case PictureKind::webp: return webp_size(file);
    default: return {};
    }
}

} // namespace bake
