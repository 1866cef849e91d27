#include "bake/base/error.h"
#include "bake/picture/image_io.h"
#include "cli/command.h"
#include <algorithm>

using namespace bake;
using namespace bake::test;

namespace {

std::string header(const std::string& size, const std::string& more = "") {
    return "#?RADIANCE\n" + more + "FORMAT=32-bit_rle_rgbe\n\n" + size + "\n";
}

/// A texel of three equal values, n / 256.
std::string texel(int n) { return {char(n), char(n), char(n), char(128)}; }

bool refused(const std::string& path) try {
    read_image(path);
    return false;
} catch (const Error& error) {
    CHECK(error.refusal == Refusal::unreadable);
    return true;
}

} // namespace

TEST_SUITE("oracle") {
    TEST_CASE("rgbe: every order of the axes is turned upright") {
        const Folder folder;
        const std::string path = folder / "a.hdr";
        for (const char* axes : {"-Y+X", "-Y-X", "+Y+X", "+Y-X", "+X-Y", "-X-Y", "-X+Y", "+X+Y"}) {
            CAPTURE(std::string(axes));
            const bool rows_are_lines = axes[1] == 'Y';
            const int width = rows_are_lines ? 3 : 2, height = rows_are_lines ? 2 : 3;
            std::string bytes = header(std::string(axes, 2) + " 2 " + std::string(axes + 2, 2) + " 3");
            for (int line = 0; line < 2; ++line)
                for (int along = 0; along < 3; ++along) {
                    // The text says along which axis a step goes, and which way: Y runs up.
                    int x = rows_are_lines ? along : line, y = rows_are_lines ? line : along;
                    if (std::string(axes).find("-X") != std::string::npos) x = width - 1 - x;
                    if (std::string(axes).find("+Y") != std::string::npos) y = height - 1 - y;
                    bytes += texel(10 + 10 * (y * width + x));
                }
            write_file(path, bytes);
            ImageInfo info;
            const Image<float> image = read_image(path, &info);
            REQUIRE(image.width() == width);
            REQUIRE(image.height() == height);
            CHECK(info.width == width);
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x)
                    CHECK(image.at(x, y) == doctest::Approx((10 + 10 * (y * width + x)) / 256.0));
        }
    }
}

TEST_SUITE("unit") {
    TEST_CASE("rgbe: run lengths of the first versions, and of today") {
        const Folder folder;
        const std::string path = folder / "a.hdr", run = std::string("\1\1\1", 3);
        // 300 texels: one, 255 + 1 * 256 is too many: a run of 43 and one of 1 * 256 that continues it.
        write_file(path, header("-Y 1 +X 300") + texel(7) + run + char(43) + run + char(1));
        const Image<float> old = read_image(path);
        CHECK(std::all_of(old.data(), old.data() + old.size(), [](float v) { return v == 7 / 256.0f; }));

        const std::string row = std::string("\2\2\0\12", 4);
        const std::string mantissas = std::string("\x84\x20\6\1\2\3\4\5\6", 9), exponents = std::string("\x8a\x80", 2);
        write_file(path, header("-Y 1 +X 10") + row + mantissas + mantissas + mantissas + exponents);
        const Image<float> today = read_image(path);
        CHECK(today.at(3, 0, 1) == 32 / 256.0f);
        CHECK(today.at(4, 0, 1) == 1 / 256.0f);
        CHECK(today.at(9, 0, 2) == 6 / 256.0f);
    }

    TEST_CASE("rgbe: the exposure is divided out and told, long comments are skipped") {
        const Folder folder;
        const std::string path = folder / "a.hdr";
        write_file(path,
                   header("-Y 1 +X 1", "# " + std::string(9000, 'x') + "\nEXPOSURE=0.5\nEXPOSURE=0.5\n") + texel(64));
        ImageInfo info;
        CHECK(read_image(path, &info).at(0, 0) == 1);
        REQUIRE(info.notes.size() == 1);
        CHECK(info.notes[0].find("0.25") != std::string::npos);
        write_file(path, header("-Y 1 +X 1", "EXPOSURE=1\n") + texel(64));
        read_image(path, &info);
        CHECK(info.notes.empty());
    }

    TEST_CASE("rgbe: other primaries are told, and zeros, which Photoshop writes, are none") {
        const Folder folder;
        const std::string path = folder / "a.hdr";
        for (const auto& [numbers, told] : {std::pair("0.708 0.292 0.17 0.797 0.131 0.046 0.3127 0.329", true),
                                            {"0.64 0.33 0.3 0.6 0.15 0.06 0.3127 0.329", false},
                                            {"0 0 0 0 0 0 0 0", false}}) {
            write_file(path, header("-Y 1 +X 1", std::string("PRIMARIES=") + numbers + "\n") + texel(64));
            ImageInfo info;
            read_image(path, &info);
            CHECK(info.colour.note.empty() != told);
        }
    }

    TEST_CASE("rgbe: damage is refused") {
        const Folder folder;
        const std::string path = folder / "a.hdr", run = std::string("\1\1\1\3", 4);
        for (const std::string& bytes : {header("-Y 1 +X 2") + run + texel(1), header("-Y 1 +X 3") + texel(1) + run,
                                         header("-Y 2 +X 2") + texel(1) + texel(2) + texel(3), header("2 x 2"),
                                         header("-Y 0 +X 2"), header("-Y 1 +X 10") + std::string("\2\2\0\13", 4)}) {
            write_file(path, bytes);
            CHECK(refused(path));
        }
    }
}
