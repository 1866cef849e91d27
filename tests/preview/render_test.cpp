// Pictures and their layers.
#include "bake/preview/render.h"
#include "preview/little_scenes.h"
#include <algorithm>
#include <cstring>
#include <doctest/doctest.h>

using namespace bake;
using namespace bake::test;

namespace {

Scene shiny_ball() {
    Material material;
    material.reflectance.specular = Vec3f(0.3f);
    material.reflect = Vec3f(0.2f);
    Scene scene = one_mesh(sphere_mesh(), material);
    scene.lights.push_back(directional({1, 1, 1}));
    scene.ambient = Vec3f(0.1f);
    scene.sky.cube = constant_cube(Vec3f(0.5f, 0.6f, 0.7f));
    scene.settings.width = 40, scene.settings.height = 30;
    build(scene);
    return scene;
}

/// Index of a channel of layer_channels().
int channel(const char* name) {
    const std::vector<std::string> all = layer_channels();
    const auto at = std::find(all.begin(), all.end(), name);
    REQUIRE(at != all.end());
    return int(at - all.begin());
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("render: layers hold the picture, its parts add up to it, and its hits are those of the camera's rays") {
        const Scene scene = shiny_ball();
        const Image<float> plain = render(scene, scene.settings), all = render_layers(scene, scene.settings);
        REQUIRE(all.channels() == int(layer_channels().size()));
        const CameraFrame frame = camera_frame(scene.camera);
        int hits = 0;
        for (int y = 0; y < 30; ++y)
            for (int x = 0; x < 40; ++x) {
                const float* p = &all.at(x, y);
                for (int c = 0; c < 3; ++c) {
                    CHECK(p[c] == plain.at(x, y, c));
                    float sum = 0;
                    for (const char* part : {"emission.R", "diffuse.R", "specular.R", "reflection.R"})
                        sum += p[channel(part) + c];
                    CHECK(sum == doctest::Approx(p[c]).epsilon(1e-5));
                }
                Sampler sampler(x, y, 0);
                const Vec2d at = pixel_sample(scene.settings.spp, sampler);
                const Hit hit = scene.bvh->intersect(primary_ray(frame, x + at.x, y + at.y, 40, 30));
                CHECK((p[channel("object.Y")] == 1) == bool(hit));
                CHECK(p[channel("Z")] == doctest::Approx(hit ? hit.t : 0));
                if (!hit) continue;
                ++hits;
                CHECK(p[channel("material.Y")] == 1);
                CHECK(p[channel("samples.Y")] == float(scene.settings.spp));
                CHECK(p[channel("rays.Y")] > 1);
                CHECK(p[channel("triangle.Y")] == float(hit.triangle + 1));
                const Vec3f position(p[channel("P.X")], p[channel("P.Y")], p[channel("P.Z")]);
                CHECK(glm::length(position) == doctest::Approx(1).epsilon(0.01));
                if (p[3] < 1) continue;
                const Vec3f normal(p[channel("N.X")], p[channel("N.Y")], p[channel("N.Z")]);
                CHECK(angle_deg(normal, position) < 8);
                CHECK(p[channel("albedo.R")] == doctest::Approx(0.8));
            }
        CHECK(hits > 100);
    }

    TEST_CASE("render: a part of a picture has the very pixels of the whole, for any number of samples") {
        const Scene scene = shiny_ball();
        RenderSettings settings = scene.settings;
        const Image<float> whole = render(scene, settings);
        settings.part = PixelRect{7, 11, 20, 9};
        const Image<float> part = render(scene, settings);
        REQUIRE(part.width() == 20);
        REQUIRE(part.height() == 9);
        for (int y = 0; y < 9; ++y) CHECK(std::memcmp(part.row(y), &whole.at(7, 11 + y), 20 * 3 * sizeof(float)) == 0);
    }

    TEST_CASE("render: two seeds have independent noise about the same mean") {
        const Scene scene = shiny_ball();
        RenderSettings settings = scene.settings;
        settings.spp = 16;
        std::vector<Image<float>> pictures;
        for (settings.seed = 0; settings.seed < 3; ++settings.seed) pictures.push_back(render(scene, settings));
        settings.spp = 256;
        const Image<float> mean = render(scene, settings);
        double squares = 0, product = 0;
        for (std::size_t i = 0; i < mean.size(); ++i) {
            const double a = pictures[0].data()[i] - mean.data()[i], b = pictures[1].data()[i] - mean.data()[i];
            squares += a * a, product += a * b;
        }
        CHECK(squares > 0);
        CHECK(std::abs(product) < 0.3 * squares);
    }

    TEST_CASE("render: the share of samples whose relief is in trouble is counted by kind") {
        // Slopes of 2 along u on a plane that is seen at 60 degrees from its normal: those that fall away face away.
        Material material;
        material.bump_table = texture(64, 1, 2, [](float u, float, float* t) { t[0] = u < 0.5f ? 4 : -4, t[1] = 0; });
        Scene scene = one_mesh(plane_mesh(), material);
        scene.camera.position = {-8 * std::sin(pi_f / 3), 0, 8 * std::cos(pi_f / 3)};
        scene.camera.fov_deg = 6;
        scene.lights.push_back(directional({1, 0, 0.01f}));
        scene.settings.spp = 1, scene.settings.width = scene.settings.height = 32;
        build(scene);
        RenderStats stats;
        render(scene, scene.settings, &stats);
        CHECK(stats.hits == 32 * 32);
        CHECK(std::abs(double(stats.tilted) / double(stats.hits) - 0.5) < 0.1);
        CHECK(stats.repaired >= stats.tilted);
        CHECK(stats.repaired <= stats.tilted + stats.mirrored_below + stats.lit_below);
        CHECK(stats.lit_below == 0);
        scene.lights[0] = directional({1, 0, -0.1f}); // below the plane, but above the slopes that face it
        render(scene, scene.settings, &(stats = {}));
        CHECK(double(stats.lit_below) / double(stats.hits) == doctest::Approx(0.5).epsilon(0.2));
    }

} // TEST_SUITE

TEST_SUITE("stability") {

    TEST_CASE("render: one pixel, no lights, an empty scene, a camera inside a mesh") {
        Scene scene;
        scene.settings.width = scene.settings.height = 1;
        build(scene);
        CHECK(render(scene, scene.settings).at(0, 0) == 0);
        scene = one_mesh(sphere_mesh(), Material{});
        scene.camera.position = Vec3f(0);
        scene.camera.target = Vec3f(0, 0, 1);
        scene.settings.width = scene.settings.height = 1;
        build(scene);
        CHECK(render(scene, scene.settings).at(0, 0) == 0);
        scene.lights.push_back(directional({0, 1, 0}));
        CHECK(std::isfinite(render(scene, scene.settings).at(0, 0)));
    }

} // TEST_SUITE
