#include "bake/base/error.h"
#include "bake/environment/file/environment_io.h"
#include "cli/command.h"
#include <cmath>
#include <cstdint>

using namespace bake;
using test::Folder;
namespace fs = std::filesystem;

namespace {

/// Grey TIFF, which needs no OpenImageIO.
std::string picture(const Folder& folder, int width, int height, float value = 1) {
    Image<float> image(width, height, 1);
    for (std::size_t i = 0; i < image.size(); ++i) image.data()[i] = value;
    const std::string file = folder / ("p" + std::to_string(width) + "x" + std::to_string(height) + ".tif");
    write_image(file, image, {.depth = Depth::float32});
    return file;
}

SkyFormat read_as(const std::string& file, SkyFormat from = SkyFormat::automatic) {
    EnvironmentReport report;
    read_environment({file}, {.from = from}, &report);
    return report.format;
}

void put(std::string& bytes, std::size_t at, std::uint32_t value) {
    for (int i = 0; i < 4; ++i) bytes[at + i] = char(value >> (8 * i) & 255);
}

/// A DDS cube map of n x n BGRA texels whose face k is grey 40 k + x + y, with the mip levels of its chain if asked for.
/// `sides`: how many of the six faces it has.
std::string dds_cube(int n, bool mips, int sides = 6) {
    std::string bytes(128, '\0');
    bytes.replace(0, 4, "DDS ");
    const std::uint32_t count = mips ? std::uint32_t(std::log2(n)) + 1 : 1;
    put(bytes, 4, 124);
    put(bytes, 8, 0x1007 | (mips ? 0x20000 : 0)); // caps, height, width, pixel format; mip count
    put(bytes, 12, std::uint32_t(n));
    put(bytes, 16, std::uint32_t(n));
    put(bytes, 28, count);
    put(bytes, 76, 32);
    put(bytes, 80, 0x41); // RGB and alpha
    put(bytes, 88, 32);
    put(bytes, 92, 0xff0000);
    put(bytes, 96, 0xff00);
    put(bytes, 100, 0xff);
    put(bytes, 104, 0xff000000);
    put(bytes, 108, 0x1008 | (mips ? 0x400000 : 0));    // texture, complex; mipmap
    put(bytes, 112, 0x200 | ((1u << sides) - 1) << 10); // cube map and its sides
    for (int k = 0; k < sides; ++k)
        for (std::uint32_t level = 0; level < count; ++level)
            for (int y = 0; y < n >> level; ++y)
                for (int x = 0; x < n >> level; ++x)
                    bytes += std::string(3, char(level == 0 ? 40 * k + x + y : 255)) + '\xff';
    return bytes;
}

/// A grey float TIFF of ones with the tag by which textures say that they are environments.
std::string tagged_tiff(int w, int h, const std::string& tag) {
    struct Entry {
        std::uint32_t id, type, count, value;
    };
    const auto bytes_of_picture = std::uint32_t(4 * w * h);
    const std::uint32_t text = 8, pixels = text + 32, directory = pixels + bytes_of_picture;
    const std::vector<Entry> entries = {{256, 4, 1, std::uint32_t(w)},
                                        {257, 4, 1, std::uint32_t(h)},
                                        {258, 3, 1, 32},
                                        {259, 3, 1, 1},
                                        {262, 3, 1, 1},
                                        {273, 4, 1, pixels},
                                        {277, 3, 1, 1},
                                        {278, 4, 1, std::uint32_t(h)},
                                        {279, 4, 1, bytes_of_picture},
                                        {339, 3, 1, 3},
                                        {33302, 2, std::uint32_t(tag.size() + 1), text}};
    std::string bytes(directory + 2 + 12 * entries.size() + 4, '\0');
    bytes.replace(0, 4, std::string("II*\0", 4));
    put(bytes, 4, directory);
    bytes.replace(text, tag.size(), tag);
    for (std::uint32_t i = 0; i < bytes_of_picture; i += 4) put(bytes, pixels + i, 0x3f800000);
    bytes[directory] = char(entries.size());
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const std::size_t at = directory + 2 + 12 * i;
        put(bytes, at, entries[i].id | entries[i].type << 16);
        put(bytes, at + 4, entries[i].count);
        put(bytes, at + 8, entries[i].value);
    }
    return bytes;
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("environment_io: a DDS cube map has Direct3D's faces, which are GL's, and samples at the centres") {
        const Folder folder;
        for (const bool mips : {false, true}) {
            test::write_file(folder / "cube.dds", dds_cube(8, mips));
            EnvironmentReport report;
            const Environment sky = read_environment({folder / "cube.dds"}, {.space = ColourSpace::linear}, &report);
            CHECK(report.format == SkyFormat::strip);
            CHECK(!sky.edge_samples);
            REQUIRE(sky.cube.size() == 8);
            for (int k = 0; k < 6; ++k)
                for (const auto& [x, y] : {std::pair(0, 0), std::pair(7, 0), std::pair(2, 5)})
                    CHECK(sky.cube.faces[k].at(x, y, 1) == doctest::Approx((40 * k + x + y) / 255.0));
        }
    }

