#include "bake/picture/image_io.h"
#include "bake/relief/map/slope_code.h"
#include "cli/command.h"
#include <cmath>
#include <doctest/doctest.h>

using namespace bake;

TEST_SUITE("unit") {

    TEST_CASE("slope_code: decode(encode(slope)) is within half a level, and 0 and the range are exact") {
        const SlopeCode code{7.25f};
        const auto stored = [&](float slope) {
            return code.decode(std::floor(code.encode(slope) * 65535 + 0.5f) / 65535);
        };
        for (const float exact : {0.0f, 7.25f, -7.25f}) CHECK(stored(exact) == exact);
        const double half_level = 0.5 * 7.25 / 32767;
        // Float's rounding of a value near 1 is 1/256 of a level.
        for (float slope = -7.25f; slope <= 7.25f; slope += 0.0137f)
            CHECK(std::abs(stored(slope) - slope) <= 1.02 * half_level);
    }

    TEST_CASE("slope_code: the description holds the range to the last bit, and other texts hold none") {
        for (const float range : {1e-30f, 0.1f, 7.96640921f, 3.4e38f}) {
            const auto read = slope_code("bricks; " + to_text({range}));
            REQUIRE(read);
            CHECK(read->range == range);
        }
        for (const char* text :
             {"", "slope", "slope = (level - 32768) / 32767 * ", "slope = (level - 32768) / 32767 * x",
              "slope = (level - 32768) / 32767 * -1", "slope = (level - 32768) / 32767 * 0",
              "slope = (level - 32768) / 32767 * inf", "slope = (level - 32768) / 32767 * nan"})
            CHECK_MESSAGE(!slope_code(text), text);
    }

    TEST_CASE("slope_code: PNG and TIFF keep a picture's description") {
        const test::Folder folder;
        Image<float> image(3, 2, 3);
        std::fill_n(image.data(), image.size(), 0.5f);
        for (const char* file : {"a.png", "a.tif", "b.tif", "a.exr"}) {
            CAPTURE(std::string(file));
            WriteOptions options;
            options.description = to_text({2.5f});
            if (file[0] == 'b') options.compression = Compression::zip;
            write_image(folder / file, image, options);
            ImageInfo info;
            read_image(folder / file, &info);
            REQUIRE(slope_code(info.description));
            CHECK(slope_code(info.description)->range == 2.5f);
            CHECK(read_image_info(folder / file).description == info.description);
        }
    }

} // TEST_SUITE
