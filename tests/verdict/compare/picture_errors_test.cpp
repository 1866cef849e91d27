#include "bake/verdict/compare/picture_errors.h"
#include "verdict/metric/pictures.h"
#include <cmath>
#include <doctest/doctest.h>
#include <random>

using namespace bake;

namespace {

constexpr int edge = 40;

double reference_at(int x, int y, int c) { return 0.3 + 0.2 * std::sin(0.2 * x + c) * std::cos(0.15 * y); }
/// What the method adds; other pixels have other errors.
double fault_at(int x, int y, int c) { return 0.04 * std::sin(0.3 * x) + 0.02 * std::cos(0.2 * y + c); }

/// Both halves, with noise that is independent in all values.
Halves noisy(double fault, double sigma, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0, sigma);
    const auto half = [&] {
        return test::picture(edge, edge, 3, [&](int x, int y, int c) {
            return reference_at(x, y, c) + fault * fault_at(x, y, c) + (sigma > 0 ? normal(random) : 0);
        });
    };
    Halves halves;
    halves.a = half(), halves.b = half();
    return halves;
}

MethodPicture picture_of(Halves halves) {
    MethodPicture picture;
    picture.halves = std::move(halves);
    picture.normals = test::picture(edge, edge, 3, [](int, int, int c) { return c == 2; });
    picture.mask = {.factor = 1, .width = edge, .height = edge, .inside = std::vector<std::uint8_t>(edge * edge, 1)};
    return picture;
}

double true_square() {
    double sum = 0;
    for (int y = 0; y < edge; ++y)
        for (int x = 0; x < edge; ++x)
            for (int c = 0; c < 3; ++c) sum += fault_at(x, y, c) * fault_at(x, y, c);
    return sum / (3.0 * edge * edge);
}

const std::vector<std::uint8_t> all_pixels(edge* edge, 1);

} // namespace

TEST_SUITE("oracle") {
    TEST_CASE("picture_errors: the squared error has no bias, and its standard error covers the truth as often as it "
              "should") {
        const double truth = true_square();
        for (const double sigma : {0.02, 0.1}) { // below and above the error itself
            int covered = 0;
            double sum = 0, naive = 0;
            constexpr int seeds = 300;
            for (unsigned seed = 0; seed < seeds; ++seed) {
                const Halves x = noisy(0, sigma, 2 * seed + 1), y = noisy(1, sigma, 2 * seed + 2);
                const Estimate square = square_error(x, y, 0, all_pixels);
                covered += std::abs(square.value - truth) <= square.error;
                sum += square.value;
                const Estimate same =
                    square_error({mean_picture(x), mean_picture(x)}, {mean_picture(y), mean_picture(y)}, 0, all_pixels);
                naive += same.value;
            }
            CAPTURE(sigma);
            CHECK(sum / seeds == doctest::Approx(truth).epsilon(sigma < 0.05 ? 0.005 : 0.03));
            CHECK(naive / seeds > truth + 0.9 * sigma * sigma); // what the halves are for
            CHECK(covered >= 0.6 * seeds);
            CHECK(covered <= 0.75 * seeds);
        }
    }

    TEST_CASE("picture_errors: the standard errors of RMSE, PSNR, SSIM and FLIP are those of repeated renderings") {
        constexpr int seeds = 24;
        double sums[4] = {}, squares[4] = {}, stated[4] = {};
        for (unsigned seed = 0; seed < seeds; ++seed) {
            const MethodPicture x = picture_of(noisy(0, 0.01, 1000 + 2 * seed)),
                                y = picture_of(noisy(1, 0.01, 1001 + 2 * seed));
            const AreaErrors errors = picture_errors(x, y, {}).object;
            const Estimate found[4] = {errors.rmse, errors.psnr, errors.ssim, errors.flip};
            for (int i = 0; i < 4; ++i) {
                sums[i] += found[i].value, squares[i] += found[i].value * found[i].value;
                stated[i] += found[i].error * found[i].error;
            }
        }
        for (int i = 0; i < 4; ++i) {
            const double mean = sums[i] / seeds, spread = std::sqrt(squares[i] / seeds - mean * mean);
            CAPTURE(i);
            CHECK(std::sqrt(stated[i] / seeds) / spread > 0.65);
            CHECK(std::sqrt(stated[i] / seeds) / spread < 1.5);
        }
    }
}

