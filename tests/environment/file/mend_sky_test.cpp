#include "bake/base/error.h"
#include "bake/environment/file/mend_sky.h"
#include "environment/skies.h"
#include <cmath>
#include <doctest/doctest.h>
#include <limits>

using namespace bake;

namespace {

const std::array<std::string, 6> names = {"a", "b", "c", "d", "e", "f"};

Environment even_cube(int n = 8) {
    Environment sky;
    sky.cube = test::even_sky(n, 3, 1);
    return sky;
}

Environment even_picture(Projection projection, int w, int h) {
    Environment sky;
    sky.projection = projection;
    sky.picture = Image<float>(w, h, 3);
    for (std::size_t i = 0; i < sky.picture.size(); ++i) sky.picture.data()[i] = 1;
    return sky;
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("mend_sky: negative values below 1e-3 of the flux become 0 by themselves, and nothing else changes") {
        Environment sky = even_cube();
        sky.cube.faces[3].at(2, 5, 1) = -0.3f;
        sky.cube.faces[4].at(0, 0, 0) = -0.1f;
        const SkyFaults faults = mend_sky(sky, names, BadPolicy::refuse);
        CHECK(faults.negative == 2);
        CHECK(faults.bad.texels == 0);
        const double expected =
            (0.3 * test::texel_solid_angle(8, 2, 5) + 0.1 * test::texel_solid_angle(8, 0, 0)) / (12 * pi);
        CHECK(faults.negative_share == doctest::Approx(expected).epsilon(0.01));
        CHECK(sky.cube.faces[3].at(2, 5, 1) == 0);
        CHECK(sky.cube.faces[3].at(2, 5, 0) == 1); // the other channels of the texel
        CHECK(sky.cube.faces[4].at(0, 0, 0) == 0);
    }

    TEST_CASE("mend_sky: more than 1e-3 of the whole sky's flux is refused with the file, or goes by the policy") {
        Environment sky = even_cube();
        sky.cube.faces[3].at(4, 4, 1) = -5; // the middle of a face: solid angle of 1/32
        try {
            mend_sky(sky, names, BadPolicy::refuse);
            FAIL("not refused");
        } catch (const Error& error) {
            CHECK(error.refusal == Refusal::unsuitable);
            CHECK(std::string(error.what()).starts_with("d: "));
            CHECK(std::string(error.what()).find("1 negative") != std::string::npos);
        }
        const SkyFaults faults = mend_sky(sky, names, BadPolicy::zero);
        CHECK(faults.negative == 0);
        CHECK(faults.bad.negative == 1);
        CHECK(sky.cube.faces[3].at(4, 4, 0) == 0); // zero blackens all channels
    }

    TEST_CASE("mend_sky: the share is that of solid angle, so that texels at the poles of a lat-long count less") {
        const auto share = [](int y) {
            Environment sky = even_picture(Projection::latlong, 32, 16);
            sky.picture.at(3, y, 0) = -0.1f;
            return mend_sky(sky, names, BadPolicy::refuse).negative_share;
        };
        const double texel = 2 * pi / 32 * pi / 16;
        CHECK(share(8) == doctest::Approx(0.1 * texel * std::cos(pi / 32) / (12 * pi)).epsilon(0.01));
        CHECK(share(0) == doctest::Approx(0.1 * texel * std::sin(pi / 32) / (12 * pi)).epsilon(0.01));
        // What lies outside the disc of a probe is no sky.
        Environment probe = even_picture(Projection::probe, 32, 32);
        probe.picture.at(0, 0, 0) = -100;
        CHECK(mend_sky(probe, names, BadPolicy::refuse).negative_share == doctest::Approx(0).epsilon(1e-6));
    }

    TEST_CASE("mend_sky: NaN and infinite values are refused beside tolerated negative ones, and alpha is left alone") {
        Environment sky = even_cube();
        sky.cube.faces[1].at(1, 1, 0) = -0.01f;
        CHECK(mend_sky(sky, names, BadPolicy::refuse, 0).negative == 0); // channel 0 as alpha
        CHECK(sky.cube.faces[1].at(1, 1, 0) == -0.01f);
        sky.cube.faces[2].at(1, 1, 1) = std::numeric_limits<float>::quiet_NaN();
        CHECK_THROWS_AS(mend_sky(sky, names, BadPolicy::refuse), Error);
        const SkyFaults faults = mend_sky(sky, names, BadPolicy::clamp);
        CHECK(faults.bad.nan == 1);
        CHECK(sky.cube.faces[2].at(1, 1, 1) == 0);
    }

    TEST_CASE("mend_sky: alpha of any sign is kept; NaN, infinite and beyond all floats it goes by the policy") {
        constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
        const auto with_alpha = [](float alpha) {
            Environment sky;
            sky.cube = test::even_sky(8, 4, 1);
            sky.cube.faces[2].at(3, 4, 3) = alpha;
            return sky;
        };
        for (const float kept : {-2.0f, -0.0f, 0.5f, 70000.0f, -1e30f}) {
            Environment sky = with_alpha(kept);
            const SkyFaults faults = mend_sky(sky, names, BadPolicy::refuse, 3);
            CHECK(faults.bad.texels == 0);
            CHECK(faults.negative == 0);
            CHECK(sky.cube.faces[2].at(3, 4, 3) == kept);
        }
        for (const float bad :
             {nan, inf, -inf, std::numeric_limits<float>::max(), std::numeric_limits<float>::lowest()}) {
            Environment refused = with_alpha(bad);
            CHECK_THROWS_AS(mend_sky(refused, names, BadPolicy::refuse, 3), Error);
            for (const BadPolicy policy : {BadPolicy::zero, BadPolicy::clamp}) {
                Environment sky = with_alpha(bad);
                CHECK(mend_sky(sky, names, policy, 3).bad.texels == 1);
                const float expected = std::isfinite(bad) ? std::copysign(largest_float, bad) : 1;
                CHECK(sky.cube.faces[2].at(3, 4, 3) == expected);
                CHECK(sky.cube.faces[2].at(3, 4, 0) == (policy == BadPolicy::zero ? 0 : 1));
            }
        }
    }

    TEST_CASE("mend_sky: a sky without any light above 0 has no share to tolerate") {
        Environment sky = even_cube();
        for (Image<float>& face : sky.cube.faces)
            for (std::size_t i = 0; i < face.size(); ++i) face.data()[i] = -1e-6f;
        CHECK_THROWS_AS(mend_sky(sky, names, BadPolicy::refuse), Error);
    }

} // TEST_SUITE
