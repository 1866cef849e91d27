// plan_probe_bench: rays per second of probed pixels, in random order and with a packet per 16 samples of a pixel, beside
// render_halves() over the same pixels, with a packet per sample of 4 x 4 pixels. The samples are the same ones.
//
// The scenes are a displaced torus with Phong's model under one light, and a smooth torus with a normal from a bump table
// and a sky that lights and is mirrored. Rows as in bench.h: size counts triangles, an item is a ray, ratio is the time over that of
// render_halves(). The error columns hold the absolute difference of a pixel's half from 256 other samples, in units of radiance.
#include "bake/preview/render.h"
#include "bake/relief/displace/displace.h"
#include "bake/relief/map/bump_table.h"
#include "bake/verdict/plan/pixel_probe.h"
#include "bench.h"
#include "relief/map/torus_relief.h"

using namespace bake;

namespace {

constexpr int edge = 128; ///< of the picture, whose pixels are all visited

/// 2^(2 levels + 10) triangles, displaced or not.
Mesh torus(const oracle::TorusRelief& r, double amplitude, int levels) {
    Relief relief;
    relief.values = oracle::relief_texture(r, 512).values;
    relief.height = {.amplitude = amplitude, .midlevel = 0.5};
    DisplaceOptions options;
    options.rates.levels = levels;
    return displace(BaseSurface(ParametricSurface("torus:R=1,r=0.4"), 32, 16), relief, options).mesh;
}

Cube gradient_sky() {
    Cube cube = make_cube(64, 3);
    for (int f = 0; f < 6; ++f)
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x) {
                const float value[3] = {float(x) / 64, float(y) / 64, float(f) / 6};
                std::copy_n(value, 3, &cube.faces[f].at(x, y));
            }
    return cube;
}

Scene scene_of(const oracle::TorusRelief& r, bool displaced, int levels) {
    Material material;
    material.reflectance.model = Reflectance::Model::phong;
    material.reflectance.diffuse = {0.6f, 0.5f, 0.4f}, material.reflectance.specular = Vec3f(0.3f);
    Scene scene;
    if (!displaced) {
        BumpTableOptions options;
        options.amplitude = 2 * r.A;
        material.bump_table = std::make_shared<Image<float>>(bump_table(oracle::relief_texture(r, 512), options));
        material.reflect = Vec3f(0.3f);
        scene.sky.cube = gradient_sky();
    }
    scene.shapes.push_back(make_shape(torus(r, displaced ? 2 * r.A : 0, levels)));
    scene.materials.push_back(std::make_unique<Material>(material));
    add_instance(scene, *scene.shapes[0], *scene.materials[0]);
    Light<float> light;
    light.from = glm::normalize(Vec3f(1, 2, 1.5f));
    light.colour = Vec3f(0.5f);
    scene.lights.push_back(light);
    scene.camera.position = {0, 2.4f, 2.4f}, scene.camera.fov_deg = 45;
    scene.settings.width = scene.settings.height = edge;
    scene.settings.spp = 32;
    build(scene);
    return scene;
}

/// Differences of values of a half from the right ones, in the order of the pixels.
class Differences {
public:
    explicit Differences(const Scene& scene) {
        RenderSettings fine = scene.settings;
        fine.spp = 256, fine.seed = 1;
        right_ = render(scene, fine);
    }
    template <class Value> bench::Errors operator()(std::span<const Pixel> pixels, const Value& value) const {
        std::vector<float> errors;
        for (std::size_t i = 0; i < pixels.size(); ++i)
            for (int c = 0; c < 3; ++c)
                errors.push_back(std::abs(value(i, c) - right_.at(pixels[i].x, pixels[i].y, c)));
        return bench::errors_of(std::move(errors));
    }

private:
    Image<float> right_;
};

void run(const char* name, const Scene& scene) {
    ProbeOptions options;
    options.settings = scene.settings, options.camera = scene.camera;
    const ProbedScene probed{&scene, {}};
    const std::vector<Pixel> pixels = object_pixels(std::array{probed}, options);
    const Differences differences(scene);
    RenderStats stats;
    const bench::Work whole(
        [&] { return stats = {}, render_halves(scene, scene.settings, &stats); },
        [&](const Halves& halves) {
            return differences(pixels, [&](std::size_t i, int c) { return halves.a.at(pixels[i].x, pixels[i].y, c); });
        });
    const bench::Work probes([&] { return probe_pixels(probed, pixels, options); },
                             [&](const std::vector<ProbedPixel>& found) {
                                 return differences(pixels, [&](std::size_t i, int c) { return found[i].mean[0][c]; });
                             });
    const auto turns = bench::in_turn(7, {}, {whole, probes});
    const auto row = [&](const char* what, const bench::Measured& measured) {
        const double ratio = measured.ratio_to(turns.works[0]);
        bench::print_row(
            measured,
            {"plan_probe", std::string(what) + "_" + name,
             std::int64_t(scene.instances[0].shape->surface.triangles.size()), double(stats.rays), ratio,
             "render_halves",
             bench::text("%.2f M rays/s; %.0f %% of render_halves; error: of a half of 16 samples in radiance",
                         1e-6 * double(stats.rays) / measured.median(), 100 / ratio)});
    };
    row("render_halves", turns.works[0]);
    row("probe_pixels", turns.works[1]);
}

} // namespace

int main(int argc, char** argv) {
    const int levels = argc > 1 ? std::atoi(argv[1]) : 4;
    if (levels < 0 || levels > 7)
        return std::fprintf(stderr, "usage: plan_probe_bench [LEVELS], up to 7: 2^(2 LEVELS + 10) triangles\n"), 2;
    const oracle::TorusRelief r{0.01, 24, 12};
    run("phong", scene_of(r, true, levels));
    run("bump_table_mirror_sky", scene_of(r, false, std::min(levels, 3)));
}
