#include "bake/base/error.h"
#include "bake/environment/file/environment_io.h"
#include "cli/command.h"
#include <cmath>

using namespace bake;
using test::Folder;

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

} // namespace

TEST_SUITE("unit") {

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
        const auto disc = [&](float outside) {
            Image<float> image(n, n, 1);
            for (int y = 0; y < n; ++y)
                for (int x = 0; x < n; ++x)
                    image.at(x, y) = std::hypot((2 * x + 1.0) / n - 1, (2 * y + 1.0) / n - 1) < 1 ? 1 : outside;
            write_image(folder / "disc.tif", image, {.depth = Depth::float32});
            return folder / "disc.tif";
        };
        CHECK(read_as(disc(0), SkyFormat::probe) == SkyFormat::probe);
        CHECK_THROWS_AS(read_as(disc(0.3f), SkyFormat::probe), Error);
        CHECK(read_as(disc(0.3f), SkyFormat::ball) == SkyFormat::ball);
    }

    TEST_CASE("environment_io: exrenvmap's files, whose tags contradict each other, are cubes by their shape") {
        const Folder folder;
        Image<float> strip(4, 24, 3);
        for (std::size_t i = 0; i < strip.size(); ++i) strip.data()[i] = 1;
        write_image(folder / "strip.exr", strip, {.environment = EnvironmentTag::latlong});
        CHECK(read_as(folder / "strip.exr") == SkyFormat::openexr_cube);
    }

} // TEST_SUITE
