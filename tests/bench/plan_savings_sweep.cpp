// plan_savings_sweep: what bake plan saves of texture memory and of skies.
//
//   plan_savings_sweep DATA [HEIGHTS]     normal maps: one row of csv per height and object on stdout; DATA is ../shared/data.
//                                         HEIGHTS: only those whose names contain it
//   plan_savings_sweep --sky DATA         skies: one row per sky, material and kind of light
//
// Normal maps: the exact normals of a height with an rms slope of .3, and with the amplitude that the pair's own normal map has,
// on a plane and on five meshes, magnified to one texel per pixel, under one directional light, with a highlight of Phong 50 on a
// diffuse surface. The reference is the full-size map in float. `like` is the form that a plan takes if a map may err as much as
// full-size RGB of 8 bits on the same 8192 pixels, `normal` the one that it takes for an RMSE of .01. Bytes are those of all
// levels. `verified` are errors over all pixels of the picture, with other random numbers.
#include "bake/environment/file/environment_io.h"
#include "bake/environment/file/sky_cube.h"
#include "bake/mesh/file/mesh_io.h"
#include "bake/preview/relief_method.h"
#include "bake/preview/render.h"
#include "bake/preview/shape_mesh.h"
#include "bake/verdict/plan/sky_plan.h"
#include "bake/verdict/plan/texture_plan.h"
#include "bench.h"
#include "plan_savings_set.h"
#include <cstring>

using namespace bench;

