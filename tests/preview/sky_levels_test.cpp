// Light of a sky from filtered levels, against closed forms, sampled light, and the files of bake cubemap.
#include "bake/base/error.h"
#include "bake/environment/file/write_environment.h"
#include "bake/environment/filter/irradiance.h"
#include "bake/environment/filter/prefilter.h"
#include "bake/light/ggx_albedo.h"
#include "environment/skies.h"
#include "preview/little_scenes.h"
#include <doctest/doctest.h>
#include <filesystem>

using namespace bake;
using namespace bake::test;

namespace {

/// A sun of 3 degrees on a sky that is bluer above, as Cube of the tests' own directions.
Cube sunny_cube(int n) {
    const Vec3d sun = glm::normalize(Vec3d(0.4, 0.7, 0.5));
    return sky_of(n, 3, [&](const Vec3d& d, int c) {
        return (glm::dot(d, sun) > std::cos(3 * pi / 180) ? 400.0 : 0.0) + 1 + 0.5 * d.y * (c + 1) / 3;
    });
}

/// With the level of one roughness alone.
Scene ball(const Material& material, const Cube& sky, SkyLighting how, double yaw = 0) {
    Scene scene = one_mesh(sphere_mesh(256, 128), material);
    for (int f = 0; f < 6; ++f) {
        const Image<float>& face = sky.faces[f];
        scene.sky.cube.faces[f] = Image<float>(face.width(), face.height(), 3);
        std::copy_n(face.data(), face.size(), scene.sky.cube.faces[f].data());
    }
    scene.sky.yaw = SkyYaw(yaw);
    scene.settings.sky_light = how;
    const double roughness = double(material.reflectance.roughness);
    scene.sky_levels.alphas = {float(roughness * roughness)};
    scene.sky_levels.glossy = prefilter(sky, {.roughness = {roughness * roughness}});
    build(scene);
    return scene;
}

Vec3d mean_at(const Scene& scene, double x, double y, int spp) {
    Vec3d sum(0);
    const Ray ray = primary_ray(camera_frame(scene.camera), x, y, 64, 64);
    for (int i = 0; i < spp; ++i) {
        sum += Vec3d(trace_one(scene, ray, 0, Sampler(int(x), int(y), i, 1)).radiance.total());
    }
    return sum / double(spp);
}

Material grey(float diffuse) {
    Material material;
    material.reflectance.diffuse = Vec3f(diffuse);
    return material;
}

Material metal(float roughness) {
    Material material = grey(1);
    material.reflectance.model = Reflectance::Model::ggx;
    material.reflectance.metallic = 1, material.reflectance.roughness = roughness;
    return material;
}

bool equal(const Cube& a, const Cube& b) {
    for (int f = 0; f < 6; ++f) {
        if (a.faces[f].size() != b.faces[f].size()) return false;
        if (!std::equal(a.faces[f].data(), a.faces[f].data() + a.faces[f].size(), b.faces[f].data())) return false;
    }
    return true;
}

/// A folder that is removed in the end.
struct Folder {
    std::filesystem::path path = std::filesystem::temp_directory_path() / "bake_sky_levels_test";
    Folder() { std::filesystem::create_directories(path); }
    ~Folder() { std::filesystem::remove_all(path); }
    std::string operator/(const char* name) const { return (path / name).string(); }
};

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("sky levels: on a convex Lambert body, irradiance is what sampling finds, within 1 per cent") {
        const Cube sky = sunny_cube(64);
        for (const double yaw : {0.0, 100.0}) {
            const Scene filtered = ball(grey(0.8f), sky, SkyLighting::irradiance, yaw);
            const Scene sampled = ball(grey(0.8f), sky, SkyLighting::sampled, yaw);
            double worst = 0, mean = 0;
            int count = 0;
            for (int y = 16; y < 50; y += 5)
                for (int x = 16; x < 50; x += 5) {
                    const Vec3d a = mean_at(filtered, x + .5, y + .5, 1), b = mean_at(sampled, x + .5, y + .5, 512);
                    mean += b.y, ++count;
                    worst = std::max(worst, std::abs(a.y - b.y));
                }
            CHECK(worst < 0.01 * mean / count);
        }
    }

    TEST_CASE("sky levels: in an even sky a white metal cannot be told from the sky, at any roughness and angle") {
        Scene scene = one_mesh(sphere_mesh(256, 128), metal(0));
        scene.sky.cube = constant_cube(Vec3f(0.7f));
        scene.settings.sky_light = SkyLighting::irradiance;
        build(scene);
        for (const float roughness : {0.f, 0.15f, 0.33f, 0.7f, 1.f}) {
            scene.materials[0]->reflectance.roughness = roughness;
            for (int i = 16; i < 48; i += 4)
                CHECK(mean_at(scene, i + .5, 20.5, 1).y == doctest::Approx(0.7).epsilon(1e-3));
        }
    }

