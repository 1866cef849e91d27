// A shape with a relief, as a method shows it and as it is displaced.
#pragma once
#include "bake/preview/relief_method.h"
#include "bake/verdict/compare/causes.h"
#include "preview/little_scenes.h"

namespace bake::test {

/// A periodic height from a formula over uv, in object units.
inline HeightTexture height_of(int size, const std::function<double(double, double)>& b) {
    HeightTexture height;
    height.values = Image<float>(size, size, 1);
    height.info.type = SampleType::float32;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) height.values.at(x, y) = float(b((x + 0.5) / size, 1 - (y + 0.5) / size));
    return height;
}

/// a sin(2 pi k u) sin(2 pi k v)
inline HeightTexture eggs(double a, int k, int size = 128) {
    return height_of(size, [=](double u, double v) { return a * std::sin(2 * pi * k * u) * std::sin(2 * pi * k * v); });
}

/// Adds the mesh with the relief to a scene.
inline void add_relief(Scene& scene, const Mesh& mesh, const Material& material, const HeightTexture& height,
                       const std::string& word, float amplitude = 1) {
    scene.shapes.push_back(make_shape(Mesh(mesh), {.derivatives = false}));
    Shape* shape = scene.shapes.back().get();
    ReliefOptions options{
        .method = parse_shade(word).value(), .height = {.amplitude = amplitude, .midlevel = 0}, .filter = Filter::c2};
    ReliefModel model = with_relief(material, *shape, height, options);
    scene.materials.push_back(std::make_unique<Material>(std::move(model.material)));
    if (model.shape) scene.shapes.push_back(std::move(model.shape)), shape = scene.shapes.back().get();
    add_instance(scene, *shape, *scene.materials.back());
}

/// The scenes of CauseScenes, before build().
struct ReliefPair {
    Scene method, reference, method_base, reference_base;

    /// Everything but the meshes is set by `prepare`, on each scene.
    ReliefPair(const Mesh& mesh, const Material& material, const HeightTexture& height, const std::string& word,
               const std::string& displaced, const std::function<void(Scene&)>& prepare) {
        add_relief(method, mesh, material, height, word);
        add_relief(reference, mesh, material, height, displaced);
        add_relief(method_base, mesh, material, height, word, 0);
        add_relief(reference_base, mesh, material, height, displaced, 0);
        for (Scene* scene : {&method, &reference, &method_base, &reference_base}) {
            scene->settings.filter = TextureFilter::off;
            scene->camera.position = Vec3f(0, 0, 4);
            prepare(*scene);
            build(*scene);
        }
    }
    CauseScenes scenes() const { return {&method, &reference, &method_base, &reference_base, {0}}; }
    CauseShares shares(const CauseOptions& options) const { return cause_shares(scenes(), options); }
};

inline CauseOptions small_picture(int size = 32, int spp = 4) {
    CauseOptions options;
    options.settings.width = options.settings.height = size;
    options.settings.spp = spp;
    return options;
}

/// An orthographic camera along -Z that sees the inner part of plane_mesh(), and a sun.
inline std::function<void(Scene&)> from_above(const Vec3f& sun, bool shadows = true) {
    return [=](Scene& scene) {
        scene.camera.orthographic = true, scene.camera.view_height = 1.6f;
        scene.lights = {directional(sun)};
        scene.settings.shadows = shadows;
    };
}

inline double share_of(const CauseShares& shares, Cause cause) {
    return shares.shares()[std::size_t(cause)] / shares.total;
}

/// Mean squared difference over the object's pixels, by the pictures of the tracer.
inline double picture_error(const ReliefPair& pair, const CauseOptions& options, std::int64_t pixels) {
    const double whole = mean_square_difference(render_halves(pair.method, options.settings),
                                                render_halves(pair.reference, options.settings));
    return whole * options.settings.width * options.settings.height / double(pixels);
}

inline double sum(const CauseShares& shares) {
    double all = 0;
    for (const double share : shares.shares()) all += share;
    return all;
}

} // namespace bake::test
