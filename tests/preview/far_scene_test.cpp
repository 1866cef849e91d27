// Scenes that lie far from the origin are traced around their own centre.
#include "bake/preview/capture.h"
#include "preview/little_scenes.h"
#include <cstring>
#include <doctest/doctest.h>

using namespace bake;
using namespace bake::test;

namespace {

/// A ball on a plane under a point light, a spot and a quad, all moved by `to`: values that floats hold exactly there.
Scene scene_at(const Vec3f& to) {
    Material material;
    material.reflect = Vec3f(0.25f);
    Scene scene = one_mesh(sphere_mesh(32, 16), material);
    scene.instances.clear();
    scene.shapes.push_back(make_shape(plane_mesh(8)));
    add_instance(scene, *scene.shapes[0], *scene.materials[0], {.translate = to, .rotate_deg = {10, 20, 30}});
    add_instance(scene, *scene.shapes[1], *scene.materials[0],
                 {.translate = to + Vec3f(0, -1, 0), .rotate_deg = {-90, 0, 0}, .scale = Vec3f(2)});
    Light<float> light;
    light.position = to + Vec3f(-2, 3, 1), light.from = glm::normalize(Vec3f(-2, 3, 1));
    light.falloff = {0, 0.5f, 0.25f}, light.colour = Vec3f(3);
    light.edge_u = {1, 0, 0}, light.edge_v = {0, 0, 1};
    for (const LightKind kind : {LightKind::point, LightKind::spot, LightKind::quad}) {
        light.kind = kind;
        scene.lights.push_back(light);
    }
    scene.camera.position = to + Vec3f(1, 2, 6), scene.camera.target = to;
    scene.settings.width = 40, scene.settings.height = 30;
    build(scene);
    return scene;
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("far scene: the picture is the same wherever the scene lies, and its positions are the scene's own") {
        const Scene here = scene_at(Vec3f(0)), there = scene_at({4096, -8192, 1024});
        CHECK(here.origin == Vec3f(0));
        CHECK(glm::length(there.origin - Vec3f(4096, -8192, 1024)) < 4);
        const Image<float> a = render_layers(here, here.settings), b = render_layers(there, there.settings);
        const std::vector<std::string>& names = layer_channels();
        const auto at = std::size_t(std::find(names.begin(), names.end(), "P.X") - names.begin());
        double worst = 0, worst_position = 0;
        int hits = 0;
        for (int y = 0; y < 30; ++y)
            for (int x = 0; x < 40; ++x) {
                const float *p = &a.at(x, y), *q = &b.at(x, y);
                CHECK(p[3] == q[3]);
                if (p[3] < 1) continue;
                ++hits;
                for (int c = 0; c < 3; ++c) worst = std::max(worst, std::abs(double(p[c]) / double(q[c]) - 1));
                const Vec3f shift = Vec3f(q[at], q[at + 1], q[at + 2]) - Vec3f(p[at], p[at + 1], p[at + 2]);
                worst_position = std::max(worst_position, double(glm::length(shift - Vec3f(4096, -8192, 1024))));
            }
        CHECK(hits > 300);
        CHECK(worst < 1e-3);          // of floats of the scene's extent
        CHECK(worst_position < 1e-3); // floats are 9.8e-4 apart at 8192
    }

    TEST_CASE("far scene: a capture sees what it sees at the origin") {
        const Scene here = scene_at(Vec3f(0)), there = scene_at({4096, -8192, 1024});
        const Cube a = capture(here, {0, 2, 0}, 8), b = capture(there, {4096, -8190, 1024}, 8);
        double seen = 0, difference = 0;
        for (int f = 0; f < 6; ++f)
            for (std::size_t i = 0; i < a.faces[f].size(); ++i) {
                seen += double(a.faces[f].data()[i]);
                difference += std::abs(double(a.faces[f].data()[i]) - double(b.faces[f].data()[i]));
            }
        CHECK(seen > 10);
        CHECK(difference < 1e-3 * seen);
    }

    TEST_CASE("far scene: a scene around or beside the origin is not moved, an empty one neither") {
        Scene scene = one_mesh(sphere_mesh(), Material{});
        build(scene);
        CHECK(scene.origin == Vec3f(0));
        add_instance(scene, *scene.shapes[0], *scene.materials[0], {.translate = {3, 0, 0}});
        build(scene);
        CHECK(scene.origin == Vec3f(0));
        Scene empty;
        build(empty);
        CHECK(empty.origin == Vec3f(0));
    }

} // TEST_SUITE
