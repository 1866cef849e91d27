// Skies of every format become the faces that the preview looks up.
#include "bake/environment/file/sky_cube.h"
#include "bake/environment/filter/irradiance.h"
#include "environment/smooth_skies.h"
#include <algorithm>
#include <doctest/doctest.h>

using namespace bake;
using namespace bake::test;

namespace {

double largest_difference(const Cube& a, const Cube& b) {
    REQUIRE(a.size() == b.size());
    double most = 0;
    for (int f = 0; f < 6; ++f)
        for (std::size_t i = 0; i < a.faces[f].size(); ++i)
            most = std::max(most, std::abs(double(a.faces[f].data()[i]) - double(b.faces[f].data()[i])));
    return most;
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("sky_cube: an octahedral sky is as fine and lights as the lat-long picture of the same sky") {
        // As many texels per radian along the horizon: 256 over a turn, and 128 over a side.
        const Cube flat = sky_cube(smooth_picture(Projection::latlong, 256, 128));
        const Cube folded = sky_cube(smooth_picture(Projection::octahedral, 128, 128));
        CHECK(flat.size() == 64);
        CHECK(folded.size() == 64);
        CHECK(flat.channels() == 3);
        CHECK(folded.channels() == 3);
        CHECK(largest_difference(flat, folded) < 0.01); // of two bilinear interpolations
        const IrradianceOptions options{.size = 16};
        CHECK(largest_difference(irradiance(flat, options), irradiance(folded, options)) < 1e-3);
    }

    TEST_CASE("sky_cube: faces stay as they are; those with samples on their edges become plain ones of their size") {
        const Environment faces = smooth_cube(16);
        const Cube same = sky_cube(smooth_cube(16));
        for (int f = 0; f < 6; ++f)
            for (std::size_t i = 0; i < same.faces[f].size(); ++i)
                CHECK(same.faces[f].data()[i] == faces.cube.faces[f].data()[i / 3]);
        CHECK(largest_difference(sky_cube(smooth_cube(65, true)), sky_cube(smooth_cube(65))) < 0.01);
    }

} // TEST_SUITE
