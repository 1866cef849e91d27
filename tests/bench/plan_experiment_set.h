// The configurations of the experiment that tries `bake plan`: an object with a relief, a finish, a light and a camera, drawn
// from a seed.
//
//   9 objects x 8 reliefs x 4 finishes x 3 lights; cameras near to far, frontal to grazing; heights from a part of a pixel
//   to several pixels
//
// Every 72 configurations in a row have each pair of object and relief once. A third of them, by a hash of their number, is
// held out: whoever works on the planner looks at the others.
#pragma once
#include "bake/mesh/file/mesh_io.h"
#include "bake/preview/sampler.h"
#include "bake/preview/scene_entries.h"
#include "bake/preview/shape_mesh.h"
#include "bake/relief/height/height.h"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace bench {

using namespace bake;

/// Numbers of one configuration: next() is evenly distributed in [0, 1).
class Draws {
public:
    explicit Draws(std::uint64_t seed) : state_(hash(seed)) {}
    double next() {
        state_ += 0x9e3779b97f4a7c15u;
        return double(hash(state_) >> 11) / 9007199254740992.0;
    }
    double between(double low, double high) { return low + (high - low) * next(); }
    /// Evenly distributed logarithm.
    double scale(double low, double high) { return low * std::pow(high / low, next()); }

private:
    std::uint64_t state_;
};

struct PlanObject {
    const char* name;
    const char* shape;      ///< null: the file
    const char* file;       ///< in the data that is shared
    const char* substitute; ///< in the folder meshes, where the shared data is absent
    int columns, rows;
    bool sheet; ///< faces up, and is looked at from above
    bool cage;  ///< its limit surface is shown
};
inline constexpr PlanObject plan_objects[] = {
    {"plane", "plane", nullptr, nullptr, 16, 16, true, false},
    {"sphere", "sphere:R=0.5", nullptr, nullptr, 48, 24, false, false},
    {"torus", "torus:R=0.35,r=0.15", nullptr, nullptr, 48, 24, false, false},
    {"saddle", "saddle:R=0.5,h=0.2", nullptr, nullptr, 16, 16, true, false},
    {"spot", nullptr, "meshes/spot/spot_control_mesh.obj", "torus.obj", 2, 2, false, true},
    {"fuze", nullptr, "meshes/trimesh/fuze.obj", "sphere.obj", 0, 0, false, false},
    {"boombox", nullptr, "meshes/materialx/boombox.obj", "torus.obj", 0, 0, false, false},
    {"head", nullptr, "meshes/leeperrysmith/LeePerrySmith.obj", "sphere.obj", 0, 0, false, false},
    {"panel", nullptr, "meshes/opensubdiv/catmark_righthanded.obj", "torus.obj", 1, 1, false, true},
};
inline constexpr int plan_object_count = int(std::size(plan_objects));

struct PlanRelief {
    const char* name;
    const char* file;       ///< in the shared data; null: made here
    const char* substitute; ///< in the folder meshes
    bool fine;              ///< its wavelengths are shorter than a pixel from most cameras
};
inline constexpr PlanRelief plan_reliefs[] = {
    {"rock", "textures/pairs/ambientcg_Rock020/Rock020_1K_Displacement.jpg", "bricks.png", false},
    {"tiles", "textures/pairs/ambientcg_Tiles036/Tiles036_1K_Displacement.jpg", "dots.png", false},
    {"planks", "textures/pairs/cube2_wooden_planks_gk_v01/wooden_planks_gk_v01_hm.png", "bricks.png", false},
    {"metal", "textures/pairs/ambientcg_Metal007/Metal007_1K_Displacement.jpg", "ripples.png", true},
    {"mountain", "textures/heights/terrain3d_mountain1.exr", "ripples.png", false},
    {"waves", nullptr, nullptr, false},
    {"grain", nullptr, nullptr, true},
    {"rough waves", nullptr, nullptr, false},
};
inline constexpr int plan_relief_count = int(std::size(plan_reliefs));

inline constexpr const char* plan_finishes[] = {"lambert", "phong50", "ggx.2", "mirror"};
inline constexpr const char* plan_lights[] = {"sun", "sun and sky", "sky"};

/// Where the shared data and the folder meshes are.
struct PlanFolders {
    std::string data, meshes;
};

inline std::string file_of(const PlanFolders& folders, const char* file, const char* substitute) {
    const std::string wanted = folders.data + "/" + file;
    return std::filesystem::exists(wanted) ? wanted : folders.meshes + "/" + substitute;
}