namespace {

constexpr int window = 256;  ///< pixels along an edge of the picture
constexpr int probed = 8192; ///< as many as a plan compares

/// An object with a baked map, seen through a window in the middle of it.
Scene mapped_scene(const Named& mesh, const Named& name, const HeightTexture& height, const std::string& data,
                   bool own_amplitude) {
    Scene scene;
    scene.shapes.push_back(
        make_shape(*mesh.file ? read_mesh(data + "/meshes/" + mesh.file) : shape_mesh("plane", 1, 1)));
    Shape& shape = *scene.shapes[0];
    const double length = length_per_uv(shape);
    Material base;
    base.reflectance = shiny();
    ReliefOptions options;
    options.method.shade = Shade::normal;
    options.height.amplitude = own_amplitude ? name.amplitude * length : amplitude_for(height, length);
    scene.materials.push_back(std::make_unique<Material>(with_relief(base, shape, height, options).material));
    Placement placement;
    if (!*mesh.file) placement.rotate_deg.x = 60; // from the ground towards the camera
    add_instance(scene, shape, *scene.materials[0], placement);
    const Bounds box = bounds(scene);
    scene.camera = framing_camera(box, 40, 1);
    scene.camera.orthographic = true;
    scene.camera.view_height = float(window * length / height.values.width());
    scene.settings.width = scene.settings.height = window;
    Light<float> light;
    light.from = glm::normalize(Vec3f(-0.3f, 0.7f, 1));
    light.colour = Vec3f(1);
    scene.lights = {light};
    build(scene);
    return scene;
}

/// Errors of forms on the pixels that a plan compares.
class Judge {
public:
    Judge(const Scene& scene, std::uint32_t seed) : texture_(scene_textures(scene).at(0)), twin_(twin_of(scene)) {
        PartOptions options;
        options.seed = seed;
        probe_.emplace(
            scene, std::vector<ObjectMask>{objects_with(scene, std::vector<const Material*>{scene.materials[0].get()})},
            options);
        halvings_ = halvings_of(*texture_.picture);
    }
    double error(const TextureForm& form, int pixels) {
        set_texture(twin_, texture_.materials, texture_.use,
                    stored(halvings_[std::size_t(form.halvings)], texture_.use, form));
        return probe_->measure(twin_, pixels).error.rmse();
    }
    TextureForm full(int channels, int bits, int halvings = 0) const {
        for (const TextureForm& form :
             texture_forms(texture_.use, texture_.picture->width(), texture_.picture->height()))
            if (form.channels == channels && form.bits == bits && form.halvings == halvings) return form;
        return {};
    }

private:
    SceneTexture texture_;
    Scene twin_;
    std::optional<WorstProbe> probe_;
    std::vector<Image<float>> halvings_;
};

TexturePlan planned(const Scene& scene, bool like_rgb8) {
    PartOptions options;
    options.like_rgb8 = like_rgb8;
    return plan_textures(scene, nullptr, options).at(0);
}

void measure_map(const Named& mesh, const Named& name, const HeightTexture& height, const std::string& data,
                 bool own_amplitude) {
    const Scene scene = mapped_scene(mesh, name, height, data, own_amplitude);
    const TexturePlan like = planned(scene, true), normal = planned(scene, false);
    Judge same(scene, 0), other(scene, 1);
    const TextureForm rgb8 = same.full(3, 8), bc5 = same.full(2, bc5_bits);
    const auto row = [](const TexturePlan& plan) {
        return bench::text("%d,%d,%d,%lld,%.4g", plan.width, plan.channels, plan.bits,
                           static_cast<long long>(plan.bytes), plan.error.rmse());
    };
    std::printf("%s,%s,%s,%d,%lld,%.4g,%.4g,%.4g,%.4g,%s,%s,%.4g,%.4g,%.4g\n", own_amplitude ? "own" : "0.3", mesh.name,
                name.name, rgb8.width, static_cast<long long>(rgb8.bytes()), like.rgb8_rmse, same.error(bc5, probed),
                same.error(same.full(3, 16, 1), probed), same.error(same.full(3, 16, 2), probed), row(like).c_str(),
                row(normal).c_str(), other.error(rgb8, window * window), other.error(form_of(like), window * window),
                other.error(form_of(normal), window * window));
    std::fflush(stdout);
}

void measure_maps(const std::string& data, const std::string& only) {
    std::printf("slope,object,height,size,rgb8_bytes,rgb8_error,bc5_error,half_error,quarter_error,like_size,like_"
                "channels,like_bits,like_"
                "bytes,like_error,normal_size,normal_channels,normal_bits,normal_bytes,normal_error,verified_rgb8,"
                "verified_like,verified_normal\n");
    for (const Named& name : heights) {
        if (std::string(name.name).find(only) == std::string::npos) continue;
        const HeightTexture height = *name.file ? read_height(data + "/textures/" + name.file) : waves();
        for (const bool own_amplitude : {false, true})
            if (!own_amplitude || name.amplitude != 0)
                for (const Named& mesh : meshes) measure_map(mesh, name, height, data, own_amplitude);
    }
}

struct Finish {
    const char* name;
    Reflectance::Model model;
    float diffuse, specular, sharpness, reflect;
};
constexpr Finish finishes[] = {
    {"lambert", Reflectance::Model::blinn, 0.8f, 0, 1, 0},
    {"phong50", Reflectance::Model::normalised_phong, 0.3f, 0.5f, 50, 0},
    {"ggx_roughness_.5", Reflectance::Model::ggx, 0.8f, 0, 0.5f, 0}, // alpha .25
    {"ggx_roughness_.25", Reflectance::Model::ggx, 0.8f, 0, 0.25f, 0},
    {"mirror", Reflectance::Model::blinn, 0, 0, 1, 1},
};

/// A ball that fills the picture: the sky itself is not seen.
Scene lit_scene(const std::string& sky, const Finish& finish, SkyLighting light) {
    Scene scene;
    scene.settings.sky_light = light;
    scene.sky.cube = sky_cube(read_environment({sky}));
    scene.shapes.push_back(make_shape(shape_mesh("sphere:R=1", 96, 48)));
    auto material = std::make_unique<Material>();
    material->name = finish.name;
    material->reflectance.model = finish.model;
    material->reflectance.diffuse = Vec3f(finish.diffuse), material->reflectance.specular = Vec3f(finish.specular);
    material->reflectance.shininess = material->reflectance.roughness = finish.sharpness;
    if (finish.model == Reflectance::Model::ggx) material->reflectance.metallic = 1;
    material->reflect = Vec3f(finish.reflect);
    scene.materials.push_back(std::move(material));
    add_instance(scene, *scene.shapes[0], *scene.materials[0]);
    scene.camera = framing_camera(bounds(scene), 40, 1);
    // Inside the ball's outline.
    scene.camera.fov_deg = float(2 * std::atan(0.6 / double(glm::length(scene.camera.position))) * 180 / pi);
    scene.settings.width = scene.settings.height = window;
    build(scene);
    return scene;
}

void measure_skies(const std::string& data) {
    std::printf("sky,material,source_face,source_bytes,model,face,bytes,error,error_low,error_high,light,seconds\n");
    for (const SkyLighting light : {SkyLighting::irradiance, SkyLighting::sampled})
        for (const char* sky : {"lebombo_1k.hdr", "studio_small_03_1k.hdr", "blender_forest.exr", "blender_sunset.exr"})
            for (const Finish& finish : finishes) {
                const Scene scene = lit_scene(data + "/environments/latlong/" + sky, finish, light);
                SkyPlan plan;
                PartOptions options;
                options.exposure = automatic_exposure(render(scene, scene.settings));
                const double seconds = bench::seconds([&] { plan = *plan_sky(scene, options); });
                std::fprintf(stderr, "%s, %s: %s\n", sky, finish.name, plan.why.c_str());
                std::printf("%s,%s,%d,%lld,%s,%d,%lld,%.4g,%.4g,%.4g,%s,%.3g\n", sky, finish.name, plan.source_face,
                            static_cast<long long>(plan.source_bytes), plan.model.c_str(), plan.face,
                            static_cast<long long>(plan.bytes), plan.error.rmse(), plan.error.low(), plan.error.high(),
                            light == SkyLighting::sampled ? "sampled" : "filtered", seconds);
                std::fflush(stdout);
            }
}

} // namespace

int main(int argc, char** argv) {
    if (argc == 3 && std::strcmp(argv[1], "--sky") == 0) measure_skies(argv[2]);
    else if (argc == 2 || argc == 3) measure_maps(argv[1], argc == 3 ? argv[2] : "");
    else return std::fprintf(stderr, "plan_savings_sweep DATA [HEIGHTS] | --sky DATA\n"), 2;
}
