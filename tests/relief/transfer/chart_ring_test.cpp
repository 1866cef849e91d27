#include "bake/base/parallel.h"
#include "bake/relief/map/normal_code.h"
#include "bake/relief/transfer/chart_ring.h"
#include "relief/transfer/transfer_meshes.h"

using namespace bake;
using namespace bake::test;

namespace {

struct Chart {
    Image<float> map;
    Image<unsigned char> owned;

    /// Texels for which inside(x, y) have the vector value(x, y), the others are flat.
    template <class Inside, class Value>
    Chart(int width, int height, const Inside& inside, const Value& value)
        : map(width, height, 3), owned(width, height, 1) {
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                owned.at(x, y) = inside(x, y);
                const Vec3f code = encode_normal(inside(x, y) ? Vec3f(value(x, y)) : Vec3f(0, 0, 1), false);
                for (int c = 0; c < 3; ++c) map.at(x, y, c) = code[c];
            }
    }
    Vec3d at(int x, int y) const {
        return Vec3d(decode_normal({map.at(x, y, 0), map.at(x, y, 1), map.at(x, y, 2)}, false));
    }
};

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("continue_charts: a linear ramp goes on as it is, on every side") {
        const auto ramp = [](int x, int y) { return Vec3d(0.02 * x - 0.1, 0.03 * y - 0.1, 1.0); };
        Chart chart(
            12, 10, [](int x, int y) { return x >= 3 && x < 9 && y >= 2 && y < 7; }, ramp);
        CHECK(continue_charts(chart.map, chart.owned) == 2 * 6 + 2 * 5 + 4);
        for (int x = 3; x < 9; ++x)
            for (const int y : {1, 7}) CHECK(glm::length(chart.at(x, y) - glm::normalize(ramp(x, y))) < 1e-6);
        for (int y = 2; y < 7; ++y)
            for (const int x : {2, 9}) CHECK(glm::length(chart.at(x, y) - glm::normalize(ramp(x, y))) < 1e-6);
        for (const int x : {2, 9})
            for (const int y : {1, 7}) {
                CAPTURE(x);
                CAPTURE(y);
                CHECK(glm::length(chart.at(x, y) - glm::normalize(ramp(x, y))) < 1e-6);
                CHECK(chart.owned.at(x, y) == 1);
            }
        CHECK(chart.owned.at(1, 4) == 0);
        CHECK((chart.at(1, 4) == Vec3d(0, 0, 1)));
    }

    TEST_CASE("continue_charts: normals of unit length turn on, with an error of the third order in the step") {
        const auto error = [](double step) {
            const auto turned = [&](int x, int) { return Vec3d(std::sin(step * x), 0, std::cos(step * x)); };
            Chart chart(
                4, 1, [](int x, int) { return x > 0; }, turned);
            continue_charts(chart.map, chart.owned);
            return oracle::angle_deg(chart.at(0, 0), turned(0, 0));
        };
        CHECK(error(0.2) < 0.5);
        CHECK(error(0.2) / error(0.1) == doctest::Approx(8).epsilon(0.1));
    }

    TEST_CASE("continue_charts: where the two owned texels differ by more than 30 degrees, and of one texel, a copy") {
        for (const double step_deg : {29.0, 31.0}) {
            const double step = glm::radians(step_deg);
            const auto turned = [&](int x, int) { return Vec3d(std::sin(step * x), 0, std::cos(step * x)); };
            Chart chart(
                4, 1, [](int x, int) { return x > 0; }, turned);
            continue_charts(chart.map, chart.owned);
            CHECK((oracle::angle_deg(chart.at(0, 0), turned(1, 0)) < 1e-4) == (step_deg > 30));
        }
        const Vec3d lone = glm::normalize(Vec3d(0.3, 0.2, 1));
        Chart one(
            3, 3, [](int x, int y) { return x == 1 && y == 1; }, [&](int, int) { return lone; });
        CHECK(continue_charts(one.map, one.owned) == 8);
        for (int y = 0; y < 3; ++y)
            for (int x = 0; x < 3; ++x) CHECK(glm::length(one.at(x, y) - lone) < 1e-6);
    }

    TEST_CASE("continue_charts: a texel between two charts has the mean of what both continue to") {
        const Vec3d left = glm::normalize(Vec3d(0.2, 0, 1)), right = glm::normalize(Vec3d(-0.1, 0.1, 1));
        Chart chart(
            5, 1, [](int x, int) { return x != 2; }, [&](int x, int) { return x < 2 ? left : right; });
        CHECK(continue_charts(chart.map, chart.owned) == 1);
        CHECK(glm::length(chart.at(2, 0) - glm::normalize(left + right)) < 1e-6);
    }

} // TEST_SUITE

TEST_SUITE("stability") {

    TEST_CASE(
        "continue_charts: nothing owned and all owned leave the map; the number of threads does not change a bit") {
        for (const bool all : {false, true}) {
            Chart chart(
                7, 5, [&](int, int) { return all; }, [](int, int) { return Vec3d(0, 0.6, 0.8); });
            const Vec3d before = chart.at(3, 3);
            CHECK(continue_charts(chart.map, chart.owned) == 0);
            CHECK((chart.at(3, 3) == before));
        }
        const auto run = [](int threads) {
            const ThreadLimit limit(threads);
            Chart chart(
                90, 70, [](int x, int y) { return (x * 7 + y * 3) % 11 < 4; },
                [](int x, int y) { return glm::normalize(Vec3d(std::sin(x), std::cos(y), 2)); });
            continue_charts(chart.map, chart.owned);
            return std::move(chart.map);
        };
        const Image<float> one = run(1);
        CHECK(same_bytes(one, run(2)));
        CHECK(same_bytes(one, run(7)));
    }

} // TEST_SUITE
