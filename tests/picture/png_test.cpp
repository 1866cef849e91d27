#include "bake/base/error.h"
#include "bake/base/parallel.h"
#include "bake/picture/image_io.h"
#include "picture/openimageio.h"
#include "picture/png_bytes.h"
#include <cmath>
#include <cstring>
#include <random>

using namespace bake;
using namespace bake::test;

namespace {

/// Smooth, so that every filter is used, with a little noise.
Image<float> waves(int width, int height, int channels) {
    std::mt19937 random(4);
    Image<float> image(width, height, channels);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width * channels; ++x)
            image.row(y)[x] = 0.5f + 0.3f * std::sin(0.1f * float(x)) * std::cos(0.07f * float(y % 600 * (y % 600))) +
                              float(random() % 100) * 0.001f;
    return image;
}

bool refused(const std::string& path) try {
    read_image(path);
    return false;
} catch (const Error& error) {
    CHECK(error.refusal == Refusal::unreadable);
    return true;
}

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("png: samples of 8 and 16 bits, and what the file says of them") {
        const Folder folder;
        const std::string path = folder / "a.png";
        ImageInfo info;
        write_file(path, png_bytes(2, 2, 8, 0, {std::string("\x00\xff", 2), "\x80\x01"}));
        const Image<float> grey = read_image(path, &info);
        CHECK(grey.channels() == 1);
        CHECK(grey.at(0, 0) == 0);
        CHECK(grey.at(1, 0) == 1);
        CHECK(grey.at(0, 1) == doctest::Approx(128 / 255.0));
        CHECK(info.channels == std::vector<std::string>{"Y"});
        CHECK_FALSE(info.srgb_tagged);

        write_file(path, png_bytes(1, 1, 16, 6, {std::string("\x01\x00\xff\xff\x00\x01\x80\x00", 8)}, srgb_tag()));
        const Image<float> colour = read_image(path, &info);
        CHECK(colour.at(0, 0, 0) == doctest::Approx(256 / 65535.0));
        CHECK(colour.at(0, 0, 1) == 1);
        CHECK(colour.at(0, 0, 2) == doctest::Approx(1 / 65535.0));
        CHECK(info.bits == 16);
        CHECK(info.alpha_channel == 3);
        CHECK(info.srgb_tagged);
    }

    TEST_CASE("png: palettes become colours, transparent colours an alpha channel") {
        const Folder folder;
        const std::string path = folder / "a.png", palette = png_chunk("PLTE", "\x10\x20\x30\x40\x50\x60");
        ImageInfo info;
        write_file(path, png_bytes(2, 1, 1, 3, {"\x40"}, palette));
        const Image<float> colours = read_image(path, &info);
        CHECK(info.channels == std::vector<std::string>{"R", "G", "B"});
        CHECK(info.bits == 8);
        CHECK(colours.at(0, 0, 2) == doctest::Approx(0x30 / 255.0));
        CHECK(colours.at(1, 0, 0) == doctest::Approx(0x40 / 255.0));

        write_file(path, png_bytes(2, 1, 8, 3, {std::string("\x01\x00", 2)}, palette + png_chunk("tRNS", "\x33")));
        const Image<float> clear = read_image(path, &info);
        CHECK(info.channels == std::vector<std::string>{"R", "G", "B", "A"});
        CHECK(info.alpha_channel == 3);
        CHECK(clear.at(0, 0, 3) == 1);
        CHECK(clear.at(1, 0, 3) == doctest::Approx(0x33 / 255.0));

        write_file(path, png_bytes(2, 1, 8, 0, {"\x07\x08"}, png_chunk("tRNS", std::string("\x00\x07", 2))));
        const Image<float> grey = read_image(path, &info);
        CHECK(info.channels == std::vector<std::string>{"Y", "A"});
        CHECK(grey.at(0, 0, 1) == 0);
        CHECK(grey.at(1, 0, 1) == 1);
        CHECK(grey.at(0, 0, 0) == doctest::Approx(7 / 255.0));
    }

    TEST_CASE("png: a position on a page moves no texel, an orientation in eXIf is told, a palette too") {
        const Folder folder;
        const std::string path = folder / "a.png";
        ImageInfo info;
        const std::string offset = big_endian(1) + big_endian(std::uint32_t(-1)) + std::string(1, '\0');
        write_file(path, png_bytes(2, 1, 8, 0, {"\x10\x20"}, png_chunk("oFFs", offset)));
        Image<float> image = read_image(path, &info);
        CHECK(image.at(0, 0) == doctest::Approx(16 / 255.0));
        CHECK(image.at(1, 0) == doctest::Approx(32 / 255.0));
        CHECK(info.notes.empty());

        const std::string exif("MM\0*\0\0\0\10\0\1\1\22\0\3\0\0\0\1\0\6\0\0\0\0\0\0", 26);
        write_file(path, png_bytes(2, 1, 8, 0, {"\x10\x20"}, png_chunk("eXIf", exif)));
        CHECK(read_image(path, &info).width() == 2);
        REQUIRE(info.notes.size() == 1);
        CHECK(info.notes[0].find("orientation 6") != std::string::npos);

        write_file(path, png_bytes(2, 1, 8, 0, {"\x10\x20"}, png_chunk("acTL", std::string("\0\0\0\2\0\0\0\0", 8))));
        read_image(path, &info);
        REQUIRE(info.notes.size() == 1);
        CHECK(info.notes[0].find("animation") != std::string::npos);

        write_file(path, png_bytes(2, 1, 1, 3, {"\x40"}, png_chunk("PLTE", std::string("\0\0\0\xff\xff\xff", 6))));
        read_image(path, &info);
        CHECK_FALSE(info.palette); // a ramp of greys
        write_file(path, png_bytes(2, 1, 1, 3, {"\x40"}, png_chunk("PLTE", std::string("\xff\xff\xff\0\0\0", 6))));
        image = read_image(path, &info);
        CHECK(info.palette);
        CHECK(image.at(0, 0) == 1);
    }

    TEST_CASE("png: damage is refused, unless every texel is what it was") {
        const Folder folder;
        const std::string path = folder / "a.png", rows = std::string("\x01\x02", 2);
        const auto given = [&](const std::string& bytes) {
            write_file(path, bytes);
            return !refused(path);
        };
        const std::string good = png_bytes(2, 1, 8, 0, {rows});
        CHECK(given(good));
        // A chunk that claims 1.9 GB, of which nothing follows: refused before the memory is taken.
        write_file(path, good.substr(0, 33) + big_endian(2'000'000'000) + "tEXtComment");
        CHECK_THROWS_WITH_AS(read_image(path), doctest::Contains("has a chunk that is longer than the file"), Error);
        CHECK(given(good + "what follows the end"));
        CHECK(given(good.substr(0, good.size() - 12))); // no end
        CHECK_FALSE(given(good.substr(0, 40)));
        CHECK_FALSE(given(png_bytes(2, 2, 8, 0, {rows}))); // too few rows
        CHECK_FALSE(given(png_bytes(0, 1, 8, 0, {rows})));
        CHECK_FALSE(given(png_bytes(1 << 19, 1 << 19, 8, 0, {rows}))); // more than its bytes can hold
        std::size_t unnoticed = 0;
        for (std::size_t i = 8; i < good.size(); ++i) {
            std::string damaged = good;
            damaged[i] = char(damaged[i] ^ 4);
            if (!given(damaged)) continue;
            ++unnoticed;
            const Image<float> image = read_image(path);
            CHECK(image.at(0, 0) == doctest::Approx(1 / 255.0));
            CHECK(image.at(1, 0) == doctest::Approx(2 / 255.0));
        }
        CHECK(unnoticed <= 12); // in the end mark
        write_file(path, good);
        CHECK_THROWS_AS(read_image(path, nullptr, {.max_bytes = 7}), Error);
    }

    TEST_CASE("png: the same bytes for any number of threads and of calls, over several groups of blocks") {
        const Folder folder;
        const Image<float> image = waves(1500, 1200, 3); // 10.8 MB of 16 bits
        std::string first;
        for (const int threads : {1, 2, 7})
            for (const int rows : {1200, 77}) {
                const ThreadLimit limit(threads);
                ImageWriter writer(folder / "a.png", 1500, 1200, 3, {});
                for (int y = 0; y < 1200; y += rows) writer.write(image.row(y), std::min(rows, 1200 - y));
                writer.finish();
                if (first.empty()) first = contents(folder / "a.png");
                CHECK((contents(folder / "a.png") == first));
            }
        const Image<float> back = read_image(folder / "a.png");
        float most = 0;
        for (std::size_t i = 0; i < image.size(); ++i)
            most = std::max(most, std::abs(back.data()[i] - image.data()[i]));
        CHECK(most <= 0.51f / 65535);
    }

    TEST_CASE("png: the first row of a group of blocks is filtered against the last row of the group before it") {
        // All rows are the same, so that every row but the first is filtered by the row above it. Each byte is half of the
        // byte before it plus or minus some levels, modulo 256: if the row above were taken as 0, filtering by the average
        // would win, and a reader, which knows the row above, would read other values.
        std::mt19937 random(2);
        Image<float> row(4500, 1, 1);
        for (int x = 0, value = 128; x < row.width(); ++x) {
            value = (value / 2 + 248 + int(random() % 16)) % 256;
            row.at(x, 0) = float(value) / 255;
        }
        const Folder folder;
        const std::string path = folder / "a.png";
        const int height = 1900; // 8.5 MB; a group has 8 MiB
        ImageWriter writer(path, row.width(), height, 1, {.depth = Depth::u8});
        for (int y = 0; y < height; ++y) writer.write(row.data(), 1);
        writer.finish();
        const Image<float> back = read_image(path);
        int wrong = 0;
        for (int y = 0; y < height; ++y)
            wrong += std::memcmp(back.row(y), back.row(0), row.size() * sizeof(float)) != 0;
        CHECK(wrong == 0);
        CHECK(std::abs(back.at(17, 0) - row.at(17, 0)) < 1e-6f);
    }

    TEST_CASE("png: rows that repeat cost a small part of what noise does") {
        const Folder folder;
        std::mt19937 random(1);
        Image<float> tile(64, 64, 1), image(1024, 1024, 1), noise(1024, 1024, 1);
        for (std::size_t i = 0; i < tile.size(); ++i) tile.data()[i] = float(random() % 256) / 255;
        for (std::size_t i = 0; i < noise.size(); ++i) noise.data()[i] = float(random() % 256) / 255;
        for (int y = 0; y < 1024; ++y)
            for (int x = 0; x < 1024; ++x) image.at(x, y) = tile.at(x % 64, y % 64);
        write_image(folder / "tiles.png", image, {.depth = Depth::u8});
        write_image(folder / "noise.png", noise, {.depth = Depth::u8});
        CHECK(fs::file_size(folder / "tiles.png") * 10 < fs::file_size(folder / "noise.png"));
        CHECK(fs::file_size(folder / "noise.png") < 1.01 * 1024 * 1024);
    }

    TEST_CASE("png: a channel too many and mips are refused") {
        const Folder folder;
        CHECK_THROWS_AS(ImageWriter(folder / "a.png", 4, 4, 5, {}), Error);
        CHECK_THROWS_AS(ImageWriter(folder / "a.png", 4, 4, 1, {.mips = true}), Error);
        CHECK(folder.names().empty());
    }
}

TEST_SUITE("oracle") {
    TEST_CASE("png: OpenImageIO reads the same floats out of what is written, for all channels and depths") {
        const Folder folder;
        for (const int channels : {1, 2, 3, 4})
            for (const Depth depth : {Depth::u8, Depth::u16}) {
                const std::string path = folder / "a.png";
                write_image(path, waves(61, 47, channels),
                            {.depth = depth, .colour = channels == 3 ? ColourSpace::srgb : ColourSpace::automatic});
                ImageInfo info;
                CHECK(same(read_image(path, &info), by_openimageio(folder, path)));
                CHECK(info.srgb_tagged == (channels == 3));
            }
    }
}

TEST_SUITE("real" * doctest::skip(no_shared_data())) {
    TEST_CASE("png: real files are read as OpenImageIO reads them") {
        const Folder folder;
        int files = 0;
        for (const auto& entry : fs::recursive_directory_iterator(shared_data())) {
            const std::string path = entry.path().string();
            if (entry.path().extension() != ".png" || path.find("/bad/") != std::string::npos ||
                entry.file_size() > 800000)
                continue;
            ++files;
            CAPTURE(path);
            CHECK(same(read_image(path), by_openimageio(folder, path)));
        }
        CHECK(files > 10);
    }
}
