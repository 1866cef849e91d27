// Environments as files, read back by OpenImageIO.
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

} // TEST_SUITE
