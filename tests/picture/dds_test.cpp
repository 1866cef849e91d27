#include "bake/base/error.h"
#include "bake/picture/image_io.h"
#include "cli/command.h"
#include <cstring>

using namespace bake;
using namespace bake::test;

namespace {

constexpr std::uint32_t alpha = 1, alpha_only = 2, code = 4, rgb = 0x40, grey = 0x20000;

void put(std::string& bytes, std::size_t at, std::uint32_t n) {
    for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = char(n >> 8 * i);
}

struct Size {
    std::uint32_t width = 2, height = 1, levels = 1;
    bool cube = false;
};

std::string dds(std::uint32_t flags, std::uint32_t bits, const std::vector<std::uint32_t>& masks,
                const std::string& texels, const Size& size = {}) {
    std::string bytes(128, '\0');
    bytes.replace(0, 4, "DDS ");
    put(bytes, 4, 124), put(bytes, 8, size.levels > 1 ? 0x21007 : 0x1007);
    put(bytes, 12, size.height), put(bytes, 16, size.width), put(bytes, 28, size.levels);
    put(bytes, 76, 32), put(bytes, 80, flags), put(bytes, 88, bits), put(bytes, 108, 0x1000);
    if (size.levels > 1 || size.cube) put(bytes, 108, size.levels > 1 ? 0x401008 : 0x1008);
    for (std::size_t i = 0; i < masks.size(); ++i) put(bytes, 92 + 4 * i, masks[i]);
    if (size.cube) put(bytes, 112, 0xfe00);
    return bytes + texels;
}

/// Texels of a code instead of masks: "DXT1", or a number of D3DFORMAT or, extended, of DXGI_FORMAT.
std::string coded(std::uint32_t number, bool extended, const std::string& texels, const Size& size = {}) {
    std::string bytes = dds(code, 0, {}, "", size);
    if (!extended) return put(bytes, 84, number), bytes + texels;
    put(bytes, 84, 0x30315844); // "DX10"
    std::string more(20, '\0');
    put(more, 0, number), put(more, 4, 3), put(more, 12, 1);
    return bytes + more + texels;
}

std::string halves(const std::vector<std::uint16_t>& values) {
    std::string bytes;
    for (const std::uint16_t value : values) bytes += {char(value), char(value >> 8)};
    return bytes;
}

Refusal refusal_of(const std::string& path, std::string& message) try {
    read_image(path);
    return Refusal(0);
} catch (const Error& error) {
    message = error.what();
    return error.refusal;
}

/// A file of which nothing but the whole can be read.
void check_cut_anywhere(const std::string& path, const std::string& bytes) {
    write_file(path, bytes);
    CHECK_NOTHROW(read_image(path));
    for (std::size_t size = 4; size < bytes.size(); size += size < 120 ? 29 : 1) {
        CAPTURE(size);
        write_file(path, bytes.substr(0, size));
        std::string message;
        CHECK(refusal_of(path, message) == Refusal::unreadable);
        CHECK(message.find("is cut short") != std::string::npos);
    }
}

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("dds: every layout of masks is read; a mask of 0 is no channel") {
        struct {
            const char* name;
            std::uint32_t flags, bits;
            std::vector<std::uint32_t> masks;
            std::uint32_t texel; ///< the first; the second is 0
            std::vector<std::string> channels;
            std::vector<double> values;
        } const layouts[] = {
            {"A8R8G8B8",
             rgb | alpha,
             32,
             {0xff0000, 0xff00, 0xff, 0xff000000},
             0x80402010,
             {"R", "G", "B", "A"},
             {64 / 255.0, 32 / 255.0, 16 / 255.0, 128 / 255.0}},
            {"X8R8G8B8",
             rgb,
             32,
             {0xff0000, 0xff00, 0xff},
             0x80402010,
             {"R", "G", "B"},
             {64 / 255.0, 32 / 255.0, 16 / 255.0}},
            {"A8B8G8R8",
             rgb | alpha,
             32,
             {0xff, 0xff00, 0xff0000, 0xff000000},
             0x80402010,
             {"R", "G", "B", "A"},
             {16 / 255.0, 32 / 255.0, 64 / 255.0, 128 / 255.0}},
            {"X8B8G8R8",
             rgb,
             32,
             {0xff, 0xff00, 0xff0000},
             0x80402010,
             {"R", "G", "B"},
             {16 / 255.0, 32 / 255.0, 64 / 255.0}},
            {"R8G8B8",
             rgb,
             24,
             {0xff0000, 0xff00, 0xff},
             0x402010,
             {"R", "G", "B"},
             {64 / 255.0, 32 / 255.0, 16 / 255.0}},
            {"R5G6B5", rgb, 16, {0xf800, 0x7e0, 0x1f}, 0x0821, {"R", "G", "B"}, {1 / 31.0, 1 / 63.0, 1 / 31.0}},
            {"A1R5G5B5",
             rgb | alpha,
             16,
             {0x7c00, 0x3e0, 0x1f, 0x8000},
             0x8421,
             {"R", "G", "B", "A"},
             {1 / 31.0, 1 / 31.0, 1 / 31.0, 1}},
            {"X1R5G5B5", rgb, 16, {0x7c00, 0x3e0, 0x1f}, 0x8421, {"R", "G", "B"}, {1 / 31.0, 1 / 31.0, 1 / 31.0}},
            {"A4R4G4B4",
             rgb | alpha,
             16,
             {0xf00, 0xf0, 0xf, 0xf000},
             0x4321,
             {"R", "G", "B", "A"},
             {3 / 15.0, 2 / 15.0, 1 / 15.0, 4 / 15.0}},
            {"A8R3G3B2",
             rgb | alpha,
             16,
             {0xe0, 0x1c, 0x3, 0xff00},
             0x8025,
             {"R", "G", "B", "A"},
             {1 / 7.0, 1 / 7.0, 1 / 3.0, 128 / 255.0}},
            {"A2B10G10R10",
             rgb | alpha,
             32,
             {0x3ff, 0xffc00, 0x3ff00000, 0xc0000000},
             0x40300801,
             {"R", "G", "B", "A"},
             {1 / 1023.0, 2 / 1023.0, 3 / 1023.0, 1 / 3.0}},
            {"A2R10G10B10",
             rgb | alpha,
             32,
             {0x3ff00000, 0xffc00, 0x3ff, 0xc0000000},
             0x40300801,
             {"R", "G", "B", "A"},
             {3 / 1023.0, 2 / 1023.0, 1 / 1023.0, 1 / 3.0}},
            {"G16R16", rgb, 32, {0xffff, 0xffff0000}, 0x00020001, {"R", "G"}, {1 / 65535.0, 2 / 65535.0}},
            {"L8", grey, 8, {0xff}, 0x10, {"Y"}, {16 / 255.0}},
            {"L16", grey, 16, {0xffff}, 1, {"Y"}, {1 / 65535.0}},
            {"A8L8", grey | alpha, 16, {0xff, 0, 0, 0xff00}, 0x8010, {"Y", "A"}, {16 / 255.0, 128 / 255.0}},
            {"A4L4", grey | alpha, 8, {0xf, 0, 0, 0xf0}, 0x21, {"Y", "A"}, {1 / 15.0, 2 / 15.0}},
            {"A8", alpha_only, 8, {0, 0, 0, 0xff}, 0x80, {"A"}, {128 / 255.0}},
            {"blue alone", rgb | alpha, 8, {0, 0, 0xff, 0}, 0x80, {"B"}, {128 / 255.0}},
        };
        const Folder folder;
        const std::string path = folder / "a.dds";
        for (const auto& layout : layouts) {
            CAPTURE(std::string(layout.name));
            std::string texels(layout.bits / 4, '\0');
            for (std::size_t i = 0; i < layout.bits / 8; ++i) texels[i] = char(layout.texel >> 8 * i);
            write_file(path, dds(layout.flags, layout.bits, layout.masks, texels));
            ImageInfo info;
            const Image<float> image = read_image(path, &info);
            CHECK(info.channels == layout.channels);
            REQUIRE(image.channels() == int(layout.values.size()));
            for (int c = 0; c < image.channels(); ++c) {
                CHECK(image.at(0, 0, c) == doctest::Approx(layout.values[std::size_t(c)]));
                CHECK(image.at(1, 0, c) == 0);
            }
        }
    }

