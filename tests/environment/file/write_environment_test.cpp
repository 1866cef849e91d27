// Environments as files, read back by OpenImageIO.
#include "bake/base/error.h"
#include "bake/environment/file/write_environment.h"
#include "bake/environment/filter/mips.h"
#include "environment/skies.h"
#include "picture/openimageio.h"

using namespace bake;

TEST_SUITE("unit") {

    TEST_CASE("write_levels: once its faces are single texels, a strip is halved to the means of its texels") {
        const test::Folder folder;
        for (const auto& [name, to] :
             {std::pair("strip.tif", SkyFormat::strip), {"cube.exr", SkyFormat::openexr_cube}}) {
            INFO(std::string(name));
            std::vector<Cube> levels = mip_chain(test::rough_sky(4, 3));
            double mean[3] = {};
            for (const Image<float>& face : levels.back().faces)
                for (int c = 0; c < 3; ++c) mean[c] += double(face.at(0, 0, c)) / 6;
            const std::string file = folder / name;
            const EnvironmentWritten written =
                write_levels(std::move(levels), {.file = file, .to = to, .depth = Depth::float32});
            REQUIRE(written.levels == 5); // 4 x 24, 2 x 12, 1 x 6, 1 x 3, 1 x 1
            const Image<float> faces = test::by_openimageio(folder, file, 2),
                               three = test::by_openimageio(folder, file, 3),
                               one = test::by_openimageio(folder, file, 4);
            REQUIRE((faces.width() == 1 && faces.height() == 6));
            REQUIRE((three.width() == 1 && three.height() == 3));
            REQUIRE((one.width() == 1 && one.height() == 1));
            for (int c = 0; c < 3; ++c) {
                CHECK(one.at(0, 0, c) == doctest::Approx(mean[c]).epsilon(1e-6));
                for (int y = 0; y < 3; ++y)
                    CHECK(three.at(0, y, c) ==
                          doctest::Approx((faces.at(0, 2 * y, c) + faces.at(0, 2 * y + 1, c)) / 2).epsilon(1e-6));
            }
        }
    }

    TEST_CASE("write_environment: radiance beyond half floats is refused, or clamped, or its texel is black") {
        const test::Folder folder;
        Environment sky;
        sky.cube = test::even_sky(4, 3, 2);
        sky.cube[CubeFace::ny].at(1, 2, 1) = 1e6f;
        const std::string file = folder / "sky.exr";
        EnvironmentTarget target{.file = file, .to = SkyFormat::strip, .depth = Depth::half};
        CHECK_THROWS_WITH_AS(write_environment(sky, target), doctest::Contains("half floats cannot hold"), Error);
        CHECK_FALSE(std::filesystem::exists(file));
        for (const BadPolicy bad : {BadPolicy::clamp, BadPolicy::zero}) {
            target.bad = bad;
            CHECK(write_environment(sky, target).over.over == 1);
            const Image<float> strip = test::by_openimageio(folder, file);
            REQUIRE((strip.width() == 4 && strip.height() == 24));
            for (int y = 0; y < 24; ++y)
                for (int x = 0; x < 4; ++x)
                    for (int c = 0; c < 3; ++c) {
                        const bool mended = x == 1 && y == 3 * 4 + 2 && (c == 1 || bad == BadPolicy::zero);
                        CHECK(strip.at(x, y, c) == (!mended ? 2 : bad == BadPolicy::zero ? 0 : 65504));
                    }
        }
    }

} // TEST_SUITE