    TEST_CASE("environment_io: a TIFF that is tagged as an environment has its samples at the centres") {
        const Folder folder;
        test::write_file(folder / "wide.tif", tagged_tiff(16, 8, "LatLong Environment"));
        CHECK(read_image_info(folder / "wide.tif").environment == EnvironmentTag::latlong);
        CHECK(read_as(folder / "wide.tif") == SkyFormat::latlong);
        test::write_file(folder / "strip.tif", tagged_tiff(4, 24, "CubeFace Environment"));
        CHECK(read_image_info(folder / "strip.tif").environment == EnvironmentTag::cube);
        CHECK(read_as(folder / "strip.tif") == SkyFormat::strip);
    }

    TEST_CASE("environment_io: a DDS cube map without all six faces is refused, because the others would be black") {
        const Folder folder;
        test::write_file(folder / "five.dds", dds_cube(8, false, 5));
        try {
            read_as(folder / "five.dds");
            FAIL("not refused");
        } catch (const Error& error) {
            CHECK(error.refusal == Refusal::unsuitable);
            CHECK(std::string(error.what()).find("+x -x +y -y +z only") != std::string::npos);
        }
    }

    TEST_CASE("environment_io: files tagged by OpenEXR have samples on the edges") {
        const Folder folder;
        Image<float> wide(16, 8, 3), strip(4, 24, 3);
        for (Image<float>* image : {&wide, &strip})
            for (std::size_t i = 0; i < image->size(); ++i) image->data()[i] = 1;
        write_image(folder / "wide.exr", wide, {.environment = EnvironmentTag::latlong});
        CHECK(read_as(folder / "wide.exr") == SkyFormat::openexr_latlong);
        write_image(folder / "strip.exr", strip, {.environment = EnvironmentTag::cube});
        CHECK(read_as(folder / "strip.exr") == SkyFormat::openexr_cube);
    }

    TEST_CASE("environment_io: a cross with its caps over the first column is folded, and that is told") {
        const Folder folder;
        Image<float> cross(32, 24, 1);
        for (int y = 0; y < 24; ++y)
            for (int x = 0; x < 32; ++x)
                cross.at(x, y) = y / 8 == 1 ? float(1 + x / 8) + 0.1f * float(x % 3)
                                 : x < 8    ? 5 + 0.1f * float(y % 3)
                                            : 0;
        write_image(folder / "cross.tif", cross, {.depth = Depth::float32});
        EnvironmentReport report;
        const Environment sky = read_environment({folder / "cross.tif"}, {}, &report);
        CHECK(sky.cube[CubeFace::pz].at(0, 0) == 1);
        CHECK(sky.cube[CubeFace::px].at(0, 0) == doctest::Approx(2.2f)); // column 8
        const std::vector<std::string> notes = reading_notes(report);
        REQUIRE(notes.size() == 1);
        CHECK(notes[0].find("column 1") != std::string::npos);
    }

