// How much tilted normals change the light: bounds against the lobes themselves.
#include "bake/verdict/plan/shading_bound.h"
#include "verdict/plan/bound_hunt.h"
#include <doctest/doctest.h>

using namespace bake;

namespace {

struct Lit {
    Scene scene;
    Material material;
    std::optional<ShadingBound> bound(const Vec3d& f, const ViewCone& view, float exposure = 0) const {
        return ShadingBound::of(scene, material, f, view, exposure);
    }
};

Lit lambert(double elevation, bool shadows) {
    Lit lit;
    lit.material.reflectance.diffuse = Vec3f(0.5f);
    lit.scene.lights = {test::directional(Vec3f(float(std::cos(elevation)), 0, float(std::sin(elevation))))};
    lit.scene.settings.shadows = shadows;
    return lit;
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("shading_bound: no normal within the slope changes what the lobes reflect by more") {
        test::Draw draw(3);
        double nearest = 0;
        for (int k = 0; k < 20000; ++k) {
            Lit lit;
            lit.material.reflectance = test::drawn_reflectance(draw);
            if (lit.material.reflectance.model == Reflectance::Model::ggx) continue;
            lit.scene.settings.shadows = false;
            const Vec3d f = draw.direction();
            lit.scene.lights = {test::directional(Vec3f(draw.direction()))};
            ViewCone view{draw.direction(), draw.chance(0.5) ? 0 : draw.between(0, 0.6)};
            if (glm::dot(view.axis, f) < 0) view.axis = -view.axis;
            // Half of the views are near the mirror direction, where the highlight is.
            if (draw.chance(0.5)) {
                const Vec3d l(lit.scene.lights[0].from);
                view.axis = glm::normalize(2 * glm::dot(l, f) * f - l + draw.between(0, 0.3) * draw.direction());
            }
            const Vec3d v = glm::normalize(view.axis + 0.99 * std::tan(view.angle) * draw.unit() *
                                                           unit_or_zero(glm::cross(view.axis, draw.direction())));
            const double g = draw.log_between(1e-4, 1), exposure = draw.between(-1, 1);
            const Vec3d across = unit_or_zero(glm::cross(f, draw.direction()));
            const Vec3d n = glm::normalize(f - (draw.chance(0.5) ? g : g * draw.unit()) * across);
            const Bsdf bsdf = make_bsdf(lit.material.reflectance);
            const auto shown = [&](const Vec3d& normal) {
                const BsdfValue value = evaluate(bsdf, Vec3f(normal), lit.scene.lights[0].from, Vec3f(v));
                return glm::clamp(std::exp2(exposure) * pi * Vec3d(value.diffuse + value.specular), Vec3d(0), Vec3d(1));
            };
            const auto bound = lit.bound(f, view, float(exposure));
            REQUIRE(bound);
            const Vec3d most = bound->change(g, g), change = glm::abs(shown(n) - shown(f));
            for (int c = 0; c < 3; ++c) {
                CHECK(change[c] <= most[c] + 1e-5 * (1 + lit.material.reflectance.shininess / 50));
                if (most[c] > 1e-3) nearest = std::max(nearest, change[c] / most[c]);
            }
        }
        CHECK(nearest > 0.95); // it is not loose everywhere
    }

    TEST_CASE("shading_bound: Lambert's change is g cos a, of second order under a light overhead") {
        const double g = 0.01;
        CHECK(lambert(0.5, false).bound({0, 0, 1}, {})->change(g, g).x ==
              doctest::Approx(0.5 * g * std::cos(0.5)).epsilon(0.01));
        CHECK(lambert(pi / 2, false).bound({0, 0, 1}, {})->change(g, g).x ==
              doctest::Approx(0.5 * g * g / 2).epsilon(0.01));
        CHECK(lambert(-0.5, true).bound({0, 0, 1}, {})->change(g, g) == Vec3d(0));
    }

    TEST_CASE("shading_bound: a low light may be shadowed, which takes all of its light") {
        const double low = 0.05;
        CHECK(lambert(low, false).bound({0, 0, 1}, {})->change(0.001, 0.1).x < 0.001);
        CHECK(lambert(low, true).bound({0, 0, 1}, {})->change(0.001, 0.1).x == doctest::Approx(0.5 * std::sin(low)));
        CHECK(lambert(low, true).bound({0, 0, 1}, {})->change(0.001, 0.02).x < 0.001); // below half its elevation
    }
}

TEST_SUITE("unit") {

    TEST_CASE("shading_bound: nothing is known of mirrors, skies, lamps, GGX and textures") {
        const Vec3d f(0, 0, 1);
        CHECK(Lit().bound(f, {}));
        const auto without = [&](auto change) {
            Lit lit;
            change(lit);
            return !lit.bound(f, {});
        };
        CHECK(without([](Lit& lit) { lit.material.reflect = Vec3f(0.1f); }));
        CHECK(without([](Lit& lit) { lit.material.reflectance.model = Reflectance::Model::ggx; }));
        CHECK(without([](Lit& lit) { lit.material.reflectance.model = Reflectance::Model::dielectric; }));
        CHECK(without([](Lit& lit) { lit.material.reflectance.subsurface = Vec3f(0.1f); }));
        CHECK(without(
            [](Lit& lit) { lit.material.reflectance.specular = Vec3f(1), lit.material.reflectance.shininess = 0.5f; }));
        CHECK(without([](Lit& lit) {
            lit.material.albedo = test::texture(2, 2, 3, [](float, float, float* c) { c[0] = c[1] = c[2] = 1; });
        }));
        CHECK(without([](Lit& lit) {
            lit.scene.lights.emplace_back();
            lit.scene.lights[0].kind = LightKind::point;
        }));
        CHECK(without([](Lit& lit) {
            lit.scene.sky.cube = test::constant_cube(Vec3f(1));
            build(lit.scene);
        }));
        CHECK_FALSE(without([](Lit& lit) {
            lit.scene.sky.cube = test::constant_cube(Vec3f(1));
            lit.scene.settings.sky_light = SkyLighting::off;
            build(lit.scene);
        }));
    }
}
