// Estimates against sums by hand, and the laws of stopping.
#include "bake/verdict/plan/error_tally.h"
#include <doctest/doctest.h>
#include <limits>
#include <vector>

using namespace bake;

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

SquareEstimate estimate_of(const std::vector<PixelSquare>& pixels) {
    ErrorTally tally;
    for (const PixelSquare& pixel : pixels) tally.add(pixel);
    return tally.estimate();
}

/// An estimate whose interval, in RMSE, is from low to high.
SquareEstimate between(double low, double high, std::int64_t pixels) {
    return {(low * low + high * high) / 2, (high * high - low * low) / 4, pixels, false};
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("error_tally: the estimate is the sum of squares over the sum of areas, and its error counts the largest "
              "square twice") {
        const SquareEstimate estimate = estimate_of({{0.5, 1}, {0.25, 0.5}, {-0.25, 0.5}, {0.5, 2}, {9, 0}});
        // R = 1 / 4; q = .25, .125, -.375, 0; largest |m| = .5
        CHECK(estimate.square == doctest::Approx(0.25));
        const double squares = 0.25 * 0.25 + 0.125 * 0.125 + 0.375 * 0.375;
        CHECK(estimate.error == doctest::Approx(std::sqrt(squares + 0.25) / 4));
        CHECK(estimate.pixels == 4); // the last pixel does not show the object
        CHECK(estimate.rmse() == doctest::Approx(0.5));
        CHECK(estimate.low() == doctest::Approx(std::sqrt(std::fmax(0.0, 0.25 - 2 * estimate.error))));
        CHECK(estimate.high() == doctest::Approx(std::sqrt(0.25 + 2 * estimate.error)));
    }

    TEST_CASE(
        "error_tally: the error between pixels counts as far as pixels are left, that of the samples as far as not") {
        ErrorTally tally;
        for (const PixelSquare& pixel : {PixelSquare{0.5, 1, 0.02}, {0.25, 1, 0.01}, {0, 2, 0.03}}) tally.add(pixel);
        const double pixels = tally.estimate().error, samples = tally.estimate(1).error;
        // R = .1875; q = .3125, .0625, -.375
        CHECK(pixels == doctest::Approx(std::sqrt(0.3125 * 0.3125 + 0.0625 * 0.0625 + 0.375 * 0.375 + 0.25) / 4));
        CHECK(samples == doctest::Approx(std::sqrt(0.06 + 0.03) / 4));
        CHECK(tally.estimate(0.25).error ==
              doctest::Approx(std::sqrt(0.75 * pixels * pixels + 0.25 * samples * samples)));
        CHECK(tally.estimate(1).square == tally.estimate().square);
    }

    TEST_CASE("error_tally: without pixels and with equal pictures the estimate is exactly 0") {
        for (const auto& pixels : {std::vector<PixelSquare>{}, {{0, 1}, {0, 0.3}, {0, 0.1}}}) {
            const SquareEstimate estimate = estimate_of(pixels);
            CHECK(estimate.square == 0);
            CHECK(estimate.error == 0);
            CHECK(estimate.pixels == std::int64_t(pixels.size()));
            CHECK(estimate.high() == 0);
        }
    }

    TEST_CASE("error_tally: scaling pictures by s scales the RMSE by s; weights of areas cancel") {
        const SquareEstimate one = estimate_of({{0.5, 1}, {0.25, 0.5}, {-0.25, 0.5}});
        const SquareEstimate brighter = estimate_of({{4.5, 1}, {2.25, 0.5}, {-2.25, 0.5}});
        const SquareEstimate larger = estimate_of({{1, 2}, {0.5, 1}, {-0.5, 1}});
        CHECK(brighter.rmse() == doctest::Approx(3 * one.rmse()));
        CHECK(brighter.high() == doctest::Approx(3 * one.high()));
        CHECK(larger.square == doctest::Approx(one.square));
        CHECK(larger.error == doctest::Approx(one.error));
    }

    TEST_CASE("error_tally: noise may make the square negative, but not an end of the interval") {
        const SquareEstimate estimate = estimate_of({{-0.1, 1}, {-0.3, 1}});
        CHECK(estimate.square == doctest::Approx(-0.2));
        CHECK(estimate.rmse() == 0);
        CHECK(estimate.low() == 0);
    }

    TEST_CASE("judge: over at any look, within from pass_from pixels or when all are visited") {
        CHECK(judge(between(0.0091, 0.02, 32), 0.01) == Settled::over);
        CHECK(judge(between(0.0089, 0.02, 2048), 0.01) == Settled::open);
        CHECK(judge(between(0.001, 0.011, 256), 0.01) == Settled::within);
        CHECK(judge(between(0.001, 0.011, 255), 0.01) == Settled::open);
        CHECK(judge(between(0.001, 0.0111, 2048), 0.01) == Settled::open);
        SquareEstimate few = between(0.001, 0.01, 7);
        few.all = true;
        CHECK(judge(few, 0.01) == Settled::within);
    }

    TEST_CASE("judge: a larger budget is never judged more strictly, and a less exact reference never settles more") {
        const auto grade = [](Settled settled) {
            return settled == Settled::over ? -1 : settled == Settled::open ? 0 : 1;
        };
        for (const SquareEstimate& estimate :
             {between(0.002, 0.004, 300), between(0, 0.004, 300), between(0.01, 0.0101, 40), SquareEstimate{},
              SquareEstimate{-1e-4, 1e-5, 400, false}}) {
            int before = -1;
            for (const double budget : {0.0, 0.001, 0.002, 0.003, 0.004, 0.008, 0.02, infinite}) {
                const int now = grade(judge(estimate, budget));
                CHECK(now >= before);
                before = now;
                CHECK((now < 1 || acceptable(estimate, budget)));
                for (const double error : {0.0005, 0.002, 0.01}) {
                    const int doubtful = grade(judge(estimate, budget, error));
                    CHECK((doubtful == 0 || doubtful == now));
                    CHECK((!acceptable(estimate, budget, error) || acceptable(estimate, budget)));
                }
            }
        }
    }

    TEST_CASE("judge: the error of the reference widens the interval of the RMSE on both sides") {
        CHECK(judge(between(0.0101, 0.02, 32), 0.01, 0.001) == Settled::over);
        CHECK(judge(between(0.0099, 0.02, 32), 0.01, 0.001) == Settled::open);
        CHECK(judge(between(0.001, 0.0099, 256), 0.01, 0.001) == Settled::within);
        CHECK(judge(between(0.001, 0.0101, 256), 0.01, 0.001) == Settled::open);
    }

    TEST_CASE("judge: within a budget of 0 are equal pictures alone, within an infinite one is everything") {
        const SquareEstimate equal{0, 0, 256, false}, close{1e-12, 0, 256, false}, noise{0, 1e-12, 256, false},
            below{-1, 0.1, 256, false};
        CHECK(judge(equal, 0) == Settled::within);
        CHECK(judge({0, 0, 255, false}, 0) == Settled::open);
        CHECK(judge(equal, 0, 1e-9) == Settled::open);
        CHECK(judge(close, 0) == Settled::over);
        CHECK(judge(noise, 0) == Settled::open);
        CHECK(judge(below, 0) == Settled::open);
        CHECK(acceptable(equal, 0));
        for (const SquareEstimate& estimate : {close, noise, below}) CHECK_FALSE(acceptable(estimate, 0));
        for (const SquareEstimate& estimate : {SquareEstimate{}, {1e30, 1e30, 1, false}}) {
            CHECK(judge(estimate, infinite, 1e9) == Settled::within);
            CHECK(acceptable(estimate, infinite, 1e9));
        }
    }

    TEST_CASE("judge: an object that no picture shows is within every budget; one that was not looked at is open") {
        const SquareEstimate unseen{0, 0, 0, true};
        CHECK(judge(unseen, 0, 0.1) == Settled::within);
        CHECK(acceptable(unseen, 0, 0.1));
        CHECK(judge({}, 0.01) == Settled::open);
    }

    TEST_CASE("acceptable: at the end one standard error is enough") {
        CHECK(acceptable({1.0e-4, 0.2e-4, 2048, false}, 0.01));
        CHECK_FALSE(acceptable({1.0e-4, 0.22e-4, 2048, false}, 0.01));
        CHECK(acceptable({1.0e-4, 0.2e-4, 2048, false}, 0.01, 0.0009));
        CHECK_FALSE(acceptable({1.0e-4, 0.2e-4, 2048, false}, 0.01, 0.0011));
    }
}
