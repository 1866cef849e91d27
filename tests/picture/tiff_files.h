// TIFF files of any kind, written by libtiff itself.
#pragma once
#include <cstdint>
#include <doctest/doctest.h>
#include <string>
#include <tiffio.h>
#include <vector>

namespace bake::test {

/// One directory of a file. Levels are given as bits, texel by texel, and packed here.
struct TiffPicture {
    int width = 0, height = 0, per_texel = 1;
    int bits = 8, format = SAMPLEFORMAT_UINT, photometric = PHOTOMETRIC_MINISBLACK;
    int compression = COMPRESSION_NONE, predictor = 1, orientation = ORIENTATION_TOPLEFT;
    bool tiled = false, planes = false;
    int fill_order = FILLORDER_MSB2LSB;
    std::uint32_t kind = 0; ///< NewSubfileType
    std::vector<std::uint16_t> extra = {};
    std::vector<std::uint64_t> levels = {};
};

/// `count` levels from `first` on, `stride` apart, as libtiff takes them: whole samples in this machine's order, smaller
/// ones packed from the highest bit on.
inline std::vector<unsigned char> packed_levels(const TiffPicture& p, std::size_t first, std::size_t count,
                                                std::size_t stride) {
    std::vector<unsigned char> bytes((count * std::size_t(p.bits) + 7) / 8);
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint64_t level = p.levels[first + i * stride];
        for (int bit = 0; bit < p.bits; ++bit) {
            const std::size_t at = i * std::size_t(p.bits) + std::size_t(bit);
            if (p.bits % 8 == 0) // little endian
                bytes[at / 8] |= static_cast<unsigned char>((level >> bit & 1) << (at % 8));
            else bytes[at / 8] |= static_cast<unsigned char>((level >> (p.bits - 1 - bit) & 1) << (7 - at % 8));
        }
    }
    return bytes;
}

inline void write_tiff_tile(TIFF* tiff, const TiffPicture& p, int left, int top, int plane) {
    constexpr int edge = 16;
    std::vector<unsigned char> tile;
    const int per_texel = p.planes ? 1 : p.per_texel;
    TiffPicture padded = p; // a row of the tile, zero beyond the edge
    for (int y = top; y < top + edge; ++y) {
        padded.levels.assign(std::size_t(edge * per_texel), 0);
        for (int x = left; x < left + edge && x < p.width && y < p.height; ++x)
            for (int c = 0; c < per_texel; ++c)
                padded.levels[std::size_t((x - left) * per_texel + c)] =
                    p.levels[std::size_t((y * p.width + x) * p.per_texel + (p.planes ? plane : c))];
        const auto row = packed_levels(padded, 0, padded.levels.size(), 1);
        tile.insert(tile.end(), row.begin(), row.end());
    }
    REQUIRE(TIFFWriteTile(tiff, tile.data(), std::uint32_t(left), std::uint32_t(top), 0, std::uint16_t(plane)) >= 0);
}

/// `more` sets further tags of the directory.
template <class More> void write_tiff_picture(TIFF* tiff, const TiffPicture& p, More&& more) {
    const auto set = [&](std::uint32_t tag, int value) { REQUIRE(TIFFSetField(tiff, tag, value) == 1); };
    set(TIFFTAG_IMAGEWIDTH, p.width), set(TIFFTAG_IMAGELENGTH, p.height), set(TIFFTAG_BITSPERSAMPLE, p.bits);
    set(TIFFTAG_SAMPLEFORMAT, p.format), set(TIFFTAG_PHOTOMETRIC, p.photometric);
    set(TIFFTAG_SAMPLESPERPIXEL, p.per_texel), set(TIFFTAG_COMPRESSION, p.compression);
    if (p.predictor > 1) set(TIFFTAG_PREDICTOR, p.predictor);
    set(TIFFTAG_PLANARCONFIG, p.planes ? PLANARCONFIG_SEPARATE : PLANARCONFIG_CONTIG);
    set(TIFFTAG_ORIENTATION, p.orientation), set(TIFFTAG_FILLORDER, p.fill_order);
    if (p.kind) set(TIFFTAG_SUBFILETYPE, int(p.kind));
    if (p.tiled) set(TIFFTAG_TILEWIDTH, 16), set(TIFFTAG_TILELENGTH, 16);
    else set(TIFFTAG_ROWSPERSTRIP, 5);
    if (!p.extra.empty()) REQUIRE(TIFFSetField(tiff, TIFFTAG_EXTRASAMPLES, int(p.extra.size()), p.extra.data()) == 1);
    more(tiff);
    const int planes = p.planes ? p.per_texel : 1;
    for (int plane = 0; plane < planes; ++plane)
        for (int y = 0; y < p.height; y += p.tiled ? 16 : 1)
            if (p.tiled) {
                for (int x = 0; x < p.width; x += 16) write_tiff_tile(tiff, p, x, y, plane);
            } else {
                const auto first = std::size_t(y * p.width * p.per_texel + plane);
                auto row = packed_levels(p, first, std::size_t(p.width * (p.planes ? 1 : p.per_texel)),
                                         std::size_t(p.planes ? p.per_texel : 1));
                REQUIRE(TIFFWriteScanline(tiff, row.data(), std::uint32_t(y), std::uint16_t(plane)) == 1);
            }
}

template <class More>
void write_tiff(const std::string& path, const std::vector<TiffPicture>& pictures, More&& more,
                const char* mode = "w") {
    TIFF* const tiff = TIFFOpen(path.c_str(), mode);
    REQUIRE(tiff);
    for (const TiffPicture& picture : pictures) {
        write_tiff_picture(tiff, picture, more);
        REQUIRE(TIFFWriteDirectory(tiff) == 1);
    }
    TIFFClose(tiff);
}
inline void write_tiff(const std::string& path, const TiffPicture& picture, const char* mode = "w") {
    write_tiff(
        path, {picture}, [](TIFF*) {}, mode);
}

/// Levels without a pattern, the least and the largest among them.
inline std::vector<std::uint64_t> some_levels(std::size_t count, int bits) {
    const std::uint64_t largest = bits == 64 ? ~std::uint64_t(0) : (std::uint64_t(1) << bits) - 1;
    std::vector<std::uint64_t> levels{0, largest};
    for (std::uint64_t state = 1; levels.size() < count;) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        levels.push_back(state >> 20 & largest);
    }
    levels.resize(count);
    return levels;
}

} // namespace bake::test
