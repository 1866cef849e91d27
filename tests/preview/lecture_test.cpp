// The systems of docs/lecture.md, each through the tracer against a closed form. The figures that are printed stand there.
#include "bake/preview/capture.h"
#include "bake/preview/relief_method.h"
#include "preview/little_scenes.h"
#include <doctest/doctest.h>
#include <initializer_list>

using namespace bake;
using namespace bake::test;

namespace {

/// First intersection with the sphere about the origin; false if there is none.
bool on_sphere(const Ray& ray, double radius, Vec3d& p) {
    const Vec3d o(ray.origin), d(glm::normalize(Vec3d(ray.direction)));
    const double b = glm::dot(o, d), root = b * b - glm::dot(o, o) + radius * radius;
    p = o + (-b - std::sqrt(std::max(0.0, root))) * d;
    return root > 0;
}

Ray ray_at(const Scene& scene, double x, double y, int n) { return primary_ray(camera_frame(scene), x, y, n, n); }

Material mirror() {
    Material material;
    material.reflectance.ambient = material.reflectance.diffuse = Vec3f(0);
    material.reflect = Vec3f(1);
    return material;
}

/// A sky whose radiance is a smooth function of the world direction.
double smooth_sky(const Vec3d& d) { return 1 + 0.4 * d.x + 0.3 * d.y - 0.2 * d.z + 0.25 * d.x * d.y; }

Cube smooth_cube(int size) {
    Cube cube = constant_cube(Vec3f(0), size);
    for (const CubeFace face : all_cube_faces)
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                const Vec3d d = cube_direction(CubePoint<double>{face, (x + .5) / size, (y + .5) / size});
                for (int c = 0; c < 3; ++c)
                    cube[face].at(x, y, c) = float(smooth_sky(glm::normalize(world_to_cube(d))));
            }
    return cube;
}

