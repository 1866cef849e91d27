// Light that leaves a body elsewhere than it enters, against closed forms.
#include "bake/light/diffusion.h"
#include "bake/preview/translucency.h"
#include "preview/little_scenes.h"
#include <doctest/doctest.h>

using namespace bake;
using namespace bake::test;

namespace {

/// Its light spreads by the length `d`, whatever the reflectance.
Material translucent(float reflectance, const Vec3f& d) {
    Material material;
    material.reflectance.diffuse = Vec3f(reflectance), material.reflectance.ambient = Vec3f(0);
    material.reflectance.subsurface = d / diffusion_length(reflectance, 1);
    return material;
}
Material translucent(float reflectance, float d) { return translucent(reflectance, Vec3f(d)); }

/// A box with sharp edges, [-1, 1]^3.
Mesh box_mesh() {
    Mesh mesh;
    for (int i = 0; i < 8; ++i) mesh.positions.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    const std::uint32_t faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                       {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& face : faces) {
        mesh.corner_position.insert(mesh.corner_position.end(), face, face + 4);
        mesh.face_begin.push_back(std::uint32_t(mesh.corner_position.size()));
    }
    return mesh;
}

struct Seen {
    Vec3d mean{0};
    double deviation = 0; ///< of one sample, of the green channel
};

/// Of a ray, or of rays that differ by their samples alone.
Seen seen(const Scene& scene, const Ray& ray, int spp) {
    Seen out;
    double squares = 0;
    for (int i = 0; i < spp; ++i) {
        const Vec3d value(trace_one(scene, ray, 0, Sampler(3, 5, i, scene.settings.seed)).radiance.total());
        out.mean += value / double(spp), squares += value.y * value.y / spp;
    }
    out.deviation = std::sqrt(std::max(0.0, squares - out.mean.y * out.mean.y));
    return out;
}

Scene body(Mesh mesh, const Material& material, const Placement& placement, const Vec3f& light, bool flat = false) {
    Scene scene;
    scene.shapes.push_back(make_shape(std::move(mesh), {.flat = flat}));
    scene.materials.push_back(std::make_unique<Material>(material));
    add_instance(scene, *scene.shapes[0], *scene.materials[0], placement);
    if (light != Vec3f(0)) scene.lights.push_back(directional(light));
    build(scene);
    return scene;
}

const Ray from_above{{0.3f, 0.2f, 3}, {0, 0, -1}};
const Placement wide{.scale = Vec3f(100)};

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("translucency: a half-space reflects its reflectance, and one colour costs no noise") {
        const Scene grey = body(plane_mesh(), translucent(0.6f, 0.5f), wide, {0, 0, 1});
        const Seen one = seen(grey, from_above, 4096);
        CHECK(one.mean.y == doctest::Approx(0.6).epsilon(1e-3));
        CHECK(one.deviation < 0.02);
        const Scene red = body(plane_mesh(), translucent(0.6f, Vec3f(2, 0.5f, 0.02f)), wide, {0, 0, 1});
        const Seen three = seen(red, from_above, 4096);
        for (int c = 0; c < 3; ++c) CHECK(three.mean[c] == doctest::Approx(0.6).epsilon(0.02));
    }

    TEST_CASE("translucency: entries lie as the profile says, for every colour") {
        const Vec3f d(1, 0.3f, 0.1f);
        const Scene scene = body(plane_mesh(), translucent(0.8f, d), wide, {0, 0, 1});
        const Hit hit = scene.bvh->intersect(from_above);
        const Surfel s = make_surfel(scene, hit, from_above.direction);
        constexpr int count = 1 << 15;
        for (const double bound : {0.05, 0.3, 1.0, 4.0}) {
            Vec3d within(0);
            std::int64_t rays = 0;
            for (int i = 0; i < count; ++i) {
                Sampler sampler(1, 2, i, 9);
                const LightEntries entries = draw_light_entries(scene, s, hit, sampler, rays);
                for (int k = 0; k < entries.count; ++k) {
                    const Vec3f to = scene.bvh->point(entries.entry[k].hit).p - s.at.p;
                    if (glm::length(Vec3d(to)) < bound) within += Vec3d(entries.entry[k].factor) / double(count);
                }
            }
            for (int c = 0; c < 3; ++c)
                CHECK(within[c] == doctest::Approx(0.8 * double(diffusion_within(d[c], float(bound)))).epsilon(0.02));
        }
    }

    TEST_CASE("translucency: a slab lit from behind lets through what its thickness leaves") {
        constexpr float d = 0.5f;
        for (const float thickness : {0.2f, 1.f, 3.f}) {
            const Scene scene =
                body(box_mesh(), translucent(0.9f, d), {.scale = {100, 100, thickness / 2}}, {0, 0, -1}, true);
            const double expected = 0.9 * (1 - double(diffusion_within(d, thickness)));
            CHECK(seen(scene, from_above, 1 << 13).mean.y == doctest::Approx(expected).epsilon(0.02));
        }
    }

