// A bumpy floor to the horizon: filtered lookups at one sample per pixel against many samples of unfiltered ones.
#include "preview/little_scenes.h"
#include <doctest/doctest.h>
#include <random>

using namespace bake;
using namespace bake::test;

namespace {

/// Slopes of waves of random directions, of whole numbers of periods, and of `slope` root mean square along each axis.
Texture waves(int size, double slope) {
    struct Wave {
        int k, l;
        double phase;
    };
    std::mt19937 random(11);
    std::uniform_int_distribution<int> number(-12, 12);
    std::uniform_real_distribution<double> phase(0, 2 * pi);
    std::vector<Wave> all;
    while (all.size() < 40) {
        const Wave w{number(random), number(random), phase(random)};
        if (w.k * w.k + w.l * w.l > 16) all.push_back(w);
    }
    Texture table = texture(size, size, 2, [&](float u, float v, float* s) {
        s[0] = s[1] = 0;
        for (const Wave& w : all) {
            const double c = std::cos(2 * pi * (w.k * double(u) + w.l * double(v)) + w.phase) / std::hypot(w.k, w.l);
            s[0] += float(w.k * c), s[1] += float(w.l * c);
        }
        const double scale = slope * 2 / std::sqrt(double(all.size()));
        s[0] *= float(scale), s[1] *= float(scale);
    });
    return table;
}

/// A floor of many repeats of a table, with its horizon in the upper third of the picture.
Scene floor_scene(const Material& material, TextureFilter filter) {
    constexpr float size = 4000, repeats = 4000; // one repeat is a square of edge 1
    Scene scene = one_mesh(grid_mesh(1, 1,
                                     [](float u, float v, Vec3f& p, Vec3f& n) {
                                         p = Vec3f(size * (u - 0.5f), 0, size * (0.5f - v));
                                         n = Vec3f(0, 1, 0);
                                     }),
                           material);
    for (Vec2f& uv : scene.shapes[0]->mesh.uvs) uv *= repeats;
    scene.shapes[0]->surface = make_mesh_surface(scene.shapes[0]->mesh);
    scene.camera.position = Vec3f(0, 2, 0);
    scene.camera.target = Vec3f(0.3f, 1.8f, -1);
    scene.lights.push_back(directional({0.25f, 0.6f, -1}));
    scene.settings.width = 48, scene.settings.height = 48;
    scene.settings.filter = filter;
    build(scene);
    return scene;
}

/// Mean of the green in a row.
double mean_of(const Image<float>& image, int y) {
    double sum = 0;
    for (int x = 0; x < image.width(); ++x) sum += image.at(x, y, 1);
    return sum / image.width();
}

/// Root mean square difference of the green of a row.
double apart(const Image<float>& a, const Image<float>& b, int y) {
    double sum = 0;
    for (int x = 0; x < a.width(); ++x) sum += std::pow(a.at(x, y, 1) - b.at(x, y, 1), 2);
    return std::sqrt(sum / a.width());
}

Image<float> picture(const Material& material, TextureFilter filter, int spp) {
    Scene scene = floor_scene(material, filter);
    scene.settings.spp = spp;
    return render(scene, scene.settings);
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("minification: a bumpy floor keeps its brightness into the distance at one sample, by moments alone") {
        Material bumpy;
        bumpy.bump_table = waves(128, 0.1);
        bumpy.reflectance.diffuse = Vec3f(0.3f), bumpy.reflectance.ambient = Vec3f(0);
        bumpy.reflectance.specular = Vec3f(0.8f), bumpy.reflectance.shininess = 120;
        const Image<float> truth = picture(bumpy, TextureFilter::off, 256);
        const Image<float> filtered = picture(bumpy, TextureFilter::moments, 1);
        const Image<float> mips = picture(bumpy, TextureFilter::mips, 1);
        const Image<float> points = picture(bumpy, TextureFilter::off, 1);
        double worst = 0, worst_mips = 0, noise = 0, noise_points = 0;
        int rows = 0;
        for (int y = 2; y <= 24; ++y) {
            // Not the sky, nor the row of the horizon.
            const double wanted = mean_of(truth, y);
            if (mean_of(truth, y - 1) == 0 || mean_of(truth, y - 2) == 0) continue;
            worst = std::max(worst, std::abs(mean_of(filtered, y) / wanted - 1));
            worst_mips = std::max(worst_mips, std::abs(mean_of(mips, y) / wanted - 1));
            noise += apart(filtered, truth, y) / wanted, noise_points += apart(points, truth, y) / wanted;
            ++rows;
        }
        MESSAGE(rows << " rows: by moments " << 100 * worst << " % off at most, by mips " << 100 * worst_mips
                     << " %; noise " << noise / rows << " instead of " << noise_points / rows);
        REQUIRE(rows > 5);
        CHECK(worst < 0.02);
        CHECK(worst_mips > 0.05);
        CHECK(noise < 0.25 * noise_points);
    }

    TEST_CASE("minification: filtering fades with the number of samples, and far textures have their mean") {
        Material bumpy;
        bumpy.bump_table = waves(64, 0.15);
        bumpy.reflectance.specular = Vec3f(1), bumpy.reflectance.shininess = 50;
        bumpy.albedo =
            texture(64, 64, 3, [](float u, float, float* c) { c[0] = c[1] = c[2] = u < 0.5f ? 0.0f : 1.0f; });
        const Image<float> truth = picture(bumpy, TextureFilter::off, 256);
        const auto difference = [&](int spp) {
            const Image<float> image = picture(bumpy, TextureFilter::moments, spp);
            double sum = 0;
            for (std::size_t i = 0; i < image.size(); ++i) sum += std::pow(image.data()[i] - truth.data()[i], 2);
            return std::sqrt(sum / double(image.size()));
        };
        const double one = difference(1), many = difference(64);
        MESSAGE("difference " << one << " at 1 sample, " << many << " at 64");
        CHECK(many < 0.5 * one);
    }

    TEST_CASE("minification: a material can ask for moments whatever the scene does, as bump+roughness does") {
        Material bumpy;
        bumpy.bump_table = waves(64, 0.15);
        bumpy.reflectance.specular = Vec3f(1);
        const Image<float> by_scene = picture(bumpy, TextureFilter::moments, 1);
        bumpy.always_moments = true;
        const Image<float> by_material = picture(bumpy, TextureFilter::off, 1);
        for (std::size_t i = 0; i < by_scene.size(); ++i) CHECK(by_material.data()[i] == by_scene.data()[i]);
    }

} // TEST_SUITE
