// Shading normals that relief tilts: away from the viewer, until the mirror direction is below the surface, and towards
// light that is below the horizon.
#include "bake/preview/terminator.h"
#include "preview/little_scenes.h"
#include "stability/themes.h"
#include <algorithm>
#include <limits>

using namespace bake;
using namespace bake::test;

namespace stability {
namespace {

/// A plane whose bump table has one slope everywhere, in world units: normal (-s cos a, -s sin a, 1).
Scene tilted_plane(double slope, double azimuth_deg, const Material& like) {
    Material material = like;
    const double a = azimuth_deg * pi / 180;
    material.bump_table = texture(2, 2, 2, [&](float, float, float* to) {
        to[0] = float(2 * slope * std::cos(a)),
        to[1] = float(2 * slope * std::sin(a)); // per unit of uv, which is 2 long
    });
    Scene scene = one_mesh(plane_mesh(), material);
    scene.camera.orthographic = true, scene.camera.view_height = 0.1f;
    scene.settings.width = scene.settings.height = 4, scene.settings.spp = 1;
    return scene;
}

/// Seen from +X, `angle_deg` off the normal.
void look_from(Scene& scene, double angle_deg) {
    const double t = angle_deg * pi / 180;
    scene.camera.position = Vec3f(Vec3d(4 * std::sin(t), 0, 4 * std::cos(t)));
    scene.camera.target = Vec3f(0);
}

struct Seen {
    RenderStats stats;
    double least = 0, most = 0; ///< values of the picture
};

Seen see(double slope, double azimuth_deg, double angle_deg, const Material& material = {}) {
    Scene scene = tilted_plane(slope, azimuth_deg, material);
    scene.lights.push_back(directional({0.3f, 0.2f, 1}));
    scene.sky.background = Vec3f(1);
    look_from(scene, angle_deg);
    build(scene);
    Seen seen;
    const Image<float> picture = render(scene, scene.settings, &seen.stats);
    const auto [least, most] = std::minmax_element(picture.data(), picture.data() + picture.size());
    seen.least = double(*least), seen.most = double(*most);
    return seen;
}

/// The slope from which on `bad` holds, by bisection.
template <class Bad> double first_slope(const Bad& bad) {
    double good = 0, worse = 1e4;
    for (int i = 0; i < 40; ++i) {
        const double middle = good > 1e-3 ? std::sqrt(good * worse) : 0.5 * (good + worse);
        (bad(middle) ? worse : good) = middle;
    }
    return 0.5 * (good + worse);
}

/// What the pictures hold on both sides of the break.
std::string told(const Seen& before, const Seen& past) {
    const auto fine = [](const Seen& s) { return s.least >= 0 && std::isfinite(s.most) && s.stats.bad_samples == 0; };
    return fine(before) && fine(past) ? "finite, none below 0, on both sides; the report counts the samples past it"
                                      : "values out of range";
}

std::vector<Row> facing_rows(int steps) {
    std::vector<Row> rows;
    for (const double angle : linear_steps(5, 85, steps)) {
        const auto tilted = [&](double s) { return see(s, 0, angle).stats.tilted > 0; };
        const double s = first_slope(tilted);
        rows.push_back(
            {"", angle, s, 1 / std::tan(angle * pi / 180), told(see(0.99 * s, 0, angle), see(1.01 * s, 0, angle))});
    }
    return rows;
}

/// The slope s at the angle t between relief and viewer from which on cos t (1 - s^2) < 2 s sin t cos a.
double mirror_break(double angle_deg, double azimuth_deg) {
    const double t = std::tan(angle_deg * pi / 180) * std::cos(azimuth_deg * pi / 180);
    return std::sqrt(t * t + 1) - t;
}

std::vector<Row> mirror_rows(int steps) {
    Material material;
    material.reflect = Vec3f(1);
    std::vector<Row> rows;
    for (const auto& [name, azimuth] :
         {std::pair("along the view", 0.0), {"60 deg aside", 60.0}, {"across the view", 90.0}})
        for (const double angle : linear_steps(5, 85, steps)) {
            // Tilted so far that it faces away, a normal has no mirror direction; that is counted apart.
            const auto below = [&, aside = azimuth](double s) {
                const RenderStats stats = see(s, aside, angle, material).stats;
                return stats.mirrored_below + stats.tilted > 0;
            };
            const double s = first_slope(below);
            rows.push_back({name, angle, s, mirror_break(angle, azimuth),
                            told(see(0.99 * s, azimuth, angle, material), see(1.01 * s, azimuth, angle, material))});
        }
    return rows;
}

/// The radiance, for a light of radiance 1 and diffuse 1, just above the horizon of a plane tilted towards it.
double at_horizon(double slope, Terminator mode) {
    Material material;
    material.reflectance.ambient = Vec3f(0), material.reflectance.diffuse = Vec3f(1);
    Scene scene = tilted_plane(-slope, 0, material);
    const double e = 1e-4;
    scene.lights.push_back(directional({float(std::cos(e)), 0, float(std::sin(e))}));
    scene.settings.terminator = mode;
    build(scene);
    const Image<float> picture = render(scene, scene.settings);
    return double(picture.at(1, 1, 0));
}

std::vector<Row> horizon_rows(int steps) {
    std::vector<Row> rows;
    for (const auto& [name, mode] :
         {std::pair("off", Terminator::off), {"estevez", Terminator::estevez}, {"chiang", Terminator::chiang}})
        for (const double slope : geometric_steps(1e-2, 1e2, steps)) {
            const double step = slope / std::sqrt(1 + slope * slope);
            const bool off = mode == Terminator::off;
            rows.push_back({name, slope, at_horizon(slope, mode), off ? step : 0.0,
                            off ? "off: light stops at the surface's horizon; tilted normals keep a step there"
                                : "estevez and chiang: light fades to the horizon"});
        }
    return rows;
}

} // namespace

std::vector<Sweep> tilt_sweeps() {
    return {
        {.name = "facing_away",
         .construction =
             "a plane of one slope, seen under an angle from its normal: the slope from which on the shading "
             "normal faces away",
         .x_label = "angle of view from the normal (deg)",
         .y_label = "slope",
         .log_y = true,
         .limit = 1,
         .falls = true,
         .closed_form = "slope = cot(angle); here the angle at which a slope of 1 faces away",
         .test = "stability/tilt_test",
         .rows = facing_rows},
        {.name = "mirror_below",
         .construction =
             "the same plane as a mirror: the slope from which on the mirror direction is below the surface",
         .x_label = "angle of view from the normal (deg)",
         .y_label = "slope",
         .log_y = true,
         .limit = 0.5,
         .falls = true,
         .closed_form = "cos t (1 - s^2) = 2 s sin t cos(azimuth); here the angle at which a slope of .5 mirrors below",
         .test = "stability/tilt_test",
         .rows = mirror_rows},
        {.name = "horizon_step",
         .construction = "a plane tilted by its relief towards a light at its horizon: the step where the light sets",
         .x_label = "slope",
         .y_label = "step (diffuse 1 and light 1)",
         .log_x = true,
         .limit = 0.05,
         .closed_form = "off s / sqrt(1 + s^2), the others 0",
         .test = "stability/tilt_test",
         .rows = horizon_rows},
    };
}

} // namespace stability
