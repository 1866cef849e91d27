// The shading of a pixel in numbers: they add up to the picture.
#include "bake/verdict/explain_pixel.h"
#include "preview/little_scenes.h"
#include <algorithm>
#include <doctest/doctest.h>

using namespace bake;
using namespace bake::test;

namespace {

/// Three kinds of light, a sky, a mirror, emission: every part of the sum is there.
Scene rich_scene() {
    Material material;
    material.name = "rich";
    material.reflectance.specular = Vec3f(0.3f, 0.2f, 0.1f);
    material.reflectance.emission = Vec3f(0.01f, 0.02f, 0.03f);
    material.reflect = Vec3f(0.2f);
    Scene scene = one_mesh(sphere_mesh(), material);
    scene.lights.push_back(directional({1, 1, 1}));
    Light<float> point;
    point.kind = LightKind::point;
    point.position = Vec3f(-2, 1, 2);
    scene.lights.push_back(point);
    Light<float> quad;
    quad.kind = LightKind::quad;
    quad.position = Vec3f(0, 3, 0), quad.edge_u = Vec3f(1, 0, 0), quad.edge_v = Vec3f(0, 0, 1);
    scene.lights.push_back(quad);
    scene.ambient = Vec3f(0.1f);
    scene.sky.cube = constant_cube(Vec3f(0.5f, 0.6f, 0.7f));
    scene.settings.width = 24, scene.settings.height = 18;
    scene.settings.spp = 8;
    build(scene);
    return scene;
}

const RouteEntry* find(const std::vector<RouteStep>& route, const std::string& name) {
    for (const RouteStep& step : route)
        for (const RouteEntry& entry : step.entries)
            if (entry.name == name) return &entry;
    return nullptr;
}

Vec3d colour(const std::vector<RouteStep>& route, const std::string& name) {
    const RouteEntry* const entry = find(route, name);
    REQUIRE_MESSAGE(entry, name);
    REQUIRE(entry->values.size() == 3);
    return {entry->values[0], entry->values[1], entry->values[2]};
}

void check_near(const Vec3d& a, const Vec3d& b) {
    for (int c = 0; c < 3; ++c) CHECK(a[c] == doctest::Approx(b[c]).epsilon(1e-5));
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("explain_pixel: the radiance is that of the picture, and its parts are those of the layers") {
        const Scene scene = rich_scene();
        const Image<float> picture = render(scene, scene.settings), layers = render_layers(scene, scene.settings);
        const std::vector<std::string> channels = layer_channels();
        const auto layer = [&](int x, int y, const char* name) {
            const auto at = std::find(channels.begin(), channels.end(), name) - channels.begin();
            return Vec3d(layers.at(x, y, int(at)), layers.at(x, y, int(at) + 1), layers.at(x, y, int(at) + 2));
        };
        int hits = 0;
        for (int y = 0; y < 18; ++y)
            for (int x = 0; x < 24; ++x) {
                const std::vector<RouteStep> route = explain_pixel(scene, x, y, 0.5f, false);
                const Vec3d radiance = colour(route, "radiance");
                for (int c = 0; c < 3; ++c) CHECK(radiance[c] == picture.at(x, y, c));
                check_near(colour(route, "emission, ambient") + colour(route, "lights and sky") +
                               colour(route, "reflections") + colour(route, "sky behind"),
                           radiance);
                check_near(colour(route, "reflections"), layer(x, y, "reflection.R"));
                check_near(colour(route, "lights and sky"), layer(x, y, "diffuse.R") + layer(x, y, "specular.R"));
                const Vec3d levels = colour(route, "8 bit");
                for (int c = 0; c < 3; ++c)
                    CHECK(levels[c] == std::floor(shown_value(picture.at(x, y, c), 0.5f, Tone::srgb) * 255 + 0.5f));
                if (!find(route, "object, triangle")) continue;
                ++hits;
                Vec3d diffuse = colour(route, "sky: diffuse"), specular = colour(route, "sky: specular");
                for (const char* light : {"directional 1", "point 2", "quad 3"}) {
                    diffuse += colour(route, light + std::string(": diffuse"));
                    specular += colour(route, light + std::string(": specular"));
                }
                check_near(diffuse, layer(x, y, "diffuse.R"));
                check_near(specular, layer(x, y, "specular.R"));
            }
        CHECK(hits > 60);
    }

    TEST_CASE("explain_pixel: a filtered sky and light from inside a translucent body are parts of the sum") {
        Scene scene = rich_scene();
        scene.materials[0]->reflectance.subsurface = Vec3f(0.05f);
        scene.settings.sky_light = SkyLighting::irradiance;
        build(scene);
        const Image<float> picture = render(scene, scene.settings);
        const std::vector<RouteStep> route = explain_pixel(scene, 12, 9, 0, false);
        Vec3d lights = colour(route, "filtered sky: diffuse") + colour(route, "filtered sky: specular") +
                       colour(route, "from inside: diffuse");
        CHECK(lights.x > 0.1);
        for (const char* light : {"directional 1", "point 2", "quad 3"})
            for (const char* part : {": diffuse", ": specular"}) lights += colour(route, light + std::string(part));
        check_near(lights, colour(route, "lights and sky"));
        CHECK(colour(route, "radiance").y == picture.at(12, 9, 1));
    }

    TEST_CASE("explain_pixel: geometry, material and light of a point that is known in closed form") {
        // The plane z = 0 under a light from (0, 3, 4), seen from (0, 0, 4): n.l = .8 at every point.
        Material material;
        material.name = "matt";
        material.reflectance.diffuse = Vec3f(0.5f, 0.25f, 0.125f);
        Scene scene = one_mesh(plane_mesh(), material);
        scene.lights.push_back(directional({0, 3, 4}));
        scene.lights.push_back(directional({0, 0, -1}));
        scene.settings.width = scene.settings.height = 3, scene.settings.spp = 1;
        build(scene);
        const std::vector<RouteStep> route = explain_pixel(scene, 1, 1, 1, true);
        check_near(colour(route, "p"), Vec3d(0, 0, 0));
        CHECK(find(route, "distance")->values[0] == doctest::Approx(4));
        CHECK(find(route, "material")->words == "matt");
        CHECK(find(route, "uv")->values == std::vector<double>{0.5, 0.5});
        for (const char* normal : {"facet", "surface", "shading"}) check_near(colour(route, normal), Vec3d(0, 0, 1));
        check_near(colour(route, "lambert"), Vec3d(0.5, 0.25, 0.125));
        for (const char* unused : {"occlusion", "translucent"}) CHECK_FALSE(find(route, unused));
        CHECK(find(route, "directional 1: n . l")->values[0] == doctest::Approx(0.8));
        CHECK(find(route, "directional 1: l")->words == "lights 1 of 1 samples");
        CHECK(find(route, "directional 2: l")->words == "behind the shading normal");
        check_near(colour(route, "directional 1: diffuse"), 0.8 * Vec3d(0.5, 0.25, 0.125));
        check_near(colour(route, "radiance"), 0.8 * Vec3d(0.5, 0.25, 0.125));
        check_near(colour(route, "exposed"), 1.6 * Vec3d(0.5, 0.25, 0.125));
        CHECK(find(route, "exposure")->words.find("whole picture") != std::string::npos);
        // .8 is 231 in sRGB.
        CHECK(colour(route, "8 bit").x == 231);
    }

    TEST_CASE("explain_pixel: a shadow is told from a light behind the surface") {
        Scene scene = one_mesh(plane_mesh(), Material{});
        scene.shapes.push_back(make_shape(plane_mesh(), {}));
        add_instance(scene, *scene.shapes[1], *scene.materials[0], {.translate = Vec3f(0, 1, 1), .scale = Vec3f(0.5f)});
        scene.lights.push_back(directional({0, 1, 1}));
        scene.settings.width = scene.settings.height = 3, scene.settings.spp = 1;
        build(scene);
        CHECK(find(explain_pixel(scene, 1, 1, 0, false), "directional 1: l")->words == "in shadow");
        scene.settings.shadows = false;
        CHECK(find(explain_pixel(scene, 1, 1, 0, false), "directional 1: l")->words == "lights 1 of 1 samples");
    }

} // TEST_SUITE

TEST_SUITE("stability") {

    TEST_CASE("explain_pixel: an empty scene") {
        Scene scene;
        scene.settings.width = scene.settings.height = 2;
        build(scene);
        const std::vector<RouteStep> route = explain_pixel(scene, 1, 1, 0, false);
        CHECK(colour(route, "radiance") == Vec3d(0));
        CHECK(find(route, "no mesh"));
        CHECK_FALSE(find(route, "shading"));
    }

} // TEST_SUITE
