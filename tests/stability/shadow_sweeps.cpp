// What bump mapping cannot show: the contour of the relief, and the shadows that it casts. And the shadows of facets, which
// should not be there.
#include "bake/preview/relief_method.h"
#include "preview/little_scenes.h"
#include "stability/themes.h"
#include <algorithm>

using namespace bake;
using namespace bake::test;

namespace stability {
namespace {

HeightTexture heights(int width, int height, const std::function<double(double, double)>& at) {
    HeightTexture texture;
    texture.info.type = SampleType::float32;
    texture.values = Image<float>(width, height, 1);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) texture.values.at(x, y) = float(at((x + 0.5) / width, 1 - (y + 0.5) / height));
    return texture;
}

/// A mesh with a relief by a method, seen by an orthographic camera.
Scene relief_scene(Mesh mesh, const HeightTexture& height, const std::string& method, Wrap wrap_v) {
    Material white;
    white.reflectance.ambient = Vec3f(0);
    auto shape = make_shape(std::move(mesh));
    ReliefOptions options{.method = parse_shade(method).value(), .height = {.amplitude = 1, .midlevel = 0}};
    options.height.wrap_v = wrap_v, options.mips = false;
    ReliefModel model = with_relief(white, *shape, height, options);
    Scene scene;
    scene.shapes.push_back(model.shape ? std::move(model.shape) : std::move(shape));
    scene.materials.push_back(std::make_unique<Material>(model.material));
    add_instance(scene, *scene.shapes[0], *scene.materials[0]);
    scene.camera.orthographic = true;
    scene.settings.filter = TextureFilter::off;
    return scene;
}

constexpr int lobes = 6;

/// A unit sphere with b = a cos(6 u) cos^2(v), v the latitude, seen along its poles: displacement is radial, so that the
/// contour is that of the equator, at the radius 1 + a cos(6 u), while a < 1/3.
Scene lobed_ball(double a, const std::string& method) {
    Scene scene = relief_scene(sphere_mesh(192, 24),
                               heights(192, 96,
                                       [&](double u, double v) {
                                           const double c = std::cos(pi * (v - 0.5));
                                           return a * std::cos(2 * pi * lobes * u) * c * c;
                                       }),
                               method, Wrap::clamp);
    scene.camera.position = Vec3f(0, 8, 0), scene.camera.up = Vec3f(0, 0, -1);
    build(scene);
    return scene;
}

/// The radius at which the ball ends under the camera of lobed_ball(), in a direction.
double contour(const Scene& scene, double angle) {
    double inside = 0.3, outside = 3;
    const Vec3d along(std::sin(angle), 0, std::cos(angle));
    for (int i = 0; i < 24; ++i) {
        const double r = 0.5 * (inside + outside);
        const bool hit = bool(scene.bvh->intersect({Vec3f(r * along + Vec3d(0, 8, 0)), Vec3f(0, -1, 0)}));
        (hit ? inside : outside) = r;
    }
    return 0.5 * (inside + outside);
}

constexpr double pixel = 2.5 / 512; // of a picture of 512 pixels that holds the ball

std::vector<Row> silhouette_rows(int steps) {
    std::vector<Row> rows;
    std::vector<double> sizes = geometric_steps(1e-3, 0.3, steps);
    for (const char* method : {"bump", "exact", "displace:2"}) {
        const bool displaced = std::string(method).starts_with("displace");
        for (const double a : sizes) {
            const Scene shown = lobed_ball(a, method);
            double worst = 0;
            const int directions = 96;
            for (int i = 0; i < directions; ++i) {
                const double angle = 2 * pi * i / directions, truth = 1 + a * std::cos(lobes * angle);
                worst = std::max(worst, std::abs(contour(shown, angle) - truth));
            }
            rows.push_back({method, a, worst / pixel, displaced ? 0.0 : a / pixel,
                            displaced ? "displaced: the contour is the relief's"
                                      : "bump and normal maps: the contour stays that of the mesh; displace for it"});
        }
    }
    return rows;
}

/// Share of a period of a sin(k x) that gets no light of a sun at the height `e` in the plane of the waves: from the crest's
/// tangent point, where the slope is -tan e, to where its ray meets the next flank.
double shadowed_share(double steepest, double tan_e) {
    if (tan_e >= steepest) return 0;
    const auto wave = [&](double x) { return steepest * std::sin(x); };
    const double from = std::acos(-tan_e / steepest);
    const auto gap = [&](double x) { return wave(from) - tan_e * (x - from) - wave(x); };
    // The ray is above the waves from its tangent point until it meets the next flank.
    double above = 2 * pi - from, below = from + 2 * pi; // the flank's own tangent points are the end of the search
    for (int i = 0; i < 60; ++i) {
        const double x = 0.5 * (above + below);
        (gap(x) > 0 ? above : below) = x;
    }
    return (0.5 * (above + below) - from) / (2 * pi);
}

/// The same for bump mapping, which is dark only where the normal faces away from the light.
double away_share(double steepest, double tan_e) { return tan_e >= steepest ? 0 : std::acos(tan_e / steepest) / pi; }

constexpr int ridges = 4;

/// Share of points in the middle period that get no light, from a plane of waves of the slope 1.
double dark_share(const Scene& scene, int points) {
    int dark = 0;
    for (int i = 0; i < points; ++i) {
        const float x = float((i + 0.5) / points * 2 / ridges);
        const PrimaryHit hit = trace_one(scene, {Vec3f(x, 0.01f, 4), Vec3f(0, 0, -1)}, 0, Sampler(i, 0, 0));
        dark += !(hit.radiance.diffuse.x > 0);
    }
    return double(dark) / points;
}

std::vector<Row> self_shadow_rows(int steps) {
    std::vector<Row> rows;
    // Whole waves over the plane, which is 2 long.
    const HeightTexture waves =
        heights(64 * ridges, 2, [&](double u, double) { return std::sin(2 * pi * ridges * u) / (pi * ridges); });
    for (const char* method : {"displace:256", "exact"}) {
        Scene scene = relief_scene(plane_mesh(), waves, method, Wrap::repeat);
        build(scene);
        const bool displaced = std::string(method) != "exact";
        for (const double e : linear_steps(4, 80, steps)) {
            const double tan_e = std::tan(e * pi / 180);
            scene.lights = {directional({float(-std::cos(e * pi / 180)), 0, float(std::sin(e * pi / 180))})};
            rows.push_back({displaced ? "displaced" : "bump", e, dark_share(scene, 2000),
                            displaced ? shadowed_share(1, tan_e) : away_share(1, tan_e),
                            e < 45 ? "displaced relief shadows itself; bump is dark only where it faces away"
                                   : "no shadow: the sun is higher than the steepest slope"});
        }
    }
    return rows;
}

/// Angle from the terminator within which a coarse sphere with smooth normals has dark points that face the light.
double false_shadow_deg(int columns) {
    Scene scene = one_mesh(sphere_mesh(columns, columns / 2), Material{});
    const Vec3f sun = glm::normalize(Vec3f(1, 0.3f, 0.4f));
    scene.lights.push_back(directional(sun));
    build(scene);
    double worst = 0;
    const int rays = 120;
    for (int y = 0; y < rays; ++y)
        for (int x = 0; x < rays; ++x) {
            const Ray ray{{float(2.0 * (x + 0.5) / rays - 1), float(2.0 * (y + 0.5) / rays - 1), 4}, {0, 0, -1}};
            const PrimaryHit seen = trace_one(scene, ray, 0, Sampler(x, y, 0));
            if (!seen.first.hit || seen.radiance.diffuse.x > 0) continue;
            worst = std::max(worst, std::asin(std::min(1.0, double(glm::dot(seen.first.normal, sun)))) * 180 / pi);
        }
    return worst;
}

std::vector<Row> facet_rows(int steps) {
    std::vector<Row> rows;
    for (const double x : geometric_steps(8, 256, steps)) {
        const int columns = 2 * int(std::lround(x / 2));
        rows.push_back({"", double(columns), false_shadow_deg(columns), 0.0,
                        "shadow rays start on the smooth surface: Hanika's offset"});
    }
    return rows;
}

} // namespace

