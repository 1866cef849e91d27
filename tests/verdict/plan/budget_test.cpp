// Words for budgets.
#include "bake/base/error.h"
#include "bake/verdict/plan/budget.h"
#include <cmath>
#include <doctest/doctest.h>

using namespace bake;

TEST_SUITE("unit") {
    TEST_CASE("parse_budget: names stand for RMSE, and keep the user's word") {
        CHECK(parse_budget("strict").value == 0.005);
        CHECK(parse_budget("normal").value == 0.01);
        CHECK(parse_budget("loose").value == 0.02);
        for (const char* word : {"strict", "normal", "loose"}) {
            CHECK(parse_budget(word).metric == Budget::Metric::rmse);
            CHECK(parse_budget(word).name == word);
        }
        CHECK(Budget{}.value == parse_budget(Budget{}.name).value);
    }

    TEST_CASE("parse_budget: a metric and a number from 0 up, without bound too") {
        CHECK(parse_budget("rmse=.01").value == 0.01);
        CHECK(parse_budget("rmse=0").value == 0);
        CHECK(std::isinf(parse_budget("rmse=inf").value));
        CHECK(parse_budget("flip=2e-2").value == 0.02);
        CHECK(parse_budget("flip=2e-2").metric == Budget::Metric::flip);
        CHECK(parse_budget("deg=1").metric == Budget::Metric::degrees);
        CHECK(parse_budget("deg=1").name == "deg=1");
    }

    TEST_CASE("parse_budget: everything else is refused by its name") {
        for (const char* word : {"", "Strict", "rmse", "rmse=", "rmse=-1", "rmse=nan", "rmse=-inf", "rmse=1e999", "=1",
                                 "strict=1", "psnr=40", "rmse=0.01 ", "rmse=0,01", "0.01"}) {
            CAPTURE(word);
            try {
                parse_budget(word);
                FAIL("is not refused");
            } catch (const Error& error) {
                CHECK(error.refusal == Refusal::usage);
                CHECK(std::string(error.what()).starts_with("`budget` " + std::string(word) + ": "));
            }
        }
    }
}
