#include "bake/base/error.h"
#include "bake/base/parallel.h"
#include "bake/picture/image_io.h"
#include "picture/openimageio.h"
#include "picture/tiff_files.h"
#include <bit>
#include <cmath>
#include <cstring>

using namespace bake;
using namespace bake::test;

namespace {

Image<float> pattern(int width, int height, int channels) {
    Image<float> image(width, height, channels);
    for (std::size_t i = 0; i < image.size(); ++i) image.data()[i] = float((i * 7919) % 65536) / 65535;
    return image;
}

/// What a level stands for, by the standard.
double meaning(const TiffPicture& p, std::uint64_t level) {
    if (p.format == SAMPLEFORMAT_IEEEFP)
        return p.bits == 32 ? std::bit_cast<float>(std::uint32_t(level)) : std::bit_cast<double>(level);
    if (p.format == SAMPLEFORMAT_INT) {
        const double value = double(level) - (level >> (p.bits - 1) ? std::ldexp(1.0, p.bits) : 0);
        return value / (std::ldexp(1.0, p.bits - 1) - 1);
    }
    const double value = double(level) / (std::ldexp(1.0, p.bits) - 1);
    return p.photometric == PHOTOMETRIC_MINISWHITE ? 1 - value : value;
}

void check_levels(const std::string& path, const TiffPicture& p) {
    CAPTURE(p.bits);
    CAPTURE(p.format);
    CAPTURE(p.photometric);
    CAPTURE(p.compression);
    CAPTURE(p.tiled);
    CAPTURE(p.planes);
    ImageInfo info;
    const Image<float> image = read_image(path, &info);
    REQUIRE(image.width() == p.width);
    REQUIRE(image.height() == p.height);
    REQUIRE(image.channels() == p.per_texel);
    CHECK(info.bits == p.bits);
    double most = 0;
    for (std::size_t i = 0; i < image.size(); ++i) {
        const double want = meaning(p, p.levels[i]);
        most = std::max(most, std::abs(image.data()[i] - want) / std::max(1.0, std::abs(want)));
    }
    CHECK(most < 1.3e-7); // one rounding to float
}

/// A 16 x 16 file of 8 bits whose directory lies before its one or two strips, as some programs write it.
std::string directory_first(int strips, std::uint32_t orientation) {
    const std::uint32_t beyond = 8 + 2 + 10 * 12 + 4, samples = beyond + 16, rows = 16 / std::uint32_t(strips);
    const std::uint32_t arrays[4] = {samples, samples + 128, 128, 128};
    const std::uint32_t offsets = strips == 1 ? samples : beyond, counts = strips == 1 ? 256 : beyond + 8,
                        count = std::uint32_t(strips);
    const std::uint32_t entries[10][3] = {{256, 1, 16},   {257, 1, 16},          {258, 1, 8},           {259, 1, 1},
                                          {262, 1, 1},    {273, count, offsets}, {274, 1, orientation}, {277, 1, 1},
                                          {278, 1, rows}, {279, count, counts}};
    std::string bytes("II*\0\10\0\0\0\12\0", 10);
    const auto put = [&](const void* from, std::size_t size) { bytes.append(static_cast<const char*>(from), size); };
    for (const auto& [tag, many, value] : entries) {
        const std::uint16_t start[2] = {std::uint16_t(tag), 4};
        put(start, 4), put(&many, 4), put(&value, 4);
    }
    bytes.append(4, '\0');
    put(arrays, 16);
    return bytes + std::string(256, '\x40');
}

} // namespace