/// Sums of waves whose lengths are whole parts of the picture: the picture repeats. Waves have `least` to `most` periods, and
/// amplitudes of (number of periods)^-fall.
inline Image<float> wave_sum(int texels, int least, int most, double fall, int count, std::uint64_t seed) {
    Draws draw(seed);
    Image<float> sum(texels, texels, 1);
    std::fill_n(sum.data(), sum.size(), 0.f);
    std::vector<double> c(static_cast<std::size_t>(texels)), s(c.size());
    for (int i = 0; i < count; ++i) {
        const double periods = draw.scale(least, most), turn = draw.between(0, 2 * pi), phase = draw.between(0, 2 * pi);
        const double k = std::round(periods * std::cos(turn)), m = std::round(periods * std::sin(turn));
        const double amplitude = std::pow(std::max(1.0, std::hypot(k, m)), -fall);
        for (std::size_t x = 0; x < c.size(); ++x) {
            const double angle = 2 * pi * k * (double(x) + 0.5) / texels + phase;
            c[x] = amplitude * std::cos(angle), s[x] = amplitude * std::sin(angle);
        }
        for (int y = 0; y < texels; ++y) {
            const double angle = 2 * pi * m * (y + 0.5) / texels, c_y = std::cos(angle), s_y = std::sin(angle);
            for (std::size_t x = 0; x < c.size(); ++x) sum.row(y)[x] += float(c[x] * c_y - s[x] * s_y);
        }
    }
    return sum;
}

struct ReliefPicture {
    std::shared_ptr<LoadedPicture> picture; ///< values from 0 to 1
    float mean = 0;                         ///< of them
    double slope = 0;                       ///< root mean square per texel, of a central difference
};

/// Each value becomes the mean of its neighbours with the weights 1, 2, 1 along both axes: what is left has waves that the
/// reference has vertices enough for.
inline Image<float> smoothed(const Image<float>& from) {
    const int w = from.width(), h = from.height();
    Image<float> to(w, h, 1);
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x) {
            float sum = 0;
            for (int j = -1; j <= 1; ++j)
                for (int i = -1; i <= 1; ++i)
                    sum += float((2 - std::abs(i)) * (2 - std::abs(j))) * from.at((x + i + w) % w, (y + j + h) % h);
            to.at(x, y) = sum / 16;
        }
    return to;
}

/// Those of files have 128 texels or a little more, fine ones twice as many.
inline ReliefPicture relief_picture(const PlanRelief& relief, const PlanFolders& folders) {
    Image<float> values;
    if (relief.file) {
        const HeightTexture height = read_height(file_of(folders, relief.file, relief.substitute));
        const int texels = relief.fine ? 256 : 128;
        values = smoothed(box_minify(height.values, texels, texels));
    } else if (relief.fine) {
        values = wave_sum(192, 30, 48, 0, 96, 11);
    } else {
        const bool smooth = relief.name == std::string("waves");
        values = wave_sum(128, smooth ? 3 : 4, smooth ? 9 : 30, smooth ? 1 : 1.1, smooth ? 12 : 64, smooth ? 5 : 6);
    }
    const auto [low, high] = std::minmax_element(values.data(), values.data() + values.size());
    const float from = *low, range = std::max(*high - *low, 1e-9f);
    ReliefPicture made{.picture = std::make_shared<LoadedPicture>()};
    double sum = 0, squares = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        values.data()[i] = (values.data()[i] - from) / range;
        sum += double(values.data()[i]);
    }
    for (int y = 0; y < values.height(); ++y)
        for (int x = 0; x < values.width(); ++x) {
            const int right = (x + 1) % values.width(), down = (y + 1) % values.height();
            const double d_x = double(values.at(right, y) - values.at(x, y));
            const double d_y = double(values.at(x, down) - values.at(x, y));
            squares += d_x * d_x + d_y * d_y;
        }
    made.mean = float(sum / double(values.size()));
    made.slope = std::sqrt(squares / double(values.size()));
    made.picture->info.type = SampleType::float32, made.picture->info.bits = 32;
    made.picture->info.width = values.width(), made.picture->info.height = values.height();
    made.picture->info.channels = {"Y"}, made.picture->info.colours = 1;
    made.picture->image = std::move(values);
    return made;
}

/// An object with what the drawing of cameras and amplitudes needs to know of it.
struct PlanBase {
    const PlanObject* object = nullptr;
    std::string file;
    std::vector<Vec3f> points;
    Vec3f centre{0};
    double radius = 0;  ///< of a sphere around the centre
    double uv_edge = 1; ///< length on the surface of an edge of the unit square of uvs: root of the ratio of the areas
};