    TEST_CASE("dds: channels of more than 8 bits say so, whether by masks, by numbers or by the longer header") {
        const Folder folder;
        const std::string path = folder / "a.dds", one = halves({0x3c00}), eighth = halves({0x3000}); // as half floats
        std::string floats(16, '\0');
        const float values[] = {0.5f, 2, -3, 1};
        std::memcpy(floats.data(), values, 16);
        const Size single{1, 1};
        struct {
            std::string bytes;
            int bits;
            std::vector<double> values;
        } const cases[] = {
            {dds(grey, 16, {0xffff}, "\xff\xff", single), 16, {1}},
            {dds(rgb | alpha, 32, {0x3ff, 0xffc00, 0x3ff00000, 0xc0000000}, std::string(4, '\0'), single),
             10,
             {0, 0, 0, 0}},
            {coded(36, false, halves({1, 2, 3, 65535}), single), 16, {1 / 65535.0, 2 / 65535.0, 3 / 65535.0, 1}},
            {coded(110, false, halves({1, 0x8000, 0x8001, 32767}), single), 16, {1 / 32767.0, -1, -1, 1}},
            {coded(111, false, eighth, single), 16, {0.125}},
            {coded(112, false, one + eighth, single), 16, {1, 0.125}},
            {coded(113, false, one + eighth + one + one, single), 16, {1, 0.125, 1, 1}},
            {coded(114, false, floats.substr(0, 4), single), 32, {0.5}},
            {coded(115, false, floats.substr(0, 8), single), 32, {0.5, 2}},
            {coded(116, false, floats, single), 32, {0.5, 2, -3, 1}},
            {coded(2, true, floats, single), 32, {0.5, 2, -3, 1}},
            {coded(10, true, one + eighth + one + one, single), 16, {1, 0.125, 1, 1}},
            {coded(56, true, "\xff\xff", single), 16, {1}},
            {coded(87, true, "\x10\x20\x40\xff", single), 8, {64 / 255.0, 32 / 255.0, 16 / 255.0, 1}},
        };
        for (const auto& [bytes, bits, expected] : cases) {
            write_file(path, bytes);
            ImageInfo info;
            const Image<float> image = read_image(path, &info);
            CHECK(info.bits == bits);
            REQUIRE(image.channels() == int(expected.size()));
            for (int c = 0; c < image.channels(); ++c)
                CHECK(image.at(0, 0, c) == doctest::Approx(expected[std::size_t(c)]));
        }
    }

