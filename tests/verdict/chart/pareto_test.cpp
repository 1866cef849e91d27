#include "bake/verdict/chart/pareto.h"
#include <cmath>
#include <doctest/doctest.h>
#include <limits>
#include <random>

using namespace bake;

TEST_SUITE("unit") {
    TEST_CASE("pareto_front: by hand") {
        CHECK(pareto_front({}).empty());
        CHECK(pareto_front({{1, 1}}) == std::vector<bool>{true});
        CHECK(pareto_front({{1, 3}, {2, 2}, {3, 1}, {3, 2}, {2, 3}}) ==
              std::vector<bool>{true, true, true, false, false});
        CHECK(pareto_front({{2, 1}, {2, 1}, {2, 2}}) == std::vector<bool>{true, true, false});
        CHECK(pareto_front({{0, 5}, {1, 0}, {2, 0}}) == std::vector<bool>{true, true, false});
        const double nan = std::nan("");
        CHECK(pareto_front({{nan, 1}, {1, nan}, {1, 1}}) == std::vector<bool>{false, false, true});
        CHECK(pareto_front({{1, std::numeric_limits<double>::infinity()}}) == std::vector<bool>{true});
    }

    TEST_CASE("pareto_front: errors up to the noise are equal, so that the cheaper one wins") {
        CHECK(pareto_front({{1, 1e-5}, {2, 1e-6}, {3, 1e-7}}, 1e-5) == std::vector<bool>{true, false, false});
    }
}

TEST_SUITE("oracle") {
    TEST_CASE("pareto_front: the definition itself, over all pairs, on points with many ties") {
        std::mt19937 random(7);
        for (int round = 0; round < 500; ++round) {
            std::vector<CostError> points(1 + random() % 30);
            for (CostError& p : points) p = {double(random() % 9), double(random() % 9)};
            const double noise = double(random() % 3);
            const std::vector<bool> front = pareto_front(points, noise);
            for (std::size_t i = 0; i < points.size(); ++i) {
                bool beaten = false;
                for (const CostError& q : points) {
                    const double cost = q.cost - points[i].cost,
                                 error = std::max(noise, q.error) - std::max(noise, points[i].error);
                    beaten = beaten || (cost <= 0 && error <= 0 && (cost < 0 || error < 0));
                }
                CHECK(front[i] == !beaten);
            }
        }
    }
}
