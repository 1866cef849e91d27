#include "stability/terminator_map.h"
#include "bake/preview/relief_method.h"
#include "preview/little_scenes.h"
#include "preview/sky_of.h"
#include <algorithm>

namespace bake::test {
namespace {

/// Periods of the egg-box along an edge of the plane, which is 2 long, and radians of it per radius of the sphere.
constexpr double periods = 10, sphere_wave = 16;
/// Width of the pictures of the plane: 2.5 periods, so that no border of it comes into view.
constexpr float plane_window = 0.5f;
/// The direction of the view is not along an axis of the egg-box.
constexpr double view_azimuth_deg = 20;

/// A height of lengths on the chart of plane_mesh() or sphere_mesh(), of the steepest slope `slope`.
HeightTexture egg_box(bool sphere, double slope, int size) {
    HeightTexture height;
    height.info.type = SampleType::float32;
    height.values = Image<float>(sphere ? 2 * size : size, size, 1);
    for (int y = 0; y < height.values.height(); ++y)
        for (int x = 0; x < height.values.width(); ++x) {
            const double u = (x + 0.5) / height.values.width(), v = 1 - (y + 0.5) / height.values.height();
            if (!sphere) {
                const double a = slope / (pi * periods); // d/dx = d/du / 2
                height.values.at(x, y) = float(a * std::sin(2 * pi * periods * u) * std::sin(2 * pi * periods * v));
                continue;
            }
            const double east = 2 * pi * u, north = pi * (v - 0.5), k = sphere_wave;
            const Vec3d p(std::cos(north) * std::sin(east), std::sin(north), std::cos(north) * std::cos(east));
            height.values.at(x, y) = float(slope / k * std::sin(k * p.x) * std::sin(k * p.y) * std::sin(k * p.z));
        }
    return height;
}

Material material_of(const std::string& name) {
    Material m;
    m.reflectance.ambient = Vec3f(0);
    if (name.ends_with("mirror")) return mirror();
    if (name.ends_with("phong 50")) {
        m.reflectance.model = Reflectance::Model::phong;
        m.reflectance.diffuse = Vec3f(0.3f), m.reflectance.specular = Vec3f(0.5f), m.reflectance.shininess = 50;
    }
    return m;
}

/// Unit vector at a height over the plane z = 0, towards an azimuth from +X.
Vec3f direction(double height_deg, double azimuth_deg) {
    const double h = height_deg * pi / 180, a = azimuth_deg * pi / 180;
    return Vec3f(Vec3d(std::cos(h) * std::cos(a), std::cos(h) * std::sin(a), std::sin(h)));
}

/// Two scenes of one relief: as the exact normal on the plain mesh, and displaced.
struct Pair {
    Scene bump, truth;
};

Scene scene_of(std::unique_ptr<Shape> shape, const Material& material, bool sphere,
               const TerminatorMapOptions& options) {
    Scene scene;
    scene.shapes.push_back(std::move(shape));
    scene.materials.push_back(std::make_unique<Material>(material));
    add_instance(scene, *scene.shapes[0], *scene.materials[0]);
    scene.camera.orthographic = true;
    scene.camera.view_height = sphere ? 3 : plane_window;
    scene.camera.position = Vec3f(0, 0, 8);
    scene.settings.width = scene.settings.height = options.edge;
    scene.settings.spp = options.spp, scene.settings.filter = TextureFilter::off;
    if (material.reflect != Vec3f(0)) {
        scene.sky.cube = sky_of(64, [](const Vec3d& d) { return 1 + 0.6 * d.z + 0.3 * std::sin(5 * d.x) * d.y; });
        scene.settings.sky_light = SkyLighting::off;
    }
    build(scene);
    return scene;
}

Pair make_pair(const std::string& name, double slope, const TerminatorMapOptions& options) {
    const bool sphere = name.starts_with("sphere");
    const HeightTexture height = egg_box(sphere, slope, 2 * options.segments);
    const auto base = [&] {
        return make_shape(sphere ? sphere_mesh(options.segments, options.segments / 2) : plane_mesh());
    };
    ReliefOptions relief{.method = {Shade::exact}, .height = {.amplitude = 1, .midlevel = 0}, .mips = false};
    if (sphere) relief.height.wrap_v = Wrap::clamp;
    auto shape = base();
    const ReliefModel bump = with_relief(material_of(name), *shape, height, relief);
    relief.method = {Shade::displace, sphere ? 1 : int(std::lround(std::log2(options.segments)))};
    ReliefModel truth = with_relief(material_of(name), *shape, height, relief);
    return {scene_of(std::move(shape), bump.material, sphere, options),
            scene_of(std::move(truth.shape), truth.material, sphere, options)};
}

/// Where the viewer and the sun stand for a row of the map.
struct Stand {
    Vec3f viewer{0, 0, 1}, sun{0, 0, 1};
};

std::vector<Stand> stands(const std::string& name, double height_deg, const TerminatorMapOptions& options) {
    if (name.ends_with("mirror")) return {{direction(height_deg, view_azimuth_deg), Vec3f(0, 0, 1)}};
    std::vector<Stand> all;
    if (name.starts_with("sphere")) return {{Vec3f(0, 0, 1), direction(height_deg, 60)}};
    const double from_normal = std::stod(name.substr(6));
    for (int i = 0; i < options.azimuths; ++i) // from behind the viewer to opposite; the other half is its mirror image
        all.push_back({direction(90 - from_normal, view_azimuth_deg),
                       direction(height_deg, view_azimuth_deg + 180.0 * i / std::max(1, options.azimuths - 1))});
    return all;
}

void stand(Scene& scene, const Stand& at) {
    scene.camera.position = 8.0f * at.viewer;
    scene.lights.clear();
    if (scene.sky.cube.empty()) scene.lights.push_back(directional(at.sun));
}

/// Share of the pixels that show a mesh in one of the scenes.
double shown(Scene& a, Scene& b) {
    const auto once = [](Scene& scene) {
        RenderSettings settings = scene.settings;
        settings.spp = 1;
        return render_layers(scene, settings);
    };
    const Image<float> p = once(a), q = once(b);
    double count = 0;
    for (int y = 0; y < p.height(); ++y)
        for (int x = 0; x < p.width(); ++x) count += p.at(x, y, 3) > 0 || q.at(x, y, 3) > 0;
    return count / (double(p.width()) * p.height());
}

/// The mean square of the values, without the noise.
double mean_square(const Halves& x) {
    double sum = 0;
    for (std::size_t i = 0; i < x.a.size(); ++i) sum += double(x.a.data()[i]) * double(x.b.data()[i]);
    return sum / double(x.a.size());
}

TerminatorRow measure(Pair& pair, const std::string& name, double slope, double height_deg,
                      const TerminatorMapOptions& options) {
    TerminatorRow row{name, slope, height_deg};
    const std::vector<Stand> all = stands(name, height_deg, options);
    const double share = shown(pair.bump, pair.truth) * double(all.size());
    for (const Stand& at : all) {
        stand(pair.bump, at), stand(pair.truth, at);
        const Halves truth = render_halves(pair.truth, pair.truth.settings);
        row.truth += mean_square(truth) / share;
        for (std::size_t i = 0; i < all_terminators.size(); ++i) {
            RenderSettings settings = pair.bump.settings;
            settings.terminator = pair.bump.settings.terminator = all_terminators[i];
            row.rmse[i] += mean_square_difference(render_halves(pair.bump, settings), truth) / share;
        }
    }
    for (double& value : row.rmse) value = std::sqrt(std::max(0.0, value));
    row.truth = std::sqrt(std::max(0.0, row.truth));
    return row;
}

} // namespace

int TerminatorRow::best() const noexcept {
    const int least = int(std::min_element(rmse.begin(), rmse.end()) - rmse.begin());
    return rmse[std::size_t(least)] < 0.99 * rmse[0] ? least : 0;
}

std::vector<TerminatorRow> terminator_map(const TerminatorMapOptions& options) {
    std::vector<TerminatorRow> rows;
    for (const std::string& name : options.cases)
        for (const double slope : options.slopes) {
            Pair pair = make_pair(name, slope, options);
            for (const double height : options.heights_deg) rows.push_back(measure(pair, name, slope, height, options));
        }
    return rows;
}

} // namespace bake::test
