// What the skies of little scenes are reduced to.
#include "bake/base/parallel.h"
#include "bake/verdict/plan/scene_twin.h"
#include "bake/verdict/plan/sky_plan.h"
#include "bake/verdict/plan/sky_use.h"
#include "preview/little_scenes.h"
#include "preview/sky_of.h"
#include <doctest/doctest.h>

using namespace bake;
using namespace bake::test;

namespace {

/// Of the bands 0 to 2.
double smooth_sky(const Vec3d& d) { return 0.3 + 0.15 * d.y + 0.1 * (1.5 * d.x * d.x - 0.5); }
/// Stripes of `count` periods over the half circle, as sharp as texels allow.
auto stripes(int count) {
    return [count](const Vec3d& d) { return std::sin(2 * count * std::asin(d.y)) > 0 ? 0.6 : 0.1; };
}

Material gloss(Reflectance::Model model, float sharpness) {
    Material material;
    material.reflectance.model = model;
    material.reflectance.diffuse = Vec3f(0.2f), material.reflectance.specular = Vec3f(0.7f);
    material.reflectance.shininess = material.reflectance.roughness = sharpness;
    return material;
}

/// A ball, or a wall that fills the picture.
Scene under(Cube cube, Material material, bool wall = false) {
    Scene scene = one_mesh(wall ? plane_mesh() : sphere_mesh(48, 24), std::move(material));
    if (wall) scene.camera.position.z = 1;
    scene.settings.width = scene.settings.height = 32;
    scene.sky.cube = std::move(cube);
    build(scene);
    return scene;
}

PartOptions options(double budget) {
    PartOptions out;
    out.budget = budget;
    out.rule.most = 1024;
    return out;
}

Vec3d mean_of(const Cube& cube) {
    double sum = 0;
    for (const Image<float>& face : cube.faces)
        for (std::size_t i = 0; i < face.size(); ++i) sum += double(face.data()[i]);
    return Vec3d(sum / (18.0 * cube.size() * cube.size()));
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("sky plan: a constant sky is found constant") {
        const Scene scene =
            under(constant_cube({0.4f, 0.5f, 0.6f}, 16), gloss(Reflectance::Model::normalised_phong, 50));
        const auto plan = plan_sky(scene, options(0.001));
        REQUIRE(plan);
        CHECK(plan->model == "constant");
        CHECK(plan->error.rmse() < 1e-6);
        CHECK(plan->bytes == 6);
        CHECK(plan->source_face == 16);
        CHECK(plan->source_bytes == 6 * 6 * (256 + 64 + 16 + 4 + 1));
    }

    TEST_CASE("sky plan: a sky of three bands is found as spherical harmonics of three bands") {
        const Scene scene = under(sky_of(64, smooth_sky), gloss(Reflectance::Model::normalised_phong, 20));
        const auto plan = plan_sky(scene, options(0.002));
        REQUIRE(plan);
        CHECK(plan->model == "sh:3");
        CHECK(plan->bytes == 9 * 3 * 4);
        const Cube sky = reduced(copied(scene.sky.cube), reduction_of(*plan));
        CHECK(sky.size() == plan->face);
        CHECK(mean_of(sky).x == doctest::Approx(mean_of(scene.sky.cube).x).epsilon(0.002));
    }

    TEST_CASE("sky plan: a mirror keeps the full size, a rough wall does not") {
        const auto face = [](Material material) {
            const Scene scene = under(sky_of(64, stripes(16)), std::move(material), true);
            const auto plan = plan_sky(scene, options(0.01));
            REQUIRE(plan);
            return plan->model == "faces" ? plan->face : 1;
        };
        CHECK(face(mirror()) == 64);
        CHECK(face(gloss(Reflectance::Model::normalised_phong, 10)) <= 16);
        CHECK(face(gloss(Reflectance::Model::ggx, 0.6f)) <= 16);
    }

    TEST_CASE("sky plan: a sky that cameras see counts, one that nothing shows does not") {
        Scene scene = under(sky_of(64, stripes(16)), gloss(Reflectance::Model::blinn, 10));
        scene.settings.sky_light = SkyLighting::off;
        const std::vector<PartOptions::View> views = views_of(scene, {});
        CHECK(sky_use(scene, views).seen);
        CHECK(!sky_use(scene, views).lit);
        CHECK(plan_sky(scene, options(0.005))->model == "faces");
        scene.camera.position.z = 1.2f; // nothing but the ball is in the picture
        CHECK(!sky_use(scene, views_of(scene, {})).any());
        const auto plan = plan_sky(scene, options(0));
        CHECK(plan->model == "constant");
        CHECK(plan->error.all);
        CHECK(!plan_sky(one_mesh(plane_mesh(), {}), {}));
    }

    TEST_CASE("sky plan: without a budget the sky stays as it is") {
        const Scene scene = under(sky_of(16, stripes(3)), mirror(), true);
        const auto plan = plan_sky(scene, options(0));
        CHECK(plan->face == 16);
        CHECK(plan->bytes == plan->source_bytes);
        CHECK(plan->error.rmse() == 0);
    }

    TEST_CASE("sky plan: filtered light is computed anew for each sky") {
        Scene scene = under(sky_of(16, smooth_sky), gloss(Reflectance::Model::ggx, 0.8f), true);
        scene.settings.width = scene.settings.height = 12;
        scene.settings.sky_light = SkyLighting::irradiance;
        build(scene);
        const auto plan = plan_sky(scene, options(0.0005));
        CHECK(plan->model == "sh:3"); // a constant one errs
    }

    TEST_CASE("lobe width: of Phong, Blinn and ggx, in radians about the mirror direction") {
        CHECK(lobe_width({.kind = LobeKind::phong, .exponent = 50}) == doctest::Approx(1 / std::sqrt(50.0)));
        CHECK(lobe_width({.kind = LobeKind::blinn, .exponent = 200}) == doctest::Approx(1 / std::sqrt(50.0)));
        // GGX about the mirror direction: K falls as 1 / (1 + kappa t)^2 with kappa = 1 / (2 alpha^2), so the width is
        // about sqrt 2 alpha.
        CHECK(lobe_width({.kind = LobeKind::ggx, .roughness = 0.25f}) ==
              doctest::Approx(std::sqrt(2.0) / 16).epsilon(0.01));
        CHECK(lobe_width({.kind = LobeKind::lambert}) == 2);
        CHECK(lobe_width({.kind = LobeKind::mirror}) == 0);
        CHECK(face_for(0, 256) == 256);
        CHECK(face_for(2, 256) == 4);
    }

    TEST_CASE("sky plan: the same for any number of threads") {
        const Scene scene = under(sky_of(32, stripes(4)), gloss(Reflectance::Model::phong, 20));
        const auto plan = plan_sky(scene, options(0.01));
        const ThreadLimit one(1);
        const auto again = plan_sky(scene, options(0.01));
        CHECK(plan->why == again->why);
        CHECK(plan->error.square == again->error.square);
    }
}
