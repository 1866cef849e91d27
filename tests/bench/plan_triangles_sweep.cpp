// plan_triangles_sweep: what bake plan saves of triangles.
//
//   plan_triangles_sweep DATA [HEIGHTS]   one row of csv per height, mesh and slope on stdout; DATA is ../shared/data.
//                                         HEIGHTS: only those whose names contain it
//
// A mesh that fills a picture of 256² pixels, with a height that is on it once, of three rms slopes, under one directional
// light; budget normal. `one_pixel` is the number of triangles of half a square pixel that tile the surface, seen face on: what
// displacement with edges of one pixel needs at least. `chosen` has `triangles`. The errors are those of whole pictures with
// their intervals.
#include "bake/base/error.h"
#include "bake/mesh/file/mesh_io.h"
#include "bake/preview/relief_method.h"
#include "bake/preview/scene_entries.h"
#include "bake/verdict/plan/plan.h"
#include "bench.h"
#include "plan_savings_set.h"

using namespace bench;

namespace {

constexpr int edge = 256; ///< pixels along an edge of the picture
constexpr double slopes[] = {0.03, 0.1, 0.3};
constexpr float fov_deg = 40;

struct Relief {
    const char* name;
    std::shared_ptr<LoadedPicture> picture;
    double amplitude = 0; ///< with the rms slope `rms_slope`, on a surface whose unit of uv is one long
    float mean = 0;       ///< of the values, which is the surface without relief
};

Relief relief_of(const Named& name, const std::string& data) {
    HeightTexture height = *name.file ? read_height(data + "/textures/" + name.file) : waves();
    Relief made{.name = name.name, .picture = std::make_shared<LoadedPicture>(), .amplitude = amplitude_for(height, 1)};
    const Image<float>& values = height.values;
    double sum = 0;
    for (std::size_t i = 0; i < values.size(); ++i) sum += double(values.data()[i]);
    made.mean = float(sum / double(values.size()));
    ImageInfo& info = made.picture->info;
    info.type = SampleType::float32, info.bits = 32;
    info.width = values.width(), info.height = values.height();
    info.channels = {"Y"}, info.colours = 1;
    made.picture->image = std::move(height.values);
    return made;
}

struct Planned {
    SceneEntries entries;
    double one_pixel = 0;
    std::size_t base = 0; ///< triangles of the mesh
};

Planned planned_scene(const Named& mesh, const Relief& relief, double slope, const std::string& data) {
    Planned made;
    const std::string file = data + "/meshes/" + mesh.file;
    const std::unique_ptr<const Shape> owned = make_shape(read_mesh(file));
    const Shape& shape = *owned;
    SceneEntries& entries = made.entries;
    entries.file = std::string(mesh.name) + " with " + relief.name;
    entries.settings.width = entries.settings.height = edge;
    entries.settings.spp = 16;
    entries.pictures["relief.exr"] = relief.picture;
    Light<float> light;
    light.from = glm::normalize(Vec3f(-0.3f, 0.7f, 1));
    light.colour = Vec3f(1);
    entries.lights = {light}, entries.any_light = true;
    MaterialEntry material{.name = "shiny"};
    material.reflectance = shiny();
    material.relief.file = "relief.exr";
    material.relief.amplitude = float(slope / rms_slope * relief.amplitude * length_per_uv(shape));
    material.relief.midlevel = relief.mean;
    entries.materials = {material};
    MeshEntry entry{.file = file, .name = mesh.name};
    entry.material = 0, entry.own_materials = false;
    entries.meshes = {entry};
    CameraEntry camera;
    camera.fov_deg = fov_deg;
    entries.cameras = {camera};

    double area = 0;
    for (const Triangle& triangle : shape.surface.triangles) {
        Vec3d p[3];
        for (int k = 0; k < 3; ++k) p[k] = Vec3d(shape.mesh.positions[shape.mesh.corner_position[triangle.corner[k]]]);
        area += 0.5 * glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
    }
    const Camera placed = place_camera(camera, bounds(shape.mesh), 1);
    const double distance = double(glm::length(placed.position - placed.target)); // to the middle of the mesh
    const double pixel = 2 * distance * std::tan(double(fov_deg) * pi / 360) / edge;
    made.one_pixel = 2 * area / (pixel * pixel);
    made.base = shape.surface.triangles.size();
    return made;
}

void measure(const Named& mesh, const Relief& relief, double slope, const std::string& data) {
    const Planned scene = planned_scene(mesh, relief, slope, data);
    PlanOptions options;
    options.verify = true;
    ScenePlan plan;
    const double seconds = bench::seconds([&] { plan = plan_scene(scene.entries, options); });
    if (plan.objects.size() != 1 || plan.verified.empty())
        throw Error(Refusal::unsuitable, scene.entries.file + ": no object was planned");
    const ObjectPlan& object = plan.objects.front();
    const Verification& verified = plan.verified.front();
    const bool cheaper = object.chosen >= 0;
    const Rung* rung = cheaper ? &object.rungs[std::size_t(object.chosen)] : nullptr;
    std::printf("%s,%s,%g,%zu,%.0f,%s,%lld,%.4g,%.4g,%.4g,%.4g,%.3g\n", mesh.name, relief.name, slope, scene.base,
                scene.one_pixel, name(cheaper ? rung->method : object.reference).c_str(),
                static_cast<long long>((cheaper ? rung->cost : object.reference_cost).triangles),
                verified.predicted.rmse(), verified.measured.rmse(), verified.measured.low(), verified.measured.high(),
                seconds);
    std::fflush(stdout);
}

} // namespace

int main(int argc, char** argv) try {
    if (argc < 2 || argc > 3) return std::fprintf(stderr, "plan_triangles_sweep DATA [HEIGHTS]\n"), 2;
    std::printf(
        "mesh,height,slope,base,one_pixel,chosen,triangles,predicted,measured,measured_low,measured_high,seconds\n");
    for (const Named& name : heights) {
        if (argc > 2 && std::string(name.name).find(argv[2]) == std::string::npos) continue;
        const Relief relief = relief_of(name, argv[1]);
        for (const Named& mesh : meshes)
            for (const double slope : slopes)
                if (*mesh.file) measure(mesh, relief, slope, argv[1]);
    }
} catch (const std::exception& error) {
    return std::fprintf(stderr, "plan_triangles_sweep: %s\n", error.what()), 1;
}
