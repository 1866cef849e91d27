#include "bake/verdict/metric/error_summary.h"
#include "verdict/metric/pictures.h"
#include <doctest/doctest.h>

using namespace bake;
using bake::test::picture;

TEST_SUITE("unit") {
    TEST_CASE("error_summary: percentiles are those of nearest rank, whatever the order") {
        // 1 to 200 in a mixed order: 77 is prime to 200.
        const auto value = [](int x, int y, int) { return 1 + (20 * y + x) * 77 % 200; };
        const ErrorSummary s = summarise(picture(20, 10, 1, value));
        CHECK(s.mean == 100.5);
        CHECK(s.p95 == 190);
        CHECK(s.p99 == 198);
        CHECK(s.max == 200);
        std::vector<double> list;
        for (int i = 0; i < 200; ++i) list.push_back(1 + i * 77 % 200);
        const ErrorSummary t = summarise(list);
        CHECK(t.mean == 100.5);
        CHECK(t.p95 == 190);
        CHECK(t.p99 == 198);
        CHECK(t.max == 200);
    }

    TEST_CASE("error_summary: of one error all are that error, of none 0") {
        const ErrorSummary one = summarise(std::vector<double>{3});
        CHECK(one.mean == 3);
        CHECK(one.p95 == 3);
        CHECK(one.p99 == 3);
        CHECK(one.max == 3);
        CHECK(summarise(std::vector<double>{}).max == 0);
        CHECK(summarise(Image<float>()).mean == 0);
    }

    TEST_CASE("error_summary: the mean of many small errors beside a large one is summed in double") {
        // In float, 1e-3 would not change a sum of 1e6 beyond its last bit, 0.06.
        const auto value = [](int x, int y, int) { return x == 0 && y == 0 ? 1e6 : 1e-3; };
        const double expected = (1e6 + (1e6 - 1) * double(1e-3f)) / 1e6;
        CHECK(summarise(picture(1000, 1000, 1, value)).mean == doctest::Approx(expected).epsilon(1e-12));
    }
}
