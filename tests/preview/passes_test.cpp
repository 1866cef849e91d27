// Rendering in passes: prefixes, independent halves, adaptive sampling, limits.
#include "bake/base/parallel.h"
#include "bake/preview/passes.h"
#include "preview/little_scenes.h"
#include <cstring>
#include <doctest/doctest.h>
#include <mutex>

using namespace bake;
using namespace bake::test;

namespace {

/// A ball before black under a quad light that shines to both sides, of which parts of the ball see a part only: noise
/// there alone.
Scene ball_under_quad(int size = 48, float distance = 4) {
    Material material;
    material.reflectance.specular = Vec3f(0.2f);
    Scene scene = one_mesh(sphere_mesh(32, 16), material);
    Light<float> quad;
    quad.kind = LightKind::quad;
    quad.position = Vec3f(3, 1, 2), quad.edge_u = Vec3f(0, 3, 0), quad.edge_v = Vec3f(2, 0, -2);
    quad.colour = Vec3f(2, 1.5f, 1);
    scene.lights.push_back(quad);
    quad.edge_v = -quad.edge_v;
    scene.lights.push_back(quad);
    scene.camera.position.z = distance;
    scene.settings.width = scene.settings.height = size;
    build(scene);
    return scene;
}

bool same(const Image<float>& a, const Image<float>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

double mean(const Image<float>& image) {
    double sum = 0;
    for (std::size_t i = 0; i < image.size(); ++i) sum += image.data()[i];
    return sum / double(image.size());
}

/// Mean square of the difference.
double square_difference(const Image<float>& a, const Image<float>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += (double(a.data()[i]) - b.data()[i]) * (double(a.data()[i]) - b.data()[i]);
    return sum / double(a.size());
}

Halves halves_of(const Scene& scene, int spp, std::uint32_t seed) {
    RenderSettings settings = scene.settings;
    settings.spp = spp, settings.seed = seed;
    return render_halves(scene, settings);
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("passes: a part of a picture has the bytes of the whole one, wherever it begins") {
        const Scene scene = ball_under_quad(37);
        RenderSettings settings = scene.settings;
        settings.spp = 3;
        const Image<float> whole = render(scene, settings), layers = render_layers(scene, settings);
        for (const PixelRect& part : {PixelRect{0, 0, 1, 1}, {3, 1, 17, 18}, {6, 15, 2, 3}, {35, 36, 2, 1}}) {
            settings.part = part;
            const Image<float> picture = render(scene, settings), part_layers = render_layers(scene, settings);
            for (int y = 0; y < part.height; ++y)
                for (int x = 0; x < part.width; ++x) {
                    CHECK(std::equal(&picture.at(x, y), &picture.at(x, y) + 3, &whole.at(part.x + x, part.y + y)));
                    CHECK(std::equal(&part_layers.at(x, y), &part_layers.at(x, y) + layers.channels(),
                                     &layers.at(part.x + x, part.y + y)));
                }
        }
    }

    TEST_CASE("passes: after each pass the picture and its layers are those of as many samples, to the last bit") {
        const Scene scene = ball_under_quad(20);
        RenderSettings settings = scene.settings;
        settings.spp = 24;
        settings.part = PixelRect{3, 1, 17, 18};
        Passes passes(scene, settings, {.layers = true});
        std::vector<int> reached;
        while (passes.next()) {
            const SampleCounts counts = passes.samples();
            CHECK(counts.least == counts.most);
            reached.push_back(counts.most);
            if (counts.most == 1) continue; // a single sample is the pixel's centre
            RenderSettings plain = settings;
            plain.spp = counts.most;
            RenderStats stats;
            CHECK(same(passes.picture(), render(scene, plain, &stats)));
            CHECK(same(passes.layers(), render_layers(scene, plain)));
            CHECK(passes.stats().rays == stats.rays);
            CHECK(passes.rays_done() == stats.rays);
            CHECK(passes.samples_done() == 17 * 18 * counts.most);
        }
        CHECK(reached == std::vector<int>{1, 2, 4, 8, 16, 20, 24});
    }

    TEST_CASE("passes: tiles arrive with the values of the picture") {
        const Scene scene = ball_under_quad(20);
        RenderSettings settings = scene.settings;
        settings.spp = 2;
        Passes passes(scene, settings, {.first = 2});
        Image<float> seen(20, 20, 3);
        std::mutex mutex;
        passes.next([&](const PixelRect& tile, const std::vector<float>& values) {
            const std::lock_guard lock(mutex);
            REQUIRE(values.size() == std::size_t(tile.width) * tile.height * 3);
            for (int y = 0; y < tile.height; ++y)
                std::memcpy(&seen.at(tile.x, tile.y + y), &values[std::size_t(y) * tile.width * 3],
                            std::size_t(tile.width) * 3 * sizeof(float));
        });
        CHECK(same(seen, passes.picture()));
    }

    TEST_CASE("halves: each is the picture of its own seed, and the picture is their mean") {
        const Scene scene = ball_under_quad(20);
        RenderSettings settings = scene.settings;
        settings.spp = 15; // one is added
        Passes passes(scene, settings, {.layers = true, .halves = true});
        while (passes.next()) {
        }
        CHECK(passes.spp() == 16);
        const Image<float> a = passes.half(0), b = passes.half(1), picture = passes.picture(), all = passes.layers();
        settings.spp = 8;
        CHECK(same(a, render(scene, settings)));
        settings.seed = second_seed(settings.seed);
        CHECK(same(b, render(scene, settings)));
        const std::vector<std::string> channels = layer_channels(true);
        REQUIRE(all.channels() == int(channels.size()));
        CHECK(channels.back() == "half_b.B");
        for (int y = 0; y < 20; ++y)
            for (int x = 0; x < 20; ++x) {
                for (int c = 0; c < 3; ++c) {
                    const float middle = (a.at(x, y, c) + b.at(x, y, c)) / 2;
                    CHECK(picture.at(x, y, c) == doctest::Approx(middle).epsilon(1e-5));
                    CHECK(all.at(x, y, all.channels() - 6 + c) == a.at(x, y, c));
                    CHECK(all.at(x, y, all.channels() - 3 + c) == b.at(x, y, c));
                }
            }
    }

    TEST_CASE("halves: their product of differences is unbiased, where the plain square is not") {
        // Two scenes that differ by a factor of 1.1 in the light, each seen through noise of its own.
        Scene scene = ball_under_quad(24);
        Scene brighter = ball_under_quad(24);
        for (Light<float>& light : brighter.lights) light.colour *= 1.1f;
        RenderSettings many = scene.settings;
        many.spp = 1024;
        const double truth = square_difference(render(scene, many), render(brighter, many));
        constexpr int runs = 24;
        double product = 0, square = 0, squares_of_product = 0;
        for (int run = 0; run < runs; ++run) {
            const Halves x = halves_of(scene, 8, std::uint32_t(run)),
                         y = halves_of(brighter, 8, std::uint32_t(1000 + run));
            const double estimate = mean_square_difference(x, y);
            product += estimate / runs, squares_of_product += estimate * estimate / runs;
            square += square_difference(x.a, y.a) / runs;
        }
        const double error = std::sqrt((squares_of_product - product * product) / (runs - 1));
        CHECK(std::abs(product - truth) < 3.5 * error);
        CHECK(error < 0.5 * truth); // so that the check means something
        CHECK(square > truth + 5 * error);
    }

    TEST_CASE("halves: without noise the estimate is the square; equal pictures have 0") {
        const auto filled = [](float value) {
            Image<float> image(2, 2, 3);
            std::fill(image.data(), image.data() + image.size(), value);
            return image;
        };
        const Halves x{filled(3), filled(3)}, y{filled(1), filled(1)};
        CHECK(mean_square_difference(x, y) == 4);
        CHECK(mean_square_difference(x, x) == 0);
        const Halves noisy{filled(2), filled(4)}; // 3 on the average, with errors of opposite signs
        CHECK(mean_square_difference(noisy, y) == 3);
    }

    TEST_CASE("noise: tiles end where the error is below the limit, and the error is below the limit then") {
        // The ball lies in the four tiles in the middle.
        const Scene scene = ball_under_quad(6 * tile_size, 9);
        RenderSettings settings = scene.settings;
        settings.spp = 4096;
        constexpr double limit = 0.03;
        Passes passes(scene, settings, {.noise = limit});
        while (passes.next()) {
        }
        const SampleCounts counts = passes.samples();
        CHECK(counts.least == least_adaptive_samples); // tiles at the border are black, and so are their neighbours
        CHECK(counts.most > least_adaptive_samples);
        CHECK(counts.most < 4096);
        settings.spp = 1024, settings.seed = 99;
        settings.part = PixelRect{2 * tile_size, 2 * tile_size, 2 * tile_size, 2 * tile_size};
        const Image<float> reference = render(scene, settings), seen = passes.picture();
        const double darkest = 0.1 * mean(reference) / 9; // a tenth of the picture's mean, which is black around
        double all = 0, all_limits = 0, worst = 0;
        for (const PixelRect& tile : {PixelRect{0, 0}, {tile_size, 0}, {0, tile_size}, {tile_size, tile_size}}) {
            double squares = 0, sum = 0;
            for (int y = tile.y; y < tile.y + tile_size; ++y)
                for (int x = tile.x; x < tile.x + tile_size; ++x)
                    for (int c = 0; c < 3; ++c) {
                        const double r = reference.at(x, y, c);
                        const double d = seen.at(2 * tile_size + x, 2 * tile_size + y, c) - r;
                        squares += d * d, sum += r;
                    }
            const double n = 3.0 * tile_size * tile_size, most = limit * std::max(sum / n, darkest);
            all += squares, all_limits += n * most * most;
            worst = std::max(worst, std::sqrt(squares / n) / most);
        }
        CHECK(all < all_limits);
        // The error is estimated from few pixels where a tile shows a corner of the ball, and is uncertain by that.
        CHECK(worst < 1.4);
        CHECK(worst > 0.3); // no more samples than needed
    }

    TEST_CASE("noise: adaptive pictures are as bright on the average as those of a fixed number of samples") {
        const Scene scene = ball_under_quad(32);
        RenderSettings settings = scene.settings;
        settings.spp = 1024;
        const double truth = mean(render(scene, settings));
        settings.spp = 256;
        constexpr int runs = 16;
        double sum = 0, squares = 0;
        for (settings.seed = 100; settings.seed < 100 + runs; ++settings.seed) {
            Passes passes(scene, settings, {.noise = 0.05});
            while (passes.next()) {
            }
            const double ratio = mean(passes.picture()) / truth - 1;
            sum += ratio, squares += ratio * ratio;
        }
        const double error = std::sqrt(squares / runs / runs);
        CHECK(std::abs(sum / runs) < 3.5 * error + 1e-4);
        CHECK(error < 0.002);
    }

    TEST_CASE("noise: the picture does not depend on the number of threads") {
        const Scene scene = ball_under_quad(40);
        RenderSettings settings = scene.settings;
        settings.spp = 64;
        const auto seen = [&](int threads) {
            const ThreadLimit limit(threads);
            Passes passes(scene, settings, {.layers = true, .noise = 0.02});
            while (passes.next()) {
            }
            return passes.layers();
        };
        CHECK(same(seen(1), seen(4)));
    }

    TEST_CASE("passes: a limit on the time ends after the first pass at the earliest") {
        const Scene scene = ball_under_quad(20);
        RenderSettings settings = scene.settings;
        settings.spp = 65536;
        Passes passes(scene, settings, {.seconds = 1e-9});
        CHECK(passes.next());
        CHECK_FALSE(passes.next());
        CHECK(passes.samples().least == 1);
        CHECK(passes.samples().most == 1);
    }

} // TEST_SUITE

TEST_SUITE("stability") {

    TEST_CASE("passes: one pixel, a black scene, a picture before the first pass") {
        Scene scene;
        scene.settings.width = scene.settings.height = 1;
        build(scene);
        for (const double noise : {0.0, 0.01}) {
            Passes passes(scene, scene.settings, {.layers = true, .noise = noise});
            CHECK(passes.picture().at(0, 0) == 0);
            CHECK(passes.samples().without == 1);
            const Image<float> before = passes.layers();
            for (std::size_t i = 0; i < before.size(); ++i) CHECK(before.data()[i] == 0);
            while (passes.next()) {
            }
            CHECK(passes.picture().at(0, 0) == 0);
            CHECK(passes.samples().least == 4);
        }
    }

} // TEST_SUITE
