// Bounds of the error without relief, against the error that pictures show.
#include "verdict/plan/bound_hunt.h"
#include <doctest/doctest.h>

using namespace bake;

namespace {

/// A square of 2 units with a height, and the same displaced.
std::unique_ptr<test::HuntedScene> square(HeightTexture height, double amplitude, float height_of_view,
                                          const Vec3f& from, const Vec3f& sun) {
    auto out = std::make_unique<test::HuntedScene>();
    out->height = std::move(height);
    Material material;
    material.reflectance.diffuse = Vec3f(0.5f);
    test::add_relief(out->plain, test::plane_mesh(8), material, out->height, "plain");
    test::add_relief(out->truth, test::plane_mesh(8), material, out->height, "displace:16", float(amplitude));
    FactsInput& input = out->input;
    input.camera.position = 4.f * glm::normalize(from);
    input.camera.orthographic = true, input.camera.view_height = height_of_view;
    input.width = input.height = 32;
    input.scene = &out->plain, input.relief = &out->height;
    input.options.height = {.amplitude = amplitude, .midlevel = 0};
    for (Scene* scene : {&out->plain, &out->truth}) {
        scene->lights = {test::directional(sun)};
        build(*scene);
    }
    return out;
}

std::optional<ErrorBound> bound_of(const test::HuntedScene& scene, Shade shade = Shade::plain) {
    return error_bound(shade, scene.input, relief_facts(scene.input));
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("error_bound: random scenes do not refute it") {
        int bounds = 0;
        for (std::uint32_t seed = 20001; seed <= 20036; ++seed) {
            const auto scene = test::drawn_scene(seed, "displace:8");
            const test::Hunted found = test::hunt(*scene, 8);
            bounds += bool(found.bound);
            CHECK_MESSAGE(!found.refuted(), "seed " << seed << ": bound " << found.bound->rmse << " error "
                                                    << found.error.rmse() << " of " << scene->base);
        }
        CHECK(bounds > 15);
    }

    TEST_CASE("error_bound: two samples that happen to see a moved border in one pixel refute nothing") {
        const auto scene = test::drawn_scene(207, "displace:8");
        const auto bound = bound_of(*scene);
        REQUIRE(bound);
        const SquareEstimate first = test::measured_error(*scene, 8);
        CHECK(std::sqrt(first.square - 4 * first.error) > 2 * bound->rmse); // the coincidence is in these samples
        CHECK(test::repeated_error(*scene).high() < bound->rmse);
    }

    TEST_CASE("error_bound: of long waves that fill the picture it is less than twice the error") {
        const auto scene = square(test::eggs(1, 1, 64), 2e-3, 2, Vec3f(0, 0, 1), Vec3f(1, 0, 1));
        const auto bound = bound_of(*scene);
        REQUIRE(bound);
        const SquareEstimate error = test::measured_error(*scene);
        CHECK(error.low() > 0.5 * bound->rmse);
        CHECK(error.high() < bound->rmse);
        // k sin(2 pi u) has the slopes a pi cos(pi x) ..., of mean square (a pi)^2 / 4 along x.
        CHECK(error.rmse() == doctest::Approx(0.5 * std::sqrt(0.5) * 2e-3 * pi / 2).epsilon(0.05));
    }

    TEST_CASE("error_bound: a constant height only moves the border") {
        const auto scene =
            square(test::height_of(16, [](double, double) { return 1.0; }), 0.001, 4, Vec3f(1, 0, 1), Vec3f(0, 0, 1));
        const auto bound = bound_of(*scene);
        REQUIRE(bound);
        const SquareEstimate error = test::measured_error(*scene, 32);
        CHECK(error.rmse() < bound->rmse);
        CHECK(bound->rmse < 0.01);
        CHECK(bound->why.find("border") != std::string::npos);
        const auto inside =
            square(test::height_of(16, [](double, double) { return 1.0; }), 0.002, 0.5, Vec3f(1, 0, 1), Vec3f(0, 0, 1));
        CHECK(bound_of(*inside)->rmse < 2e-4);
        CHECK(bound_of(*inside)->why.find("border") == std::string::npos);
    }

    TEST_CASE("error_bound: it is no less than the error where the relief casts shadows") {
        const auto low = square(test::eggs(1, 3, 64), 0.01, 2, Vec3f(0, 0, 1), Vec3f(1, 0, 0.04f));
        const auto bound = bound_of(*low);
        REQUIRE(bound);
        CHECK(test::measured_error(*low).high() < bound->rmse);
        CHECK(relief_facts(low->input).sun_above_horizon_deg < 0);
    }
}

TEST_SUITE("unit") {

    TEST_CASE("error_bound: nothing is wrong where there is no height, or nothing to see") {
        const auto flat =
            square(test::height_of(8, [](double, double) { return 0.0; }), 1, 4, Vec3f(1, 0, 1), Vec3f(0, 0, 1));
        for (const Shade shade : {Shade::plain, Shade::roughness}) {
            REQUIRE(bound_of(*flat, shade));
            CHECK(bound_of(*flat, shade)->rmse == 0);
        }
        auto behind = square(test::eggs(1, 3, 64), 0.1, 4, Vec3f(1, 0, 1), Vec3f(0, 0, 1));
        behind->input.camera.target = 2.f * behind->input.camera.position;
        for (const Shade shade : {Shade::plain, Shade::bump, Shade::normal, Shade::displace}) {
            REQUIRE(bound_of(*behind, shade));
            CHECK(bound_of(*behind, shade)->rmse == 0);
        }
        // Just beside the picture the relief may reach into it.
        behind->input.camera.target = {0, 3.5f, 0}, behind->input.camera.position = Vec3f(0, 3.5f, 4);
        behind->input.camera.view_height = 4;
        CHECK_FALSE(relief_facts(behind->input).in_view);
        REQUIRE(bound_of(*behind));
        behind->input.options.height.amplitude = 2;
        CHECK_FALSE(bound_of(*behind, Shade::bump));
    }

    TEST_CASE("error_bound: nothing is known of other methods and other scenes") {
        const auto scene = square(test::eggs(1, 3, 64), 1e-4, 4, Vec3f(1, 0, 1), Vec3f(0, 0, 1));
        CHECK(bound_of(*scene));
        for (const Shade shade : {Shade::bump, Shade::normal, Shade::displace, Shade::roughness})
            CHECK_FALSE(bound_of(*scene, shade));
        Scene& plain = scene->plain;
        plain.shapes.push_back(make_shape(test::sphere_mesh(8, 4)));
        add_instance(plain, *plain.shapes.back(), *plain.materials[0]);
        build(plain);
        CHECK_FALSE(bound_of(*scene)); // the ball casts a shadow on it
    }
}

TEST_SUITE("stability") {

    TEST_CASE("error_bound: heights that are no numbers have none") {
        const auto scene = square(test::eggs(1, 3, 64), 1e-4, 4, Vec3f(1, 0, 1), Vec3f(0, 0, 1));
        scene->height.values.at(3, 4) = std::numeric_limits<float>::quiet_NaN();
        CHECK_FALSE(bound_of(*scene));
        scene->input.relief = nullptr;
        CHECK(bound_of(*scene)->rmse == 0);
    }
}
