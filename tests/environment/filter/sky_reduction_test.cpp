// Skies of fewer texels.
#include "bake/environment/filter/sky_reduction.h"
#include "bake/environment/sky/solid_angle.h"
#include "preview/sky_of.h"
#include <algorithm>
#include <doctest/doctest.h>

using namespace bake;
using namespace bake::test;

namespace {

/// A step, whose series rings.
double step(const Vec3d& d) { return d.x > 0.3 ? 1 : 0; }

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("sky reduction: nothing changes unless faces are larger than asked for") {
        for (const int size : {0, 16, 32}) {
            const Cube sky = reduced(sky_of(16, step), {.face_size = size}), source = sky_of(16, step);
            REQUIRE(sky.size() == 16);
            CHECK(std::equal(sky.faces[2].data(), sky.faces[2].data() + sky.faces[2].size(), source.faces[2].data()));
        }
    }

    TEST_CASE("sky reduction: smaller faces have the means of the texels that they cover") {
        const Cube source = sky_of(16, step), sky = reduced(sky_of(16, step), {.face_size = 4});
        REQUIRE(sky.size() == 4);
        const std::vector<double> omega = texel_solid_angles(16);
        double sum = 0, weight = 0;
        for (int y = 4; y < 8; ++y)
            for (int x = 4; x < 8; ++x) {
                const double own = omega[std::size_t(16 * y + x)];
                sum += own * double(source.faces[2].at(x, y, 0)), weight += own;
            }
        CHECK(sum > 0);
        CHECK(sum < weight);
        CHECK(sky.faces[2].at(1, 1, 0) == doctest::Approx(sum / weight).epsilon(1e-5));
    }

    TEST_CASE("sky reduction: one band is the mean, and no band is negative") {
        const Cube mean = reduced(sky_of(32, step), {.sh_bands = 1});
        CHECK(mean.size() == 1);
        for (const Image<float>& face : mean.faces) CHECK(face.at(0, 0, 2) == doctest::Approx(0.35).epsilon(0.02));
        const Cube five = reduced(sky_of(32, step), {.sh_bands = 5});
        CHECK(five.size() == face_of_bands(5));
        float least = 1;
        for (const Image<float>& face : five.faces)
            least = std::min(least, *std::min_element(face.data(), face.data() + face.size()));
        CHECK(least == 0);
        CHECK(reduced(sky_of(32, step), {.face_size = 8, .sh_bands = 5}).size() == 8);
    }
}
