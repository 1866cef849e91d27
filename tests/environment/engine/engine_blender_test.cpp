// What bake cubemap --for blender writes, seen by Blender.
#include "bake/base/vec.h"
#include "bake/picture/image_io.h"
#include "blender.h"
#include <cmath>

using namespace bake;
using namespace bake::test;

TEST_SUITE("oracle") {
    TEST_CASE("cubemap --for blender: Blender sees each direction of the sky where bake has it" *
              doctest::skip(no_blender())) {
        const Folder folder;
        Image<float> sky(256, 128, 3); // radiance 2 + direction, in the axes of glTF
        for (int y = 0; y < 128; ++y)
            for (int x = 0; x < 256; ++x) {
                const double azimuth = 2 * pi * ((x + 0.5) / 256 - 0.5), polar = pi * (y + 0.5) / 128;
                sky.at(x, y, 0) = float(2 - std::sin(polar) * std::sin(azimuth));
                sky.at(x, y, 1) = float(2 + std::cos(polar));
                sky.at(x, y, 2) = float(2 + std::sin(polar) * std::cos(azimuth));
            }
        write_image(folder / "sky.tif", sky, {.depth = Depth::float32});
        const Run run = run_bake(folder, {"cubemap", "sky.tif", "--for", "blender", "-o", "sky.exr"});
        REQUIRE_MESSAGE(run.code == 0, run.err);
        const Vec3d directions[] = {{1, 0, 0}, {-1, 0, 0}, {0, 0, 1}, {0, 0, -1}, {0.4, 0.8, 0.3}, {-0.2, -0.9, 0.5}};
        nlohmann::json outputs = nlohmann::json::array();
        for (const Vec3d& d : directions)
            outputs.push_back({{"what", "sky"},
                               {"file", std::to_string(outputs.size()) + ".f32"},
                               {"camera", {{"position", {0, 0, 0}}, {"target", {d.x, d.y, d.z}}, {"fov_deg", 10}}}});
        const auto seen = blender(folder, {{"sky", "sky.exr"}, {"size", {5, 5}}, {"outputs", outputs}});
        for (std::size_t k = 0; k < seen.size(); ++k) {
            const Vec3d expected = Vec3d(2) + glm::normalize(directions[k]);
            CAPTURE(k);
            for (int c = 0; c < 3; ++c)
                CHECK(double(seen[k].at(2, 2, c)) == doctest::Approx(expected[c]).epsilon(0.005));
        }
    }
}