    TEST_CASE("translucency: near an edge, beyond which no light enters, the light of a half-plane is seen") {
        constexpr float d = 0.4f;
        for (const float distance : {0.05f, 0.5f}) {
            // Seen and lit from above; the edge is at x = 0.
            const Scene scene = body(box_mesh(), translucent(0.7f, d),
                                     {.translate = {-100, 0, -100}, .scale = Vec3f(100)}, {0, 0, 1}, true);
            double missing = 0; // the part beyond the edge, in polar coordinates
            const double step = 1e-3;
            for (double r = double(distance) + step / 2; r < 20; r += step)
                missing += double(diffusion_profile(d, float(r))) * 2 * std::acos(double(distance) / r) * r * step;
            const Ray ray{{-distance, 0, 3}, {0, 0, -1}};
            CHECK(seen(scene, ray, 1 << 13).mean.y == doctest::Approx(0.7 * (1 - missing)).epsilon(0.015));
        }
    }

    TEST_CASE(
        "translucency: a ball in an even sky has the light within its diameter, since areas go with distance squared") {
        for (const float d : {0.05f, 0.4f, 2.f}) {
            Scene scene = body(sphere_mesh(96, 48), translucent(1, d), {}, {});
            scene.sky.cube = constant_cube(Vec3f(1));
            build(scene);
            const Seen light = seen(scene, from_above, 1 << 12);
            CHECK(light.mean.y == doctest::Approx(double(diffusion_within(d, 2))).epsilon(0.01));
        }
    }

} // TEST_SUITE
TEST_SUITE("unit") {

    TEST_CASE(
        "translucency: a share of 0, a mean free path of 0, and one below the precision of positions are Lambert") {
        Material none = translucent(0.6f, 0.5f), zero = translucent(0.6f, 0.f), least = translucent(0.6f, 1e-12f);
        none.reflectance.translucency = 0;
        for (const Material& material : {none, zero, least}) {
            const Seen light = seen(body(plane_mesh(), material, wide, {0, 0.5f, 1}), from_above, 4);
            CHECK(light.mean.y == doctest::Approx(0.6 / std::sqrt(1.25)));
            CHECK(light.deviation < 1e-6);
        }
    }

    TEST_CASE("translucency: a share spreads, the rest is Lambert") {
        Material half = translucent(0.8f, 0.5f);
        half.reflectance.translucency = 0.25f;
        CHECK(seen(body(plane_mesh(), half, wide, {0, 0, 1}), from_above, 1024).mean.y ==
              doctest::Approx(0.8).epsilon(2e-3));
        // Lit from behind, a thin slab shows the share alone.
        const Scene slab = body(box_mesh(), half, {.scale = {100, 100, 0.1f}}, {0, 0, -1}, true);
        const double expected = 0.25 * 0.8 * (1 - double(diffusion_within(0.5f, 0.2f)));
        CHECK(seen(slab, from_above, 1 << 12).mean.y == doctest::Approx(expected).epsilon(0.03));
    }

    TEST_CASE("translucency: light enters the body's own surface alone, and what shadows it shadows it there") {
        Scene scene = body(plane_mesh(), translucent(0.8f, 0.2f), wide, {0, 0, 1});
        add_instance(scene, *scene.shapes[0], *scene.materials[0], {.translate = {0, 0, 1e-3f}, .scale = Vec3f(50)});
        build(scene);
        const Ray between{{0, 0, 5e-4f}, {0, 0, -1}}; // the upper plane is lit, and close enough to be found
        CHECK(seen(scene, between, 64).mean.y == 0);
    }

    TEST_CASE("translucency: ggx on a translucent body takes its part, and in even light the sum is the same") {
        Material coated = translucent(0.9f, 0.3f), plain = coated;
        for (Material* m : {&coated, &plain}) m->reflectance.model = Reflectance::Model::ggx;
        plain.reflectance.subsurface = Vec3f(0);
        const auto light = [](const Material& material) {
            Scene scene = body(plane_mesh(), material, wide, {});
            scene.sky.cube = constant_cube(Vec3f(1));
            build(scene);
            return seen(scene, from_above, 1 << 12).mean.y;
        };
        CHECK(light(coated) == doctest::Approx(light(plain)).epsilon(3e-3));
    }

} // TEST_SUITE
TEST_SUITE("stability") {

    TEST_CASE("translucency: extreme lengths, meshes and places give finite light") {
        for (const float d : {1e-30f, 1e-6f, 1.f, 1e6f, 1e14f})
            for (const float at : {0.f, 1e4f}) {
                Scene scene = body(sphere_mesh(8, 4), translucent(0.999f, Vec3f(d, d / 3, 0)),
                                   {.translate = Vec3f(at), .scale = {1, 1, 1e-4f}}, {0.2f, 0.3f, 1});
                scene.sky.cube = constant_cube(Vec3f(2));
                build(scene);
                for (int i = 0; i < 64; ++i) {
                    const Ray ray{{at + 0.02f * float(i % 8) - 0.1f, at + 0.1f * float(i / 8) - 0.4f, at + 2},
                                  {0, 0, -1}};
                    const Seen light = seen(scene, ray, 2);
                    REQUIRE(std::isfinite(light.mean.x + light.mean.y + light.mean.z));
                    REQUIRE(light.mean.y >= 0);
                }
            }
    }

} // TEST_SUITE
