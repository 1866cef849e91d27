#include "bake/base/error.h"
#include "bake/base/vec.h"
#include "bake/picture/bc5.h"
#include "bake/picture/image_io.h"
#include "bake/picture/masked_texels.h"
#include "bake/picture/texture_file.h"
#include "picture/openimageio.h"
#include <algorithm>

using namespace bake;
using namespace bake::test;

namespace {

constexpr TexelFormat formats[] = {TexelFormat::r8, TexelFormat::rgba8, TexelFormat::rgba16, TexelFormat::bc5};

/// Unit normals, or colours, that differ from texel to texel and from level to level.
Image<float> values(int width, int height, TexelFormat format) {
    Image<float> image(width, height, 3);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const Vec3d n = glm::normalize(Vec3d(0.4 * std::sin(0.31 * x + width), 0.3 * std::cos(0.23 * y + x), 1));
            for (int c = 0; c < 3; ++c) image.at(x, y, c) = float(format == TexelFormat::bc5 ? n[c] : 0.5 * n[c] + 0.5);
        }
    return image;
}

std::vector<TextureLevel> chain(int width, int height, TexelFormat format) {
    std::vector<TextureLevel> levels = {pack_level(values(width, height, format), format)};
    while (std::max(width, height) > 1) {
        width = std::max(1, width / 2), height = std::max(1, height / 2);
        levels.push_back(pack_level(values(width, height, format), format));
    }
    return levels;
}

std::string written(const std::string& path, int width, int height, TexelFormat format) {
    BlockWriter out(path);
    write_texture(out, *texture_container(path), format, chain(width, height, format));
    out.commit();
    return contents(path);
}

std::uint64_t number(const std::string& bytes, std::size_t at, std::size_t size) {
    const std::uint64_t low = little_endian(bytes, at, std::min<std::size_t>(size, 4));
    return size == 8 ? low | std::uint64_t(little_endian(bytes, at + 4, 4)) << 32 : low;
}

