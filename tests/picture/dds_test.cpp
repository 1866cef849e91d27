#include "bake/base/error.h"
#include "bake/picture/image_io.h"
#include "cli/command.h"

using namespace bake;
using namespace bake::test;

namespace {

void put(std::string& bytes, std::size_t at, std::uint32_t n) {
    for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = char(n >> 8 * i);
}

/// 2 x 1 texels.
std::string dds(std::uint32_t flags, std::uint32_t bits, const std::vector<std::uint32_t>& masks,
                const std::string& texels) {
    std::string bytes(128, '\0');
    bytes.replace(0, 4, "DDS ");
    put(bytes, 4, 124), put(bytes, 8, 0x1007), put(bytes, 12, 1), put(bytes, 16, 2);
    put(bytes, 76, 32), put(bytes, 80, flags), put(bytes, 88, bits), put(bytes, 108, 0x1000);
    for (std::size_t i = 0; i < masks.size(); ++i) put(bytes, 92 + 4 * i, masks[i]);
    return bytes + texels;
}

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("dds: channels of 10 and 16 bits keep all of them") {
        const Folder folder;
        const std::string path = folder / "a.dds";
        ImageInfo info;
        const std::string grey = dds(0x20000, 16, {0xffff}, std::string("\1\0\xff\xff", 4));
        write_file(path, grey);
        Image<float> image = read_image(path, &info);
        CHECK(info.bits == 16);
        CHECK(info.channels == std::vector<std::string>{"Y"});
        CHECK(image.at(0, 0) == doctest::Approx(1 / 65535.0));
        CHECK(image.at(1, 0) == 1);

        write_file(path, dds(0x41, 32, {0x3ff, 0xffc00, 0x3ff00000, 0xc0000000}, std::string("\1\0\0\x40\0\0\0\0", 8)));
        image = read_image(path, &info);
        CHECK(info.bits == 10);
        REQUIRE(image.channels() == 4);
        CHECK(image.at(0, 0, 0) == doctest::Approx(1 / 1023.0));
        CHECK(image.at(0, 0, 3) == doctest::Approx(1 / 3.0));

        write_file(path, dds(0x41, 32, {0xff, 0xff00, 0xff0000, 0xff000000}, std::string("\1\2\3\4\0\0\0\0", 8)));
        image = read_image(path, &info);
        CHECK(info.bits == 8);
        CHECK(image.at(0, 0, 2) == doctest::Approx(3 / 255.0));

        write_file(path, grey.substr(0, grey.size() - 1));
        CHECK_THROWS_AS(read_image(path), Error);
    }
}
