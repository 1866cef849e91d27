// Probed pixels against whole pictures of many samples, and what decisions rest on.
#include "bake/base/parallel.h"
#include "verdict/plan/probe_scenes.h"
#include <doctest/doctest.h>
#include <limits>

using namespace bake;
using namespace bake::test;

namespace {

struct Pair {
    Scene candidate = ball_above_floor(0), reference = ball_above_floor(0.04f);
    ProbedScene shown() const { return {&candidate, first_of_two}; }
    ProbedScene wanted() const { return {&reference, first_of_two}; }
    std::vector<Pixel> pixels(const ProbeOptions& options) const {
        return object_pixels(std::array{shown(), wanted()}, options);
    }
};

/// Mean and standard error of the mean.
struct Mean {
    double sum = 0, squares = 0;
    int count = 0;
    void add(double x) { sum += x, squares += x * x, ++count; }
    double mean() const { return sum / count; }
    double error() const { return std::sqrt(std::max(0.0, squares / count - mean() * mean()) / (count - 1)); }
};

/// The tally of all pixels between two whole pictures.
ErrorTally tally_of(const std::vector<ProbedPixel>& a, const std::vector<ProbedPixel>& b) {
    ErrorTally tally;
    for (std::size_t i = 0; i < a.size(); ++i) tally.add(square_of(a[i], b[i]));
    return tally;
}

/// The mean of the squared difference of the means of all samples: what noise biases.
double naive_square(const std::vector<ProbedPixel>& a, const std::vector<ProbedPixel>& b) {
    double sum = 0, area = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const PixelSquare square = square_of(a[i], b[i]);
        if (!(square.a > 0)) continue;
        const Vec3d d = 0.5 * (Vec3d(a[i].mean[0]) + Vec3d(a[i].mean[1]) - Vec3d(b[i].mean[0]) - Vec3d(b[i].mean[1]));
        sum += glm::dot(d, d) / 3, area += square.a;
    }
    return sum / area;
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("probe_pixels: the halves of a pixel are those of a picture") {
        const Scene scene = ball_above_floor(0.04f);
        const ProbeOptions options = probe_options(scene, 10);
        const auto probed = probe_pixels({&scene, first_of_two}, all_pixels(10), options);
        const auto whole = whole_picture(scene, options, 16, 0);
        for (std::size_t i = 0; i < whole.size(); ++i) {
            CHECK(probed[i].covered == whole[i].covered);
            for (const std::size_t half : {0, 1})
                CHECK(glm::length(probed[i].mean[half] - whole[i].mean[half]) < 1e-5f);
        }
        RenderSettings settings = options.settings;
        settings.spp = 32;
        const Halves halves = render_halves(scene, settings);
        // The light is dim enough that nothing is clamped.
        for (std::size_t i = 0; i < whole.size(); ++i)
            CHECK(probed[i].mean[1].y == doctest::Approx(halves.b.at(int(i % 10), int(i / 10), 1)).epsilon(1e-4));
    }

    TEST_CASE("probe_pixels: half the samples are the first of them; odd numbers of samples are counted right") {
        const Scene scene = ball_above_floor(0.04f);
        ProbeOptions options = probe_options(scene, 12);
        const auto pixels = all_pixels(12);
        options.half = 32;
        const auto full = probe_pixels({&scene, first_of_two}, pixels, options);
        CHECK(std::any_of(full.begin(), full.end(), [](const ProbedPixel& pixel) {
            return pixel.covered[0] >> 16 != (pixel.covered[0] & 0xffff); // the second packet has samples of its own
        }));
        for (const int half : {1, 5, 16, 17}) {
            options.half = half;
            const auto part = probe_pixels({&scene, first_of_two}, pixels, options);
            const std::uint32_t mask = (1u << half) - 1;
            for (std::size_t i = 0; i < pixels.size(); ++i) {
                CHECK(part[i].samples == half);
                // One sample in two halves is not yet one at the centre of the pixel.
                CHECK(part[i].covered[0] == (full[i].covered[0] & mask));
                CHECK(part[i].covered[1] == (full[i].covered[1] & mask));
            }
        }
    }