TEST_SUITE("unit") {
    TEST_CASE("picture_errors: equal pictures are 0 and infinity exactly, with or without noise") {
        const MethodPicture picture = picture_of(noisy(1, 0.05, 3)), same = picture_of(noisy(1, 0.05, 3));
        const PictureErrors errors = picture_errors(picture, same, {.exposure = 0.5f});
        for (const AreaErrors* area : {&errors.object, &errors.frame}) {
            CHECK(area->square.value == 0);
            CHECK(area->square.error == 0);
            CHECK(area->rmse.value == 0);
            CHECK(std::isinf(area->psnr.value));
            CHECK(area->ssim.value == 1);
            CHECK(area->flip.value == 0);
            CHECK(area->hdr_flip.value == 0);
        }
        CHECK(errors.angles.max == 0);
        CHECK(errors.outline.max == 0);
    }

    TEST_CASE(
        "picture_errors: the object's pixels alone count for the object, and the worst part is where the error is") {
        const auto with_spot = [](double value) {
            const Image<float> whole = test::picture(edge, edge, 3, [&](int x, int y, int) {
                return x >= 28 && x < 34 && y >= 12 && y < 18 ? value : 0.25;
            });
            Halves halves;
            halves.a = test::picture(edge, edge, 3, [&](int x, int y, int c) { return whole.at(x, y, c); });
            halves.b = test::picture(edge, edge, 3, [&](int x, int y, int c) { return whole.at(x, y, c); });
            return picture_of(std::move(halves));
        };
        MethodPicture x = with_spot(0.25), y = with_spot(0.75);
        for (MethodPicture* picture : {&x, &y})
            for (int i = 0; i < edge * edge; ++i) picture->mask.inside[std::size_t(i)] = i % edge >= 20;
        PictureErrors errors = picture_errors(x, y, {});
        CHECK(errors.object.pixels == edge * 20);
        CHECK(errors.object.square.value == doctest::Approx(0.25 * 36 / (edge * 20)));
        CHECK(errors.frame.square.value == doctest::Approx(0.25 * 36 / (edge * edge)));
        CHECK(errors.object.flip.value > 1.9 * errors.frame.flip.value);
        CHECK((errors.worst.x <= 33 && errors.worst.x + errors.worst.width > 28));
        CHECK((errors.worst.y <= 15 && errors.worst.y + errors.worst.height > 12));
        // At twice the light the larger value is clamped to 1: .5 and 1.
        errors = picture_errors(x, y, {.exposure = 1});
        CHECK(errors.object.square.value == doctest::Approx(0.25 * 36 / (edge * 20)));
        // Normals turned by 10 degrees in the pixels of the object.
        for (int i = 0; i < edge * edge; ++i) {
            y.normals.data()[3 * i] = std::sin(0.1745329f), y.normals.data()[3 * i + 2] = std::cos(0.1745329f);
            if (i % edge < 20) y.normals.data()[3 * i] = 1;
        }
        errors = picture_errors(x, y, {});
        CHECK(errors.angles.mean == doctest::Approx(10).epsilon(1e-5));
        CHECK(errors.angles.max == doctest::Approx(10).epsilon(1e-5));
    }

    TEST_CASE("picture_errors: the root of a square below its noise is 0 with the root of the noise") {
        CHECK(root({4, 0.4}).value == 2);
        CHECK(root({4, 0.4}).error == doctest::Approx(0.1));
        CHECK(root({-1, 0.04}).value == 0);
        CHECK(root({-1, 0.04}).error == doctest::Approx(0.2));
        CHECK(root({0, 0}).error == 0);
    }

    TEST_CASE("frame_errors: those of all pixels of picture_errors") {
        const MethodPicture x = picture_of(noisy(0, 0.02, 5)), y = picture_of(noisy(1, 0.02, 6));
        const PictureErrors all = picture_errors(x, y, {.exposure = 0.5f});
        const FrameErrors frame = frame_errors(x.halves, y.halves, {.exposure = 0.5f});
        CHECK(frame.rmse.value == all.frame.rmse.value);
        CHECK(frame.rmse.error == all.frame.rmse.error);
        CHECK(frame.flip_summary.mean == doctest::Approx(all.frame.flip.value));
        CHECK(frame.flip_summary.p95 == doctest::Approx(all.frame.flip_of_pixels.p95));
        CHECK(frame.worst.x == all.worst.x);
        CHECK(frame.worst.y == all.worst.y);
    }
}