TEST_SUITE("oracle") {
    TEST_CASE("tiff: levels of every depth, format, storage and compression stand for what the standard says") {
        const Folder folder;
        const std::string path = folder / "a.tif";
        struct {
            int bits, format;
        } const depths[] = {{1, 1},  {2, 1},  {4, 1}, {8, 1},  {12, 1}, {16, 1},
                            {24, 1}, {32, 1}, {8, 2}, {16, 2}, {32, 2}};
        for (const auto& [bits, format] : depths)
            for (const int photometric : {PHOTOMETRIC_MINISBLACK, PHOTOMETRIC_MINISWHITE})
                for (const int compression : {COMPRESSION_NONE, COMPRESSION_LZW, COMPRESSION_ADOBE_DEFLATE})
                    for (const bool tiled : {false, true}) {
                        if (format == 2 && photometric == PHOTOMETRIC_MINISWHITE) continue;
                        TiffPicture p{.width = 37,
                                      .height = 21,
                                      .bits = bits,
                                      .format = format,
                                      .photometric = photometric,
                                      .compression = compression,
                                      .tiled = tiled};
                        p.levels = some_levels(37 * 21, bits);
                        write_tiff(path, p);
                        check_levels(path, p);
                    }
    }

    TEST_CASE("tiff: floats, planes, predictors, bytes and bits in the other order, and wide offsets") {
        const Folder folder;
        const std::string path = folder / "a.tif";
        std::vector<TiffPicture> pictures;
        for (const bool planes : {false, true})
            for (const bool tiled : {false, true})
                for (const int bits : {4, 8, 16, 32})
                    pictures.push_back({.width = 37,
                                        .height = 21,
                                        .per_texel = 3,
                                        .bits = bits,
                                        .photometric = PHOTOMETRIC_RGB,
                                        .tiled = tiled,
                                        .planes = planes});
        for (const int predictor : {1, 3})
            for (const int compression : {COMPRESSION_LZW, COMPRESSION_ADOBE_DEFLATE})
                pictures.push_back({.width = 37,
                                    .height = 21,
                                    .bits = 32,
                                    .format = SAMPLEFORMAT_IEEEFP,
                                    .compression = compression,
                                    .predictor = predictor});
        pictures.push_back({.width = 37, .height = 21, .bits = 32, .format = SAMPLEFORMAT_IEEEFP});
        pictures.push_back({.width = 37, .height = 21, .bits = 64, .format = SAMPLEFORMAT_IEEEFP});
        pictures.push_back(
            {.width = 37, .height = 21, .bits = 16, .compression = COMPRESSION_LZW, .predictor = 2, .tiled = true});
        pictures.push_back({.width = 37, .height = 21, .bits = 1, .fill_order = FILLORDER_LSB2MSB});
        for (TiffPicture& p : pictures) {
            p.levels = some_levels(std::size_t(p.width * p.height * p.per_texel), p.bits);
            for (std::size_t i = 0; i < p.levels.size() && p.format == SAMPLEFORMAT_IEEEFP; ++i) {
                const double value = double(i) * 0.37 - 50;
                p.levels[i] =
                    p.bits == 32 ? std::bit_cast<std::uint32_t>(float(value)) : std::bit_cast<std::uint64_t>(value);
            }
            for (const char* mode : {"wl", "wb", "w8"}) {
                // libtiff swaps the bytes of such floats once too often in writing them.
                if (p.predictor == 3 && mode == std::string("wb")) continue;
                CAPTURE(std::string(mode));
                write_tiff(path, p, mode);
                check_levels(path, p);
            }
        }
    }

    TEST_CASE("tiff: OpenImageIO reads what is written, and it comes back the same") {
        const Folder folder;
        const std::string path = folder / "out.tif";
        for (const int channels : {1, 2, 3, 4, 6})
            for (const Depth depth : {Depth::u8, Depth::u16, Depth::float32})
                for (const Compression compression : {Compression::none, Compression::zip}) {
                    const Image<float> image = pattern(70, 130, channels);
                    WriteOptions options{.depth = depth, .compression = compression};
                    if (channels == 2) options.channels = {"b_u", "b_v"};
                    write_image(path, image, options);
                    ImageInfo info;
                    const Image<float> back = read_image(path, &info);
                    CHECK(same(back, by_openimageio(folder, path)));
                    if (depth == Depth::float32) CHECK(same(back, image));
                    CHECK(info.alpha_channel == (channels == 4 ? 3 : -1));
                    CHECK(info.notes.empty());
                }
    }
}

