// What must come out when ways of showing a relief are compared with true displacement: cases whose answer is known.
#include "bake/preview/relief_method.h"
#include "bake/preview/render.h"
#include "bake/surface/analytic/parametric.h"
#include "bake/surface/patch/base_surface.h"
#include "oracle/surfaces.h"
#include "preview/little_scenes.h"
#include <doctest/doctest.h>

using namespace bake;
using namespace bake::test;

namespace {

/// Values are lengths.
HeightTexture height_picture(int width, int height, const std::function<double(double, double)>& at) {
    HeightTexture picture;
    picture.values = Image<float>(width, height, 1);
    picture.info.type = SampleType::float32;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) picture.values.at(x, y) = float(at((x + 0.5) / width, 1 - (y + 0.5) / height));
    return picture;
}

HeightTexture egg_box(int texels, double amplitude, int waves) {
    return height_picture(texels, texels, [&](double u, double v) {
        return amplitude * std::sin(2 * pi * waves * u) * std::sin(2 * pi * waves * v);
    });
}

/// The mesh with its relief, white, under a directional light, seen by a parallel camera; without shadows and filters.
Scene relief_scene(Mesh mesh, const HeightTexture& height, const std::string& word) {
    Scene scene;
    scene.shapes.push_back(make_shape(std::move(mesh)));
    Material white;
    white.reflectance.diffuse = Vec3f(1);
    ReliefModel model = with_relief(white, *scene.shapes[0], height,
                                    {.method = parse_shade(word).value(),
                                     .height = {.amplitude = 1, .midlevel = 0},
                                     .filter = Filter::c2,
                                     .mips = false});
    scene.materials.push_back(std::make_unique<Material>(std::move(model.material)));
    if (model.shape) scene.shapes.push_back(std::move(model.shape));
    add_instance(scene, *scene.shapes.back(), *scene.materials[0]);
    scene.lights = {directional(Vec3f(1, 0.5f, 1.5f))};
    scene.settings.shadows = false;
    scene.settings.filter = TextureFilter::off;
    scene.settings.width = scene.settings.height = 24;
    scene.settings.spp = 32;
    scene.camera.orthographic = true;
    scene.camera.position = Vec3f(0, 0, 4);
    scene.camera.view_height = 1.6f;
    return scene;
}

Halves shown(Scene& scene) {
    build(scene);
    return render_halves(scene, scene.settings);
}

double root_mean_square(const Halves& x, const Halves& y) {
    return std::sqrt(std::max(0.0, mean_square_difference(x, y)));
}

/// Of pictures of the plane, whose camera is turned by an angle about the vertical.
double error_on_plane(const std::string& a, const std::string& b, const HeightTexture& height, int cells,
                      double view_deg) {
    const auto picture = [&](const std::string& word) {
        Scene scene = relief_scene(plane_mesh(cells), height, word);
        const double angle = view_deg * pi / 180;
        scene.camera.position = Vec3f(Vec3d(4 * std::sin(angle), 0, 4 * std::cos(angle)));
        if (view_deg > 0) scene.camera.view_height = 0.8f; // the plane still fills the picture
        return shown(scene);
    };
    return root_mean_square(picture(a), picture(b));
}

/// Coverage of the pixels of a ball of radius 1, 32 pixels per unit, seen against `from`.
Image<float> coverage(const HeightTexture& height, const std::string& word, const Vec3f& from) {
    Scene scene = relief_scene(sphere_mesh(96, 48), height, word);
    scene.camera.position = from;
    scene.camera.view_height = 3;
    scene.settings.width = scene.settings.height = 96;
    scene.settings.spp = 8;
    build(scene);
    const Image<float> layers = render_layers(scene, scene.settings);
    Image<float> alpha(96, 96, 1);
    for (int y = 0; y < 96; ++y)
        for (int x = 0; x < 96; ++x) alpha.at(x, y) = (&layers.at(x, y))[3];
    return alpha;
}