    TEST_CASE("probe_pixels: a pixel does not depend on the pixels beside it, on their order, or on threads") {
        const Pair pair;
        const ProbeOptions options = probe_options(pair.candidate, 16);
        auto pixels = pair.pixels(options);
        const auto probed = probe_pixels(pair.shown(), pixels, options);
        {
            const ThreadLimit one(1);
            CHECK(probe_pixels(pair.shown(), pixels, options) == probed);
        }
        std::reverse(pixels.begin(), pixels.end());
        auto reversed = probe_pixels(pair.shown(), pixels, options);
        std::reverse(reversed.begin(), reversed.end());
        CHECK(reversed == probed);
        CHECK(probe_pixels(pair.shown(), std::span(pixels).first(1), options)[0] == probed.back());
        CHECK(probe_pixels(pair.shown(), {}, options).empty());
    }

    TEST_CASE("probe_pixels: a scene far from 0 is seen by its camera in the scene's coordinates") {
        // Coordinates of 2^10 leave 13 bits behind the point.
        const Scene here = ball_above_floor(0.04f), there = ball_above_floor(0.04f, Vec3f(1024, 0, -2048));
        REQUIRE(there.origin != Vec3f(0));
        const auto pixels = all_pixels(12);
        const auto near = probe_pixels({&here, first_of_two}, pixels, probe_options(here, 12));
        const auto far = probe_pixels({&there, first_of_two}, pixels, probe_options(there, 12));
        int equal = 0;
        for (std::size_t i = 0; i < pixels.size(); ++i) equal += near[i].covered == far[i].covered;
        CHECK(equal > 130);
        CHECK(tally_of(near, far).estimate().rmse() < 0.01);
    }

