// Relief that becomes smaller than a pixel: means of normals lose the slopes, moments keep their variance.
#include "preview/little_scenes.h"
#include "stability/themes.h"

using namespace bake;
using namespace bake::test;

namespace stability {
namespace {

constexpr double steepest = 0.2, sun_deg = 20;
constexpr float exponent = 50;
constexpr int texels = 16; ///< per wave

/// Waves along u, or along both axes.
Material wavy(bool both) {
    Material material;
    material.reflectance.ambient = Vec3f(0), material.reflectance.diffuse = Vec3f(0);
    material.reflectance.model = Reflectance::Model::blinn;
    material.reflectance.specular = Vec3f(1), material.reflectance.shininess = exponent;
    // 16 waves; one repeat of the table is one unit of uv, which seen() makes one unit of length.
    material.bump_table = texture(16 * texels, 16 * texels, 2, [both](float u, float v, float* to) {
        to[0] = float(steepest * std::cos(2 * pi * 16 * double(u)));
        to[1] = both ? float(steepest * std::cos(2 * pi * 16 * double(v))) : 0;
    });
    return material;
}

/// Mean radiance of a plane of many waves whose pixels are `per_pixel` texels wide, one sample each.
double seen(const Material& material, double per_pixel, TextureFilter filter) {
    Mesh mesh = plane_mesh();
    const float size = 4096;
    for (Vec3f& p : mesh.positions) p *= size / 2;
    for (Vec2f& uv : mesh.uvs) uv *= size;
    Scene scene = one_mesh(std::move(mesh), material);
    scene.settings.filter = filter, scene.settings.spp = 1;
    scene.settings.width = scene.settings.height = 64;
    scene.camera.orthographic = true, scene.camera.view_height = float(64 * per_pixel / (16 * texels));
    scene.camera.position = Vec3f(0.37f, 0.21f, 4), scene.camera.target = Vec3f(0.37f, 0.21f, 0);
    scene.lights = {directional({float(std::sin(sun_deg * pi / 180)), 0, float(std::cos(sun_deg * pi / 180))})};
    build(scene);
    const Image<float> picture = render(scene, scene.settings);
    double sum = 0;
    for (std::size_t i = 0; i < picture.size(); ++i) sum += double(picture.data()[i]);
    return sum / double(picture.size());
}

/// The mean over the waves of the highlight of slopes that are at most `size`.
double mean_highlight(double size, bool both) {
    const double half = sun_deg / 2 * pi / 180;
    double sum = 0;
    const int points = 128;
    for (int j = 0; j < points; ++j)
        for (int i = 0; i < points; ++i) {
            const double u = size * std::cos(2 * pi * (i + 0.5) / points);
            const double v = both ? size * std::cos(2 * pi * (j + 0.5) / points) : 0;
            const double cosine = (std::cos(half) - u * std::sin(half)) / std::sqrt(1 + u * u + v * v);
            sum += std::pow(std::max(0.0, cosine), double(exponent));
        }
    return sum / (points * points);
}

std::vector<Row> highlight_rows(int steps) {
    std::vector<Row> rows;
    for (const bool both : {true, false}) {
        const Material material = wavy(both);
        const double truth = mean_highlight(steepest, both);
        for (const auto& [name, filter] :
             {std::pair("mean slopes", TextureFilter::mips), {"moments", TextureFilter::moments}})
            for (const double x : geometric_steps(1, 1000, steps)) {
                const bool moments = filter == TextureFilter::moments;
                // A box that is x texels wide leaves waves that are sin(w) / w as high.
                const double w = pi * x / texels, left = steepest * std::abs(std::sin(w) / w);
                rows.push_back({std::string(name) + (both ? ", both axes" : ", one axis"), x,
                                std::abs(seen(material, x, filter) / truth - 1),
                                moments ? std::optional<double>() : std::abs(mean_highlight(left, both) / truth - 1),
                                moments ? "filter = moments, the default: the highlight is widened alike along all axes"
                                        : "filter = mips: the highlight of the mean slope"});
            }
    }
    return rows;
}

/// Variance of slopes that lookups take out of a wave of x radians per half texel: measured in the means of the mips.
std::vector<Row> variance_rows(int steps) {
    const Material material = wavy(false);
    const auto mips = slope_mips(*material.bump_table);
    std::vector<Row> left, all;
    const double whole = 0.5 * steepest * steepest;
    for (const double x : geometric_steps(1, 256, steps)) {
        double mean2 = 0, variance = 0;
        const int points = 256;
        for (int i = 0; i < points; ++i) {
            const Vec2f uv((float(i) + 0.5f) / float(points), 0.5f);
            const Footprint print{Vec2f(float(x) / float(16 * texels), 0), Vec2f(0, float(x) / float(16 * texels))};
            const SlopeMoments m = moments_over(*mips, taps_of(*mips, uv, print),
                                                [&](const Vec2f& p) { return lookup2(*material.bump_table, p); });
            mean2 += double(m.mean.x) * double(m.mean.x) / points, variance += double(m.covariance.x) / points;
        }
        const double w = pi * x / texels;
        left.push_back({"left in the mean slope", x, mean2 / whole, std::pow(std::sin(w) / w, 2),
                        "what the mean loses is kept as variance"});
        all.push_back({"mean and variance together", x, (mean2 + variance) / whole, 1.0,
                       "what the mean loses is kept as variance"});
    }
    left.insert(left.end(), all.begin(), all.end());
    return left;
}

} // namespace

std::vector<Sweep> minification_sweeps() {
    return {
        {.name = "minified_highlight",
         .construction =
             "waves of slope .2 and of 16 texels under a highlight of exponent 50; x texels per pixel, one sample: "
             "error of the brightness",
         .x_label = "texels per pixel",
         .y_label = "relative error of the mean radiance",
         .log_x = true,
         .log_y = true,
         .limit = 0.06,
         .closed_form = "mean slopes: the highlight of slopes times sin(w) / w, w = pi x / 16, as a box leaves them; "
                        "mips are up to twice as wide",
         .test = "stability/minification_test",
         .rows = highlight_rows},
        {.name = "minified_variance",
         .construction = "the same waves: share of E[s^2] that a lookup over x texels has",
         .x_label = "texels per lookup",
         .y_label = "share of E[s^2]",
         .log_x = true,
         .limit = 0.5,
         .falls = true,
         .closed_form =
             "of a box (sin(w) / w)^2, w = pi x / 16; mips are up to twice as wide; together 1 at every width",
         .test = "stability/minification_test",
         .rows = variance_rows},
    };
}

} // namespace stability
