#include "bench/plan_experiment_set.h"
#include "bench/plan_experiment_truth.h"
#include "folders.h"
#include <doctest/doctest.h>
#include <random>
#include <set>

using namespace bake;
using bench::exposed;
using bench::true_error;
using bench::TrueError;
using bench::TruePicture;

namespace {

/// A candidate that is brighter by `difference`, with noise of this standard deviation in each sample of both pictures.
struct NoisyPair {
    TruePicture reference, candidate;
};

NoisyPair noisy_pair(int pixels, int spp, double difference, double noise, unsigned seed) {
    std::mt19937 random(seed);
    const auto gauss = [&] { // of twelve even numbers
        double sum = -6;
        for (int i = 0; i < 12; ++i) sum += double(random()) / 4294967296.0;
        return sum;
    };
    NoisyPair pair;
    for (TruePicture* picture : {&pair.reference, &pair.candidate}) {
        *picture = {pixels, 1, spp, {}};
        picture->pixels.resize(std::size_t(pixels));
        for (bench::TruePixel& pixel : picture->pixels) {
            pixel.covered = spp == 64 ? ~std::uint64_t(0) : (std::uint64_t(1) << spp) - 1;
            for (Vec3d& half : pixel.half)
                for (int c = 0; c < 3; ++c) half[c] = (0.5 + noise / std::sqrt(spp / 2.0) * gauss()) * spp / 2;
        }
    }
    for (bench::TruePixel& pixel : pair.candidate.pixels)
        for (Vec3d& half : pixel.half) half += difference * spp / 2;
    return pair;
}

/// The root of the mean squared difference of the mean pictures.
double naive_rmse(const NoisyPair& pair) {
    double sum = 0;
    for (std::size_t i = 0; i < pair.reference.pixels.size(); ++i) {
        const auto &r = pair.reference.pixels[i], &c = pair.candidate.pixels[i];
        const Vec3d d = (c.half[0] + c.half[1] - r.half[0] - r.half[1]) / double(pair.reference.spp);
        sum += glm::dot(d, d) / 3;
    }
    return std::sqrt(sum / double(pair.reference.pixels.size()));
}

SceneEntries ambient_sphere(float diffuse, float exposure) {
    SceneEntries entries;
    entries.settings.width = entries.settings.height = 20;
    entries.settings.exposure = exposure;
    entries.any_light = true, entries.ambient = Vec3f(1);
    MaterialEntry material;
    material.reflectance.diffuse = material.reflectance.ambient = Vec3f(diffuse);
    entries.materials.push_back(material);
    MeshEntry mesh;
    mesh.shape = "sphere:R=0.5", mesh.material = 0;
    entries.meshes.push_back(mesh);
    CameraEntry camera;
    camera.position = Vec3f(0, 0, 0.8f), camera.target = Vec3f(0); // the sphere fills the picture
    entries.cameras.push_back(camera);
    return entries;
}

TruePicture ambient_picture(float diffuse, float exposure) {
    const Scene scene = load(ambient_sphere(diffuse, exposure));
    const std::vector<std::uint8_t> all(scene.instances.size(), 1);
    TruePicture picture;
    for (const int spp : {4, 16}) bench::add_samples_to(picture, scene, {all, scene.settings, exposure, 3}, spp);
    return picture;
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("plan experiment: a naive truth agrees with a naive probe, and both are wrong") {
        constexpr double difference = 0.004, noise = 0.02;
        const NoisyPair probe = noisy_pair(3000, 8, difference, noise, 1);
        const NoisyPair truth = noisy_pair(3000, 8, difference, noise, 2);
        CHECK(naive_rmse(probe) == doctest::Approx(naive_rmse(truth)).epsilon(0.03));
        // The variances of both means add to the square.
        CHECK(naive_rmse(truth) == doctest::Approx(std::hypot(difference, noise / 2)).epsilon(0.03));
        CHECK(naive_rmse(truth) > 2.5 * difference);
        for (const NoisyPair* pair : {&probe, &truth}) {
            const TrueError error = true_error(pair->reference, pair->candidate);
            CHECK(std::abs(error.square - difference * difference) < 3 * error.error);
            CHECK(std::sqrt(error.square) == doctest::Approx(difference).epsilon(0.1));
        }
    }

    TEST_CASE("plan experiment: the stated standard error is the one that repeats have") {
        double sum = 0, squares = 0, stated = 0;
        constexpr int repeats = 60;
        for (int i = 0; i < repeats; ++i) {
            const NoisyPair pair = noisy_pair(200, 8, 0.01, 0.05, 10 + unsigned(i));
            const TrueError error = true_error(pair.reference, pair.candidate);
            sum += error.square, squares += error.square * error.square, stated += error.error * error.error;
        }
        const double variance = squares / repeats - sum / repeats * (sum / repeats);
        CHECK(variance * repeats / stated == doctest::Approx(1).epsilon(0.45)); // of 60 repeats: 18 % at one sigma
    }

    TEST_CASE("plan experiment: pixels of the box that do not show the object do not count") {
        NoisyPair pair = noisy_pair(100, 16, 0.05, 0.01, 4);
        const TrueError alone = true_error(pair.reference, pair.candidate);
        CHECK(alone.area == 100);
        for (TruePicture* picture : {&pair.reference, &pair.candidate}) picture->pixels.resize(400);
        const TrueError in_box = true_error(pair.reference, pair.candidate);
        CHECK(in_box.square == alone.square);
        CHECK(in_box.area == alone.area);
        CHECK(naive_rmse(pair) < 0.55 * std::sqrt(alone.square)); // three quarters of the box are empty
    }

    TEST_CASE("plan experiment: of a constant difference the error is that difference, exposed and clamped") {
        const auto rmse = [](float a, float b, float exposure) {
            return std::sqrt(true_error(ambient_picture(a, exposure), ambient_picture(b, exposure)).square);
        };
        CHECK(rmse(0.3f, 0.4f, 0) == doctest::Approx(0.1));
        CHECK(rmse(0.3f, 0.4f, 1) == doctest::Approx(0.2));
        CHECK(rmse(0.3f, 0.4f, 1.5f) == doctest::Approx(1 - 0.3 * std::exp2(1.5)));
        CHECK(rmse(0.4f, 0.4f, 0) == 0);
    }

    TEST_CASE("plan experiment: samples are clamped before their mean is taken") {
        // One sample in two sees a small sun: clamped late, the pixel hides any error of the others.
        const Vec3d early = 0.5 * (exposed(Vec3f(1000), 0) + exposed(Vec3f(0.2f), 0));
        CHECK(early.x == doctest::Approx(0.6));
        CHECK(exposed(Vec3f(0.5f * (1000 + 0.2f)), 0).x == 1);
    }

    TEST_CASE("plan experiment: the reference is four times finer per edge than the finest rung") {
        for (const std::int64_t triangles : {8, 512, 2208, 17684, 500'000}) {
            const bench::TrueLadder ladder = bench::true_ladder(triangles);
            CHECK(ladder.rungs.back().levels == ladder.reference.levels - 2);
            CHECK((double(triangles) * std::exp2(2 * ladder.reference.levels) <= 4e5 || ladder.reference.levels == 2));
        }
    }
}

TEST_SUITE("unit") {

    TEST_CASE("plan experiment: configurations are drawn evenly, and again as they were") {
        const bench::PlanSet set({"none", test::own_meshes().string()});
        std::set<std::pair<int, int>> pairs;
        int held_out = 0, count[4] = {};
        for (int number = 0; number < 288; ++number) {
            const bench::PlanTrial trial = set.trial(number);
            if (number < 72) pairs.insert({trial.object, trial.relief});
            held_out += trial.held_out, ++count[trial.finish];
            const RenderSettings& settings = trial.entries.settings;
            CHECK(std::max(settings.width, settings.height) >= 43);
            CHECK(std::max(settings.width, settings.height) <= 150);
            CHECK(trial.slope <= 0.91);
        }
        CHECK(pairs.size() == 72);
        CHECK(held_out > 72);
        CHECK(held_out < 120);
        for (const int of_finish : count) CHECK(of_finish == 72);
        const bench::PlanTrial one = set.trial(17), again = set.trial(17);
        CHECK(one.height_px == again.height_px);
        CHECK(*one.entries.cameras[0].position == *again.entries.cameras[0].position);
        CHECK(one.height_px != set.trial(18).height_px);
    }
}
