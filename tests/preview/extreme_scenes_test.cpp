// Pictures of random scenes with extreme values: every value of every layer is finite, or the scene is refused.
#include "bake/base/error.h"
#include "bake/preview/relief_method.h"
#include "preview/little_scenes.h"
#include <algorithm>
#include <doctest/doctest.h>
#include <random>

using namespace bake;
using namespace bake::test;

namespace {

/// Seeded choices: usual values most of the time, extreme ones otherwise, so that most scenes still show something.
class Dice {
public:
    explicit Dice(std::uint32_t seed) : random_(seed) {}

    int below(int n) { return int(random_() % std::uint32_t(n)); }
    bool one_in(int n) { return below(n) == 0; }
    template <class T> T pick(std::initializer_list<T> values) { return values.begin()[below(int(values.size()))]; }

    float extreme() { return pick({0.f, 1.f, -1.f, 0.5f, 1e-30f, -1e-20f, 1e-6f, 1e6f, -1e12f, 1e15f, 3e38f}); }
    /// Not negative.
    float amount() { return one_in(3) ? std::abs(extreme()) : pick({0.f, 0.25f, 0.5f, 1.f}); }
    float share() { return pick({0.f, 1e-30f, 1e-3f, 0.3f, 0.5f, 1.f}); }
    Vec3f vector() { return {extreme(), extreme(), extreme()}; }
    Vec3f colour() { return one_in(3) ? Vec3f(amount()) : Vec3f(amount(), amount(), amount()); }
    /// `usual`, or an extreme vector.
    Vec3f near(const Vec3f& usual) { return one_in(4) ? vector() : usual; }

private:
    std::mt19937 random_;
};

/// A small mesh, damaged half of the time.
Mesh any_mesh(Dice& dice) {
    Mesh mesh = dice.one_in(2) ? sphere_mesh(6, 4) : plane_mesh(1 + dice.below(2));
    if (dice.one_in(40)) return {};
    const auto index = [&](const auto& list) { return std::size_t(dice.below(int(list.size()))); };
    switch (dice.below(20)) {
    case 0: mesh.positions.assign(mesh.positions.size(), Vec3f(0.5f)); break; // no area anywhere
    case 1: mesh.positions[index(mesh.positions)] = mesh.positions[0]; break;
    case 2: mesh.positions[index(mesh.positions)] = dice.vector(); break;
    case 3: {
        const float factor = dice.extreme();
        for (Vec3f& p : mesh.positions) p *= factor;
        break;
    }
    case 4: mesh.normals.assign(mesh.normals.size(), Vec3f(0)); break;
    case 5: mesh.normals.clear(), mesh.corner_normal.clear(); break;
    case 6: mesh.normals[index(mesh.normals)] = dice.vector(); break;
    case 7:
        for (Vec3f& n : mesh.normals) n = -n;
        break;
    case 8: mesh.uvs.clear(), mesh.corner_uv.clear(); break;
    case 9: mesh.uvs.assign(mesh.uvs.size(), Vec2f(0.25f)); break;
    case 10: mesh.uvs[index(mesh.uvs)] = Vec2f(dice.extreme(), dice.extreme()); break;
    default: break;
    }
    return mesh;
}

Texture any_texture(Dice& dice, int channels, bool colours = false) {
    return texture(1 + dice.below(4), 1 + dice.below(4), channels, [&](float, float, float* t) {
        for (int c = 0; c < channels; ++c) t[c] = colours ? dice.amount() : dice.near({0.5f, -0.25f, 1})[c];
    });
}

std::shared_ptr<const SurfaceMaps> any_maps(Dice& dice) {
    auto maps = std::make_shared<SurfaceMaps>();
    for (SurfaceMap* map : {&maps->base, &maps->specular, &maps->shininess, &maps->roughness, &maps->metallic,
                            &maps->occlusion, &maps->emission, &maps->alpha})
        if (dice.one_in(3)) {
            map->texture = any_texture(dice, 3, true);
            map->wrap_u = MapWrap(dice.below(3)), map->wrap_v = MapWrap(dice.below(3));
            map->nearest = dice.one_in(2);
        }
    maps->occlusion_strength = dice.share(), maps->opacity = dice.share();
    maps->alpha_mode = AlphaMode(dice.below(3)), maps->alpha_cutoff = dice.share();
    maps->one_sided = dice.one_in(4), maps->unlit = dice.one_in(8);
    return maps;
}

Material any_material(Dice& dice) {
    Material material;
    Reflectance& r = material.reflectance;
    r.model = Reflectance::Model(dice.below(6));
    r.diffuse = dice.colour(), r.specular = dice.colour(), r.ambient = dice.colour(), r.emission = dice.colour();
    r.shininess = dice.pick({0.f, 1.f, 50.f, 1e6f, 1e15f, 3e38f});
    r.roughness = dice.share(), r.metallic = dice.share();
    r.ior = dice.pick({1.f, 1.5f, 1e-3f, 10.f, 1e15f});
    if (dice.one_in(6)) r.subsurface = dice.colour(), r.translucency = dice.share();
    if (dice.one_in(6)) material.maps = any_maps(dice);
    if (dice.one_in(3)) material.reflect = dice.colour();
    if (dice.one_in(3)) material.albedo = any_texture(dice, 3, true);
    switch (dice.below(6)) {
    case 0: material.bump_table = any_texture(dice, 2); break;
    case 1: material.normal_map = any_texture(dice, 3); break;
    case 2: material.object_normals = any_texture(dice, 3); break;
    default: break;
    }
    return material;
}

/// Puts a mesh with a material in the scene; its height, if any, by any method.
void add_any_mesh(Scene& scene, Dice& dice) {
    scene.shapes.push_back(make_shape(any_mesh(dice), {.flat = dice.one_in(3)}));
    Material material = any_material(dice);
    if (!material.bump_table && !material.normal_map && !material.object_normals && dice.one_in(2)) {
        HeightTexture height;
        height.info.type = SampleType::float32;
        height.values = Image<float>(2 + dice.below(3), 2 + dice.below(3), 1);
        for (std::size_t i = 0; i < height.values.size(); ++i)
            height.values.data()[i] = dice.one_in(8) ? std::min(1e12f, dice.extreme()) : dice.share();
        const char* word = dice.pick({"plain", "roughness", "constant-scale", "blinn", "exact", "bump", "normal",
                                      "displace:2", "displace+normal:2"});
        ReliefOptions options{.method = parse_shade(word).value()};
        options.height.amplitude = double(dice.one_in(2) ? dice.extreme() : 0.1f);
        ReliefModel model = with_relief(material, *scene.shapes.back(), height, options);
        if (model.shape) scene.shapes.push_back(std::move(model.shape));
        material = model.material;
    }
    scene.materials.push_back(std::make_unique<Material>(std::move(material)));
    Placement placement;
    if (dice.one_in(4)) placement.scale = dice.near({1, -1, 0.5f});
    if (dice.one_in(4)) placement.rotate_deg = dice.near({30, 20, 10});
    if (dice.one_in(4)) placement.translate = dice.near({0.5f, 0, 100});
    add_instance(scene, *scene.shapes.back(), *scene.materials.back(), placement);
}

Light<float> any_light(Dice& dice) {
    Light<float> light = directional({0.1f, 0.2f, 1});
    light.kind = LightKind(dice.below(4));
    light.position = dice.near({0.5f, 1, 3}), light.from = unit_or_zero(dice.near({0, 0.6f, 0.8f}));
    light.colour = dice.colour(), light.diffuse = dice.colour(), light.specular = dice.colour();
    light.falloff = {dice.amount(), dice.amount(), dice.amount()};
    light.cos_outer = dice.pick({-1.f, 0.f, 0.7f, 0.999999f});
    light.edge_u = dice.near({1, 0, 0}), light.edge_v = dice.near({0, 1, 0});
    return light;
}

void set_camera(Scene& scene, Dice& dice) {
    scene.camera.position = dice.one_in(8) ? dice.vector() : Vec3f(0, 0, dice.pick({4.f, 4.f, 4.f, 0.f, 1e-20f}));
    scene.camera.target = dice.one_in(8) ? dice.vector() : Vec3f(0);
    scene.camera.up = dice.near({0, 1, 0});
    scene.camera.fov_deg = dice.pick({40.f, 40.f, 1e-3f, 179.f});
    scene.camera.orthographic = dice.one_in(4);
    scene.camera.view_height = dice.pick({2.f, 2.f, 1e-20f, 1e15f});
}

Scene any_scene(std::uint32_t seed) {
    Dice dice(seed);
    Scene scene;
    for (int i = dice.pick({0, 1, 1, 1, 1, 1, 2, 2, 3}); i > 0; --i) add_any_mesh(scene, dice);
    for (int i = dice.below(4); i > 0; --i) scene.lights.push_back(any_light(dice));
    if (dice.one_in(2)) {
        scene.sky.cube = constant_cube(Vec3f(0), 1 + dice.below(2));
        for (Image<float>& face : scene.sky.cube.faces)
            for (std::size_t k = 0; k < face.size(); ++k) face.data()[k] = dice.amount();
        scene.sky.scale = dice.pick({1.f, 1.f, 0.f, 1e-30f, 1e15f});
        scene.sky.yaw = SkyYaw(dice.pick({0., 90., -1e6}));
    }
    scene.sky.background = dice.colour(), scene.ambient = dice.colour();
    set_camera(scene, dice);
    RenderSettings& s = scene.settings;
    s.width = 1 + dice.below(4), s.height = 1 + dice.below(4), s.spp = 1 + dice.below(2);
    s.bounces = dice.below(4), s.diffuse_bounces = dice.below(3), s.shadows = !dice.one_in(8);
    s.sky_light = dice.one_in(200) ? SkyLighting::irradiance : SkyLighting(dice.below(2)),
    s.terminator = Terminator(dice.below(5)), s.seed = seed;
    return scene;
}

} // namespace

