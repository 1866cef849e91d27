#include "bake/base/parallel.h"
#include "bake/preview/tracer.h"
#include "bake/relief/map/bump_table.h"
#include "preview/little_scenes.h"
#include <cstring>
#include <doctest/doctest.h>
#include <limits>

using namespace bake;
using namespace bake::test;

namespace {

bool near(const Vec3f& a, const Vec3f& b, float tolerance = 1e-5f) { return glm::length(a - b) <= tolerance; }

float mean(const Vec3f& v) { return (v.x + v.y + v.z) / 3; }

Material shiny() {
    Material material;
    material.reflectance.ambient = {0.2f, 0.1f, 0.05f};
    material.reflectance.diffuse = {0.5f, 0.6f, 0.7f};
    material.reflectance.specular = Vec3f(0.4f);
    material.reflectance.emission = {0.01f, 0.02f, 0.03f};
    material.reflectance.shininess = 20;
    return material;
}

Material mirror(float k = 1) {
    Material material;
    material.reflectance.ambient = material.reflectance.diffuse = Vec3f(0);
    material.reflect = Vec3f(k);
    return material;
}

/// Every texel has a different colour.
Cube numbered_cube(int n) {
    Cube cube;
    for (int f = 0; f < 6; ++f) {
        Image<float>& face = cube.faces[f] = Image<float>(n, n, 3);
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x) {
                face.at(x, y, 0) = float(x + 1);
                face.at(x, y, 1) = float(y + 1);
                face.at(x, y, 2) = float(f + 1);
            }
    }
    return cube;
}