    TEST_CASE("sky levels: seen from the axis of the lobe, the split sum is what sampling finds") {
        const Cube sky = sunny_cube(64);
        for (const float roughness : {0.2f, 0.45f, 0.8f}) {
            const Scene filtered = ball(metal(roughness), sky, SkyLighting::irradiance, 160);
            const Scene sampled = ball(metal(roughness), sky, SkyLighting::sampled, 160);
            const double expected = mean_at(sampled, 32, 32, 4096).y;
            CHECK(mean_at(filtered, 32, 32, 1).y == doctest::Approx(expected).epsilon(0.02));
        }
    }

} // TEST_SUITE
TEST_SUITE("unit") {

    TEST_CASE("sky levels: files of bake cubemap give the light of the levels in memory") {
        const Folder folder;
        const Cube sky = sunny_cube(32);
        const PrefilterOptions options{.roughness = {0, 0.1, 0.5}, .size = 32};
        std::vector<Cube> levels = prefilter(sky, options), again = prefilter(sky, options);
        write_levels(std::move(levels), {.file = folder / "ggx_%s.exr", .depth = Depth::float32});
        const std::vector<Cube> read = read_glossy(folder / "ggx_%s.exr", 3);
        REQUIRE(read.size() == 3);
        for (std::size_t k = 0; k < 3; ++k) CHECK(equal(read[k], again[k]));
        std::vector<Cube> even;
        even.push_back(irradiance(sky));
        write_levels(std::move(even), {.file = folder / "even_%s.exr", .depth = Depth::float32});
        CHECK(equal(read_irradiance(folder / "even_%s.exr"), irradiance(sky)));
        CHECK_THROWS_WITH_AS(read_glossy(folder / "ggx_%s.exr", 9), doctest::Contains("levels for 9 values"), Error);
        CHECK_THROWS_AS(read_glossy(folder / "none_%s.exr", 2), Error);
    }

    TEST_CASE("sky levels: what was computed for one sky is computed again for another one; given levels stay") {
        SkyLevels levels;
        complete(levels, constant_cube(Vec3f(1)));
        complete(levels, constant_cube(Vec3f(2)));
        CHECK(levels.irradiance[CubeFace::px].at(0, 0) == doctest::Approx(2 * pi));
        CHECK(levels.glossy.size() == levels.alphas.size());
        CHECK(levels.glossy.back()[CubeFace::px].at(0, 0) == doctest::Approx(2));
        SkyLevels given;
        given.irradiance = constant_cube(Vec3f(5));
        given.glossy.push_back(constant_cube(Vec3f(6))), given.alphas = {0.5f};
        complete(given, constant_cube(Vec3f(1)));
        complete(given, constant_cube(Vec3f(2)));
        CHECK(given.irradiance[CubeFace::px].at(0, 0) == 5);
        CHECK(given.glossy.size() == 1);
    }

    TEST_CASE("sky levels: between two levels light is mixed by roughness; rougher than the last it is the last") {
        SkyLevels levels;
        levels.irradiance = constant_cube(Vec3f(0));
        levels.glossy.push_back(constant_cube(Vec3f(1))), levels.glossy.push_back(constant_cube(Vec3f(3)));
        levels.alphas = {0.04f, 0.16f};
        Sky sky;
        sky.scale = 10;
        const auto light = [&](float roughness) {
            Bsdf bsdf;
            bsdf.count = 1;
            bsdf.lobes[0].kind = LobeKind::ggx, bsdf.lobes[0].roughness = roughness;
            const Vec3f n(0, 0, 1);
            const double single = 1 - double(ggx_albedo(ggx_row(roughness * roughness), 1).loss);
            return double(reflected(levels, sky, bsdf, n, n).specular.y) / single;
        };
        CHECK(light(0.1f) == doctest::Approx(10));
        CHECK(light(0.2f) == doctest::Approx(10));
        CHECK(light(0.25f) == doctest::Approx(15));
        CHECK(light(0.4f) == doctest::Approx(30));
        CHECK(light(0.9f) == doctest::Approx(30));
    }

    TEST_CASE("sky levels: nothing shadows them, and lambert, phong and blinn have their albedo") {
        for (const LobeKind kind : {LobeKind::lambert, LobeKind::normalised_blinn, LobeKind::normalised_phong}) {
            Bsdf bsdf;
            bsdf.count = 1;
            bsdf.lobes[0].kind = kind, bsdf.lobes[0].weight = Vec3f(0.5f), bsdf.lobes[0].exponent = 50;
            SkyLevels levels;
            Sky sky;
            sky.cube = constant_cube(Vec3f(1));
            complete(levels, sky.cube);
            const BsdfValue value = reflected(levels, sky, bsdf, {0, 1, 0}, glm::normalize(Vec3f(1, 2, 0)));
            CHECK(value.diffuse.y + value.specular.y == doctest::Approx(0.5));
        }
        Scene scene = one_mesh(plane_mesh(), grey(0.5f));
        add_instance(scene, *scene.shapes[0], *scene.materials[0], {.translate = {0, 0, 8}, .scale = Vec3f(9)});
        scene.sky.cube = constant_cube(Vec3f(1));
        scene.settings.sky_light = SkyLighting::irradiance;
        build(scene);
        CHECK(mean_at(scene, 32, 32, 1).y == doctest::Approx(0.5));
    }

} // TEST_SUITE