/// Area between two silhouettes, in square units.
double area_between(const Image<float>& a, const Image<float>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(double(a.data()[i]) - double(b.data()[i]));
    return sum / (32 * 32);
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("known truth: on a plane at normal incidence, in parallel light without shadows, bump is displacement") {
        // Parallel rays meet p + b n and p at the same uv, so that only normals count, and on a plane all methods have the
        // same. What remains is the displaced mesh: its interpolated normals are wrong by h^2 / 8 times their second derivative.
        const HeightTexture height = egg_box(256, 0.08, 2);
        Scene scene = relief_scene(plane_mesh(4), height, "displace:64");
        const Halves displaced = shown(scene);
        const Halves same_scene_other_samples = [&] {
            scene.settings.seed = 1;
            return render_halves(scene, scene.settings);
        }();
        double noise =
            0; // of one picture: the squares of the differences of independent pictures are twice its variance
        for (std::size_t i = 0; i < displaced.a.size(); ++i)
            noise += std::pow(double(displaced.a.data()[i]) - double(same_scene_other_samples.a.data()[i]), 2) / 2;
        noise = std::sqrt(noise / double(displaced.a.size()));
        Scene plain = relief_scene(plane_mesh(4), height, "plain");
        CHECK(root_mean_square(shown(plain), displaced) > 0.1);
        for (const char* word : {"constant-scale", "blinn", "exact", "bump", "normal", "displace+normal:16"}) {
            Scene other = relief_scene(plane_mesh(4), height, word);
            const double error = root_mean_square(shown(other), displaced);
            MESSAGE(std::string(word) << ": " << error << ", sampling noise " << noise);
            CHECK(error < 0.5 * noise);
            CHECK(error < 5e-4);
        }
        // The remainder belongs to the mesh: half the edges, four times the error.
        const double coarse = error_on_plane("exact", "displace:16", height, 4, 0);
        CHECK(coarse / error_on_plane("exact", "displace:32", height, 4, 0) == doctest::Approx(4).epsilon(0.15));
        // At an angle the ray meets the displaced plane elsewhere.
        CHECK(error_on_plane("exact", "displace:64", height, 4, 45) > 0.03);
    }

    TEST_CASE("known truth: a bump table, by the surface gradient, is blinn's normal but for its interpolation") {
        const auto ball = [](const char* word, int texels) {
            const auto height = height_picture(texels, texels / 2, [](double u, double v) {
                return 0.05 * std::sin(2 * pi * 6 * u) * std::pow(std::sin(pi * v), 2);
            });
            Scene scene = relief_scene(sphere_mesh(96, 48), height, word);
            scene.camera.view_height = 1.4f;
            return shown(scene);
        };
        const Halves blinn = ball("blinn", 512);
        const double coarse = root_mean_square(ball("bump", 64), blinn),
                     fine = root_mean_square(ball("bump", 128), blinn);
        CHECK(fine < 0.01);
        CHECK(coarse / fine == doctest::Approx(4).epsilon(0.15)); // bilinear interpolation is of second order
    }

    TEST_CASE(
        "known truth: the normal of a displaced mesh, from its positions alone, tends to exact, and not to blinn") {
        // The diagonals of a quad give the normal at its centre up to second order in its edges.
        const ParametricSurface sphere("sphere:R=1");
        const auto value = [](const Vec3d& p) { return 0.06 * std::sin(3 * p.x + 1) * std::cos(4 * p.y) + 0.08; };
        const auto gradient = [](const Vec3d& p) {
            return Vec3d(0.18 * std::cos(3 * p.x + 1) * std::cos(4 * p.y),
                         -0.24 * std::sin(3 * p.x + 1) * std::sin(4 * p.y), 0);
        };
        const HeightTexture height =
            height_picture(512, 256, [&](double u, double v) { return value(sphere.jet(u, v).p); });
        const auto shape = make_shape(tessellate(sphere, 16, 8));
        shape->smooth = std::make_shared<const BaseSurface>(sphere, 16, 8);
        const auto mean_angle = [&](const std::string& word, NormalMethod method) {
            const ReliefModel model = with_relief(
                Material{}, *shape, height,
                {.method = parse_shade(word).value(), .height = {.amplitude = 1, .midlevel = 0}, .filter = Filter::c2});
            const Mesh& mesh = model.shape->mesh;
            double sum = 0;
            int count = 0;
            for (std::size_t f = 0; f < mesh.faces(); ++f) {
                const std::uint32_t first = mesh.face_begin[f];
                if (mesh.face_begin[f + 1] - first != 4) continue;
                const auto p = [&](int i) { return Vec3d(mesh.positions[mesh.corner_position[first + i]]); };
                Vec2d uv(0);
                for (int i = 0; i < 4; ++i) uv += 0.25 * Vec2d(mesh.uvs[mesh.corner_uv[first + i]]);
                const Jet<double> jet = sphere.jet(uv.x, uv.y);
                if (std::abs(jet.p.y) > 0.9) continue; // near a pole quads are thin
                const Vec3d slope = gradient(jet.p);
                const Height<double> h{value(jet.p), glm::dot(slope, jet.p_u), glm::dot(slope, jet.p_v)};
                sum += oracle::angle_deg(glm::cross(p(2) - p(0), p(3) - p(1)), displaced_normal(jet, h, method, {}));
                ++count;
            }
            return sum / count;
        };
        const double coarse = mean_angle("displace:4", NormalMethod::exact),
                     fine = mean_angle("displace:8", NormalMethod::exact);
        CHECK(coarse / fine == doctest::Approx(4).epsilon(0.1));
        CHECK(mean_angle("displace:16", NormalMethod::exact) < 0.05);
        CHECK(mean_angle("displace:16", NormalMethod::blinn) > 0.3); // |b * curvature| is up to 0.14
    }

    TEST_CASE("known truth: no method that only shades moves the silhouette, which is wrong by the projected height") {
        const auto constant = height_picture(64, 32, [](double, double) { return 0.1; });
        const auto lobes = height_picture(256, 128, [](double u, double) { return 0.1 * std::cos(2 * pi * 6 * u); });
        // Seen from above, the outline of the second has the radius 1 + h(u) of its equator.
        double between_lobes = 0;
        for (int i = 0; i < 3600; ++i) {
            const double h = 0.1 * std::cos(6 * 2 * pi * i / 3600);
            between_lobes += std::abs(h + h * h / 2) * 2 * pi / 3600;
        }
        const Vec3f ahead(0, 0, 4), above(0, 4, 0);
        const Image<float> ball = coverage(constant, "plain", ahead), ball_above = coverage(lobes, "plain", above);
        CHECK(area_between(coverage(constant, "displace:2", ahead), ball) == doctest::Approx(0.21 * pi).epsilon(0.01));
        CHECK(area_between(coverage(lobes, "displace:2", above), ball_above) ==
              doctest::Approx(between_lobes).epsilon(0.01));
        for (const char* word : {"constant-scale", "blinn", "exact", "bump", "bump+roughness", "normal"})
            CHECK(area_between(coverage(lobes, word, above), ball_above) == 0);
    }

    TEST_CASE("known truth: on a plane seen at a grazing angle, bump is worse than no relief beyond an amplitude") {
        // The grazing plane: 2 x 2, waves of 0.25 by 0.25, 72 degrees from the vertical, the sun 30 degrees above it.
        const auto ratio = [](double amplitude) {
            const HeightTexture height = egg_box(256, amplitude, 8);
            const auto picture = [&](const char* word) {
                Scene scene = relief_scene(plane_mesh(8), height, word);
                scene.lights = {directional(Vec3f(-0.75f, 0.43f, 0.5f))};
                scene.settings.shadows = true;
                scene.camera.position = Vec3f(3.8f, 0, 1.24f);
                scene.camera.view_height = 0.4f; // the plane fills the picture
                return shown(scene);
            };
            const Halves displaced = picture("displace:16");
            return root_mean_square(picture("bump"), displaced) / root_mean_square(picture("plain"), displaced);
        };
        // The shift of the picture grows with the amplitude, and with it the error, until nothing fits any more.
        const double low = ratio(0.005), beyond = ratio(0.08);
        CHECK(low == doctest::Approx(0.25).epsilon(0.1));
        CHECK(ratio(0.01) / low == doctest::Approx(2).epsilon(0.1));
        CHECK(beyond > 1.05);
        CHECK(beyond < 2.1);
    }

} // TEST_SUITE
