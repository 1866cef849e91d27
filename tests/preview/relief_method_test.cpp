// Every way of showing a relief, against the closed form of the displaced normal.
#include "bake/base/error.h"
#include "bake/preview/relief_method.h"
#include "bake/preview/shape_mesh.h"
#include "preview/little_scenes.h"
#include <doctest/doctest.h>

using namespace bake;
using namespace bake::test;

namespace {

constexpr float big = 2, small = 0.7f;

/// The torus of ../ORACLES: z is its axis, u runs around it, v around the tube.
Mesh torus_mesh(int columns, int rows) {
    return grid_mesh(columns, rows, [](float u, float v, Vec3f& p, Vec3f& n) {
        const double a = 2 * pi * u, b = 2 * pi * v;
        n = Vec3f(Vec3d(std::cos(b) * std::cos(a), std::cos(b) * std::sin(a), std::sin(b)));
        p = Vec3f(big * std::cos(a), big * std::sin(a), 0) + small * n;
    });
}

/// b = .1 sin 5u cos 4v + .03 in radians, as a float height whose values are lengths.
HeightTexture waves(int size) {
    HeightTexture height;
    height.values = Image<float>(size, size, 1);
    height.info.type = SampleType::float32;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const double u = 2 * pi * (x + 0.5) / size, v = 2 * pi * (1 - (y + 0.5) / size);
            height.values.at(x, y) = float(0.1 * std::sin(5 * u) * std::cos(4 * v) + 0.03);
        }
    return height;
}

/// The exact displaced normal at (u, v) in radians.
Vec3d exact_normal(double u, double v) {
    const double b = 0.1 * std::sin(5 * u) * std::cos(4 * v) + 0.03;
    const double b_u = 0.5 * std::cos(5 * u) * std::cos(4 * v), b_v = -0.4 * std::sin(5 * u) * std::sin(4 * v);
    const Vec3d n(std::cos(v) * std::cos(u), std::cos(v) * std::sin(u), std::sin(v));
    const Vec3d e_u(-std::sin(u), std::cos(u), 0),
        e_v(-std::sin(v) * std::cos(u), -std::sin(v) * std::sin(u), std::cos(v));
    return glm::normalize(n - b_u / (big + (small + b) * std::cos(v)) * e_u - b_v / (small + b) * e_v);
}

ReliefModel model(const std::string& word, const Shape& shape, const HeightTexture& height) {
    ReliefOptions options{
        .method = parse_shade(word).value(), .height = {.amplitude = 1, .midlevel = 0}, .filter = Filter::c2};
    return with_relief(Material{}, shape, height, options);
}

/// Mean angle in degrees between shading normals over the surface and the closed form.
double mean_error(const std::string& word, const Shape& shape, const HeightTexture& height) {
    const ReliefModel m = model(word, shape, height);
    if (m.material.normal_map && !m.shape) add_tangents(const_cast<Shape&>(shape));
    const Shape& shown = m.shape ? *m.shape : shape;
    double sum = 0;
    int count = 0;
    const std::size_t triangles = shown.surface.triangles.size();
    for (std::size_t i = 0; i < triangles; i += 1 + triangles / 4000, ++count) {
        const ShapePoint at{std::uint32_t(i), 0.3f, 0.35f};
        const Vec2d uv = 2 * pi * Vec2d(uv_at(shown, at));
        sum += angle_deg(shading_normal(m.material, shown, at), Vec3f(exact_normal(uv.x, uv.y)));
    }
    return sum / count;
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("relief method: the mean error of each normal on a torus, from the best to none at all") {
        const auto shape = make_shape(torus_mesh(128, 64));
        const HeightTexture height = waves(512);
        const double exact = mean_error("exact", *shape, height), blinn = mean_error("blinn", *shape, height);
        const double scale = mean_error("constant-scale", *shape, height), plain = mean_error("plain", *shape, height);
        const double bump = mean_error("bump", *shape, height), normal = mean_error("normal", *shape, height);
        const double displaced = mean_error("displace:4", *shape, height);
        const double both = mean_error("displace+normal:2", *shape, height);
        MESSAGE("exact " << exact << ", normal " << normal << ", displace:4 " << displaced << ", displace+normal:2 "
                         << both << ", blinn " << blinn << ", bump " << bump << ", constant-scale " << scale
                         << ", plain " << plain << " degrees");
        CHECK(exact < 0.06); // of the normals that the mesh interpolates
        CHECK(normal < 0.1);
        CHECK(displaced < 0.2);
        CHECK(both < 0.1);
        CHECK(blinn > 0.3);
        CHECK(blinn < 1.5);
        CHECK(bump == doctest::Approx(blinn).epsilon(0.1));
        CHECK(scale > blinn);
        CHECK(plain > 10);
    }

    TEST_CASE("relief method: displaced points lie on p + b n") {
        const auto shape = make_shape(torus_mesh(128, 64));
        const ReliefModel m = model("displace:4", *shape, waves(512));
        REQUIRE(m.shape);
        CHECK(m.segments == 4);
        CHECK(m.shape->surface.triangles.size() == 16 * shape->surface.triangles.size());
        double worst = 0;
        for (std::size_t c = 0; c < m.shape->mesh.corners(); ++c) {
            const Vec2d uv = 2 * pi * Vec2d(m.shape->mesh.uvs[m.shape->mesh.corner_uv[c]]);
            const double b = 0.1 * std::sin(5 * uv.x) * std::cos(4 * uv.y) + 0.03;
            const Vec3d n(std::cos(uv.y) * std::cos(uv.x), std::cos(uv.y) * std::sin(uv.x), std::sin(uv.y));
            const Vec3d p = Vec3d(big * std::cos(uv.x), big * std::sin(uv.x), 0) + (small + b) * n;
            worst = std::max(worst, glm::length(p - Vec3d(m.shape->mesh.positions[m.shape->mesh.corner_position[c]])));
        }
        CHECK(worst < 4e-3); // the coarse torus lies inside the smooth one by up to 1.4e-3, times 1 + b a
    }

    TEST_CASE("relief method: roughness widens the highlight by the variance of the slopes, and keeps its flux") {
        const auto shape = make_shape(plane_mesh());
        HeightTexture height =
            waves(256); // over a plane 2 wide: slopes .1 * 5 * 2 pi / 2 and .1 * 4 * 2 pi / 2 at most
        ReliefOptions options{.method = parse_shade("roughness").value(), .height = {.amplitude = 1, .midlevel = 0}};
        Material shiny;
        shiny.reflectance.specular = Vec3f(0.5f), shiny.reflectance.shininess = 200;
        const Material wide = with_relief(shiny, *shape, height, options).material;
        const double variance = 0.5 * (0.25 * std::pow(0.5 * pi, 2) + 0.25 * std::pow(0.4 * pi, 2));
        const double expected = std::max(0.0, 2 / (2.0 / 202 + 2 * variance) - 2);
        CHECK(wide.reflectance.shininess == doctest::Approx(expected).epsilon(0.01));
        CHECK(wide.reflectance.specular.x == doctest::Approx(0.5 * (expected + 2) / 202).epsilon(0.01));
        CHECK(wide.reflectance.shininess < 10);

        // Little relief: a highlight of Phong is as wide as one of Blinn with four times the exponent, at the same flux.
        options.height.amplitude = 0.02;
        shiny.reflectance.model = Reflectance::Model::phong, shiny.reflectance.shininess = 50;
        const Reflectance phong = with_relief(shiny, *shape, height, options).material.reflectance;
        const double alpha2 = 2 / (4 * 50.0 + 2) + 2 * variance * 0.02 * 0.02;
        CHECK(phong.shininess == doctest::Approx((2 / alpha2 - 2) / 4).epsilon(0.01));
        CHECK(phong.specular.x * 51 == doctest::Approx(0.5 * (phong.shininess + 1)).epsilon(1e-4));
        shiny.reflectance.model = Reflectance::Model::normalised_phong;
        CHECK(with_relief(shiny, *shape, height, options).material.reflectance.specular == Vec3f(0.5f));
    }

} // TEST_SUITE

