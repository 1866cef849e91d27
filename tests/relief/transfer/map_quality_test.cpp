// Density of texels, and the difference between the centre of a texel and its mean.
#include "bake/relief/map/normal_code.h"
#include "bake/relief/transfer/map_quality.h"
#include "relief/transfer/transfer_meshes.h"
#include <algorithm>

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

TEST_SUITE("unit") {

    TEST_CASE("map_quality: the picture of the texels has a colour for each state, and grey by the bend where there is "
              "detail") {
        Transfer result;
        result.map = Image<float>(5, 3, 3);
        result.states = Image<TexelState>(5, 3, 1);
        for (std::size_t i = 0; i < 15; ++i) {
            const float flat[] = {0.5f, 0.5f, 1};
            std::copy_n(flat, 3, result.map.data() + 3 * i);
            result.states.data()[i] = TexelState::hit;
        }
        const TexelState states[] = {TexelState::outside, TexelState::missed, TexelState::behind,
                                     TexelState::unmatched};
        std::copy_n(states, 4, result.states.row(0));
        result.map.at(4, 0, 2) = 0.2f; // inward
        const auto colour = [&](int x, int y) {
            const Image<float> map = report_map(result, Space::tangent, false);
            return Vec3f(map.at(x, y, 0), map.at(x, y, 1), map.at(x, y, 2));
        };
        CHECK(glm::length(colour(0, 0)) < 0.1f);
        CHECK((colour(1, 0) == Vec3f(1, 0, 0)));
        CHECK((colour(2, 0) == Vec3f(1, 0.5f, 0)));
        CHECK((colour(3, 0) == Vec3f(0, 0.2f, 1)));
        CHECK((colour(4, 0) == Vec3f(1, 0, 1)));
        CHECK((colour(0, 2) == Vec3f(0.15f))); // at the edge: not known
        std::fill_n(result.states.data(), 15, TexelState::hit);
        CHECK((colour(2, 1) == Vec3f(0.15f)));
        result.map.at(2, 0, 0) = 0.5f + 0.5f * 0.24f; // bends by 0.24 / 24 = 0.01, about .57 degrees
        CHECK(double(colour(2, 1).x) == doctest::Approx(0.15 + 0.85 * 0.573).epsilon(0.01));
        result.map.at(2, 0, 0) = 1; // 1.19 degrees
        CHECK((colour(2, 1) == Vec3f(1)));
        CHECK((report_map(result, Space::object, false).at(4, 0, 1) > 0)); // object space has no inward normals
    }
}
