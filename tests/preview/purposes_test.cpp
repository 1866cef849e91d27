// Each purpose has random numbers of its own: what happens to one part of a path does not shift the numbers of another, so
// that pictures of similar scenes with the same seed have the same noise.
#include "bake/preview/light_terms.h"
#include "preview/little_scenes.h"
#include <doctest/doctest.h>

using namespace bake;
using namespace bake::test;

namespace {

struct Sample {
    std::vector<LightTerm> terms;
    Radiance radiance;
};

/// Two bounces. `cone`: around the ray.
Sample sample_of(const Scene& scene, const Ray& ray, int i, const RayCone& cone = {}) {
    Sample out;
    std::array<PrimaryRay, packet_size> rays;
    std::array<PrimaryHit, packet_size> hits;
    rays[0].ray = ray, rays[0].cone = cone, rays[0].sampler = Sampler(3, 5, i);
    hits[0].first.terms = &out.terms;
    trace(scene, rays, 1, 2, false, hits);
    out.radiance = hits[0].radiance;
    return out;
}

/// It shines up along z, or down.
Light<float> quad(const Vec3f& at, bool up) {
    Light<float> light;
    light.kind = LightKind::quad;
    light.position = at;
    light.edge_u = Vec3f(up ? 2 : -2, 0, 0), light.edge_v = Vec3f(0, 2, 0);
    return light;
}

/// What a light adds is told as the difference of sums.
bool same(const Vec3f& a, const Vec3f& b) { return glm::length(a - b) < 1e-5f; }

const Ray down{Vec3f(0.1f, 0.2f, 3), glm::normalize(Vec3f(0.1f, -0.2f, -1))};

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("purposes: a body beside a surface takes light away from it, and changes nothing else") {
        Material shiny;
        shiny.reflectance.model = Reflectance::Model::phong;
        shiny.reflectance.specular = Vec3f(0.3f), shiny.reflect = Vec3f(0.2f);
        const auto floor = [&](bool body) {
            Scene scene = one_mesh(plane_mesh(), shiny);
            if (body) {
                scene.shapes.push_back(make_shape(sphere_mesh()));
                add_instance(scene, *scene.shapes[1], *scene.materials[0],
                             {.translate = Vec3f(0.9f, 0.2f, 0.7f), .scale = Vec3f(0.6f)});
            }
            scene.lights = {quad(Vec3f(0, 0, 4), false), quad(Vec3f(3, 0, 4), false)};
            scene.sky.cube = constant_cube(Vec3f(0.2f, 0.3f, 0.4f), 8);
            for (int c = 0; c < 3; ++c) scene.sky.cube.faces[4].at(3, 3, c) = 20;
            scene.settings.diffuse_bounces = 1;
            build(scene);
            return scene;
        };
        const Scene without = floor(false), with = floor(true);
        int equal = 0, taken = 0;
        for (int i = 0; i < 256; ++i) {
            const Sample a = sample_of(without, down, i), b = sample_of(with, down, i);
            REQUIRE(a.terms.size() == b.terms.size());
            CHECK(a.radiance.reflected == b.radiance.reflected); // the mirror ray passes the body
            for (std::size_t k = 0; k < a.terms.size(); ++k) {
                const LightTerm &free = a.terms[k], &shown = b.terms[k];
                CHECK(free.light == shown.light);
                CHECK(free.l == shown.l);
                if (same(free.diffuse, shown.diffuse) && same(free.specular, shown.specular)) ++equal;
                else if (free.light == LightTerm::sky_by_surface || same(shown.diffuse + shown.specular, Vec3f(0)))
                    ++taken;
            }
        }
        CHECK(equal + taken == 4 * 256);
        CHECK(taken > 100);
        CHECK(equal > 500);
    }

    TEST_CASE("purposes: what is found inside of a translucent body does not change the light on its surface") {
        Material wax;
        wax.reflectance.model = Reflectance::Model::phong;
        wax.reflectance.specular = Vec3f(0.3f), wax.reflect = Vec3f(0.2f);
        wax.reflectance.subsurface = Vec3f(0.3f);
        const auto body = [&](bool hollow) {
            Mesh ball = sphere_mesh(32, 16);
            if (hollow) { // a second surface inside of the first
                const auto corners = std::uint32_t(ball.corner_position.size()),
                           points = std::uint32_t(ball.positions.size());
                for (std::uint32_t i = 0; i < points; ++i) {
                    ball.positions.push_back(0.8f * ball.positions[i]), ball.normals.push_back(ball.normals[i]);
                    ball.uvs.push_back(ball.uvs[i]);
                }
                for (std::size_t f = 1, faces = ball.face_begin.size(); f < faces; ++f)
                    ball.face_begin.push_back(ball.face_begin[f] + corners);
                for (std::uint32_t i = 0; i < corners; ++i)
                    for (auto* corner : {&ball.corner_position, &ball.corner_normal, &ball.corner_uv})
                        corner->push_back((*corner)[i] + points);
            }
            Scene scene = one_mesh(std::move(ball), wax);
            scene.sky.cube = constant_cube(Vec3f(0.2f, 0.3f, 0.4f), 8);
            for (int c = 0; c < 3; ++c) scene.sky.cube.faces[4].at(3, 3, c) = 20;
            build(scene);
            return scene;
        };
        const Scene full = body(false), hollow = body(true);
        int inside = 0;
        for (int i = 0; i < 128; ++i) {
            const Sample a = sample_of(full, down, i), b = sample_of(hollow, down, i);
            REQUIRE(a.terms.size() == b.terms.size());
            for (std::size_t k = 0; k < a.terms.size(); ++k) {
                if (a.terms[k].light == LightTerm::from_inside) {
                    inside += a.terms[k].diffuse != b.terms[k].diffuse;
                    continue;
                }
                CHECK(same(a.terms[k].specular, b.terms[k].specular));
            }
            CHECK(a.radiance.reflected == b.radiance.reflected);
        }
        CHECK(inside > 20);
    }

    TEST_CASE("purposes: slopes that a mirror's lookup averages away do not shift the numbers of what it shows") {
        const auto mirror = [&](float tilt) {
            Material material;
            material.reflectance.diffuse = Vec3f(0), material.reflect = Vec3f(1);
            material.normal_map = texture(64, 64, 3, [&](float u, float, float* xyz) {
                const Vec3f n = glm::normalize(Vec3f(int(64 * u) % 2 ? tilt : -tilt, 0, 1));
                for (int c = 0; c < 3; ++c) xyz[c] = n[c];
            });
            Scene scene = one_mesh(plane_mesh(), material);
            scene.materials.push_back(std::make_unique<Material>());
            scene.shapes.push_back(make_shape(plane_mesh()));
            add_instance(scene, *scene.shapes[1], *scene.materials[1],
                         {.translate = Vec3f(0, 0, 4), .scale = Vec3f(3)});
            scene.lights = {quad(Vec3f(2.5f, 0, 2), true)};
            build(scene);
            return scene;
        };
        const Scene flat = mirror(0), rough = mirror(1e-4f);
        const RayCone wide{0.2f, 0};
        double difference = 0, spread = 0;
        const float first = sample_of(flat, down, 0, wide).radiance.reflected.x;
        for (int i = 0; i < 64; ++i) {
            const float a = sample_of(flat, down, i, wide).radiance.reflected.x;
            const float b = sample_of(rough, down, i, wide).radiance.reflected.x;
            difference += std::abs(a - b), spread += std::abs(a - first);
        }
        CHECK(difference > 0); // the normals do vary
        CHECK(spread > 0);
        CHECK(difference < 0.02 * spread);
    }
}
