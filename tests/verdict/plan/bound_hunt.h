// A hunt for a scene in which a bound of the error is below the error.
#pragma once
#include "bake/preview/shape_mesh.h"
#include "bake/verdict/plan/pixel_probe.h"
#include "bake/verdict/plan/relief_facts.h"
#include "verdict/compare/relief_pair.h"
#include <random>

namespace bake::test {

/// Draws from a seed; the standard fixes the numbers of the engine, unlike those of its distributions.
class Draw {
public:
    explicit Draw(std::uint32_t seed) : engine_(seed) {}
    double unit() { return double(engine_()) / 4294967296.0; }
    double between(double low, double high) { return low + (high - low) * unit(); }
    double log_between(double low, double high) { return low * std::pow(high / low, unit()); }
    int below(int n) { return std::min(n - 1, int(n * unit())); }
    bool chance(double share) { return unit() < share; }
    Vec3d direction() {
        const double z = between(-1, 1), east = between(0, 2 * pi), ring = std::sqrt(1 - z * z);
        return {ring * std::cos(east), ring * std::sin(east), z};
    }

private:
    std::mt19937 engine_;
};

/// Values whose differences from texel to texel are at most about 1.
inline HeightTexture drawn_height(Draw& draw) {
    const int size = 16 << draw.below(3), kind = draw.below(5);
    const double offset = draw.chance(0.3) ? draw.between(-3, 3) : 0;
    if (kind == 0) {
        const double k = 1 + draw.below(size / 5), m = 1 + draw.below(size / 5);
        return height_of(size, [=](double u, double v) {
            return offset + size / (2 * pi * std::max(k, m)) * std::sin(2 * pi * k * u) * std::cos(2 * pi * m * v);
        });
    }
    if (kind == 1) { // a bump
        const double wide = draw.between(0.05, 0.3);
        return height_of(size, [=](double u, double v) {
            const double d2 = (u - 0.5) * (u - 0.5) + (v - 0.5) * (v - 0.5);
            return offset + size * wide * std::exp(-d2 / (2 * wide * wide));
        });
    }
    if (kind == 2) { // a constant height, which moves nothing but the border
        const double height = draw.between(-20, 20);
        return height_of(size, [=](double, double) { return height; });
    }
    if (kind == 3) // white noise
        return height_of(size, [&](double, double) { return offset + draw.unit(); });
    const double step = draw.between(0.2, 0.8); // a step, and a gutter
    return height_of(size, [=](double u, double v) { return offset + (u < step) + 0.5 * (std::abs(v - 0.5) < 0.1); });
}

struct HuntedScene {
    Scene plain, truth;
    HeightTexture height;
    FactsInput input; ///< of `plain`
    std::string base;
    double slope = 0; ///< drawn
};

inline Reflectance drawn_reflectance(Draw& draw) {
    using Model = Reflectance::Model;
    Reflectance r;
    const Model models[] = {Model::blinn, Model::phong, Model::normalised_blinn, Model::normalised_phong};
    r.model = models[draw.below(4)];
    r.diffuse = Vec3f(Vec3d(draw.unit(), draw.unit(), draw.unit()));
    if (draw.chance(0.5)) r.specular = Vec3f(float(draw.unit())), r.shininess = float(draw.log_between(1, 1000));
    if (draw.chance(0.1)) r.model = Model::ggx;
    return r;
}

inline Camera drawn_camera(Draw& draw, const Vec3d& n, const Vec3d& target, double size) {
    Camera camera;
    // From frontal to grazing, sometimes from behind.
    Vec3d from = draw.direction();
    if (glm::dot(from, n) * (draw.chance(0.1) ? -1 : 1) < 0) from = -from;
    if (draw.chance(0.5)) from = glm::normalize(from + 2.0 * n);
    const double distance = size * draw.log_between(0.7, 15);
    camera.target = Vec3f(target), camera.position = Vec3f(target + distance * from);
    camera.up = {0.1f, 1, 0.2f};
    const double seen = size * draw.log_between(0.3, 4); // height of the view at the target
    camera.orthographic = draw.chance(0.4);
    camera.view_height = float(seen);
    camera.fov_deg = float(std::min(80.0, 2 * std::atan(0.5 * seen / distance) * 180 / pi));
    return camera;
}

/// Scenes of one object; most are flat, because little is known of the others.
inline std::unique_ptr<HuntedScene> drawn_scene(std::uint32_t seed, const std::string& reference = "displace:16") {
    Draw draw(seed);
    auto out = std::make_unique<HuntedScene>();
    const char* shapes[] = {"sphere:R=1", "cylinder:R=1,h=2", "saddle:R=1,h=0.4", "torus:R=1,r=0.4"};
    const bool flat = draw.chance(0.75);
    out->base = flat ? "plane" : shapes[draw.below(4)];
    Mesh mesh = flat ? plane_mesh(8) : shape_mesh(out->base, 8, 8);
    const float repeat = draw.chance(0.5) ? 1 : float(draw.between(0.5, 4));
    for (Vec2f& uv : mesh.uvs) uv = repeat * uv + Vec2f(repeat == 1 ? 0.f : 0.3f);
    out->height = drawn_height(draw);
    out->slope = draw.log_between(2e-5, 0.5);
    const double amplitude = out->slope * 2 / (repeat * out->height.values.width());
    Placement placement;
    placement.rotate_deg = Vec3f(Vec3d(draw.between(0, 360), draw.between(0, 360), draw.between(0, 360)));
    if (flat && draw.chance(0.5)) placement.scale = {float(draw.between(0.5, 2)), float(draw.between(0.5, 2)), 1};
    if (draw.chance(0.3)) placement.translate = Vec3f(100.0 * draw.direction());
    Material material;
    material.reflectance = drawn_reflectance(draw);
    const HeightOptions options{.amplitude = amplitude, .midlevel = 0};
    const auto add = [&](Scene& scene, const std::string& word) {
        scene.shapes.push_back(make_shape(Mesh(mesh), {.derivatives = false}));
        Shape* shape = scene.shapes.back().get();
        ReliefModel model = with_relief(material, *shape, out->height,
                                        {.method = parse_shade(word).value(), .height = options, .filter = Filter::c2});
        scene.materials.push_back(std::make_unique<Material>(std::move(model.material)));
        if (model.shape) scene.shapes.push_back(std::move(model.shape)), shape = scene.shapes.back().get();
        add_instance(scene, *shape, *scene.materials.back(), placement);
    };
    add(out->plain, "plain");
    add(out->truth, reference);
    const Instance& placed = out->plain.instances[0];
    const Vec3d n = unit_or_zero(Vec3d(placed.normals * Vec3f(0, 0, 1)));
    const Vec3d target =
        Vec3d(placed.linear * Vec3f(Vec3d(draw.between(-1, 1), draw.between(-1, 1), 0))) + Vec3d(placement.translate);
    FactsInput& input = out->input;
    input.camera = drawn_camera(draw, n, target, 2);
    if (draw.chance(0.03)) input.camera.target = 2.f * input.camera.position - input.camera.target;
    input.exposure = float(draw.between(-2, 2));
    input.width = 12 + draw.below(20), input.height = 12 + draw.below(20);
    std::vector<Light<float>> lights;
    for (int i = 0; i <= draw.below(2); ++i) {
        const Vec3d l = draw.direction();
        lights.push_back(directional(Vec3f(glm::dot(l, n) < 0 && draw.chance(0.8) ? -l : l)));
        lights.back().colour = Vec3f(Vec3d(draw.unit(), draw.unit(), draw.unit()));
    }
    const bool shadows = draw.chance(0.7);
    const Vec3f background = draw.chance(0.5) ? Vec3f(0) : Vec3f(float(draw.unit()));
    for (Scene* scene : {&out->plain, &out->truth}) {
        scene->lights = lights, scene->camera = input.camera;
        scene->settings.shadows = shadows, scene->sky.background = background;
        build(*scene);
    }
    input.scene = &out->plain, input.relief = &out->height, input.options.height = options;
    return out;
}

inline SquareEstimate measured_error(const HuntedScene& scene, int half = 16, std::uint32_t seed = 0) {
    ProbeOptions options;
    options.seed = seed;
    options.settings = scene.plain.settings;
    options.settings.width = scene.input.width, options.settings.height = scene.input.height;
    options.camera = scene.input.camera, options.half = half, options.exposure = scene.input.exposure;
    const std::vector<std::uint8_t> all{1};
    const ProbedScene plain{&scene.plain, all}, truth{&scene.truth, all};
    const ProbedScene both[] = {plain, truth};
    ReferenceProbe probe(truth, object_pixels(both, options), options);
    return probe.measure(plain, 1 << 20);
}

struct Hunted {
    std::optional<ErrorBound> bound;
    SquareEstimate error; ///< measured if there is a bound
    /// Four standard errors, and the noise of floats.
    bool refuted() const noexcept { return bound && error.square - 4 * error.error > bound->rmse * bound->rmse + 1e-9; }
};

/// The mean of measurements with other samples, and the standard error that their spread shows.
inline SquareEstimate repeated_error(const HuntedScene& scene) {
    constexpr std::uint32_t times = 32;
    double sum = 0, squares = 0;
    SquareEstimate out;
    for (std::uint32_t k = 1; k <= times; ++k) {
        out = measured_error(scene, 32, k);
        sum += out.square, squares += out.square * out.square;
    }
    out.square = sum / times;
    out.error = std::sqrt(std::max(0.0, squares / times - out.square * out.square) / (times - 1));
    return out;
}

/// Where a border moves by a thousandth of a pixel, one sample in thousands sees it. If in one pixel both halves happen to, they
/// differ by the same amount, and the measurement takes that for certain (v of error_tally.h is 0). So a bound is refuted only by
/// measurements with samples that were not those that found it.
inline Hunted hunt(const HuntedScene& scene, int half = 16) {
    Hunted out{error_bound(Shade::plain, scene.input, relief_facts(scene.input)), {}};
    if (!out.bound) return out;
    out.error = measured_error(scene, half);
    if (out.refuted()) out.error = repeated_error(scene);
    return out;
}

} // namespace bake::test
