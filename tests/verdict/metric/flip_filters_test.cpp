#include "bake/verdict/metric/flip.h"
#include "bake/verdict/metric/flip_filters.h"
#include "verdict/metric/pictures.h"
#include <algorithm>
#include <doctest/doctest.h>
#include <numeric>

using namespace bake;
using namespace bake::test;

namespace {

double sum(const std::vector<double>& weights) { return std::accumulate(weights.begin(), weights.end(), 0.0); }

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("flip_filters: radii and sums for the paper's viewer and for others") {
        const FlipFilters f(flip_pixels_per_degree);
        CHECK(f.luminance.size() == 21); // ceil(3 sqrt(0.04 / (2 pi^2)) 67.02) = 10
        CHECK(f.blue_yellow[1].size() == 21);
        CHECK(f.edge.size() == 19); // ceil(3 * 0.041 * 67.02) = 9
        CHECK(f.margin == 10);
        for (const double ppd : {1.0, 20.0, flip_pixels_per_degree, 300.0}) {
            const FlipFilters g(ppd);
            for (const auto* weights : {&g.luminance, &g.red_green, &g.blue_yellow[0], &g.blue_yellow[1], &g.smooth})
                CHECK(sum(*weights) == doctest::Approx(1).epsilon(1e-12));
            CHECK(g.blue_yellow_share[0] + g.blue_yellow_share[1] == doctest::Approx(1).epsilon(1e-12));
            for (const auto* weights : {&g.edge, &g.point}) {
                double positive = 0;
                for (const double w : *weights) positive += std::max(0.0, w);
                CHECK(positive == doctest::Approx(1).epsilon(1e-12));
                CHECK(std::abs(sum(*weights)) < 1e-12);
            }
        }
    }

    TEST_CASE("flip_filters: a step of luminance is an edge of its own height, whichever way it goes") {
        // In the middle of the step half of the derivative's weights, which sum to 1, see each side; their centre is 0.
        const FlipFilters f(flip_pixels_per_degree);
        const FlipColour space;
        const auto step = [](bool along_x, bool down) {
            return picture(40, 40, 3,
                           [=](int x, int y, int) { return ((along_x ? x : y) >= 20) != down ? 0.75 : 0.25; });
        };
        for (const bool along_x : {false, true})
            for (const bool down : {false, true}) {
                const FlipBand band = flip_band(step(along_x, down), f, space, 20, 21);
                const float strength = band.edge[along_x ? 20 : 5];
                CHECK(strength == doctest::Approx(0.5).epsilon(1e-5));
            }
        const FlipBand flat = flip_band(picture(5, 5, 3, [](int, int, int) { return 0.3; }), f, space, 0, 5);
        for (const float v : flat.edge) CHECK(v < 1e-6f);
        for (const float v : flat.point) CHECK(v < 1e-6f);
    }

    TEST_CASE("flip_filters: a band has the same bits as the picture") {
        const FlipFilters f(30);
        const FlipColour space;
        const Image<float> a = noisy(33, 40, 9);
        const FlipBand whole = flip_band(a, f, space, 0, 40), part = flip_band(a, f, space, 13, 17);
        for (std::size_t i = 0; i < part.edge.size(); ++i) {
            REQUIRE(part.edge[i] == whole.edge[13 * 33 + i]);
            REQUIRE(part.point[i] == whole.point[13 * 33 + i]);
            REQUIRE(part.colour[i] == whole.colour[13 * 33 + i]);
        }
    }
}
