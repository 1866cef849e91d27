// JPEG by OpenImageIO, and what its files say beside their texels.
#include "bake/picture/icc.h"
#include "bake/picture/image_io.h"
#include "cli/command.h"

using namespace bake;
using namespace bake::test;

namespace {

std::string segment(int marker, const std::string& data) {
    const std::size_t size = data.size() + 2;
    return std::string("\xff") + char(marker) + char(size >> 8) + char(size) + data;
}

/// 16 x 8 grey texels: those of the left block are 192, those of the right one 64.
std::string two_blocks(const std::string& more) {
    const std::string quantisers(64, '\x08'), no_counts(14, '\0');
    return "\xff\xd8" + more + segment(0xdb, std::string(1, '\0') + quantisers) +
           segment(0xc0, std::string("\10\0\10\0\20\1\1\21\0", 9)) +
           segment(0xc4, std::string("\0\1\1", 3) + no_counts + "\7\10") + // DC: 0 is category 7, 10 category 8
           segment(0xc4, std::string("\20\1\0", 3) + no_counts + std::string(1, '\0')) + // AC: 0 ends a block
           segment(0xda, std::string("\1\1\0\0\77\0", 6)) + "\x40\x4f\xef" + "\xff\xd9";
}

std::string exif(int orientation) {
    return segment(0xe1, std::string("Exif\0\0MM\0*\0\0\0\10\0\1\1\22\0\3\0\0\0\1\0", 25) + char(orientation) +
                             std::string(6, '\0'));
}

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("jpeg: a picture whose Exif data say that it lies on its side is turned upright, and told") {
        const Folder folder;
        const std::string path = folder / "a.jpg";
        write_file(path, two_blocks(""));
        ImageInfo info;
        Image<float> image = read_image(path, &info);
        REQUIRE(image.width() == 16);
        CHECK(image.at(0, 0) == doctest::Approx(192 / 255.0));
        CHECK(image.at(15, 7) == doctest::Approx(64 / 255.0));
        CHECK(info.notes.empty());
        struct {
            int orientation;
            bool bright_first; ///< at the left, or at the top
        } const cases[] = {{2, false}, {3, false}, {4, true}, {5, true}, {6, true}, {7, false}, {8, false}};
        for (const auto& [orientation, bright_first] : cases) {
            CAPTURE(orientation);
            write_file(path, two_blocks(exif(orientation)));
            image = read_image(path, &info);
            REQUIRE(image.width() == (orientation < 5 ? 16 : 8));
            CHECK(info.width == image.width());
            CHECK(image.at(0, 0) == doctest::Approx((bright_first ? 192 : 64) / 255.0));
            CHECK(image.at(image.width() - 1, image.height() - 1) ==
                  doctest::Approx((bright_first ? 64 : 192) / 255.0));
            CHECK(info.notes.size() == 1);
        }
    }

    TEST_CASE("jpeg: the curve of its profile is told") {
        const Folder folder;
        const std::string path = folder / "a.jpg";
        for (const bool srgb : {true, false}) {
            write_file(path, two_blocks(segment(0xe2, std::string("ICC_PROFILE\0\1\1", 14) + make_icc(srgb, true))));
            ImageInfo info;
            Image<float> image = read_image(path, &info);
            CHECK(info.srgb_tagged == srgb);
            linearise(image, ColourSpace::automatic, info);
            CHECK(image.at(0, 0) == doctest::Approx(srgb ? 0.5271 : 192 / 255.0).epsilon(1e-3));
        }
    }
}
