// The sky as camera and mirror rays see it: over their cones.
#include "preview/little_scenes.h"
#include "preview/sky_of.h"
#include <algorithm>
#include <doctest/doctest.h>

using namespace bake;
using namespace bake::test;

namespace {

/// Squares of two texels, bright or dark, brighter towards the zenith.
Cube checker(int size) {
    Cube cube = sky_of(size, [](const Vec3d& d) { return 1 + 0.5 * d.y; });
    for (Image<float>& face : cube.faces)
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x)
                for (int c = 0; c < 3; ++c) face.at(x, y, c) *= (x / 2 + y / 2) % 2 ? 1.9f : 0.1f;
    return cube;
}

Scene under_sky(Mesh mesh, Cube sky, TextureFilter filter, int size) {
    Scene scene = one_mesh(std::move(mesh), mirror());
    scene.sky.cube = std::move(sky);
    scene.camera.position = Vec3f(0.3f, 1, 4), scene.camera.target = Vec3f(0);
    scene.settings.width = scene.settings.height = size, scene.settings.spp = 1;
    scene.settings.filter = filter;
    scene.settings.sky_light = SkyLighting::off;
    build(scene);
    return scene;
}

std::vector<double> row_means(const Scene& scene, int spp) {
    RenderSettings settings = scene.settings;
    settings.spp = spp;
    const Image<float> image = render(scene, settings);
    std::vector<double> means;
    for (int y = 0; y < image.height(); ++y) {
        double sum = 0;
        for (int x = 0; x < image.width(); ++x) sum += double(image.at(x, y, 1));
        means.push_back(sum / image.width());
    }
    return means;
}

/// The largest relative difference of rows of one sample per pixel from those of 256 unfiltered ones.
double worst_row(const Mesh& mesh, TextureFilter filter) {
    const auto means = [&](TextureFilter with, int spp) {
        Mesh copy = mesh;
        return row_means(under_sky(std::move(copy), checker(512), with, 48), spp);
    };
    const std::vector<double> one = means(filter, 1), many = means(TextureFilter::off, 256);
    double worst = 0;
    for (std::size_t y = 0; y < one.size(); ++y) worst = std::max(worst, std::abs(one[y] / many[y] - 1));
    return worst;
}

Mesh scaled(Mesh mesh, float by) {
    for (Vec3f& p : mesh.positions) p *= by;
    return mesh;
}

/// Wider than the picture.
Mesh floor_mesh() {
    return grid_mesh(1, 1, [](float u, float v, Vec3f& p, Vec3f& n) {
        p = Vec3f(40 * (u - 0.5f), -0.5f, 40 * (0.5f - v)), n = Vec3f(0, 1, 0);
    });
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE(
        "sky cone: rows of one sample per pixel of a checkered sky are those of 256 unfiltered samples, seen and in "
        "mirrors") {
        const Mesh nothing = scaled(plane_mesh(), 1e-6f), flat = floor_mesh(), ball = sphere_mesh(128, 64);
        for (const Mesh* mesh : {&nothing, &flat, &ball}) {
            const double filtered = worst_row(*mesh, TextureFilter::moments),
                         plain = worst_row(*mesh, TextureFilter::off);
            MESSAGE("filtered " << filtered << ", at points " << plain);
            CHECK(filtered < 0.02);
            CHECK(plain > 0.1);
        }
    }

    TEST_CASE("sky cone: a mirror sphere under a smooth sky looks the same") {
        const auto smooth = [](const Vec3d& d) { return 1 + 0.4 * d.x + 0.3 * d.y - 0.2 * d.z + 0.25 * d.x * d.y; };
        // The middle of the ball, which mirrors the inside of one face: across the edges of the cube bilinear interpolation is
        // of first order, and towards its contour a pixel of the ball mirrors ever more of the sky.
        constexpr int size = 512, part = 64;
        const auto picture = [&](TextureFilter filter) {
            Scene scene = under_sky(sphere_mesh(256, 128), sky_of(256, smooth), filter, size);
            scene.settings.part = PixelRect{(size - part) / 2, (size - part) / 2, part, part};
            return render(scene, scene.settings);
        };
        const Image<float> filtered = picture(TextureFilter::moments), plain = picture(TextureFilter::off);
        REQUIRE(filtered.size() == std::size_t(part) * part * 3);
        double worst = 0;
        for (std::size_t i = 0; i < filtered.size(); ++i)
            worst = std::max(worst, std::abs(double(filtered.data()[i]) - double(plain.data()[i])));
        MESSAGE("largest difference " << worst);
        CHECK(worst > 0);
        CHECK(worst < 1e-4);
    }

} // TEST_SUITE

TEST_SUITE("unit") {

    TEST_CASE("sky cone: halvings are those of the cube at hand; an even sky is even over every cone") {
        Sky sky;
        add_halvings(sky); // of the background, which has none
        CHECK(sky.halvings.empty());
        sky.background = Vec3f(3);
        CHECK(sky_radiance(sky, Vec3f(0, 1, 0), 0.5f) == Vec3f(3));
        for (const int size : {1, 24, 16}) {
            sky.cube = constant_cube(Vec3f(0.25f, 0.5f, 1), size);
            add_halvings(sky);
            for (const float spread : {0.0f, 1e-3f, 0.2f, 1.0f, 100.0f})
                CHECK(glm::length(sky_radiance(sky, glm::normalize(Vec3f(1, -2, 3)), spread) - Vec3f(0.25f, 0.5f, 1)) <
                      1e-6f);
        }
        CHECK(sky.halvings.size() == 4); // 8, 4, 2, 1
    }

} // TEST_SUITE
