#include "bake/base/error.h"
#include "bake/picture/image_io.h"
#include "cli/command.h"

using namespace bake;
using namespace bake::test;

namespace {

std::string little(std::uint32_t n, int bytes) {
    std::string text;
    for (int i = 0; i < bytes; ++i) text += char(n >> 8 * i);
    return text;
}

/// 2 x 2 texels, the rows as they are stored. A header of 124 bytes has room for all masks.
std::string bmp(int bits, int method, const std::vector<std::uint32_t>& masks, const std::vector<std::uint32_t>& texels,
                int height = 2) {
    std::string header = little(124, 4) + little(2, 4) + little(std::uint32_t(height), 4) + little(1, 2) +
                         little(std::uint32_t(bits), 2) + little(std::uint32_t(method), 4);
    header.resize(40);
    for (const std::uint32_t mask : masks) header += little(mask, 4);
    header.resize(124);
    std::string body;
    for (const std::uint32_t texel : texels) body += little(texel, bits / 8);
    return "BM" + little(std::uint32_t(14 + 124 + body.size()), 4) + little(0, 4) + little(14 + 124, 4) + header + body;
}

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("bmp: channels lie where their masks say, rows run upwards unless the height is negative") {
        const Folder folder;
        const std::string path = folder / "a.bmp";
        ImageInfo info;
        write_file(path, bmp(32, 3, {0xff000000, 0xff0000, 0xff00}, {0x01020300, 0, 0, 0x10203000}));
        Image<float> image = read_image(path, &info);
        REQUIRE(image.channels() == 3);
        CHECK(image.at(0, 1, 0) == doctest::Approx(1 / 255.0));
        CHECK(image.at(0, 1, 2) == doctest::Approx(3 / 255.0));
        CHECK(image.at(1, 0, 1) == doctest::Approx(0x20 / 255.0));
        CHECK(info.bits == 8);

        write_file(path, bmp(32, 3, {0xff, 0xff00, 0xff0000, 0xff000000}, {0x80030201, 0, 0, 0}, -2));
        image = read_image(path, &info);
        REQUIRE(image.channels() == 4);
        CHECK(info.alpha_channel == 3);
        CHECK(image.at(0, 0, 0) == doctest::Approx(1 / 255.0));
        CHECK(image.at(0, 0, 3) == doctest::Approx(128 / 255.0));

        write_file(path, bmp(16, 3, {0xf800, 0x7e0, 0x1f}, {0xf800, 0x7e0, 0x1f, 0x8410}));
        image = read_image(path);
        CHECK(image.at(0, 1, 0) == 1);
        CHECK(image.at(1, 1, 1) == 1);
        CHECK(image.at(0, 0, 2) == 1);
        CHECK(image.at(1, 0, 1) == doctest::Approx(32 / 63.0));

        write_file(path, bmp(16, 0, {}, {0x7c00, 0x3e0, 0x1f, 0x8000}));
        image = read_image(path);
        CHECK(image.at(0, 1, 0) == 1);
        CHECK(image.at(1, 1, 1) == 1);
        CHECK(image.at(1, 0, 0) == 0); // the unused bit

        write_file(path, bmp(32, 3, {0x3ff00000, 0xffc00, 0x3ff}, {0x20000000, 0, 0, 0}));
        image = read_image(path, &info);
        CHECK(info.bits == 10);
        CHECK(image.at(0, 1, 0) == doctest::Approx(512 / 1023.0));
    }

    TEST_CASE("bmp: cut files and masks with gaps are refused") {
        const Folder folder;
        const std::string path = folder / "a.bmp";
        const std::string good = bmp(32, 3, {0xff0000, 0xff00, 0xff}, {1, 2, 3, 4});
        write_file(path, good);
        CHECK(read_image(path).width() == 2);
        for (const std::string& bytes :
             {good.substr(0, good.size() - 1), bmp(32, 3, {0xf0f0, 0xff0000, 0xf}, {1, 2, 3, 4}),
              bmp(32, 3, {0, 0xff0000, 0xf}, {1, 2, 3, 4})}) {
            write_file(path, bytes);
            CHECK_THROWS_AS(read_image(path), Error);
        }
    }
}
