// What a camera sees of a relief, against closed forms on planes and spheres.
#include "bake/base/parallel.h"
#include "bake/verdict/plan/relief_facts.h"
#include "verdict/compare/relief_pair.h"
#include <doctest/doctest.h>
#include <limits>

using namespace bake;

namespace {

/// A scene of one mesh without relief, and a height on it. The camera and the lights can be changed before facts().
struct Relief {
    Scene scene;
    HeightTexture height;
    FactsInput input;

    Relief(Mesh mesh, HeightTexture of, const Placement& placement = {}) : height(std::move(of)) {
        scene.shapes.push_back(make_shape(std::move(mesh), {.derivatives = false}));
        scene.materials.push_back(std::make_unique<Material>());
        add_instance(scene, *scene.shapes[0], *scene.materials[0], placement);
        build(scene);
        input.scene = &scene, input.relief = &height;
        input.options.height = {.amplitude = 1, .midlevel = 0};
        input.width = input.height = 200;
        look(Vec3f(0, 0, 4), 4);
    }
    /// An orthographic view of the centre, `height` world units high.
    void look(const Vec3f& from, float height_of_view, const Vec3f& at = Vec3f(0)) {
        input.camera.position = at + from, input.camera.target = at;
        input.camera.orthographic = true, input.camera.view_height = height_of_view;
    }
    ReliefFacts facts() const { return relief_facts(input); }
};

/// a cos(2 pi k u) cos(2 pi k v), which is largest on the border of the unit square.
HeightTexture waves(double a, int k, int size = 128) {
    return test::height_of(size,
                           [=](double u, double v) { return a * std::cos(2 * pi * k * u) * std::cos(2 * pi * k * v); });
}

HeightTexture constant(double b) {
    return test::height_of(8, [=](double, double) { return b; });
}

bool equal(const ReliefFacts& a, const ReliefFacts& b) {
    return a.height_px == b.height_px && a.contour_px == b.contour_px && a.most_slope == b.most_slope &&
           a.most_bend == b.most_bend && a.sun_above_horizon_deg == b.sun_above_horizon_deg &&
           a.texel_px == b.texel_px && a.in_view == b.in_view;
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("relief_facts: a plane under a slanting orthographic view") {
        Relief r(test::plane_mesh(4), waves(0.1, 3));
        const double angle = 0.7, px = 50; // of 200 pixels, 4 units high
        r.look(4.f * Vec3f(float(std::sin(angle)), 0, float(std::cos(angle))), 4);
        const double elevation = 50 * pi / 180;
        r.scene.lights = {test::directional(Vec3f(0, float(std::cos(elevation)), float(std::sin(elevation))))};
        const ReliefFacts f = r.facts();
        CHECK(f.in_view);
        CHECK(f.height_px == doctest::Approx(0.1 * std::sin(angle) * px).epsilon(0.02));
        CHECK(f.contour_px == doctest::Approx(f.height_px).epsilon(0.02)); // the border is a contour
        const double slope = 0.1 * pi * 3;                                 // an edge of 2 units has 3 waves
        CHECK(f.most_slope == doctest::Approx(slope).epsilon(0.02));
        CHECK(f.most_bend == doctest::Approx(0).epsilon(1e-9));
        CHECK(f.texel_px == doctest::Approx(2.0 / 128 * px * std::sqrt(std::cos(angle))).epsilon(0.01));
        CHECK(f.sun_above_horizon_deg == doctest::Approx(50 - std::atan(slope) * 180 / pi).epsilon(0.02));
    }

    TEST_CASE("relief_facts: a picture without the border has no contour") {
        Relief r(test::plane_mesh(4), waves(0.1, 3));
        r.look(Vec3f(1, 0, 4), 1);
        CHECK(r.facts().in_view);
        CHECK(r.facts().height_px > 1);
        CHECK(r.facts().contour_px == 0);
        CHECK(r.facts().sun_above_horizon_deg == 90); // no light
        // Large triangles of which a small part is seen.
        Relief one(test::plane_mesh(1), waves(0.1, 3));
        one.look(Vec3f(1e-2f, 0, 4), 1e-3f, Vec3f(0.3f, 0.3f, 0));
        CHECK(one.facts().in_view);
        CHECK(one.facts().height_px > 0);
    }

    TEST_CASE("relief_facts: a constant height on a sphere is largest at the contour, and bends by b / R") {
        Relief r(test::sphere_mesh(64, 32), constant(0.05));
        const ReliefFacts f = r.facts();
        CHECK(f.height_px == doctest::Approx(0.05 * 50).epsilon(0.01));
        CHECK(f.contour_px == doctest::Approx(f.height_px).epsilon(0.01));
        CHECK(f.most_bend == doctest::Approx(0.05).epsilon(0.02));
        CHECK(f.most_slope < 1e-6);
    }

    TEST_CASE("relief_facts: a bump of a ball is near the contour up to 3 pixels from it") {
        // u = 0 faces the camera, the contour is at u = 1/4 and 3/4, and the radius is 50 pixels.
        const auto bump = [](double at, double radius) {
            return Relief(test::sphere_mesh(64, 32), test::height_of(256, [=](double u, double v) {
                              return 0.1 * std::max(0.0, 1 - std::hypot(u - at, v - 0.5) / radius);
                          }));
        };
        const auto u_at = [](double px) { return std::acos(std::sqrt(2 * px / 50)) / (2 * pi); };
        CHECK(bump(0.5, 0.1).facts().contour_px == 0);
        CHECK(bump(0.5, 0.1).facts().height_px > 0.5);
        CHECK(bump(u_at(8), 0.02).facts().contour_px == 0);
        CHECK(bump(u_at(2), 0.03).facts().contour_px > 1); // but not on it
        CHECK(bump(0.25, 0.03).facts().contour_px > 3);
    }

    TEST_CASE("relief_facts: in perspective a point that rises moves away from the middle") {
        Relief r(test::plane_mesh(8), constant(0.1));
        r.input.camera.orthographic = false;
        r.input.camera.fov_deg = 40;
        const double scale = 100 / std::tan(20 * pi / 180);
        const double corner = std::sqrt(2.0) * scale * (1 / 3.9 - 1 / 4.0);
        CHECK(r.facts().height_px == doctest::Approx(corner).epsilon(0.02));
    }
}

TEST_SUITE("unit") {

    TEST_CASE("relief_facts: facts do not change with the unit of length") {
        const Relief small(test::sphere_mesh(), waves(0.02, 4));
        Relief large(test::sphere_mesh(), waves(0.02, 4), {.scale = Vec3f(3)});
        large.look(Vec3f(0, 0, 12), 12);
        const ReliefFacts a = small.facts(), b = large.facts();
        CHECK(b.height_px == doctest::Approx(a.height_px).epsilon(1e-4));
        CHECK(b.contour_px == doctest::Approx(a.contour_px).epsilon(1e-4));
        CHECK(b.most_slope == doctest::Approx(a.most_slope).epsilon(1e-4));
        CHECK(b.texel_px == doctest::Approx(a.texel_px).epsilon(1e-4));
    }

    TEST_CASE("relief_facts: far from the origin they are the same") {
        const Relief near(test::sphere_mesh(), waves(0.02, 4));
        Relief far(test::sphere_mesh(), waves(0.02, 4), {.translate = Vec3f(5e4f, 0, 0)});
        far.look(Vec3f(0, 0, 4), 4, Vec3f(5e4f, 0, 0));
        REQUIRE(far.scene.origin != Vec3f(0));
        CHECK(far.facts().height_px == doctest::Approx(near.facts().height_px).epsilon(1e-3));
        CHECK(far.facts().texel_px == doctest::Approx(near.facts().texel_px).epsilon(1e-3));
    }

    TEST_CASE("relief_facts: light on a ball always grazes it somewhere, unless it comes from behind the camera") {
        Relief r(test::sphere_mesh(), waves(0.001, 2));
        r.scene.lights = {test::directional(Vec3f(1, 0, 0.2f))};
        const double horizon = std::atan(r.facts().most_slope) * 180 / pi;
        CHECK(r.facts().sun_above_horizon_deg < 0);
        CHECK(r.facts().sun_above_horizon_deg > -2 * horizon - 0.1);
    }

    TEST_CASE("relief_facts: the same for any number of threads") {
        Relief r(test::sphere_mesh(), waves(0.02, 4));
        r.scene.lights = {test::directional(Vec3f(1, 1, 1))};
        const ReliefFacts all = r.facts();
        const ThreadLimit one(1);
        CHECK(equal(all, r.facts()));
    }
}

TEST_SUITE("stability") {

    TEST_CASE("relief_facts: what cannot be seen has no size") {
        Relief r(test::sphere_mesh(16, 8), waves(0.02, 4));
        r.input.camera.target = Vec3f(0, 0, 8); // the ball is behind it
        CHECK(equal(r.facts(), ReliefFacts{}));
        r.input.camera.target = r.input.camera.position; // a camera without direction
        CHECK_FALSE(r.facts().in_view);
    }

    TEST_CASE("relief_facts: heights that are no numbers, no uvs, no height and no triangles do no harm") {
        HeightTexture bad = waves(0.02, 4);
        for (int x = 0; x < 64; ++x) bad.values.at(x, 20) = std::numeric_limits<float>::quiet_NaN();
        const ReliefFacts f = Relief(test::plane_mesh(), std::move(bad)).facts();
        CHECK(std::isfinite(f.height_px + f.contour_px + f.most_slope + f.most_bend + f.texel_px));
        Mesh plain = test::plane_mesh();
        plain.uvs.clear(), plain.corner_uv.clear();
        const ReliefFacts no_uvs = Relief(std::move(plain), waves(0.02, 4)).facts();
        CHECK(no_uvs.in_view);
        CHECK(no_uvs.height_px == 0);
        Relief none(test::plane_mesh(), waves(0.02, 4));
        none.input.relief = nullptr;
        CHECK(none.facts().in_view);
        CHECK(none.facts().most_slope == 0);
        CHECK(equal(Relief(Mesh(), waves(0.02, 4)).facts(), ReliefFacts{}));
    }
}