    TEST_CASE("environment_io: six cells of 3 x 2 are refused with what to do") {
        const Folder folder;
        try {
            read_as(picture(folder, 24, 16));
            FAIL("not refused");
        } catch (const Error& error) {
            CHECK(std::string(error.what()).find("no shape of a sky") != std::string::npos);
            CHECK(std::string(error.what()).find("six files") != std::string::npos);
        }
    }

    TEST_CASE("environment_io: six files are taken by their names, or in their order if asked for") {
        const Folder folder;
        std::vector<std::string> files;
        for (const char* word : {"back", "front", "bottom", "top", "left", "right"}) {
            files.push_back(folder / (std::string(word) + ".tif"));
            fs::copy_file(picture(folder, 4, 4, float(files.size())), files.back());
        }
        CHECK(read_environment(files).cube[CubeFace::nz].at(0, 0) == 1);
        CHECK(read_environment(files, {.by_name = false}).cube[CubeFace::px].at(0, 0) == 1);
        files.pop_back();
        CHECK_THROWS_AS(read_environment(files, {.by_name = false}), Error);
    }

    TEST_CASE("environment_io: the shape tells what a picture is, and a square is asked about") {
        const Folder folder;
        CHECK(read_as(picture(folder, 16, 8)) == SkyFormat::latlong);
        CHECK(read_as(picture(folder, 16, 12)) == SkyFormat::hcross);
        CHECK(read_as(picture(folder, 12, 16)) == SkyFormat::vcross);
        CHECK(read_as(picture(folder, 4, 24)) == SkyFormat::strip);
        CHECK(read_as(picture(folder, 24, 4)) == SkyFormat::strip);
        for (const auto& [w, h] : {std::pair(8, 8), std::pair(1, 1), std::pair(9, 8)})
            CHECK_THROWS_AS(read_as(picture(folder, w, h)), Error);
        CHECK(read_as(picture(folder, 8, 8), SkyFormat::octahedral) == SkyFormat::octahedral);
        CHECK(read_as(picture(folder, 8, 8), SkyFormat::ball) == SkyFormat::ball);
        CHECK_THROWS_AS(read_as(picture(folder, 8, 8), SkyFormat::latlong), Error);
        CHECK_THROWS_AS(read_as(picture(folder, 1, 1), SkyFormat::ball), Error);
        CHECK_THROWS_AS(read_as(picture(folder, 1, 6), SkyFormat::openexr_cube), Error);
    }

    TEST_CASE("environment_io: a picture of a ball is not taken for an angular map") {
        const Folder folder;
        const int n = 32;
        const auto disc = [&](float outside, float inside = 1) {
            Image<float> image(n, n, 1);
            for (int y = 0; y < n; ++y)
                for (int x = 0; x < n; ++x)
                    image.at(x, y) = std::hypot((2 * x + 1.0) / n - 1, (2 * y + 1.0) / n - 1) < 1 ? inside : outside;
            write_image(folder / "disc.tif", image, {.depth = Depth::float32});
            return folder / "disc.tif";
        };
        CHECK(read_as(disc(0), SkyFormat::probe) == SkyFormat::probe);
        CHECK_THROWS_AS(read_as(disc(0.3f), SkyFormat::probe), Error);
        CHECK(read_as(disc(0.3f), SkyFormat::ball) == SkyFormat::ball);
        // At any exposure, and with the noise of a photograph outside.
        for (const float exposure : {0.01f, 100.0f}) {
            CHECK(read_as(disc(0.01f * exposure, exposure), SkyFormat::probe) == SkyFormat::probe);
            CHECK_THROWS_AS(read_as(disc(0.3f * exposure, exposure), SkyFormat::probe), Error);
        }
    }

    TEST_CASE("environment_io: exrenvmap's files, whose tags contradict each other, are cubes by their shape") {
        const Folder folder;
        Image<float> strip(4, 24, 3);
        for (std::size_t i = 0; i < strip.size(); ++i) strip.data()[i] = 1;
        write_image(folder / "strip.exr", strip, {.environment = EnvironmentTag::latlong});
        CHECK(read_as(folder / "strip.exr") == SkyFormat::openexr_cube);
    }

} // TEST_SUITE