/// First intersection of the camera's ray through (x, y) with the unit sphere at the origin; false if there is none.
bool on_sphere(const Scene& scene, double x, double y, int n, Vec3d& p, Vec3d& v) {
    const Ray ray = primary_ray(camera_frame(scene.camera), x, y, n, n);
    const Vec3d o(ray.origin), d(glm::normalize(Vec3d(ray.direction)));
    const double b = glm::dot(o, d), c = glm::dot(o, o) - 1, root = b * b - c;
    if (root < 0) return false;
    p = o + (-b - std::sqrt(root)) * d;
    v = -d;
    return true;
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("tracer: a lit sphere agrees with the closed form, for directional and point lights") {
        Scene scene = one_mesh(sphere_mesh(512, 256), shiny());
        scene.ambient = {1, 0.5f, 0.25f};
        scene.lights.push_back(directional({1, 1, 1}));
        Light<float> point;
        point.kind = LightKind::point;
        point.position = {-2, 1, 3};
        point.colour = {4, 5, 6};
        point.falloff = {0.1f, 0.2f, 0.3f};
        scene.lights.push_back(point);
        build(scene);
        const Reflectance& m = scene.materials[0]->reflectance;
        double worst = 0;
        for (int y = 0; y < 32; ++y)
            for (int x = 0; x < 32; ++x) {
                Vec3d p, v;
                if (!on_sphere(scene, x + 0.5, y + 0.5, 32, p, v) || glm::dot(p, v) < 0.1) continue;
                Vec3d expected = Vec3d(m.emission) + Vec3d(m.ambient) * Vec3d(scene.ambient);
                const auto add = [&](const Vec3d& to_light, const Vec3d& radiance) {
                    const Vec3d l = glm::normalize(to_light), h = glm::normalize(l + v);
                    if (glm::dot(p, l) <= 0) return;
                    expected += radiance * (Vec3d(m.diffuse) * glm::dot(p, l) +
                                            Vec3d(m.specular) * std::pow(std::max(0.0, glm::dot(p, h)), 20.0));
                };
                add(Vec3d(1), Vec3d(1));
                const Vec3d to_point = Vec3d(-2, 1, 3) - p;
                const double r = glm::length(to_point);
                add(to_point, Vec3d(4, 5, 6) / (0.1 + 0.2 * r + 0.3 * r * r));
                const Vec3d seen(seen_at(scene, x + 0.5, y + 0.5, 32));
                worst = std::max(worst, glm::length(seen - expected) / glm::length(expected));
            }
        // Facets are up to (pi/256)^2/2 = 7.5e-5 inside the sphere; the slope of the highlight is about 20.
        CHECK(worst < 2e-3);
    }

} // TEST_SUITE
TEST_SUITE("unit") {

    TEST_CASE(
        "tracer: a perfect mirror in an even sky is not to be seen, whatever its shape and however many bounces") {
        const Vec3f sky(0.3f, 0.5f, 0.7f);
        for (const int bounces : {0, 1, 4}) {
            Scene scene = one_mesh(sphere_mesh(24, 12), mirror());
            add_instance(scene, *scene.shapes[0], *scene.materials[0], {.translate = {1.2f, 0.3f, -0.5f}});
            add_instance(scene, *scene.shapes[0], *scene.materials[0],
                         {.scale = Vec3f(30)}); // everything is inside a sphere
            scene.sky.cube = constant_cube(sky);
            scene.settings.bounces = bounces;
            build(scene);
            for (int i = 0; i < 64; ++i) CHECK(near(seen_at(scene, i + 0.5, 63.5 - 0.7 * i), sky));
        }
    }

    TEST_CASE("tracer: reflection is multiplied by its colour") {
        Scene scene = one_mesh(plane_mesh(), mirror());
        scene.materials[0]->reflect = {0.5f, 0.25f, 0};
        scene.sky.background = Vec3f(0.8f);
        build(scene);
        CHECK(near(seen_at(scene, 32, 32), {0.4f, 0.2f, 0}));
    }

    TEST_CASE("tracer: a camera inside the sky sees each face as its picture, never mirrored") {
        const int n = 16;
        Scene scene;
        scene.sky.cube = numbered_cube(n);
        build(scene);
        // World directions: cube space has the opposite x.
        const std::array<Vec3f, 6> ahead = {Vec3f(-1, 0, 0), {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
        const std::array<Vec3f, 6> up = {Vec3f(0, 1, 0), {0, 1, 0}, {0, 0, -1}, {0, 0, 1}, {0, 1, 0}, {0, 1, 0}};
        RenderSettings settings;
        settings.width = settings.height = n;
        settings.spp = 1;
        for (int f = 0; f < 6; ++f) {
            scene.camera.position = Vec3f(0);
            scene.camera.target = ahead[f];
            scene.camera.up = up[f];
            scene.camera.fov_deg = 90; // exactly one face
            const Image<float> seen = render(scene, settings);
            for (int y = 0; y < n; ++y)
                for (int x = 0; x < n; ++x) {
                    const Vec3f pixel(seen.at(x, y, 0), seen.at(x, y, 1), seen.at(x, y, 2));
                    CHECK(near(pixel, {x + 1, y + 1, f + 1}, 1e-3f));
                }
        }
    }

    TEST_CASE("tracer: a mirror shows the sky in the mirror direction") {
        Scene scene = one_mesh(plane_mesh(), mirror());
        scene.sky.cube = numbered_cube(8);
        build(scene);
        for (const double x : {20.0, 32.0, 40.0}) {
            const Vec3f d = primary_ray(camera_frame(scene.camera), x, 28, 64, 64).direction;
            CHECK(near(seen_at(scene, x, 28), lookup(scene.sky.cube, world_to_cube(Vec3f(d.x, d.y, -d.z))), 1e-3f));
        }
    }

    TEST_CASE("tracer: mirrors show meshes until the bounces are used up") {
        for (const int bounces : {0, 1}) {
            Scene scene = one_mesh(plane_mesh(), mirror());
            scene.materials.push_back(std::make_unique<Material>());
            scene.materials[1]->reflectance.emission = {1, 2, 3};
            add_instance(scene, *scene.shapes[0], *scene.materials[1], {.translate = {0, 0, 8}, .scale = Vec3f(50)});
            scene.sky.background = Vec3f(0.5f);
            scene.settings.bounces = bounces;
            build(scene);
            CHECK(near(seen_at(scene, 32, 32), bounces ? Vec3f(1, 2, 3) : Vec3f(0.5f)));
        }
    }

    TEST_CASE("tracer: an occluder shadows directional and point lights, not ambient light; behind a light it casts no "
              "shadow") {
        // A plane facing +Z, a small ball over its centre.
        const auto seen = [](const Light<float>& light, bool shadows) {
            Scene scene = one_mesh(plane_mesh(), Material{});
            scene.shapes.push_back(make_shape(sphere_mesh()));
            add_instance(scene, *scene.shapes[1], *scene.materials[0], {.translate = {0, 0, 1}, .scale = Vec3f(0.2f)});
            scene.camera.position = {3, 0, 3}; // past the ball
            scene.lights.push_back(light);
            scene.ambient = Vec3f(0.1f);
            scene.settings.shadows = shadows;
            build(scene);
            return mean(seen_at(scene, 32, 32));
        };
        const float dark = 0.8f * 0.1f, lit = dark + 0.8f;
        CHECK(seen(directional({0, 0, 1}), true) == doctest::Approx(dark));
        CHECK(seen(directional({0, 0, 1}), false) == doctest::Approx(lit));
        CHECK(seen(directional({0, 1, 0.3f}), true) > 2 * dark);
        Light<float> point;
        point.kind = LightKind::point;
        point.position = {0, 0, 3};
        CHECK(seen(point, true) == doctest::Approx(dark));
        point.position = {0, 0, 0.5f};
        CHECK(seen(point, true) == doctest::Approx(lit));
    }

    TEST_CASE("tracer: light comes from the direction of the light") {
        for (const Vec3f& from : {Vec3f(-1, 0, 0.5f), Vec3f(1, 0, 0.5f), Vec3f(0, 1, 0.5f), Vec3f(0, -1, 0.5f)})
            for (const LightKind kind : {LightKind::directional, LightKind::point}) {
                Scene scene = one_mesh(sphere_mesh(), Material{});
                Light<float> light = directional(from);
                light.kind = kind;
                light.position = 5.0f * from;
                scene.lights.push_back(light);
                build(scene);
                // x of the picture is +X, y is -Y.
                const float towards = mean(seen_at(scene, 32 + 12 * from.x, 32 - 12 * from.y));
                const float away = mean(seen_at(scene, 32 - 12 * from.x, 32 + 12 * from.y));
                CHECK(towards > 0.5f);
                CHECK(away < 0.1f);
            }
    }

    TEST_CASE("tracer: a white spot of a height appears raised: lit from the left, its left side is bright") {
        HeightTexture height;
        height.values = Image<float>(64, 64, 1);
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x) {
                const float dx = (float(x) - 31.5f) / 32, dy = (float(y) - 31.5f) / 32;
                height.values.at(x, y) = std::exp(-8 * (dx * dx + dy * dy));
            }
        BumpTableOptions options;
        options.filter = Filter::central;
        options.amplitude = 0.2;
        Material bump, mapped;
        bump.bump_table = std::make_shared<const Image<float>>(bump_table(height, options));
        // |p_u| = |p_v| = 2 on the plane.
        mapped.normal_map = texture(64, 64, 3, [&](float u, float v, float* t) {
            const Vec2f slopes = lookup2(*bump.bump_table, {u, v});
            const Vec3f n = glm::normalize(Vec3f(-slopes.x / 2, -slopes.y / 2, 1));
            for (int c = 0; c < 3; ++c) t[c] = n[c];
        });
        for (const Material* material : {&bump, &mapped}) {
            Scene scene = one_mesh(plane_mesh(), *material);
            scene.lights.push_back(directional({-1, 0, 1}));
            scene.camera.fov_deg = 20;
            build(scene);
            CHECK(mean(seen_at(scene, 24, 32)) > 1.1f * mean(seen_at(scene, 2, 2)));
            CHECK(mean(seen_at(scene, 40, 32)) < 0.9f * mean(seen_at(scene, 2, 2)));
            scene.lights[0] = directional({0, 1, 1}); // from above: the upper flank
            CHECK(mean(seen_at(scene, 32, 24)) > 1.1f * mean(seen_at(scene, 32, 40)));
        }
    }

    TEST_CASE("tracer: a coarse smooth sphere casts no shadows of its facets on its lit side") {
        Scene scene = one_mesh(sphere_mesh(16, 8), Material{});
        scene.lights.push_back(directional({1, 0.3f, 0.2f}));
        build(scene);
        int lit = 0;
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x) {
                scene.settings.shadows = false;
                const Vec3f without = seen_at(scene, x + 0.5, y + 0.5);
                scene.settings.shadows = true;
                lit += without != Vec3f(0);
                if (mean(without) > 0.02f) CHECK(seen_at(scene, x + 0.5, y + 0.5) == without);
            }
        CHECK(lit > 300);
    }

    TEST_CASE("tracer: surfaces are two-sided, and mirrored meshes are lit like others") {
        Scene scene = one_mesh(plane_mesh(), Material{});
        scene.lights.push_back(directional({0, 0, -1}));
        build(scene);
        CHECK(seen_at(scene, 32, 32) == Vec3f(0));
        scene.camera.position = {0, 0, -4};
        CHECK(near(seen_at(scene, 32, 32), Vec3f(0.8f)));

        const auto ball = [](const Vec3f& scale) {
            Scene s;
            s.shapes.push_back(make_shape(sphere_mesh(128, 64)));
            s.materials.push_back(std::make_unique<Material>());
            add_instance(s, *s.shapes[0], *s.materials[0], {.scale = scale});
            s.lights.push_back(directional({0, 1, 1}));
            s.camera.position = {0, 0, 4};
            build(s);
            return s;
        };
        const Scene plain = ball(Vec3f(1)), turned = ball({-1, 1, 1});
        for (int i = 0; i < 64; i += 3)
            CHECK(near(seen_at(plain, i + 0.5, 31.3), seen_at(turned, i + 0.5, 31.3), 1e-3f));
    }

    TEST_CASE("tracer: the image does not depend on the number of threads") {
        Scene scene = one_mesh(sphere_mesh(), shiny());
        scene.materials[0]->reflect = Vec3f(0.3f);
        add_instance(scene, *scene.shapes[0], *scene.materials[0], {.translate = {1, 0.5f, -1}});
        scene.lights.push_back(directional({1, 1, 1}));
        scene.sky.cube = numbered_cube(8);
        RenderSettings settings;
        settings.width = 53;
        settings.height = 37;
        settings.spp = 5;
        std::vector<Image<float>> images;
        std::vector<std::int64_t> rays;
        for (const int threads : {1, 2, 7}) {
            const ThreadLimit limit(threads);
            build(scene);
            RenderStats stats;
            images.push_back(render(scene, settings, &stats));
            rays.push_back(stats.rays);
            CHECK(std::memcmp(images[0].data(), images.back().data(), images[0].size() * sizeof(float)) == 0);
            CHECK(rays[0] == rays.back());
        }
        CHECK(rays[0] > 53 * 37 * 5);
    }

} // TEST_SUITE
TEST_SUITE("stability") {

    TEST_CASE("tracer: samples that are not finite are black and counted") {
        Scene scene = one_mesh(plane_mesh(), Material{});
        Light<float> light = directional({0, 0, 1});
        light.colour = Vec3f(3e38f);
        scene.lights = {light, light};
        build(scene);
        RenderSettings settings;
        settings.width = settings.height = 8;
        settings.spp = 3;
        RenderStats stats;
        const Image<float> image = render(scene, settings, &stats);
        for (std::size_t i = 0; i < image.size(); ++i) REQUIRE(std::isfinite(image.data()[i]));
        CHECK(stats.bad_samples > 0);
    }

    TEST_CASE("tracer: zero-area triangles, no normals, a camera without direction, an empty scene: finite pictures") {
        RenderSettings settings;
        settings.width = settings.height = 8;
        settings.spp = 2;
        const auto check_finite = [&](const Scene& scene) {
            const Image<float> image = render(scene, settings);
            for (std::size_t i = 0; i < image.size(); ++i) REQUIRE(std::isfinite(image.data()[i]));
        };
        Mesh mesh = plane_mesh(4);
        mesh.positions[7] = mesh.positions[6]; // degenerate facets
        mesh.normals.assign(mesh.normals.size(), Vec3f(0));
        mesh.uvs[3] = mesh.uvs[4];
        Material material = shiny();
        material.reflect = Vec3f(0.5f);
        material.normal_map =
            texture(2, 2, 3, [](float u, float, float* t) { t[0] = u < 0.5f ? -1 : 1, t[1] = 0, t[2] = -0.2f; });
        Scene scene = one_mesh(std::move(mesh), std::move(material));
        scene.lights.push_back(directional({1, 1, 1}));
        scene.lights.push_back({.kind = LightKind::point, .position = {0, 0, 0}});
        build(scene);
        check_finite(scene);
        scene.camera.target = scene.camera.position;
        check_finite(scene);
        Scene empty;
        build(empty);
        check_finite(empty);
    }

} // TEST_SUITE