/// Largest relative error of a sphere lit by one light, against `term`(n.l, n.h, r.v).
double highlight_error(Reflectance::Model model, float shininess, double (*term)(double, double, double, double)) {
    Material material;
    material.reflectance.model = model, material.reflectance.shininess = shininess;
    material.reflectance.ambient = material.reflectance.diffuse = Vec3f(0);
    material.reflectance.specular = Vec3f(1);
    Scene scene = one_mesh(sphere_mesh(1024, 512), material);
    scene.lights.push_back(directional({1, 1, 1}));
    build(scene);
    const Vec3d l = glm::normalize(Vec3d(1));
    double worst = 0;
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 48; ++x) {
            Vec3d p;
            const Ray ray = ray_at(scene, x + .5, y + .5, 48);
            if (!on_sphere(ray, 1, p)) continue;
            const Vec3d v = -glm::normalize(Vec3d(ray.direction)), r = 2 * glm::dot(p, l) * p - l;
            if (glm::dot(p, v) < 0.2 || std::abs(glm::dot(p, l)) < 0.01)
                continue; // the borders of the sphere and of the light
            const double expected = term(glm::dot(p, l), glm::dot(p, glm::normalize(l + v)), glm::dot(r, v), shininess);
            worst = std::max(worst, std::abs(double(seen_at(scene, x + .5, y + .5, 48).x) - expected));
        }
    return worst;
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE(
        "lecture, light: emission, ambient, diffuse and specular terms add up, each times its factor of the light") {
        Reflectance all;
        all.emission = {0.1f, 0, 0.05f}, all.ambient = {0.2f, 0.3f, 0.1f}, all.diffuse = {0.5f, 0.4f, 0.3f};
        all.specular = Vec3f(0.4f);
        const auto seen = [&](Vec3f emission, Vec3f ambient, Vec3f diffuse, Vec3f specular, double x) {
            Material material;
            material.reflectance = all;
            material.reflectance.emission *= emission;
            Scene scene = one_mesh(sphere_mesh(64, 32), material);
            scene.ambient = 0.5f * ambient;
            for (const Vec3f& from : {Vec3f(1, 1, 1), Vec3f(-1, 0.5f, 2)}) {
                scene.lights.push_back(directional(from));
                scene.lights.back().diffuse = diffuse, scene.lights.back().specular = specular;
            }
            build(scene);
            return seen_at(scene, x, 30.5);
        };
        const Vec3f on(1), off(0);
        double worst = 0;
        for (double x = 18.5; x < 46; x += 3) {
            const Vec3f sum = seen(on, off, off, off, x) + seen(off, on, off, off, x) + seen(off, off, on, off, x) +
                              seen(off, off, off, on, x);
            worst = std::max(worst, double(glm::length(seen(on, on, on, on, x) - sum)));
            const Vec3f twice = seen(off, off, 2.0f * on, off, x) - 2.0f * seen(off, off, on, off, x);
            worst = std::max(worst, double(glm::length(twice)));
        }
        MESSAGE("largest difference " << worst);
        CHECK(worst < 1e-6);
    }

    TEST_CASE(
        "lecture, attenuation: a point light over a plane, with each term of the attenuation alone and with all") {
        const Vec3d at(0.3, -0.2, 1.5);
        double worst = 0;
        for (const Vec3f& falloff : {Vec3f(2, 0, 0), Vec3f(0, 0.7f, 0), Vec3f(0, 0, 0.4f), Vec3f(0.5f, 0.2f, 0.3f)}) {
            Scene scene = one_mesh(plane_mesh(), Material{});
            scene.instances.clear();
            add_instance(scene, *scene.shapes[0], *scene.materials[0], {.scale = Vec3f(40)});
            scene.camera.position = {0, -6, 5};
            Light<float> light;
            light.kind = LightKind::point;
            light.position = Vec3f(at), light.colour = Vec3f(3);
            light.falloff = {falloff.x, falloff.y, falloff.z};
            scene.lights.push_back(light);
            build(scene);
            for (int y = 2; y < 64; y += 4)
                for (int x = 2; x < 64; x += 4) {
                    const Ray ray = ray_at(scene, x, y, 64);
                    const Vec3d o(ray.origin), d(ray.direction), p = o - o.z / d.z * d;
                    const double r = glm::length(at - p);
                    const double expected = 0.8 * 3 * (at.z / r) / (falloff.x + falloff.y * r + falloff.z * r * r);
                    worst = std::max(worst, std::abs(double(seen_at(scene, x, y).x) / expected - 1));
                }
        }
        MESSAGE("largest relative error " << worst);
        CHECK(worst < 1e-5);
    }

    TEST_CASE("lecture, Phong and Blinn: the highlights of a sphere are powers of r.v and of n.h") {
        const auto power = [](double cosine, double n) { return std::pow(std::max(0.0, cosine), n); };
        static const auto phong = [](double nl, double, double rv, double n) {
            return nl > 0 ? std::pow(std::max(0.0, rv), n) : 0.0;
        };
        static const auto blinn = [](double nl, double nh, double, double n) {
            return nl > 0 ? std::pow(std::max(0.0, nh), n) : 0.0;
        };
        for (const float n : {1.0f, 10.0f, 80.0f}) {
            const double a = highlight_error(Reflectance::Model::phong, n, phong);
            const double b = highlight_error(Reflectance::Model::blinn, n, blinn);
            MESSAGE("exponent " << n << ": Phong within " << a << ", Blinn within " << b << " of 1");
            CHECK(a < 1e-3);
            CHECK(b < 1e-3);
        }
        // Near the peak r.v turns twice as fast as n.h: Phong's exponent n is as wide as Blinn's 4 n.
        CHECK(power(std::cos(0.1), 40) / power(std::cos(0.05), 160) == doctest::Approx(1).epsilon(0.01));
    }

    TEST_CASE("lecture, BRDF: in an even sky a surface shows its albedo") {
        struct Case {
            Reflectance::Model model;
            float diffuse, specular, shininess, albedo; ///< closed form of the albedo at normal incidence
        };
        const Case cases[] = {
            {Reflectance::Model::blinn, 1, 0, 1, 1},
            {Reflectance::Model::phong, 0, 1, 1, 1},    // 2 / (n + 1)
            {Reflectance::Model::phong, 0, 1, 3, 0.5f}, // the same
            {Reflectance::Model::phong, 0, 3, 2, 2},    // 3 times 2 / (n + 1): gains energy
            {Reflectance::Model::normalised_phong, 0, 1, 20, 1},
            {Reflectance::Model::normalised_blinn, 0, 1, 20, 1},
            {Reflectance::Model::ggx, 1, 0, 1, 1}, // a white metal
        };
        for (const Case& c : cases) {
            Material material;
            material.reflectance.model = c.model, material.reflectance.shininess = c.shininess;
            material.reflectance.diffuse = Vec3f(c.diffuse), material.reflectance.specular = Vec3f(c.specular);
            material.reflectance.metallic = 1;
            Scene scene = one_mesh(plane_mesh(), material);
            scene.sky.cube = constant_cube(Vec3f(0.5f));
            build(scene);
            double sum = 0;
            const int samples = 4096;
            for (int i = 0; i < samples; ++i) {
                Sampler sampler(3, 5, i);
                RenderStats stats;
                sum += double(radiance(scene, ray_at(scene, 32, 32, 64), 0, sampler, stats).total().x);
            }
            CAPTURE(int(c.model));
            CAPTURE(c.shininess);
            CHECK(sum / samples / 0.5 == doctest::Approx(double(c.albedo)).epsilon(1e-3));
        }
    }

    TEST_CASE("lecture, normal map and bump table: a map of one normal, and slopes of one height, are a tilted plane") {
        double worst = 0;
        for (const double tilt : {-60., -20., 0., 10., 45.})
            for (const bool along_u : {true, false}) {
                const double a = tilt * pi / 180;
                const Vec3f n(along_u ? std::sin(a) : 0, along_u ? 0 : std::sin(a), std::cos(a));
                Material mapped, bumped;
                mapped.normal_map = texture(2, 2, 3, [&](float, float, float* t) {
                    for (int c = 0; c < 3; ++c) t[c] = n[c];
                });
                // The plane is 2 units wide per unit of u and of v.
                bumped.bump_table =
                    texture(2, 2, 2, [&](float, float, float* t) { t[0] = -2 * n.x / n.z, t[1] = -2 * n.y / n.z; });
                for (const Material& material : {mapped, bumped})
                    for (const Vec3f& from : {Vec3f(0, 0, 1), Vec3f(1, 0.5f, 2), Vec3f(-1, -2, 1)}) {
                        Scene scene = one_mesh(plane_mesh(), material);
                        scene.lights.push_back(directional(from));
                        build(scene);
                        const double expected = 0.8 * std::max(0.0, double(glm::dot(n, scene.lights[0].from)));
                        worst = std::max(worst, std::abs(double(seen_at(scene, 30, 34).x) - expected));
                    }
            }
        MESSAGE("largest difference " << worst);
        CHECK(worst < 1e-6);
    }

    TEST_CASE("lecture, displacement: a sphere raised by c is one of radius R + c, which bump mapping leaves at R") {
        HeightTexture height;
        height.values = Image<float>(8, 8, 1);
        height.info.type = SampleType::float32;
        for (std::size_t i = 0; i < height.values.size(); ++i) height.values.data()[i] = 0.25f;
        const auto seen = [&](const char* word, Scene& scene) {
            scene = one_mesh(sphere_mesh(64, 32), Material{});
            ReliefOptions options{.method = parse_shade(word).value(), .height = {.amplitude = 1, .midlevel = 0}};
            ReliefModel model = with_relief(Material{}, *scene.shapes[0], height, options);
            scene.instances.clear();
            *scene.materials[0] = model.material;
            if (model.shape) scene.shapes[0] = std::move(model.shape);
            add_instance(scene, *scene.shapes[0], *scene.materials[0]);
            build(scene);
        };
        for (const char* word : {"displace:8", "exact"}) {
            Scene scene;
            seen(word, scene);
            const double radius = word[0] == 'd' ? 1.25 : 1;
            double worst = 0;
            int wrong = 0, hits = 0;
            for (int y = 0; y < 64; ++y)
                for (int x = 0; x < 64; ++x) {
                    const Ray ray = ray_at(scene, x + .5, y + .5, 64);
                    Vec3d p, beside;
                    const bool inside = on_sphere(ray, radius * 0.995, beside), outside = !on_sphere(ray, radius, p);
                    const Hit hit = scene.bvh->intersect(ray);
                    wrong += (inside && !hit) || (outside && hit);
                    if (!hit || glm::dot(-Vec3d(ray.direction), p) < 0.3 * radius) continue;
                    ++hits;
                    worst = std::max(worst, std::abs(glm::length(Vec3d(scene.bvh->point(hit).p)) / radius - 1));
                }
            MESSAGE(word << ": hits within " << worst << " of the radius " << radius);
            CHECK(hits > 500);
            CHECK(wrong == 0);
            CHECK(worst <
                  2.5e-3); // facets of a sphere of 64 columns: (pi / 64)^2 / 2 = 1.2e-3, and as much for its rows
        }
    }

    TEST_CASE("lecture, cubemap reflection: a mirror sphere shows an analytic sky, pixel by pixel") {
        Scene scene = one_mesh(sphere_mesh(1024, 512), mirror());
        scene.sky.cube = smooth_cube(256);
        build(scene);
        double worst = 0, squares = 0;
        int count = 0;
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x) {
                const Ray ray = ray_at(scene, x + .5, y + .5, 64);
                Vec3d p;
                const Vec3d d = glm::normalize(Vec3d(ray.direction));
                if (!on_sphere(ray, 1, p) || glm::dot(-d, p) < 0.25) continue;
                const double expected = smooth_sky(d - 2 * glm::dot(d, p) * p);
                const double error = double(seen_at(scene, x + .5, y + .5).x) / expected - 1;
                worst = std::max(worst, std::abs(error)), squares += error * error, ++count;
            }
        MESSAGE("largest relative error " << worst << ", rms " << std::sqrt(squares / count) << " of " << count);
        CHECK(count > 800);
        CHECK(worst < 1e-4);
    }

    TEST_CASE("lecture, captured environment: the smaller a mirror ball, the better it shows what was captured in its "
              "place") {
        // A room: a large sphere seen from inside, whose emission depends on the direction.
        Material walls;
        walls.reflectance.ambient = walls.reflectance.diffuse = Vec3f(0), walls.reflectance.emission = Vec3f(1);
        const auto ball_in_room = [&](float radius) {
            Scene scene = one_mesh(plane_mesh(), walls);
            scene.instances.clear();
            // Four walls of different brightness, 2 units from the origin.
            for (int i = 0; i < 4; ++i) {
                scene.materials.push_back(std::make_unique<Material>(walls));
                scene.materials.back()->reflectance.emission = Vec3f(0.25f * float(i + 1));
                add_instance(scene, *scene.shapes[0], *scene.materials.back(),
                             {.translate = Vec3f(i == 0   ? 2
                                                 : i == 1 ? -2
                                                          : 0,
                                                 0,
                                                 i == 2   ? 2
                                                 : i == 3 ? -2
                                                          : 0),
                              .rotate_deg = {0, i < 2 ? 90.f : 0.f, 0},
                              .scale = Vec3f(2)});
            }
            scene.shapes.push_back(make_shape(sphere_mesh(128, 64)));
            scene.materials.push_back(std::make_unique<Material>(mirror()));
            if (radius > 0) add_instance(scene, *scene.shapes[1], *scene.materials.back(), {.scale = Vec3f(radius)});
            scene.sky.background = Vec3f(2);
            scene.settings.spp = 1, scene.settings.bounces = 1;
            build(scene);
            return scene;
        };
        const auto difference = [&](float radius) {
            Scene traced = ball_in_room(radius);
            Scene shown = one_mesh(sphere_mesh(128, 64), mirror());
            shown.instances.clear();
            add_instance(shown, *shown.shapes[0], *shown.materials[0], {.scale = Vec3f(radius)});
            shown.sky.cube = capture(ball_in_room(0), Vec3f(0), 128);
            build(shown);
            traced.camera.position = shown.camera.position = Vec3f(0.2f, 0.3f, 1) * 1.8f;
            traced.camera.target = shown.camera.target = Vec3f(0);
            traced.camera.fov_deg = shown.camera.fov_deg = 60 * radius;
            double sum = 0;
            int hits = 0;
            for (int y = 0; y < 96; ++y)
                for (int x = 0; x < 96; ++x) {
                    if (!shown.bvh->intersect(ray_at(shown, x + .5, y + .5, 96))) continue;
                    sum +=
                        std::abs(double(seen_at(traced, x + .5, y + .5, 96).x - seen_at(shown, x + .5, y + .5, 96).x));
                    ++hits;
                }
            REQUIRE(hits > 3000);
            return sum / hits;
        };
        const double large = difference(0.8f), half = difference(0.4f), small = difference(0.05f);
        MESSAGE("mean difference at radius 0.8: " << large << ", 0.4: " << half << ", 0.05: " << small);
        CHECK(large > 0.02);
        CHECK(large / half == doctest::Approx(2).epsilon(0.3)); // walls shift in proportion to the radius
        CHECK(small < 0.01);
    }

} // TEST_SUITE