    TEST_CASE("probe_pixels: exposure doubles the samples per stop, and each is clamped before the mean") {
        const Scene scene = ball_above_floor(0);
        ProbeOptions options = probe_options(scene, 12);
        const auto pixels = all_pixels(12);
        const ProbedScene probed{&scene, first_of_two};
        const auto as_is = probe_pixels(probed, pixels, options);
        options.exposure = -2;
        const auto darker = probe_pixels(probed, pixels, options);
        options.exposure = 3;
        const auto brighter = probe_pixels(probed, pixels, options);
        const auto whole = whole_picture(scene, options, 16, 0);
        bool between = false; // a pixel with clamped and other samples
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            CHECK(darker[i].mean[0].x == doctest::Approx(as_is[i].mean[0].x / 4).epsilon(1e-5));
            CHECK(brighter[i].mean[0].x == doctest::Approx(whole[i].mean[0].x).epsilon(1e-5));
            CHECK(brighter[i].mean[0].x <= 1);
            between = between || brighter[i].mean[0].x < std::min(1.0f, 8 * as_is[i].mean[0].x) - 0.05f;
        }
        CHECK(between);
        for (const float stops : {-1000.0f, 1000.0f}) {
            options.exposure = stops;
            for (const ProbedPixel& pixel : probe_pixels(probed, pixels, options))
                CHECK((pixel.mean[0].x >= 0 && pixel.mean[0].x <= 1));
        }
    }

    TEST_CASE("probe_pixels: samples that are not finite are black") {
        Scene scene = ball_above_floor(0);
        scene.sky.background = Vec3f(std::numeric_limits<float>::infinity(), 0, std::nanf(""));
        const ProbeOptions options = probe_options(scene, 12);
        const auto probed = probe_pixels({&scene, first_of_two}, all_pixels(12), options);
        CHECK(probed[0].mean[0] == Vec3f(0)); // a corner, where the sky is seen
        for (const ProbedPixel& pixel : probed) CHECK(is_finite(pixel.mean[0] + pixel.mean[1]));
    }

    TEST_CASE(
        "square_of: of pictures that differ by d everywhere it is d squared, over the share that sees the object") {
        ProbedPixel a, b;
        a.samples = b.samples = 4;
        a.mean = {Vec3f(0.5f), Vec3f(0.5f)}, b.mean = {Vec3f(0.4f), Vec3f(0.4f)};
        a.covered = {0b0011, 0b0000}, b.covered = {0b0110, 0b1000};
        CHECK(square_of(a, b).m == doctest::Approx(0.01));
        CHECK(square_of(a, b).a == 0.5);
        b.mean[1] = Vec3f(0.6f);
        CHECK(square_of(a, b).m == doctest::Approx(-0.01)); // noise
        a.covered = b.covered = {};
        CHECK(square_of(a, b).m == 0); // another's pixel
        CHECK(square_of(a, b).a == 0);
    }

    TEST_CASE("square_of: with the object left open, every pixel counts whole") {
        const Pair pair;
        const ProbeOptions options = probe_options(pair.candidate, 8);
        const auto pixels = all_pixels(8);
        const auto a = probe_pixels({&pair.candidate, {}}, pixels, options);
        const auto b = probe_pixels({&pair.reference, {}}, pixels, options);
        for (std::size_t i = 0; i < pixels.size(); ++i) CHECK(square_of(a[i], b[i]).a == 1);
    }

    TEST_CASE("reference_probe: the error of a scene against itself is exactly 0, and within a budget of 0") {
        const Pair pair;
        const ProbeOptions options = probe_options(pair.candidate, 16);
        ReferenceProbe probe(pair.wanted(), pair.pixels(options), options);
        const Scene same = ball_above_floor(0.04f);
        const auto [estimate, settled] = probe.judge({&same, first_of_two}, 0);
        CHECK(estimate.square == 0);
        CHECK(estimate.error == 0);
        CHECK(settled == Settled::within);
        CHECK(estimate.all);
    }

    TEST_CASE("reference_probe: what is kept of the reference changes nothing, whatever was asked before") {
        const Pair pair;
        const ProbeOptions options = probe_options(pair.candidate, 24);
        const auto pixels = pair.pixels(options);
        ReferenceProbe used(pair.wanted(), pixels, options);
        const Scene coarse = ball_above_floor(0.1f);
        used.judge({&coarse, first_of_two}, 0.001);
        used.measure({&coarse, first_of_two}, 100);
        const auto first = used.judge(pair.shown(), 0.02);
        ReferenceProbe fresh(pair.wanted(), pixels, options);
        const auto second = fresh.judge(pair.shown(), 0.02);
        CHECK(first.estimate.square == second.estimate.square);
        CHECK(first.estimate.error == second.estimate.error);
        CHECK(first.estimate.pixels == second.estimate.pixels);
        CHECK(first.settled == second.settled);
    }

    TEST_CASE("reference_probe: it stops at the first look that settles, and at the most pixels at the latest") {
        const Pair pair;
        const ProbeOptions options = probe_options(pair.candidate, 40);
        const auto pixels = pair.pixels(options);
        REQUIRE(pixels.size() > 500);
        ReferenceProbe probe(pair.wanted(), pixels, options);
        const auto error = probe.measure(pair.shown(), 1 << 30);
        CHECK(error.all);
        REQUIRE(error.rmse() > 0.01);
        const auto pixels_for = [&](double budget, Settled expected) {
            const auto result = probe.judge(pair.shown(), budget);
            CHECK(result.settled == expected);
            return result.estimate.pixels;
        };
        const double infinite = std::numeric_limits<double>::infinity();
        CHECK(pixels_for(infinite, Settled::within) < 64); // at the first look
        CHECK(pixels_for(0.1 * error.rmse(), Settled::over) < 256);
        CHECK(pixels_for(0, Settled::over) < 256);
        const auto enough = pixels_for(3 * error.rmse(), Settled::within);
        CHECK((enough >= 364 && enough < 400)); // the first look at no fewer than 256
        const ProbeOptions closer = probe_options(pair.candidate, 110);
        ReferenceProbe large(pair.wanted(), pair.pixels(closer), closer);
        const double as_many = 8 * std::sqrt(double(large.pixels().size()));
        REQUIRE(as_many > 420);
        const auto passed = large.judge(pair.shown(), 3 * error.rmse());
        CHECK(passed.settled == Settled::within);
        CHECK(double(passed.estimate.pixels) >= as_many);
        CHECK(double(passed.estimate.pixels) < 1.7 * as_many); // the next look at the latest
        // Between fail_at and pass_at it is open to the end.
        StoppingRule rule{.rounds = 1, .fail_at = 0.99, .pass_at = 1.01};
        const auto open = probe.judge(pair.shown(), error.rmse(), 0, rule);
        CHECK(open.settled == Settled::open);
        CHECK(open.estimate.pixels == error.pixels);
        // All pixels are seen again with new samples, which lessens what the noise of the samples leaves open.
        rule = {.most = 1 << 20, .rounds = 1, .fail_at = 1e9, .pass_at = 0};
        const auto once = probe.judge(pair.shown(), error.rmse(), 0, rule).estimate;
        CHECK(once.square == error.square);
        rule.rounds = 4;
        const auto again = probe.judge(pair.shown(), error.rmse(), 0, rule).estimate;
        CHECK((again.all && again.pixels == error.pixels));
        CHECK(again.square != once.square);
        CHECK(std::abs(again.square - once.square) < 4 * once.error);
        CHECK(again.error < 0.7 * once.error);
        CHECK(again.error > 0.3 * once.error);
        rule = {.most = 300, .fail_at = 0.99, .pass_at = 1.01};
        const auto capped = probe.judge(pair.shown(), error.rmse(), 0, rule).estimate;
        CHECK((capped.pixels >= 300 && capped.pixels < 320));
        CHECK_FALSE(capped.all);
        // A budget that the reference's own error uses up can not be kept.
        CHECK(probe.judge(pair.shown(), 3 * error.rmse(), 4 * error.rmse()).settled == Settled::open);
        // Where a finer reference can be had, no pixels are spent on what this one cannot tell.
        const auto doubted = probe.judge(pair.shown(), 3 * error.rmse(), 4 * error.rmse(), {.until_reference = true});
        CHECK(doubted.settled == Settled::open);
        CHECK((doubted.estimate.pixels >= 364 && doubted.estimate.pixels < 400));
        CHECK(probe.judge(pair.shown(), 0.1 * error.rmse(), 0.3 * error.rmse(), {.until_reference = true}).settled ==
              Settled::over);
    }

    TEST_CASE("reference_probe: an object out of view has no pixels and is within; a tiny one is visited whole") {
        Pair pair;
        ProbeOptions options = probe_options(pair.candidate, 32);
        options.camera.target = options.camera.position + Vec3f(0, 0, 5); // behind
        ReferenceProbe behind(pair.wanted(), pair.pixels(options), options);
        CHECK(behind.pixels().empty());
        const auto unseen = behind.judge(pair.shown(), 0);
        CHECK(unseen.settled == Settled::within);
        CHECK(unseen.estimate.pixels == 0);
        CHECK(unseen.estimate.all);
        options.camera = pair.candidate.camera;
        options.camera.position *= 25; // the ball is 1 pixel wide
        ReferenceProbe tiny(pair.wanted(), pair.pixels(options), options);
        const auto seen = tiny.judge(pair.shown(), 0.5);
        CHECK((seen.estimate.pixels > 0 && seen.estimate.pixels <= 9));
        CHECK(seen.estimate.all);
        CHECK(seen.settled == Settled::within);
    }

    TEST_CASE("reference_probe: pixels of the object are counted, not pixels around it") {
        const Pair pair;
        const ProbeOptions options = probe_options(pair.candidate, 48);
        ReferenceProbe probe(pair.wanted(), all_pixels(48), options); // also those that show the floor and the sky
        const auto result = probe.judge(pair.shown(), std::numeric_limits<double>::infinity());
        CHECK((result.estimate.pixels >= 32 && result.estimate.pixels < 48));
        const auto all = probe.measure(pair.shown(), 1 << 30);
        const auto own = ReferenceProbe(pair.wanted(), pair.pixels(options), options).measure(pair.shown(), 1 << 30);
        CHECK(all.pixels == own.pixels);
        CHECK(all.square == doctest::Approx(own.square));
    }

    TEST_CASE("probe_pixels: a mirror and a tiny sun of any brightness err by a bounded amount") {
        const auto mirror_ball = [](float height) {
            Material mirror;
            mirror.reflect = Vec3f(1);
            Scene scene = one_mesh(sphere_mesh(), mirror);
            scene.instances[0].linear[1][1] = height;
            scene.sky.cube = constant_cube(Vec3f(0.1f), 32);
            for (int c = 0; c < 3; ++c) scene.sky.cube.faces[2].at(15, 15, c) = 1e6f;
            build(scene);
            return scene;
        };
        const Scene plain = mirror_ball(1), tilted = mirror_ball(0.97f);
        const std::vector<std::uint8_t> object{1};
        const ProbeOptions options = probe_options(plain, 24);
        const auto pixels = all_pixels(24);
        const auto a = probe_pixels({&plain, object}, pixels, options),
                   b = probe_pixels({&tilted, object}, pixels, options);
        double largest = 0;
        for (std::size_t i = 0; i < pixels.size(); ++i) largest = std::max(largest, std::abs(square_of(a[i], b[i]).m));
        CHECK((largest > 1e-4 && largest <= 1)); // the sun is seen
        CHECK(tally_of(a, b).estimate().rmse() < 0.5);
    }
}