TEST_SUITE("unit") {
    TEST_CASE("tiff: the same bytes on every run and for any number of threads and of calls") {
        const Folder folder;
        const std::string path = folder / "out.tif";
        const Image<float> image = pattern(300, 200, 1);
        for (const Compression compression : {Compression::none, Compression::zip}) {
            std::string first;
            for (const int threads : {1, 2, 7})
                for (const int rows : {200, 77}) {
                    const ThreadLimit limit(threads);
                    ImageWriter writer(path, 300, 200, 1, {.depth = Depth::u16, .compression = compression});
                    for (int y = 0; y < 200; y += rows) writer.write(image.row(y), std::min(rows, 200 - y));
                    writer.finish();
                    if (first.empty()) first = contents(path);
                    CHECK((contents(path) == first));
                }
        }
    }

    TEST_CASE("tiff: mip levels are read by OpenImageIO, and the first of them here, without a note") {
        const Folder folder;
        const std::string path = folder / "mips.tif";
        for (const Compression compression : {Compression::none, Compression::zip}) {
            ImageWriter writer(path, 150, 70, 2, {.compression = compression, .mips = true});
            std::vector<Image<float>> levels;
            for (int width = 150, height = 70;; width = std::max(1, width / 2), height = std::max(1, height / 2)) {
                if (!levels.empty()) writer.next_level();
                levels.push_back(pattern(width, height, 2));
                writer.write(levels.back().data(), height);
                if (width == 1 && height == 1) break;
            }
            writer.finish();
            for (std::size_t k = 0; k < levels.size(); ++k) CHECK(same(read_level(path, int(k)), levels[k]));
            ImageInfo info;
            CHECK(same(read_image(path, &info), levels[0]));
            CHECK(info.notes.empty());
        }
    }
}

TEST_SUITE("stability") {
    TEST_CASE("tiff: a file cut anywhere is refused, never read in part") {
        const Folder folder;
        const std::string path = folder / "in.tif", cut = folder / "cut.tif";
        for (const int channels : {1, 3})
            for (const Compression compression : {Compression::none, Compression::zip}) {
                write_image(path, pattern(40, 100, channels), {.depth = Depth::u16, .compression = compression});
                const std::string bytes = contents(path);
                for (std::size_t length = 0; length < bytes.size(); length += length < 400 ? 13 : 701) {
                    write_file(cut, bytes.substr(0, length));
                    CHECK_THROWS_AS(read_image(cut), Error);
                }
            }
    }

    TEST_CASE("tiff: a file whose last rows are missing is refused where its directory comes first") {
        const Folder folder;
        const std::string path = folder / "in.tif";
        for (const int strips : {1, 2})
            for (const std::uint32_t orientation : {1u, 2u}) {
                const std::string bytes = directory_first(strips, orientation);
                write_file(path, bytes);
                CHECK(read_image(path).at(15, 15) == doctest::Approx(64 / 255.0));
                for (const std::size_t missing : {1, 128, 129, 255}) {
                    write_file(path, bytes.substr(0, bytes.size() - missing));
                    CHECK_THROWS_WITH_AS(read_image(path), doctest::Contains("is cut short"), Error);
                }
            }
    }

    TEST_CASE("tiff: a header with any one byte changed is read or refused, and nothing is printed") {
        const Folder folder;
        const std::string path = folder / "in.tif", changed = folder / "changed.tif";
        write_image(path, pattern(40, 100, 1), {.depth = Depth::u16});
        const std::string bytes = contents(path);
        for (std::size_t i = 0; i < bytes.size();
             i = i == 7 ? 8 + 2 * 40 * 100 : i + 1) // header and directory, not the samples
            for (const char value : {'\0', '\1', '\x7f', '\xff'}) {
                std::string other = bytes;
                other[i] = value;
                write_file(changed, other);
                try {
                    const Image<float> image = read_image(changed, nullptr, {.max_bytes = 1 << 24});
                    CHECK(image.size() > 0);
                } catch (const Error& error) {
                    CHECK((error.refusal == Refusal::unreadable || error.refusal == Refusal::unsuitable));
                }
            }
        // libtiff warns of a tag that it does not know, and of damage.
        std::string other = bytes;
        other[bytes.size() - 13] = '\x7f';
        write_file(changed, other);
        CHECK(lines(run_bake(folder, {"check", "changed.tif"}).err) <= 1);
    }

    TEST_CASE("tiff: a picture over the limit is refused") {
        const Folder folder;
        const std::string path = folder / "in.tif";
        write_image(path, pattern(64, 64, 1), {.depth = Depth::u16});
        CHECK(read_image(path, nullptr, {.max_bytes = 4 * 64 * 64}).width() == 64);
        CHECK_THROWS_AS(read_image(path, nullptr, {.max_bytes = 4 * 64 * 64 - 1}), Error);
    }
}