TEST_SUITE("unit") {
    TEST_CASE("relief_method: a baked map of normals says so where faces share its texels") {
        const HeightTexture height = waves(32);
        const auto cube = make_shape(shape_mesh("cube:a=1", 2, 2)); // each side has the whole unit square
        for (const char* word : {"normal", "displace+normal:2"}) {
            const ReliefModel m = model(word, *cube, height);
            REQUIRE(m.notes.size() == 1);
            CHECK(m.notes[0].starts_with(word));
            CHECK(m.notes[0].find("lie in more than one face") != std::string::npos);
        }
        CHECK(model("bump", *cube, height).notes.empty());
        CHECK(model("normal", *make_shape(torus_mesh(16, 8)), height).notes.empty());
    }

    TEST_CASE("relief method: words are read, and others are none") {
        for (const char* word :
             {"plain", "roughness", "constant-scale", "blinn", "exact", "bump", "bump+roughness", "normal",
              "displace:16", "displace:1", "displace:max", "displace+normal:64", "displace+normal:max"}) {
            REQUIRE(parse_shade(word));
            CHECK(name(*parse_shade(word)) == word);
        }
        CHECK(parse_shade("lecture")->shade == Shade::constant_scale);
        for (const char* word : {"", "displace", "displace:", "displace:3", "displace:-4", "displace:2048", "bump:4",
                                 "Exact", "displace:16x", "normal+displace:4"})
            CHECK_FALSE(parse_shade(word));
    }

} // TEST_SUITE

TEST_SUITE("stability") {

    TEST_CASE("relief method: a shape without uvs is shown without relief or refused, and a pole has a finite normal") {
        Mesh bare = plane_mesh();
        bare.uvs.clear(), bare.corner_uv.clear();
        const auto shape = make_shape(std::move(bare));
        const HeightTexture height = waves(16);
        CHECK_THROWS_AS(model("normal", *shape, height), Error);
        const ReliefModel exact = model("exact", *shape, height);
        CHECK(shading_normal(exact.material, *shape, {0, 0.3f, 0.3f}) == Vec3f(0, 0, 1));

        const auto ball = make_shape(sphere_mesh(16, 8));
        for (const char* word : {"exact", "blinn", "bump", "constant-scale"}) {
            const ReliefModel m = model(word, *ball, height);
            for (std::uint32_t t = 0; t < ball->surface.triangles.size(); ++t)
                for (const float b : {0.0f, 0.5f, 1.0f})
                    CHECK(glm::length(shading_normal(m.material, *ball, {t, b, 0})) ==
                          doctest::Approx(1).epsilon(1e-4));
        }
    }

} // TEST_SUITE
