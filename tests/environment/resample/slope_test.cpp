#include "bake/environment/resample/slope.h"
#include "environment/skies.h"
#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <random>

using namespace bake;

namespace {

constexpr int size = 12;

template <class Value> Image<float> picture_of(int channels, Value&& value) {
    Image<float> picture(2 * size, size, channels);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < 2 * size; ++x)
            for (int c = 0; c < channels; ++c) picture.at(x, y, c) = value(x, y, c);
    return picture;
}

template <class Visit> void for_each_inner_texel(const Image<float>& picture, Visit&& visit) {
    for (int y = 1; y + 1 < picture.height(); ++y)
        for (int x = 1; x + 1 < picture.width(); ++x) {
            Slopes s{};
            picture_slopes(Projection::latlong, picture, x, y, s);
            for (int c = 0; c < picture.channels(); ++c) visit(x, y, c, s.x[c], s.y[c]);
        }
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("slope: a linear picture has its own slopes, an extremum has none") {
        const Image<float> ramp = picture_of(3, [](int x, int y, int c) { return 100 + float(c) * x - 0.5f * y; });
        for_each_inner_texel(ramp, [](int, int, int c, float along, float down) {
            CHECK(along == doctest::Approx(c));
            CHECK(down == doctest::Approx(-0.5));
        });
        const Image<float> waves = picture_of(1, [](int x, int y, int) { return float(x % 2 + y % 2); });
        for_each_inner_texel(waves, [](int, int, int, float along, float down) {
            CHECK(along == 0);
            CHECK(down == 0);
        });
    }

    TEST_CASE("slope: what is linear in the plane of a face has its own slopes in all texels of the face") {
        // The texels beyond an edge are seen from the centre at other places of the plane than a row and a column further.
        const auto linear = [](const Vec3d& d, int c) { return 20 + (1 - 3 * c) * d.x / d.z - (2 + c) * d.y / d.z; };
        const Cube sky = test::sky_of(size, 2, [&](const Vec3d& d, int c) { return d.z > 0.1 ? linear(d, c) : 0; });
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                Slopes s{};
                face_slopes(sky, false, CubeFace::pz, x, y, s);
                for (int c = 0; c < 2; ++c) {
                    CHECK(s.x[c] == doctest::Approx(2.0 / size * (1 - 3 * c)).epsilon(1e-4));
                    CHECK(s.y[c] == doctest::Approx(2.0 / size * (2 + c)).epsilon(1e-4)); // rows run down
                }
            }
    }

    TEST_CASE("slope: on noise the values inside a texel stay within the range of its neighbours") {
        std::mt19937 random(3);
        std::lognormal_distribution<float> noise(0, 2);
        for (int channels = 1; channels <= 4; ++channels) {
            const Image<float> picture = picture_of(channels, [&](int, int, int) { return noise(random); });
            int steep = 0;
            for_each_inner_texel(picture, [&](int x, int y, int c, float along, float down) {
                const float own = picture.at(x, y, c), left = picture.at(x - 1, y, c), right = picture.at(x + 1, y, c),
                            above = picture.at(x, y - 1, c), below = picture.at(x, y + 1, c);
                const auto within = [own](float value, float a, float b) {
                    const float slack = 1e-5f * (std::abs(own) + std::abs(a) + std::abs(b));
                    return value >= std::min({own, a, b}) - slack && value <= std::max({own, a, b}) + slack;
                };
                const float lowest = std::min(std::min(left, right), std::min(above, below)),
                            highest = std::max(std::max(left, right), std::max(above, below));
                for (const float side : {-0.5f, 0.5f}) {
                    // Along an axis towards one neighbour not beyond that neighbour.
                    CHECK(within(own + side * along, own, side < 0 ? left : right));
                    CHECK(within(own + side * down, own, side < 0 ? above : below));
                    for (const float other : {-0.5f, 0.5f})
                        CHECK(within(own + side * along + other * down, lowest, highest));
                }
                steep += along != 0 && down != 0;
            });
            CHECK(steep > 5); // there are texels that are no extremum
        }
    }

} // TEST_SUITE
