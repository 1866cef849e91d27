#include "bake/base/error.h"
#include "bake/base/parallel.h"
#include "bake/preview/capture.h"
#include <cstring>
#include <doctest/doctest.h>
#include <limits>

using namespace bake;

namespace {

/// A scene of nothing but a sky whose radiance is its direction in cube space, plus one.
Scene direction_scene(int n) {
    Scene scene;
    scene.settings.spp = 1;
    scene.sky.cube = make_cube(n, 3);
    for (const CubeFace face : all_cube_faces)
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x) {
                const Vec3f d = glm::normalize(cube_direction(CubePoint<float>{face, (x + 0.5f) / n, (y + 0.5f) / n}));
                for (int c = 0; c < 3; ++c) scene.sky.cube[face].at(x, y, c) = d[c] + 1;
            }
    build(scene);
    return scene;
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("capture: an empty scene gives its own sky back, every face in its place and unmirrored") {
        const Scene scene = direction_scene(16);
        RenderStats stats;
        const Cube seen = capture(scene, {3, -2, 1}, 16, &stats);
        double worst = 0;
        for (int k = 0; k < 6; ++k)
            for (std::size_t i = 0; i < seen.faces[k].size(); ++i)
                worst = std::max(worst, double(std::abs(seen.faces[k].data()[i] - scene.sky.cube.faces[k].data()[i])));
        CHECK(worst < 1e-5); // floats of directions, times 16 texels
        CHECK(stats.rays == 6 * 16 * 16);
        CHECK(stats.bad_samples == 0);
    }

    TEST_CASE("capture: points that are none and sizes out of range are refused") {
        const Scene scene = direction_scene(2);
        CHECK_THROWS_AS(capture(scene, {std::numeric_limits<float>::quiet_NaN(), 0, 0}, 4), Error);
        CHECK_THROWS_AS(capture(scene, {0, 0, 0}, 0), Error);
        CHECK_THROWS_AS(capture(scene, {0, 0, 0}, 40000), Error);
    }

} // TEST_SUITE
TEST_SUITE("stability") {

    TEST_CASE("capture: the same bytes for 1, 2 and 7 threads") {
        Scene scene = direction_scene(8);
        scene.settings.spp = 5;
        std::vector<Cube> seen;
        for (const int threads : {1, 2, 7}) {
            const ThreadLimit limit(threads);
            seen.push_back(capture(scene, {0, 0, 0}, 9));
        }
        for (int i = 1; i < 3; ++i)
            for (int k = 0; k < 6; ++k)
                CHECK(std::memcmp(seen[0].faces[k].data(), seen[i].faces[k].data(),
                                  seen[0].faces[k].size() * sizeof(float)) == 0);
    }

} // TEST_SUITE
