// Density of texels, and the difference between the centre of a texel and its mean.
#include "bake/relief/map/normal_code.h"
#include "bake/relief/transfer/map_quality.h"
#include "relief/transfer/transfer_meshes.h"

using namespace bake;
using namespace bake::test;

TEST_SUITE("oracle") {

    TEST_CASE("map_quality: a unit plane has as many texels per unit as the map is wide") {
        const Mesh low = unit_plane();
        const BakeTarget target = make_bake_target(low, "low", 8, 8);
        const Percentiles density = texel_density(target, 640, 160);
        CHECK(density.median == doctest::Approx(320)); // the root of 640 * 160
        CHECK(density.p05 == doctest::Approx(320));
        CHECK(density.max == doctest::Approx(320));
        Mesh smaller = low;
        for (Vec2f& uv : smaller.uvs) uv *= 0.5f;
        CHECK(texel_density(make_bake_target(smaller, "low", 8, 8), 640, 160).median == doctest::Approx(160));
    }

    TEST_CASE("map_quality: for waves it is what the mean over a texel takes off the value at its centre") {
        constexpr int size = 64;
        const double k = 3,
                     a = 0.2; // n.x = a sin(2 pi k u): the mean over a texel is that times sin(x) / x, x = pi k / size
        Transfer result;
        result.map = Image<float>(size, size, 3);
        result.states = Image<TexelState>(size, size, 1);
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                const double slope = a * std::sin(2 * pi * k * (x + 0.5) / size);
                const Vec3f rgb = encode_normal(Vec3f(Vec3d(slope, 0, std::sqrt(1 - slope * slope))), false);
                for (int c = 0; c < 3; ++c) result.map.at(x, y, c) = rgb[c];
                result.states.at(x, y) = TexelState::hit;
            }
        const double x = pi * k / size, most = a * (1 - std::sin(x) / x) * 180 / pi;
        const Percentiles error = centre_error(result, Space::tangent, false);
        CHECK(error.max == doctest::Approx(most).epsilon(0.05));
        CHECK(error.median == doctest::Approx(most / std::sqrt(2)).epsilon(0.05));
        for (std::size_t i = 0; i < result.states.size(); ++i) result.states.data()[i] = TexelState::missed;
        CHECK(centre_error(result, Space::tangent, false).max == 0);
    }
}
