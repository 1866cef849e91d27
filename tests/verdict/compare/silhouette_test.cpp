#include "bake/verdict/compare/silhouette.h"
#include "verdict/metric/pictures.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <doctest/doctest.h>

using namespace bake;

namespace {

template <class Inside> ObjectMask mask_of(int width, int height, int factor, const Inside& inside) {
    ObjectMask mask{.factor = factor, .width = width * factor, .height = height * factor, .inside = {}};
    for (int y = 0; y < mask.height; ++y)
        for (int x = 0; x < mask.width; ++x) mask.inside.push_back(inside((x + 0.5) / factor, (y + 0.5) / factor));
    return mask;
}

ObjectMask disc(double x, double y, double radius) {
    return mask_of(64, 48, 4, [=](double u, double v) { return std::hypot(u - x, v - y) < radius; });
}

/// Every point of one outline against every point of the other.
OutlineError by_brute_force(const ObjectMask& a, const ObjectMask& b) {
    const auto points = [](const ObjectMask& m) {
        std::vector<std::array<int, 2>> found;
        for (int y = 0; y < m.height; ++y)
            for (int x = 0; x < m.width; ++x) {
                const auto outside = [&](int i, int j) {
                    return i >= 0 && j >= 0 && i < m.width && j < m.height && !m.at(i, j);
                };
                if (m.at(x, y) && (outside(x - 1, y) || outside(x + 1, y) || outside(x, y - 1) || outside(x, y + 1)))
                    found.push_back({x, y});
            }
        return found;
    };
    const auto p = points(a), q = points(b);
    double sum = 0, largest = 0;
    const auto measure = [&](const auto& from, const auto& to) {
        for (const auto& f : from) {
            double nearest = 1e30;
            for (const auto& t : to) nearest = std::min(nearest, std::hypot(f[0] - t[0], f[1] - t[1]));
            sum += nearest, largest = std::max(largest, nearest);
        }
    };
    measure(p, q);
    measure(q, p);
    return {.mean = sum / double(p.size() + q.size()) / a.factor, .max = largest / a.factor};
}

} // namespace

TEST_SUITE("oracle") {
    TEST_CASE("silhouette: discs of one centre are apart by the difference of their radii") {
        const OutlineError error = outline_error(disc(32, 24, 18), disc(32, 24, 15.5));
        CHECK(error.mean == doctest::Approx(2.5).epsilon(0.05));
        CHECK(error.max < 2.5 + 0.5);
    }

    TEST_CASE("silhouette: distances are those of every point to every other, on noise of any shape") {
        for (const unsigned seed : {1u, 2u, 3u}) {
            const auto noisy_mask = [&](double share, int c) {
                return mask_of(24, 17, 2, [&](double u, double v) {
                    return test::noise(int(2 * u), int(2 * v), c, seed) < share;
                });
            };
            const ObjectMask a = noisy_mask(0.04, 0), b = noisy_mask(0.5, 1);
            const OutlineError fast = outline_error(a, b), plain = by_brute_force(a, b);
            CHECK(fast.mean == doctest::Approx(plain.mean).epsilon(1e-12));
            CHECK(fast.max == plain.max);
        }
    }

    TEST_CASE("silhouette: the mask of a square seen by an orthographic camera is a square, of one instance alone") {
        Scene scene;
        Mesh quad;
        quad.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
        quad.corner_position = {0, 1, 2, 3};
        quad.face_begin = {0, 4};
        scene.shapes.push_back(make_shape(std::move(quad)));
        scene.materials.push_back(std::make_unique<Material>());
        for (const float x : {0.0f, 4.0f}) {
            Placement at;
            at.translate.x = x;
            add_instance(scene, *scene.shapes[0], *scene.materials[0], at);
        }
        scene.camera.orthographic = true;
        scene.camera.position = {0, 0, 5}, scene.camera.view_height = 4;
        scene.settings.width = scene.settings.height = 32;
        build(scene);
        // A square of 2 in a view of 4: 16 pixels, whose borders lie between rays.
        const ObjectMask mask = object_mask(scene, {1, 0}, 4);
        CHECK(std::count(mask.inside.begin(), mask.inside.end(), 1) == 64 * 64);
        CHECK((mask.at(32, 32) && mask.at(95, 95) && !mask.at(31, 40) && !mask.at(96, 40)));
        CHECK(object_mask(scene, {0, 0}, 4).inside == std::vector<std::uint8_t>(128 * 128, 0));
    }
}

TEST_SUITE("unit") {
    TEST_CASE("silhouette: equal masks are 0 apart, the border of the picture is no outline") {
        const OutlineError same = outline_error(disc(10, 10, 20), disc(10, 10, 20));
        CHECK(same.mean == 0);
        CHECK(same.max == 0);
        const ObjectMask all = mask_of(8, 8, 2, [](double, double) { return true; });
        const ObjectMask none = mask_of(8, 8, 2, [](double, double) { return false; });
        CHECK(outline_error(all, none).known); // neither has an outline
        CHECK(outline_error(all, none).max == 0);
        CHECK_FALSE(outline_error(disc(32, 24, 9), disc(32, 24, 0)).known);
    }

    TEST_CASE("silhouette: pixels of either mask are those of which one ray suffices") {
        const ObjectMask a = mask_of(4, 3, 2, [](double u, double v) { return u < 0.5 && v < 0.5; });
        const ObjectMask b = mask_of(4, 3, 2, [](double u, double v) { return u > 3.5 && v > 2.5; });
        std::vector<std::uint8_t> expected(12, 0);
        expected[0] = expected[11] = 1;
        CHECK(pixels_of_either(a, b) == expected);
    }
}