inline PlanBase plan_base(const PlanObject& object, const PlanFolders& folders) {
    PlanBase base{.object = &object};
    if (!object.shape) base.file = file_of(folders, object.file, object.substitute);
    const Mesh mesh = object.shape ? shape_mesh(object.shape, object.columns, object.rows) : read_mesh(base.file);
    base.points = mesh.positions;
    Vec3f low = base.points[0], high = low;
    for (const Vec3f& p : base.points) low = glm::min(low, p), high = glm::max(high, p);
    base.centre = 0.5f * (low + high);
    for (const Vec3f& p : base.points) base.radius = std::max(base.radius, double(glm::length(p - base.centre)));
    double area = 0, uv_area = 0;
    for (std::size_t face = 0; face + 1 < mesh.face_begin.size(); ++face)
        for (auto c = mesh.face_begin[face] + 1; c + 1 < mesh.face_begin[face + 1]; ++c) {
            const auto first = mesh.face_begin[face];
            const auto p = [&](auto corner) { return Vec3d(mesh.positions[mesh.corner_position[corner]]); };
            const auto uv = [&](auto corner) { return Vec2d(mesh.uvs[mesh.corner_uv[corner]]); };
            area += glm::length(glm::cross(p(c) - p(first), p(c + 1) - p(first)));
            const Vec2d e = uv(c) - uv(first), f = uv(c + 1) - uv(first);
            uv_area += std::abs(e.x * f.y - e.y * f.x);
        }
    base.uv_edge = uv_area > 0 ? std::sqrt(area / uv_area) : 1;
    return base;
}

inline Vec3f towards(double elevation_deg, double azimuth_deg) {
    const double e = elevation_deg * pi / 180, a = azimuth_deg * pi / 180;
    return Vec3f(Vec3d(std::cos(e) * std::sin(a), std::sin(e), std::cos(e) * std::cos(a)));
}

/// One configuration. The method of its material and the exposure are left to the caller.
struct PlanTrial {
    int number = 0, object = 0, relief = 0, finish = 0, light = 0;
    bool held_out = false;
    double elevation_deg = 0; ///< of the camera
    double distance = 0;      ///< of the camera from the centre, in radii of the object
    double sun_deg = 0;
    double height_px = 0; ///< from the lowest to the highest point of the relief, seen from the side
    double slope = 0;     ///< root mean square
    SceneEntries entries;
};

/// The samples per pixel of the pictures that are planned: textures are filtered for them.
inline constexpr int plan_spp = 32;
inline constexpr double plan_budgets[] = {0.005, 0.01, 0.02};

inline void set_plan_finish(MaterialEntry& material, int finish) {
    Reflectance& r = material.reflectance;
    r.model = Reflectance::Model::phong;
    const float diffuse[] = {0.7f, 0.4f, 0.75f, 0.02f};
    r.diffuse = r.ambient = Vec3f(diffuse[finish]);
    if (finish == 1) r.specular = Vec3f(0.5f), r.shininess = 50;
    if (finish == 2) r.model = Reflectance::Model::ggx, r.roughness = 0.2f, r.metallic = 1;
    if (finish == 3) material.reflect = Vec3f(0.9f);
}

/// Draws configurations.
class PlanSet {
public:
    explicit PlanSet(const PlanFolders& folders) : folders_(folders) {
        for (const PlanObject& object : plan_objects) bases_.push_back(plan_base(object, folders));
        for (const PlanRelief& relief : plan_reliefs) reliefs_.push_back(relief_picture(relief, folders));
    }