TEST_SUITE("stability") {

    TEST_CASE("extreme scenes: 10000 random ones have finite pixels in every layer, or are refused") {
        int rendered = 0, refused = 0, lit = 0;
        RenderStats stats;
        for (std::uint32_t seed = 0; seed < 10000; ++seed) {
            try {
                Scene scene = any_scene(seed);
                build(scene);
                const Image<float> layers = render_layers(scene, scene.settings, &stats);
                const Image<float> picture = render(scene, scene.settings);
                bool finite = true;
                float sum = 0;
                for (std::size_t k = 0; k < layers.size(); ++k) finite &= std::isfinite(layers.data()[k]);
                for (std::size_t k = 0; k < picture.size(); ++k) finite &= std::isfinite(picture.data()[k]);
                for (int c = 0; c < 3; ++c) sum += picture.at(0, 0, c);
                CAPTURE(seed);
                CHECK(finite);
                lit += sum > 0;
                ++rendered;
            } catch (const Error& error) {
                CHECK(error.refusal == Refusal::unsuitable);
                ++refused;
            }
        }
        MESSAGE(rendered << " rendered, " << lit << " of them not black in their first pixel, " << refused
                         << " refused; " << stats.hits << " hits, " << stats.rays << " rays, " << stats.bad_samples
                         << " samples not finite");
        CHECK(rendered > 8000);
        CHECK(lit > 4000);
        CHECK(stats.hits > 20000);
    }

    TEST_CASE("extreme scenes: where nothing shines, every pixel is 0") {
        Material dark, mirror;
        dark.reflectance.specular = Vec3f(0.5f);
        mirror.reflect = Vec3f(1);
        for (const Material& material : {dark, mirror, Material{}}) {
            Scene scene = one_mesh(sphere_mesh(), material);
            scene.lights = {directional({1, 1, 1}), {.kind = LightKind::point, .position = {0, 0, 3}}};
            for (Light<float>& light : scene.lights) light.colour = Vec3f(0);
            scene.sky.cube = constant_cube(Vec3f(0));
            scene.settings.width = scene.settings.height = 16;
            build(scene);
            const Image<float> picture = render(scene, scene.settings);
            for (std::size_t i = 0; i < picture.size(); ++i) REQUIRE(picture.data()[i] == 0);
        }
    }

} // TEST_SUITE
