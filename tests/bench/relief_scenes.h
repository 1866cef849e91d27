// Scenes of one object with relief for the sweep where bump fails: bases, reliefs, skies and materials.
//
// A relief is a sum of plane waves in space, looked at on the surface:
//
//   h(p) = sum_i a_i cos(k_i . p + phi_i)
//
// so that it has no seam, and the same wavelengths in units of the object on every base, poles and charts included. The
// projection of k_i on the surface is at most |k_i|: no wave on the surface is shorter than the shortest in space.
#pragma once
#include "bake/base/parallel.h"
#include "bake/mesh/file/mesh_io.h"
#include "bake/preview/scene_entries.h"
#include "bake/preview/smooth_mesh.h"
#include "bake/surface/patch/surface_map.h"
#include <random>

namespace bench {

using namespace bake;

/// A surface, in the rates of the methods that displace it and of those that shade it as it is.
struct Base {
    const char* name;
    std::string shape, file; ///< one of them; a file is the cage of a limit surface
    int coarse[2], fine[2];  ///< columns and rows
    double size;             ///< of the object, in its own units
    Vec3f centre{0};
    float turn_deg = 0; ///< about the vertical
};

/// The mesh of a file, turned to the camera, is the fourth. Edges of the coarse rates are about an eighth of the size.
inline std::vector<Base> bases(const std::string& file) {
    std::vector<Base> list = {{"plane", "plane", "", {8, 8}, {64, 64}, 1},
                              {"sphere", "sphere:R=0.5", "", {24, 12}, {192, 96}, 1},
                              {"saddle", "saddle:R=0.5,h=0.2", "", {8, 8}, {128, 128}, 1}};
    const Mesh cage = read_mesh(file);
    const Bounds box = bounds(cage);
    const Vec3f extent = box.max - box.min;
    list.push_back({"mesh", "", file, {1, 1}, {16, 16}, double(std::max({extent.x, extent.y, extent.z}))});
    list.back().centre = 0.5f * (box.min + box.max);
    list.back().turn_deg = 140;
    return list;
}

/// Wavelengths in parts of the object's size. Amplitudes are proportional to the wavelength, so that every octave has the same
/// slopes.
struct Spectrum {
    const char* name;
    double longest, shortest;
};
inline constexpr Spectrum spectra[] = {
    {"long", 1 / 8.0, 1 / 8.0}, {"wide", 1 / 4.0, 1 / 20.0}, {"short", 1 / 20.0, 1 / 20.0}};

/// Heights over the uv square for an rms slope of 1 on the surface.
struct ReliefField {
    std::shared_ptr<LoadedPicture> picture; ///< values are lengths
    double range = 0;                       ///< highest minus lowest point, in units of the object's size
};

struct Wave {
    Vec3d k;
    double phase, amplitude;
};

inline std::vector<Wave> waves_of(const Spectrum& spectrum, double size) {
    constexpr int count = 32;
    std::mt19937 random(7); // whose numbers the standard fixes, unlike those of its distributions
    const auto next = [&] { return double(random()) / 4294967296.0; };
    std::vector<Wave> waves;
    for (int i = 0; i < count; ++i) {
        const double z = 2 * next() - 1, east = 2 * pi * next(), ring = std::sqrt(1 - z * z);
        const double length =
            spectrum.longest * std::pow(spectrum.shortest / spectrum.longest, (i + 0.5) / count) * size;
        waves.push_back(
            {2 * pi / length * Vec3d(ring * std::cos(east), z, ring * std::sin(east)), 2 * pi * next(), length});
    }
    return waves;
}

inline std::shared_ptr<const BaseSurface> smooth_surface(const Base& base) {
    if (base.file.empty()) return shape_surface(base.shape, base.fine[0], base.fine[1]);
    return limit_mesh(read_mesh(base.file), Scheme::catmark, base.file, base.fine[0]).surface;
}

inline ReliefField relief_field(const Base& base, const Spectrum& spectrum, int texels) {
    const auto surface = smooth_surface(base);
    const SurfaceKind kind = base.file.empty() ? SurfaceKind::shape : SurfaceKind::limit;
    const MapQuantity wanted[] = {MapQuantity::position, MapQuantity::normal, MapQuantity::p_u, MapQuantity::p_v};
    SurfaceMapReport report;
    const auto maps = surface_maps(*surface, surface_mesh(*surface, kind, base.file.empty() ? 1 : 8), wanted,
                                   {.width = texels, .height = texels, .padding = 16}, base.name, report);
    const std::vector<Wave> waves = waves_of(spectrum, base.size);
    ReliefField field{.picture = std::make_shared<LoadedPicture>()};
    Image<float>& values = field.picture->image = Image<float>(texels, texels, 1);
    field.picture->info.type = SampleType::float32;
    field.picture->info.width = field.picture->info.height = texels;
    field.picture->info.channels = {"Y"}, field.picture->info.colours = 1;
    struct Sums {
        double area = 0, squares = 0;
    };
    std::vector<Sums> rows(texels);
    for_rows(texels, 8, [&](std::int64_t begin, std::int64_t end) {
        for (auto y = int(begin); y < int(end); ++y)
            for (int x = 0; x < texels; ++x) {
                const auto at = [&](int map) { return Vec3d(*reinterpret_cast<const Vec3f*>(&maps[map].at(x, y))); };
                const Vec3d p = at(0), n = at(1);
                Vec3d slope(0);
                double h = 0;
                for (const Wave& wave : waves) {
                    const double angle = glm::dot(wave.k, p) + wave.phase;
                    h += wave.amplitude * std::cos(angle);
                    slope -= wave.amplitude * std::sin(angle) * wave.k;
                }
                values.at(x, y) = float(h);
                slope -= glm::dot(slope, n) * n;
                const double area = glm::length(glm::cross(at(2), at(3)));
                rows[y].area += area, rows[y].squares += area * glm::dot(slope, slope);
            }
    });
    Sums sum;
    for (const Sums& row : rows) sum.area += row.area, sum.squares += row.squares;
    const double scale = 1 / std::sqrt(sum.squares / sum.area);
    for (std::size_t i = 0; i < values.size(); ++i) values.data()[i] = float(scale * values.data()[i]);
    const auto [lowest, highest] = std::minmax_element(values.data(), values.data() + values.size());
    field.range = double(*highest - *lowest) / base.size;
    return field;
}

/// Three materials: Lambert, Phong with exponent 50, mirror.
struct Finish {
    const char* name;
    float diffuse, specular, reflect;
};
inline constexpr Finish finishes[] = {{"lambert", 0.7f, 0, 0}, {"phong50", 0.4f, 0.5f, 0}, {"mirror", 0.02f, 0, 0.9f}};

inline void set_finish(Reflectance& r, Vec3f& reflect, const Finish& finish) {
    r.model = Reflectance::Model::phong;
    r.ambient = r.diffuse = Vec3f(finish.diffuse), r.specular = Vec3f(finish.specular), r.shininess = 50;
    reflect = Vec3f(finish.reflect);
}

/// The object with its relief shown by one method, loaded as a scene file would be.
inline Scene relief_scene(const Base& base, const ReliefField& field, double slope, const ShadeMethod& method,
                          const Finish& finish) {
    const bool displaced = method.shade == Shade::displace || method.shade == Shade::displace_normal;
    SceneEntries entries;
    entries.file = "scene";
    entries.pictures["relief"] = field.picture;
    entries.settings.sky_light = SkyLighting::off;
    entries.settings.bounces = 2;
    entries.settings.filter = TextureFilter::mips; // so that bump and bump+roughness differ
    entries.any_light = true;                      // lights are set for each picture
    entries.ambient = Vec3f(0.15f);
    MaterialEntry material{.name = "relief"};
    set_finish(material.reflectance, material.reflect, finish);
    material.relief = {.file = "relief", .amplitude = float(slope), .midlevel = 0.f, .shade = method};
    entries.materials.push_back(material);
    MeshEntry mesh{.file = base.file, .shape = base.shape};
    const int* rate = displaced ? base.coarse : base.fine;
    mesh.columns = rate[0], mesh.rows = rate[1];
    if (!base.file.empty()) mesh.subdivide = Scheme::catmark;
    mesh.material = 0;
    mesh.placement.rotate_deg.y = base.turn_deg;
    entries.meshes.push_back(mesh);
    return load(entries);
}

inline Vec3f direction(double elevation_deg, double azimuth_deg) {
    const double e = elevation_deg * pi / 180, a = azimuth_deg * pi / 180;
    return Vec3f(Vec3d(std::cos(e) * std::sin(a), std::sin(e), std::cos(e) * std::cos(a)));
}

/// From the horizon up to blue, with clouds and a sun with its glow; below a checkered ground, so that a mirror has
/// something to show in every direction.
inline Vec3f radiance_of_sky(const Vec3d& d, const Vec3d& sun) {
    if (d.y < 0) {
        const double scale = 2 / std::max(0.02, -d.y), fade = std::min(1.0, -4 * d.y);
        const bool odd = (int(std::floor(d.x * scale)) + int(std::floor(d.z * scale))) % 2 != 0;
        return Vec3f(glm::mix(Vec3d(0.3, 0.27, 0.22), odd ? Vec3d(0.42, 0.36, 0.28) : Vec3d(0.16, 0.15, 0.14), fade));
    }
    const Vec3d blue = glm::mix(Vec3d(0.75, 0.72, 0.68), Vec3d(0.16, 0.28, 0.55), std::sqrt(d.y));
    const double cloud = 0.5 + 0.5 * std::sin(7 * d.x + 2 * std::sin(5 * d.z)) * std::cos(6 * d.z + 3 * d.y);
    const double angle = std::acos(std::clamp(glm::dot(d, sun), -1.0, 1.0)) * 180 / pi;
    return Vec3f(blue + 0.35 * cloud * cloud * d.y + Vec3d(8, 7.4, 6.4) * std::exp(-angle * angle / 32) +
                 Vec3d(0.6, 0.5, 0.35) * std::exp(-angle / 20));
}

inline Sky sky_with_sun(const Vec3f& sun) {
    constexpr int size = 128;
    Sky sky;
    sky.cube = make_cube(size, 3);
    for (const CubeFace face : all_cube_faces)
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                const Vec3d d = cube_direction(CubePoint<double>{face, (x + 0.5) / size, (y + 0.5) / size});
                const Vec3f value = radiance_of_sky(glm::normalize(world_to_cube(d)), Vec3d(sun));
                for (int c = 0; c < 3; ++c) (&sky.cube[face].at(x, y))[c] = value[c];
            }
    add_halvings(sky);
    return sky;
}

} // namespace bench