std::string refusal(const std::string& path, const std::string& bytes) {
    write_file(path, bytes);
    try {
        read_image(path);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("write_texture: what is written is read back, the largest level, in both containers") {
        const Folder folder;
        for (const char* name : {"a.dds", "a.KTX2"})
            for (const TexelFormat format : formats)
                for (const auto& [width, height] : {std::pair(16, 16), std::pair(13, 6), std::pair(1, 1)}) {
                    CAPTURE(name);
                    CAPTURE(int(format));
                    CAPTURE(width);
                    written(folder / name, width, height, format);
                    ImageInfo info;
                    const Image<float> read = read_image(folder / name, &info), truth = values(width, height, format);
                    REQUIRE(read.width() == width);
                    REQUIRE(read.height() == height);
                    const bool bc5 = format == TexelFormat::bc5, wide = format == TexelFormat::rgba16;
                    REQUIRE(read.channels() == (bc5 ? 3 : format == TexelFormat::r8 ? 1 : 4));
                    CHECK(info.type == (bc5 ? SampleType::float32 : wide ? SampleType::u16 : SampleType::u8));
                    CHECK(info.notes.size() == std::size_t(bc5));
                    const double tolerance = bc5 ? 0.03 : wide ? 0.51 / 65535 : 0.51 / 255;
                    for (int y = 0; y < height; ++y)
                        for (int x = 0; x < width; ++x) {
                            for (int c = 0; c < std::min(3, read.channels()); ++c) {
                                const float value = truth.at(x, y, c);
                                CHECK(std::abs(read.at(x, y, c) - (bc5 ? 0.5f * value + 0.5f : value)) < tolerance);
                            }
                            if (read.channels() == 4) CHECK(read.at(x, y, 3) == 1);
                        }
                }
    }
    TEST_CASE("write_texture: OpenImageIO reads every level of a DDS in blocks") {
        const Folder folder;
        written(folder / "a.dds", 24, 10, TexelFormat::bc5);
        int width = 24, height = 10;
        for (int level = 0; level < 5; ++level, width = std::max(1, width / 2), height = std::max(1, height / 2)) {
            CAPTURE(level);
            const Image<float> read = by_openimageio(folder, folder / "a.dds", level);
            REQUIRE(read.width() == width);
            REQUIRE(read.height() == height);
            REQUIRE(read.channels() == 2);
            Image<float> ours(width, height, 2);
            bc5_decode(pack_level(values(width, height, TexelFormat::bc5), TexelFormat::bc5).bytes.data(), ours);
            for (std::size_t i = 0; i < ours.size(); ++i) // OpenImageIO rounds what it interpolates to 8 bits, down too
                CHECK(std::abs(read.data()[i] - (0.5f * ours.data()[i] + 0.5f)) < 1.01f / 255);
        }
    }
    TEST_CASE("write_texture: a KTX2 is laid out as its specification demands") {
        const Folder folder;
        const std::uint64_t vulkan[] = {9, 37, 91, 141}, block_bytes[] = {1, 4, 8, 16}, model[] = {1, 1, 1, 132},
                            samples[] = {1, 4, 4, 2}, alignment[] = {4, 4, 8, 16}, swapped[] = {1, 1, 2, 1};
        for (std::size_t k = 0; k < 4; ++k) {
            CAPTURE(k);
            const std::string bytes = written(folder / "a.ktx2", 20, 12, formats[k]);
            CHECK(bytes.substr(0, 12) == std::string("\xabKTX 20\xbb\r\n\x1a\n"));
            const std::uint64_t header[] = {vulkan[k], swapped[k], 20, 12, 0, 0, 1, 5, 0};
            for (std::size_t i = 0; i < 9; ++i) CHECK(number(bytes, 12 + 4 * i, 4) == header[i]);
            const std::size_t dfd = 80 + 5 * 24, dfd_size = 28 + 16 * samples[k];
            CHECK(number(bytes, 48, 4) == dfd);
            CHECK(number(bytes, 52, 4) == dfd_size);
            CHECK(number(bytes, 56, 4) == dfd + dfd_size);
            const std::size_t pairs_size = number(bytes, 60, 4);
            CHECK(number(bytes, 64, 8) == 0);
            CHECK(number(bytes, 72, 8) == 0);
            // The descriptor.
            CHECK(number(bytes, dfd, 4) == dfd_size);
            CHECK(number(bytes, dfd + 4, 4) == 0);
            CHECK(number(bytes, dfd + 8, 2) == 2);
            CHECK(number(bytes, dfd + 10, 2) == dfd_size - 4);
            CHECK(number(bytes, dfd + 12, 1) == model[k]);
            CHECK(number(bytes, dfd + 14, 1) == 1); // linear
            CHECK(number(bytes, dfd + 16, 2) == (k == 3 ? 0x0303 : 0));
            CHECK(number(bytes, dfd + 20, 1) == block_bytes[k]);
            std::uint64_t bit = 0;
            for (std::size_t s = 0; s < samples[k]; ++s) {
                const std::size_t at = dfd + 28 + 16 * s;
                CHECK(number(bytes, at, 2) == bit);
                bit += number(bytes, at + 2, 1) + 1;
                CHECK(number(bytes, at + 3, 1) == (s == 3 ? 15 : s));
                CHECK(number(bytes, at + 8, 4) == 0);
                CHECK(number(bytes, at + 12, 4) == (k == 3 ? 0xffffffff : k == 2 ? 65535 : 255));
            }
            CHECK(bit == 8 * block_bytes[k]);
            CHECK(bytes.substr(dfd + dfd_size, 4 + 18 + 2).find("KTXorientation") == 4);
            CHECK(bytes.find("KTXwriter") < dfd + dfd_size + pairs_size);
            // Levels: smallest first, aligned, without gaps beyond the alignment, up to the end.
            std::size_t end = dfd + dfd_size + pairs_size;
            const auto levels = chain(20, 12, formats[k]);
            for (std::size_t level = 5; level-- > 0;) {
                const std::size_t place = number(bytes, 80 + 24 * level, 8), size = number(bytes, 88 + 24 * level, 8);
                CHECK(place % alignment[k] == 0);
                CHECK(place >= end);
                CHECK(place < end + alignment[k]);
                CHECK(number(bytes, 96 + 24 * level, 8) == size);
                CHECK(bytes.substr(place, size) == levels[level].bytes);
                end = place + size;
            }
            CHECK(end == bytes.size());
        }
    }
    TEST_CASE("read_ktx2: a file that is cut anywhere, supercompressed, a cube, a volume or turned over is refused") {
        const Folder folder;
        const std::string path = folder / "a.ktx2", whole = written(path, 8, 8, TexelFormat::bc5);
        for (std::size_t size = 12; size < whole.size(); size += size < 300 ? 7 : 1) {
            CAPTURE(size);
            CHECK(refusal(path, whole.substr(0, size)).find("is cut short") != std::string::npos);
        }
        const auto changed = [&](std::size_t at, char to) {
            std::string bytes = whole;
            bytes[at] = to;
            return refusal(path, bytes);
        };
        CHECK(refusal(path, whole) == "");
        CHECK(changed(12, 4).find("of the format 4") != std::string::npos);
        CHECK(changed(20, 0).find("no pixels") != std::string::npos);
        CHECK(changed(21, 4).find("a level that is smaller") != std::string::npos);
        CHECK(changed(22, 100).find("more pixels") != std::string::npos);
        CHECK(changed(28, 1).find("volume") != std::string::npos);
        CHECK(changed(36, 6).find("a level that is smaller") != std::string::npos);
        CHECK(changed(44, 2).find("supercompressed") != std::string::npos);
        CHECK(changed(52, 4).find("no descriptor of its data format") != std::string::npos);
        CHECK(changed(whole.find("rd", 200) + 1, 'u').find("from the bottom up") != std::string::npos);
        CHECK(changed(80, '\xff').find("cut short") != std::string::npos);
        CHECK(changed(87, '\x7f').find("cut short") != std::string::npos); // beyond any file
    }
}

TEST_SUITE("unit") {
    TEST_CASE("write_texture: cube maps of radiance are read back, face by face and level by level") {
        const Folder folder;
        const auto value = [](int size, int face, int x, int y, int c) {
            return 0.25 * (1 + face) * (c + 1) * (1 + 0.5 * std::sin(0.7 * x + 0.3 * y + size));
        };
        for (const char* ending : {".dds", ".ktx2"})
            for (const TexelFormat format : {TexelFormat::rgb9e5, TexelFormat::rgba16f, TexelFormat::bc6h}) {
                CAPTURE(ending);
                CAPTURE(int(format));
                const std::string path = folder / ("cube" + std::string(ending));
                std::vector<TextureLevel> levels;
                for (int size = 16; size >= 2; size /= 2) {
                    TextureLevel level{size, size};
                    for (int face = 0; face < 6; ++face) {
                        Image<float> image(size, size, 3);
                        for (int y = 0; y < size; ++y)
                            for (int x = 0; x < size; ++x)
                                for (int c = 0; c < 3; ++c) image.at(x, y, c) = float(value(size, face, x, y, c));
                        level.bytes += pack_level(image, format).bytes;
                    }
                    levels.push_back(level);
                }
                BlockWriter out(path);
                write_texture(out, *texture_container(path), format, levels, 6);
                const std::vector<Image<float>> read = read_back_levels(out, path, *texture_container(path));
                out.commit();
                REQUIRE(read.size() == 4);
                double most = 0;
                for (std::size_t k = 0; k < 4; ++k) {
                    const int size = 16 >> k;
                    REQUIRE(read[k].height() == 6 * size);
                    for (int y = 0; y < 6 * size; ++y)
                        for (int x = 0; x < size; ++x)
                            for (int c = 0; c < 3; ++c) {
                                const double v = value(size, y / size, x, y % size, c);
                                most = std::max(most, std::abs(double(read[k].at(x, y, c)) / v - 1));
                            }
                }
                CHECK(most < (format == TexelFormat::rgba16f ? 5e-4 : format == TexelFormat::rgb9e5 ? 0.012 : 0.1));
                ImageInfo info;
                const Image<float> largest = read_image(path, &info);
                CHECK(info.environment == EnvironmentTag::cube);
                CHECK(std::equal(largest.data(), largest.data() + largest.size(), read[0].data()));
            }
    }
}