TEST_SUITE("oracle") {

    TEST_CASE("reference_probe: the estimate is unbiased, of 2 samples per pixel too, where the naive square is not") {
        const Pair pair;
        ProbeOptions options = probe_options(pair.candidate, 16);
        Mean truth;
        for (std::uint32_t seed = 1000; seed < 1006; ++seed)
            truth.add(tally_of(whole_picture(pair.candidate, options, 64, seed),
                               whole_picture(pair.reference, options, 64, seed))
                          .estimate()
                          .square);
        for (const int half : {1, 4}) {
            Mean estimate, naive;
            options.half = half;
            const auto pixels = all_pixels(16);
            for (std::uint32_t seed = 0; seed < 128; ++seed) {
                options.seed = seed;
                const auto a = probe_pixels(pair.shown(), pixels, options);
                const auto b = probe_pixels(pair.wanted(), pixels, options);
                estimate.add(tally_of(a, b).estimate().square), naive.add(naive_square(a, b));
            }
            const double error = std::hypot(estimate.error(), truth.error());
            CHECK(std::abs(estimate.mean() - truth.mean()) < 3 * error);
            CHECK(naive.mean() > truth.mean() + 6 * error);
        }
    }

    TEST_CASE("square_of: v is the variance of m over seeds") {
        const Pair pair;
        ProbeOptions options = probe_options(pair.candidate, 12);
        options.half = 4;
        const auto pixels = all_pixels(12);
        std::vector<Mean> m(pixels.size()), v(pixels.size());
        for (std::uint32_t seed = 0; seed < 96; ++seed) {
            options.seed = seed;
            const auto a = probe_pixels(pair.shown(), pixels, options),
                       b = probe_pixels(pair.wanted(), pixels, options);
            for (std::size_t i = 0; i < pixels.size(); ++i) {
                const PixelSquare square = square_of(a[i], b[i]);
                m[i].add(square.m), v[i].add(square.v);
            }
        }
        double spread = 0, told = 0;
        for (std::size_t i = 0; i < pixels.size(); ++i)
            spread += m[i].squares / m[i].count - m[i].mean() * m[i].mean(), told += v[i].mean();
        CHECK(told == doctest::Approx(spread).epsilon(0.15));
    }

    TEST_CASE(
        "reference_probe: with all pixels visited the interval is that of the samples, and has the truth as often") {
        const Pair pair;
        ProbeOptions options = probe_options(pair.candidate, 20);
        options.half = 8;
        const double truth = tally_of(whole_picture(pair.candidate, options, 128, 1000),
                                      whole_picture(pair.reference, options, 128, 1000))
                                 .estimate()
                                 .rmse();
        int inside = 0, seeds = 60;
        double width = 0;
        for (int seed = 0; seed < seeds; ++seed) {
            options.seed = std::uint32_t(seed);
            ReferenceProbe probe(pair.wanted(), pair.pixels(options), options);
            const SquareEstimate estimate = probe.measure(pair.shown(), 1 << 20);
            inside += estimate.low() <= truth && truth <= estimate.high();
            width += (estimate.high() - estimate.low()) / truth / seeds;
        }
        CHECK(inside >= 0.9 * seeds);
        CHECK(width < 0.6);
    }

    TEST_CASE(
        "reference_probe: from 256 pixels on, the stated interval has the error of the whole picture in 90 % of the "
        "seeds") {
        const Pair pair;
        ProbeOptions options = probe_options(pair.candidate, 64);
        options.half = 8;
        const double truth =
            tally_of(whole_picture(pair.candidate, options, 32, 1000), whole_picture(pair.reference, options, 32, 1000))
                .estimate()
                .rmse();
        int inside = 0, seeds = 50;
        double width = 0;
        for (int seed = 0; seed < seeds; ++seed) {
            options.seed = std::uint32_t(seed);
            ReferenceProbe probe(pair.wanted(), pair.pixels(options), options);
            const SquareEstimate estimate = probe.measure(pair.shown(), 256);
            REQUIRE((estimate.pixels >= 256 && !estimate.all));
            inside += estimate.low() <= truth && truth <= estimate.high();
            width += (estimate.high() - estimate.low()) / truth / seeds;
        }
        CHECK(inside >= 0.9 * seeds);
        CHECK(width < 1.2); // of the RMSE: it is not without a meaning
    }
}