    TEST_CASE("dds: a file that is cut anywhere is cut short, at a level or a face too") {
        const Folder folder;
        const std::string path = folder / "a.dds";
        check_cut_anywhere(path, dds(grey, 8, {0xff}, "ab"));
        check_cut_anywhere(path, dds(grey, 8, {0xff}, std::string(8 + 2 + 1, 'x'), {4, 2, 3}));
        check_cut_anywhere(path, dds(grey, 8, {0xff}, std::string(6 * (4 + 1), 'x'), {2, 2, 2, true}));
        check_cut_anywhere(path, coded(111, false, std::string(4, '\0')));
        check_cut_anywhere(path, coded(54, true, std::string(4, '\0')));
    }

    TEST_CASE("dds: faces of a cube map lie below each other, whatever smaller levels are between them") {
        const Folder folder;
        const std::string path = folder / "a.dds";
        std::string texels;
        for (char face = 0; face < 6; ++face) texels += std::string(4, char(face + 1)) + '\xff'; // two levels
        write_file(path, dds(grey, 8, {0xff}, texels, {2, 2, 2, true}));
        ImageInfo info;
        const Image<float> image = read_image(path, &info);
        CHECK(info.environment == EnvironmentTag::cube);
        REQUIRE(image.width() == 2);
        REQUIRE(image.height() == 12);
        CHECK(info.height == 12);
        for (int y = 0; y < 12; ++y) CHECK(image.at(1, y) == doctest::Approx((y / 2 + 1) / 255.0));
    }

    TEST_CASE("dds: compressed pictures and cube maps are whole or cut short") {
        const Folder folder;
        const std::string path = folder / "a.dds";
        const std::string blocks(6 * (8 + 8), '\xff'); // BC1, 4 x 4 and 2 x 2
        write_file(path, coded(0x31545844, false, blocks, {4, 4, 2, true}));
        CHECK(read_image(path).height() == 24);
        write_file(path, coded(0x31545844, false, blocks.substr(1), {4, 4, 2, true}));
        std::string message;
        CHECK(refusal_of(path, message) == Refusal::unreadable);
        CHECK(message.find("is cut short") != std::string::npos);
    }

    TEST_CASE("dds: what cannot be read is refused with the reason") {
        const Folder folder;
        const std::string path = folder / "a.dds", four(4, '\0');
        struct {
            std::string bytes, said;
            Refusal refusal = Refusal::unreadable;
        } const cases[] = {
            {dds(rgb, 16, {0, 0, 0}, four), "has no channel"},
            {dds(rgb, 16, {0xf00f, 0xf0, 0xf00}, four), "mask is empty or has gaps"},
            {dds(rgb, 8, {0xff00, 0, 0xff}, four), "mask exceeds its texels"},
            {dds(rgb, 12, {0xf00, 0xf0, 0xf}, four), "texels of 12 bits"},
            {dds(0x200, 16, {0xff, 0xff00}, four), "neither colours nor grey"}, // YUV
            {coded(0x59565955, false, four), "format UYVY"},
            {coded(98765, true, four), "format 98765"},
            {dds(grey, 8, {0xff}, four, {0, 4}), "has no pixels"},
            {dds(grey, 8, {0xff}, four, {0x7fffffff, 0x7fffffff}), "more pixels than DDS has room for"},
        };
        for (const auto& [bytes, said, refusal] : cases) {
            write_file(path, bytes);
            std::string message;
            CHECK(refusal_of(path, message) == refusal);
            CAPTURE(message);
            CHECK(message.find(said) != std::string::npos);
        }
    }
}
