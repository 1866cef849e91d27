#include "bake/base/error.h"
#include "bake/verdict/compare/figures.h"
#include <doctest/doctest.h>
#include <limits>

using namespace bake;

TEST_SUITE("unit") {
    TEST_CASE("figures: a limit holds from its own side, and at the limit it is kept") {
        std::vector<Figure> figures = {{"psnr", 30, true}, {"rmse", 0.5}};
        add_figures(figures, "flip", {.mean = 0.1, .p95 = 0.2, .p99 = 0.3, .max = 0.4});
        CHECK(over_limits(figures, {}).empty());
        CHECK(over_limits(figures, {{"psnr", 30}, {"rmse", 0.5}, {"flip", 0.1}, {"flip-max", 0.4}}).empty());
        CHECK(over_limits(figures, {{"psnr", 31}}).size() == 1);
        CHECK(over_limits(figures, {{"psnr", 29}, {"rmse", 0.4}, {"flip-p95", 0.19}, {"flip-p99", 0.31}}).size() == 2);
        CHECK(over_limits(figures, {{"flip", 0.05}}).front() == "over the limit: flip is 0.1, the limit 0.05");
        CHECK(over_limits({{"psnr", std::numeric_limits<double>::infinity(), true}}, {{"psnr", 1e30}}).empty());
    }

    TEST_CASE("figures: a limit of what is not computed is refused with the names that are") {
        try {
            over_limits({{"rmse", 0.5}, {"psnr", 3, true}}, {{"flip", 0.1}});
            FAIL("not refused");
        } catch (const Error& error) {
            CHECK(error.refusal == Refusal::usage);
            CHECK(std::string(error.what()) == "`limit` flip: is not computed here; these are: rmse, psnr");
        }
    }
}