std::vector<Sweep> shadow_sweeps() {
    return {
        {.name = "silhouette",
         .construction =
             "a ball with six lobes of the height x along its equator, seen along its poles, 205 pixels per "
             "radius: largest error of the contour",
         .x_label = "height over radius",
         .y_label = "pixels",
         .log_x = true,
         .log_y = true,
         .limit = 1,
         .closed_form = "bump: the projected height over the size of a pixel; displaced: 0",
         .test = "stability/shadow_test",
         .rows = silhouette_rows},
        {.name = "self_shadow",
         .construction = "waves of slope 1 under a sun in their plane: share of a period without light",
         .x_label = "height of the sun (deg)",
         .y_label = "share",
         .limit = 0.001,
         .falls = true,
         .closed_form = "displaced: from the crest's tangent point to the next flank; bump: acos(tan e / slope) / pi; "
                        "none from the height atan(slope) on",
         .test = "stability/shadow_test",
         .rows = self_shadow_rows},
        {.name = "facet_shadow",
         .construction = "a smooth sphere of x columns: largest angle above the terminator of a point in the dark",
         .x_label = "columns",
         .y_label = "angle (deg)",
         .log_x = true,
         .limit = 1,
         .closed_form = "0; without the offset half the angle of a facet, 180 / columns",
         .test = "stability/shadow_test",
         .rows = facet_rows},
    };
}

} // namespace stability
