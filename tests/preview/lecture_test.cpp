// The systems of docs/lecture.md, each through the tracer against a closed form. The figures that are printed stand there.
#include "bake/preview/relief_method.h"
#include "preview/lecture.h"
#include <doctest/doctest.h>

using namespace bake;
using namespace bake::test;

namespace {

/// A sphere of specular highlights alone under one light.
Scene shining_sphere() {
    Material material;
    material.reflectance.ambient = material.reflectance.diffuse = Vec3f(0);
    material.reflectance.specular = Vec3f(1);
    Scene scene = one_mesh(sphere_mesh(512, 256), material);
    scene.lights.push_back(directional({1, 1, 1}));
    build(scene);
    return scene;
}

/// Largest difference of its highlight from (r.v)^n or (n.h)^n.
double highlight_error(const Scene& scene, bool phong, double n) {
    const Vec3d l = glm::normalize(Vec3d(1));
    double worst = 0;
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 48; ++x) {
            Vec3d p;
            const Ray ray = ray_at(scene, x + .5, y + .5, 48);
            if (!on_sphere(ray, 1, p)) continue;
            const Vec3d v = -glm::normalize(Vec3d(ray.direction)), r = 2 * glm::dot(p, l) * p - l;
            const double facing = glm::dot(p, l);
            if (glm::dot(p, v) < 0.2 || std::abs(facing) < 0.01) continue; // the borders of the sphere and of the light
            const double cosine = phong ? glm::dot(r, v) : glm::dot(p, glm::normalize(l + v));
            const double expected = facing > 0 ? std::pow(std::max(0.0, cosine), n) : 0;
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
        const Scene scene = shining_sphere();
        Reflectance& reflectance = scene.materials[0]->reflectance;
        for (const double n : {1., 10., 80.}) {
            reflectance.shininess = float(n);
            reflectance.model = Reflectance::Model::phong;
            const double phong = highlight_error(scene, true, n);
            reflectance.model = Reflectance::Model::blinn;
            const double blinn = highlight_error(scene, false, n);
            MESSAGE("exponent " << n << ": Phong within " << phong << ", Blinn within " << blinn << " of 1");
            CHECK(phong < 1e-3);
            CHECK(blinn < 1e-3);
        }
        // Near the peak r.v turns twice as fast as n.h: Phong's exponent n is as wide as Blinn's 4 n.
        CHECK(std::pow(std::cos(0.1), 40) == doctest::Approx(std::pow(std::cos(0.05), 160)).epsilon(0.01));
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
                const PrimaryHit traced = trace_one(scene, ray_at(scene, 32, 32, 64), 0, Sampler(3, 5, i));
                sum += double(traced.radiance.total().x);
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
            MESSAGE(std::string(word) << ": hits within " << worst << " of the radius " << radius);
            CHECK(hits > 500);
            CHECK(wrong == 0);
            CHECK(worst <
                  2.5e-3); // facets of a sphere of 64 columns: (pi / 64)^2 / 2 = 1.2e-3, and as much for its rows
        }
    }

} // TEST_SUITE
