// PNG files byte by byte, for what no writer of ours makes: 1, 2 and 4 bits, sRGB tags, headers that lie.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace bake::test {

inline std::string big_endian(std::uint32_t n) { return {char(n >> 24), char(n >> 16), char(n >> 8), char(n)}; }

inline std::string png_chunk(const std::string& type, const std::string& data) {
    const std::string body = type + data;
    std::uint32_t crc = 0xffffffff;
    for (const unsigned char byte : body) {
        crc ^= byte;
        for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (crc & 1 ? 0xedb88320 : 0);
    }
    return big_endian(std::uint32_t(data.size())) + body + big_endian(~crc);
}

/// Rows of packed samples as they are stored, in deflate's stored blocks (at most 65535 bytes in all).
inline std::string zlib_stored(const std::vector<std::string>& rows) {
    std::string raw;
    for (const std::string& row : rows) raw += '\0' + row; // filter 0
    std::uint32_t a = 1, b = 0;
    for (const unsigned char byte : raw) a = (a + byte) % 65521, b = (b + a) % 65521;
    const auto size = std::uint16_t(raw.size());
    return std::string("\x78\x01\x01", 3) + char(size) + char(size >> 8) + char(~size) + char(~size >> 8) + raw +
           big_endian(b << 16 | a);
}

/// colour_type 0 grey, 2 RGB, 4 grey and alpha, 6 RGBA. `more` are chunks between header and data.
inline std::string png_bytes(std::uint32_t width, std::uint32_t height, int bits, int colour_type,
                             const std::vector<std::string>& rows, const std::string& more = "") {
    const std::string header =
        big_endian(width) + big_endian(height) + char(bits) + char(colour_type) + std::string(3, '\0');
    return "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", header) + more + png_chunk("IDAT", zlib_stored(rows)) +
           png_chunk("IEND", "");
}

inline std::string srgb_tag() { return png_chunk("sRGB", std::string(1, '\0')) + png_chunk("gAMA", big_endian(45455)); }

} // namespace bake::test
