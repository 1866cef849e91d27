#include "bake/verdict/metric/flip.h"
#include "bake/verdict/plan/flip_tiles.h"
#include "bake/verdict/plan/normal_angles.h"
#include "bake/verdict/plan/plan_scenes.h"
#include "verdict/compare/relief_scene.h"
#include <doctest/doctest.h>

using namespace bake;
using test::relief_scene;

namespace {

struct Pair {
    explicit Pair(const SceneEntries& entries)
        : scenes(entries, {}), flags(scenes.instances_of(0)), plain(scenes.assemble({nullptr})),
          displaced(scenes.assemble({scenes.bake(0, {Shade::displace, 3})})) {
        options.settings = scenes.settings();
        options.camera = scenes.cameras()[0].camera;
    }
    ProbedScene of(const AssembledScene& scene) const { return {&scene.scene, flags}; }

    PlanScenes scenes;
    std::vector<std::uint8_t> flags;
    std::unique_ptr<AssembledScene> plain, displaced;
    ProbeOptions options;
};

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("tile_flip: one tile that holds the whole picture gives its FLIP; equal scenes give 0") {
        const Pair pair(relief_scene("sphere:R=1", 0.2f));
        const ProbedScene both[] = {pair.of(*pair.displaced), pair.of(*pair.plain)};
        const std::vector<Pixel> pixels = object_pixels(both, pair.options);
        const SquareEstimate same = tile_flip(both[0], both[0], pixels, pair.options, {.half = 4});
        CHECK(same.square == 0);
        CHECK(same.all);
        const SquareEstimate found = tile_flip(both[1], both[0], pixels, pair.options, {.half = 4});
        CHECK(found.all);
        CHECK(found.error == 0);

        ProbeOptions options = pair.options;
        options.half = 4;
        std::vector<Pixel> all;
        for (int y = 0; y < 24; ++y)
            for (int x = 0; x < 24; ++x) all.push_back({x, y});
        Image<float> pictures[2];
        std::vector<std::uint32_t> covered(all.size());
        for (int k : {0, 1}) {
            pictures[k] = Image<float>(24, 24, 3);
            const std::vector<ProbedPixel> probed = probe_pixels(both[k], all, options);
            for (std::size_t i = 0; i < all.size(); ++i) {
                covered[i] |= probed[i].covered[0] | probed[i].covered[1];
                for (int c = 0; c < 3; ++c)
                    pictures[k].data()[3 * i + std::size_t(c)] = 0.5f * (probed[i].mean[0] + probed[i].mean[1])[c];
            }
        }
        const Image<float> errors = flip(pictures[0], pictures[1]);
        double sum = 0, count = 0;
        for (std::size_t i = 0; i < all.size(); ++i)
            if (covered[i]) sum += double(errors.data()[i]), ++count;
        CHECK(found.rmse() == doctest::Approx(sum / count));
        CHECK(found.pixels == std::int64_t(count));
    }

    TEST_CASE("tile_flip: some of the tiles agree with all of them within the error they state") {
        SceneEntries entries = relief_scene("sphere:R=1", 0.2f);
        entries.settings.width = entries.settings.height = 32;
        const Pair pair(entries);
        const ProbedScene both[] = {pair.of(*pair.displaced), pair.of(*pair.plain)};
        const std::vector<Pixel> pixels = object_pixels(both, pair.options);
        const SquareEstimate all =
            tile_flip(both[1], both[0], pixels, pair.options, {.tiles = 999, .size = 8, .half = 2});
        const SquareEstimate some =
            tile_flip(both[1], both[0], pixels, pair.options, {.tiles = 6, .size = 8, .half = 2});
        CHECK(all.all);
        CHECK_FALSE(some.all);
        CHECK(some.error > 0);
        CHECK(std::abs(some.square - all.square) < 4 * some.error);
    }

    TEST_CASE("mean_angle: of a plane against one tilted by 10 degrees it is 10, and 0 of equal scenes") {
        SceneEntries entries = relief_scene("plane:w=2,d=2", 0);
        entries.meshes[0].placement.scale = Vec3f(2);
        Pair pair(entries);
        const ProbedScene flat = pair.of(*pair.plain);
        const std::vector<Pixel> pixels = object_pixels(std::span(&flat, 1), pair.options);
        REQUIRE(!pixels.empty());
        CHECK(mean_angle(flat, flat, pixels, pair.options).square == 0);
        entries.meshes[0].placement.rotate_deg.x = 10;
        const Pair tilted(entries);
        const SquareEstimate found = mean_angle(tilted.of(*tilted.plain), flat, pixels, pair.options);
        CHECK(found.rmse() == doctest::Approx(10).epsilon(1e-4));
        CHECK(found.all);
    }
}
