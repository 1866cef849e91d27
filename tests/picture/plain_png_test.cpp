#include "bake/picture/image_io.h"
#include "bake/picture/plain_png.h"
#include "cli/command.h"
#include "picture/png_bytes.h"
#include <doctest/doctest.h>
#include <random>

using namespace bake;
using namespace bake::test;

namespace {

bool same(const Image<float>& a, const Image<float>& b) {
    return a.width() == b.width() && a.height() == b.height() && a.channels() == b.channels() &&
           std::equal(a.data(), a.data() + a.size(), b.data());
}

/// What OpenImageIO makes of the file. A histogram without palette does not belong into a PNG: that is left to it.
Image<float> by_openimageio(const Folder& folder, const std::string& path, ImageInfo& info) {
    const std::string bytes = contents(path), other = folder / "other.png";
    write_file(other, bytes.substr(0, 33) + png_chunk("hIST", "??") + bytes.substr(33));
    CHECK_FALSE(read_plain_png(other, {}));
    return read_image(other, &info);
}

void check_same_info(const ImageInfo& a, const ImageInfo& b) {
    CHECK(a.channels == b.channels);
    CHECK(a.alpha_channel == b.alpha_channel);
    CHECK(a.bits == b.bits);
    CHECK(a.srgb_tagged == b.srgb_tagged);
}

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("plain_png: samples of 8 and 16 bits, and what the file says of them") {
        const Folder folder;
        const std::string path = folder / "a.png";
        write_file(path, png_bytes(2, 2, 8, 0, {std::string("\x00\xff", 2), "\x80\x01"}));
        const auto grey = read_plain_png(path, {});
        REQUIRE(grey);
        CHECK(grey->image.channels() == 1);
        CHECK(grey->image.at(0, 0) == 0);
        CHECK(grey->image.at(1, 0) == 1);
        CHECK(grey->image.at(0, 1) == doctest::Approx(128 / 255.0));
        CHECK(grey->info.channels == std::vector<std::string>{"Y"});
        CHECK_FALSE(grey->info.srgb_tagged);

        write_file(path, png_bytes(1, 1, 16, 6, {std::string("\x01\x00\xff\xff\x00\x01\x80\x00", 8)}, srgb_tag()));
        const auto colour = read_plain_png(path, {});
        REQUIRE(colour);
        CHECK(colour->image.at(0, 0, 0) == doctest::Approx(256 / 65535.0));
        CHECK(colour->image.at(0, 0, 1) == 1);
        CHECK(colour->image.at(0, 0, 2) == doctest::Approx(1 / 65535.0));
        CHECK(colour->info.bits == 16);
        CHECK(colour->info.alpha_channel == 3);
        CHECK(colour->info.srgb_tagged);
    }

    TEST_CASE("plain_png: what is not plain, or does not add up, is left to OpenImageIO") {
        const Folder folder;
        const std::string path = folder / "a.png", rows = std::string("\x01\x02", 2);
        const auto given = [&](const std::string& bytes) {
            write_file(path, bytes);
            return read_plain_png(path, {}).has_value();
        };
        const std::string good = png_bytes(2, 1, 8, 0, {rows});
        CHECK(given(good));
        CHECK(given(good + "what follows the end"));
        CHECK_FALSE(given(png_bytes(8, 1, 4, 0, {std::string(4, '\1')})));                          // 4 bits
        CHECK_FALSE(given(png_bytes(2, 1, 8, 3, {rows}, png_chunk("PLTE", std::string(9, '\1'))))); // palette
        CHECK_FALSE(given(png_bytes(2, 1, 8, 0, {rows}, png_chunk("tRNS", std::string(2, '\1'))))); // transparency
        CHECK(given(png_bytes(2, 1, 8, 0, {rows}, png_chunk("oFFs", std::string(9, '\0')))));
        CHECK_FALSE(
            given(png_bytes(2, 1, 8, 0, {rows}, png_chunk("oFFs", std::string(7, '\0') + std::string("\1\0", 2)))));
        CHECK_FALSE(given(good.substr(0, good.size() - 12))); // no end
        CHECK_FALSE(given(good.substr(0, 40)));
        CHECK_FALSE(given(png_bytes(2, 2, 8, 0, {rows}))); // too few rows
        CHECK_FALSE(given(png_bytes(0, 1, 8, 0, {rows})));
        CHECK_FALSE(given(png_bytes(1 << 19, 1 << 19, 8, 0, {rows}))); // more than its bytes can hold
        std::string interlaced = png_bytes(2, 1, 8, 0, {rows});
        interlaced[28] = 1;
        CHECK_FALSE(given(interlaced));
        for (std::size_t i = 8; i < good.size(); ++i) { // a flipped bit is seen wherever it is
            std::string damaged = good;
            damaged[i] = char(damaged[i] ^ 4);
            CHECK_FALSE(given(damaged));
        }
        CHECK_FALSE(read_plain_png(folder / "absent.png", {}));
        write_file(path, good);
        CHECK_FALSE(read_plain_png(path, {.max_bytes = 7}));
    }
}

TEST_SUITE("oracle") {
    TEST_CASE("plain_png: the same floats as OpenImageIO, for all filters") {
        const Folder folder;
        std::mt19937 random(4);
        for (const int channels : {1, 2, 3, 4})
            for (const Depth depth : {Depth::u8, Depth::u16}) {
                // Smooth, so that the writer uses every filter, with a little noise.
                Image<float> image(61, 47, channels);
                for (int y = 0; y < image.height(); ++y)
                    for (int x = 0; x < image.width() * channels; ++x)
                        image.row(y)[x] = 0.5f + 0.3f * std::sin(0.1f * float(x)) * std::cos(0.07f * float(y * y)) +
                                          float(random() % 100) * 0.001f;
                const std::string path = folder / "a.png";
                write_image(path, image, {.depth = depth});
                const auto plain = read_plain_png(path, {});
                REQUIRE(plain);
                ImageInfo info;
                CHECK(same(plain->image, by_openimageio(folder, path, info)));
                check_same_info(plain->info, info);
            }
    }
}

TEST_SUITE("real" * doctest::skip(test::no_shared_data())) {
    TEST_CASE("plain_png: real files are read as OpenImageIO reads them") {
        const Folder folder;
        int plain_files = 0;
        for (const auto& entry : fs::recursive_directory_iterator(shared_data())) {
            if (entry.path().extension() != ".png" || entry.file_size() > 1500000) continue;
            const auto plain = read_plain_png(entry.path().string(), {});
            if (!plain) continue;
            ++plain_files;
            CAPTURE(entry.path().string());
            ImageInfo info;
            CHECK(same(plain->image, by_openimageio(folder, entry.path().string(), info)));
            check_same_info(plain->info, info);
        }
        CHECK(plain_files > 10);
    }
}
