// Which pixels show an object.
#include "bake/base/parallel.h"
#include "verdict/plan/probe_scenes.h"
#include <doctest/doctest.h>
#include <set>

using namespace bake;
using namespace bake::test;

namespace {

using Set = std::set<std::pair<int, int>>;

Set set_of(const std::vector<Pixel>& pixels) {
    Set out;
    for (const Pixel& pixel : pixels) out.insert({pixel.x, pixel.y});
    REQUIRE(out.size() == pixels.size()); // none twice
    return out;
}

std::vector<Pixel> pixels_of(const Scene& scene, const ProbeOptions& options) {
    return object_pixels(std::array{ProbedScene{&scene, first_of_two}}, options);
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("object_pixels: they have every pixel that a sample sees the object in, and few others") {
        const Scene scene = ball_above_floor(0.04f);
        ProbeOptions options = probe_options(scene, 40);
        for (const Vec3f& target : {Vec3f(0), Vec3f(1.3f, 0, 0), Vec3f(-0.7f, 1.2f, 0)}) {
            options.camera.target = target; // in view, half outside at an edge, at a corner
            for (const bool orthographic : {false, true}) {
                options.camera.orthographic = orthographic;
                const Set found = set_of(pixels_of(scene, options));
                const auto probed = probe_pixels({&scene, first_of_two}, all_pixels(40), options);
                std::size_t seen = 0;
                for (int y = 0; y < 40; ++y)
                    for (int x = 0; x < 40; ++x) {
                        const ProbedPixel& pixel = probed[std::size_t(40 * y + x)];
                        if (!(pixel.covered[0] | pixel.covered[1])) continue;
                        CHECK(found.count({x, y}) == 1);
                        ++seen;
                    }
                REQUIRE(seen > 100);
                CHECK(found.size() > seen);
                CHECK(double(found.size()) < seen + 8 * std::sqrt(double(seen)));
            }
        }
    }

    TEST_CASE(
        "object_pixels: a floor that reaches behind the camera is found whole, and so is an object of two instances") {
        const Scene scene = ball_above_floor(0);
        const ProbeOptions options = probe_options(scene, 32);
        ProbeOptions above = options;
        above.camera.position = Vec3f(0, 0.5f, 2), above.camera.target = Vec3f(0, 0.5f, 0), above.camera.fov_deg = 90;
        const auto check = [&](const std::vector<std::uint8_t>& object, const ProbeOptions& view) {
            const Set found = set_of(object_pixels(std::array{ProbedScene{&scene, object}}, view));
            const auto probed = probe_pixels({&scene, object}, all_pixels(32), view);
            int seen = 0;
            for (int i = 0; i < 32 * 32; ++i) {
                if (!(probed[std::size_t(i)].covered[0] | probed[std::size_t(i)].covered[1])) continue;
                CHECK(found.count({i % 32, i / 32}) == 1);
                ++seen;
            }
            CHECK((seen > 200 && seen < 1000)); // not all of the picture
        };
        check({0, 1}, above);
        check({1, 1}, options);
    }

    TEST_CASE("object_pixels: a wall beside the camera that only the outermost pixels of one side see is found") {
        // From behind the camera to where it covers .8 of these pixels.
        constexpr int size = 24;
        const float front = -1 / (1 - 0.8f * 2 / size), back = 3;
        Scene scene = one_mesh(plane_mesh(), {});
        scene.instances.clear();
        add_instance(scene, *scene.shapes[0], *scene.materials[0],
                     {.translate = Vec3f(-1, 0, (back + front) / 2),
                      .rotate_deg = Vec3f(0, 90, 0),
                      .scale = Vec3f((back - front) / 2, 9, 1)});
        build(scene);
        const std::vector<std::uint8_t> wall{1};
        ProbeOptions options = probe_options(scene, size);
        options.camera.position = Vec3f(0), options.camera.target = Vec3f(0, 0, -1), options.camera.fov_deg = 90;
        std::set<int> sides;
        for (const Vec3f& up : {Vec3f(0, 1, 0), Vec3f(1, 0, 0), Vec3f(0, -1, 0), Vec3f(-1, 0, 0)}) {
            options.camera.up = up;
            const Set found = set_of(object_pixels(std::array{ProbedScene{&scene, wall}}, options));
            const auto probed = probe_pixels({&scene, wall}, all_pixels(size), options);
            int seen = 0;
            for (int i = 0; i < size * size; ++i) {
                if (!(probed[std::size_t(i)].covered[0] | probed[std::size_t(i)].covered[1])) continue;
                const int x = i % size, y = i / size;
                REQUIRE((x % (size - 1) == 0 || y % (size - 1) == 0));
                CHECK(found.count({x, y}) == 1);
                if (++seen == size / 2) sides.insert(i);
            }
            CHECK(seen == size);
        }
        CHECK(sides.size() == 4);
    }

    TEST_CASE("object_pixels: they are those of any of the scenes; all without an object") {
        const Scene here = ball_above_floor(0), there = ball_above_floor(0);
        const ProbeOptions options = probe_options(here, 24);
        const std::vector<std::uint8_t> floor{0, 1};
        const ProbedScene ball{&here, first_of_two}, below{&there, floor};
        Set both = set_of(object_pixels(std::array{ball}, options));
        const Set second = set_of(object_pixels(std::array{below}, options));
        CHECK(both != second);
        both.insert(second.begin(), second.end());
        CHECK(set_of(object_pixels(std::array{ball, below}, options)) == both);
        CHECK(object_pixels(std::array{ProbedScene{&here, {}}}, options).size() == 24 * 24);
        CHECK(object_pixels({}, options).empty());
    }

    TEST_CASE("object_pixels: a scene far from 0 is seen as one at 0; a large picture has as many as a small one, in "
              "proportion") {
        const Vec3f far(1024, 0, -2048);
        const Scene here = ball_above_floor(0), there = ball_above_floor(0, far);
        REQUIRE(there.origin != Vec3f(0));
        const auto near_pixels = pixels_of(here, probe_options(here, 64));
        const auto far_pixels = pixels_of(there, probe_options(there, 64));
        CHECK(std::abs(double(near_pixels.size()) - double(far_pixels.size())) < 8);
        const auto large = pixels_of(here, probe_options(here, 512)); // one ray per pixel
        CHECK(double(large.size()) / 64 < double(near_pixels.size()));
        CHECK(double(large.size()) / 64 > 0.85 * double(near_pixels.size()));
    }

    TEST_CASE("object_pixels: the order is drawn from the seed; it is the same on any number of threads") {
        const Scene scene = ball_above_floor(0);
        ProbeOptions options = probe_options(scene, 32);
        const auto flat = [](const std::vector<Pixel>& pixels) {
            std::vector<int> out;
            for (const Pixel& pixel : pixels) out.push_back(32 * pixel.y + pixel.x);
            return out;
        };
        const std::vector<int> first = flat(pixels_of(scene, options));
        {
            const ThreadLimit one(1);
            CHECK(flat(pixels_of(scene, options)) == first);
        }
        options.seed = 1;
        const std::vector<int> other = flat(pixels_of(scene, options));
        CHECK(other != first);
        CHECK(std::is_permutation(first.begin(), first.end(), other.begin(), other.end()));
        // The first quarter is spread evenly: as many are left of the middle as right of it, within 4 standard deviations.
        int left = 0;
        const int count = int(first.size() / 4);
        for (int i = 0; i < count; ++i) left += first[std::size_t(i)] % 32 < 16;
        CHECK(std::abs(left - count / 2) < 4 * std::sqrt(count / 4.0));
    }

    TEST_CASE("object_pixels: an object smaller than a pixel is found; hidden and outside it has none") {
        Scene scene = ball_above_floor(0);
        ProbeOptions options = probe_options(scene, 32);
        for (const float times : {30.0f, 100.0f}) { // the ball is .8 and .25 pixels wide
            options.camera.position = times * scene.camera.position;
            const auto pixels = pixels_of(scene, options);
            CHECK(!pixels.empty());
            CHECK(pixels.size() <= 16);
        }
        options.camera = scene.camera;
        options.camera.position = Vec3f(0, -5, 0.01f); // below the floor
        CHECK(pixels_of(scene, options).empty());
        options.camera = scene.camera;
        options.camera.target = options.camera.position + Vec3f(0, 0, 1);
        CHECK(pixels_of(scene, options).empty());
        options.camera.target = Vec3f(40, 0, 0);
        CHECK(pixels_of(scene, options).empty());
        options.camera.position = options.camera.target = Vec3f(0); // sees nothing
        CHECK(pixels_of(scene, options).empty());
        options.camera.target = Vec3f(0, 0, 1); // inside of the ball
        CHECK(pixels_of(scene, options).size() == 32 * 32);
    }
}
