#include "bake/verdict/chart/labels.h"
#include <algorithm>
#include <doctest/doctest.h>
#include <random>

using namespace bake;

TEST_SUITE("unit") {
    TEST_CASE("labels: a dot alone has its label at the right; at the right border, at the left") {
        const Box area{0, 0, 200, 100};
        const auto alone = place_labels({{{100, 50}, 5, 40, 12}}, area);
        REQUIRE(alone[0]);
        CHECK_FALSE(alone[0]->far);
        CHECK(alone[0]->box.left == doctest::Approx(108));
        CHECK((alone[0]->box.top + alone[0]->box.bottom) / 2 == doctest::Approx(50));
        const auto border = place_labels({{{180, 50}, 5, 40, 12}}, area);
        REQUIRE(border[0]);
        CHECK(border[0]->box.right == doctest::Approx(172));
    }

    TEST_CASE("labels: a line under the label is avoided; without room there is no label") {
        const Box area{0, 0, 200, 100};
        const auto beside = place_labels({{{100, 50}, 5, 40, 12}}, area, {{105, 0, 200, 100}});
        REQUIRE(beside[0]);
        CHECK(beside[0]->box.right == doctest::Approx(92));
        CHECK_FALSE(place_labels({{{100, 50}, 5, 300, 12}}, area)[0]);
    }

    TEST_CASE("labels: boxes and lines") {
        CHECK(overlap({0, 0, 2, 2}, {1, 1, 3, 3}));
        CHECK_FALSE(overlap({0, 0, 2, 2}, {2, 0, 3, 2}));
        CHECK(crosses({0, 0, 2, 2}, {-1, -1}, {3, 3}));
        CHECK(crosses({0, 0, 2, 2}, {1, 1}, {1, 1}));
        CHECK_FALSE(crosses({0, 0, 2, 2}, {-1, 1}, {-0.5, 1}));
        CHECK_FALSE(crosses({0, 0, 2, 2}, {3, -1}, {3, 3}));
        CHECK_FALSE(crosses({0, 0, 2, 2}, {1, 4}, {4, 1}));
    }

    TEST_CASE("labels: in 1000 random charts no label overlaps a dot or a label, all are inside, and most are placed") {
        std::mt19937 random(11);
        const auto uniform = [&](double low, double high) {
            return low + (high - low) * double(random()) / 4294967296.0;
        };
        std::size_t wanted = 0, missing = 0;
        const Box area{60, 40, 700, 430};
        for (int round = 0; round < 1000; ++round) {
            std::vector<LabelRequest> requests(1 + random() % 14);
            const double spread = uniform(0.05, 1); // some charts are crowded
            for (LabelRequest& r : requests)
                r = {{380 + spread * uniform(-310, 310), 235 + spread * uniform(-185, 185)}, 5.5, uniform(15, 150), 13};
            const auto places = place_labels(requests, area);
            for (std::size_t i = 0; i < requests.size(); ++i) {
                ++wanted;
                missing += !places[i];
                if (!places[i]) continue;
                const Box& box = places[i]->box;
                CHECK((box.left >= area.left && box.right <= area.right && box.top >= area.top &&
                       box.bottom <= area.bottom));
                CHECK(box.right - box.left == doctest::Approx(requests[i].width));
                for (std::size_t k = 0; k < requests.size(); ++k) {
                    const Point2& p = requests[k].dot;
                    CHECK_FALSE(overlap(box, {p.x - 5.5, p.y - 5.5, p.x + 5.5, p.y + 5.5}));
                    CHECK_FALSE((k != i && places[k] && overlap(box, places[k]->box)));
                }
            }
        }
        CHECK(missing * 100 < wanted);
    }
}