    PlanTrial trial(int number) const {
        PlanTrial trial{.number = number, .object = number % plan_object_count};
        trial.relief = number / plan_object_count % plan_relief_count;
        const int round = number / (plan_object_count * plan_relief_count);
        trial.finish = (trial.object + 3 * trial.relief + round) % int(std::size(plan_finishes));
        Draws draw(std::uint64_t(number) + 20'000);
        trial.light = int(3 * draw.next());
        trial.held_out = hash(std::uint64_t(number) + 77'000) % 3 == 0;
        const double per_length = set_camera(trial, draw);
        set_lights(trial, draw);
        set_object(trial, draw, per_length);
        return trial;
    }

private:
    /// The object is 40 to 100 pixels wide or high, and there is a margin for what the relief adds. Returns pixels per length
    /// at the centre of the object.
    double set_camera(PlanTrial& trial, Draws& draw) const {
        const PlanBase& base = bases_[std::size_t(trial.object)];
        trial.elevation_deg = base.object->sheet ? draw.between(8, 90) : draw.between(-10, 80);
        trial.distance = draw.scale(1.6, 12);
        CameraEntry camera;
        const Vec3f to_camera = towards(trial.elevation_deg, draw.between(0, 360));
        camera.position = base.centre + float(trial.distance * base.radius) * to_camera;
        camera.target = base.centre;
        const CameraFrame frame = camera_frame(place_camera(camera, Bounds{}, 1));
        Vec2d low(1e30), high(-1e30);
        for (const Vec3f& p : base.points) {
            const Vec3f from = p - frame.position;
            const double depth = std::max(double(glm::dot(from, frame.forward)), 0.05 * base.radius);
            const Vec2d at = Vec2d(glm::dot(from, frame.right), glm::dot(from, frame.up)) / depth;
            low = glm::min(low, at), high = glm::max(high, at);
        }
        const double pixels = 40 * std::pow(2.5, std::pow(draw.next(), 4));
        const double focal = pixels / std::max(high.x - low.x, high.y - low.y); // pixels per tangent of an angle
        const Vec2d most = glm::max(-low, high);
        const auto size = [&](double extent) { return std::max(16, int(std::ceil(2.12 * focal * extent))); };
        trial.entries.settings.width = size(most.x), trial.entries.settings.height = size(most.y);
        camera.fov_deg = float(2 * std::atan(trial.entries.settings.height / (2 * focal)) * 180 / pi);
        trial.entries.cameras = {camera};
        return focal / (trial.distance * base.radius);
    }

    void set_lights(PlanTrial& trial, Draws& draw) const {
        SceneEntries& entries = trial.entries;
        entries.sky.image = folders_.meshes + "/sky_%s.png";
        entries.settings.sky_light = trial.light == 0 ? SkyLighting::off : SkyLighting::sampled;
        entries.any_light = true;
        trial.sun_deg = draw.between(8, 70);
        Light<float> sun;
        sun.from = towards(trial.sun_deg, draw.between(0, 360));
        sun.colour = Vec3f(1.2f, 1.15f, 1.05f);
        if (trial.light != 2) entries.lights.push_back(sun);
        if (trial.light == 0) entries.ambient = Vec3f(0.15f);
    }

    /// The height is drawn in pixels, with slopes that stay below 45 degrees or so: fine relief is low.
    void set_object(PlanTrial& trial, Draws& draw, double per_length) const {
        const PlanBase& base = bases_[std::size_t(trial.object)];
        const ReliefPicture& relief = reliefs_[std::size_t(trial.relief)];
        const bool fine = plan_reliefs[trial.relief].fine;
        const bool sheet = base.object->sheet; // most of which is far from a contour
        const double most = (sheet ? 6 : 2.5) * (fine ? 0.4 : 1), least = sheet ? 0.12 : 0.05;
        trial.height_px = draw.scale(least, most);
        double amplitude = trial.height_px / per_length; // in units of the object
        const double steepness = relief.slope * relief.picture->image.width() / base.uv_edge;
        amplitude = std::min(amplitude, draw.between(0.4, 0.9) / steepness);
        trial.height_px = amplitude * per_length, trial.slope = amplitude * steepness;
        SceneEntries& entries = trial.entries;
        entries.file = "configuration " + std::to_string(trial.number);
        entries.settings.spp = plan_spp;
        entries.settings.bounces = 2;
        entries.settings.filter = TextureFilter::mips; // so that bump and bump+roughness differ
        entries.pictures["relief.exr"] = relief.picture;
        MaterialEntry material{.name = plan_finishes[trial.finish]};
        set_plan_finish(material, trial.finish);
        material.relief.file = "relief.exr";
        material.relief.amplitude = float(amplitude), material.relief.midlevel = relief.mean;
        entries.materials.push_back(material);
        MeshEntry mesh{.file = base.file, .name = base.object->name};
        if (base.object->shape) mesh.shape = base.object->shape;
        mesh.columns = base.object->columns, mesh.rows = base.object->rows;
        if (base.object->cage) mesh.subdivide = Scheme::catmark;
        mesh.material = 0;
        entries.meshes.push_back(mesh);
    }

    PlanFolders folders_;
    std::vector<PlanBase> bases_;
    std::vector<ReliefPicture> reliefs_;
};

/// Numbers of the configurations that have a row in a csv file.
inline std::set<int> numbers_in(const std::string& file) {
    std::set<int> numbers;
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);)
        if (!line.empty() && line[0] >= '0' && line[0] <= '9') numbers.insert(std::stoi(line));
    return numbers;
}

} // namespace bench
