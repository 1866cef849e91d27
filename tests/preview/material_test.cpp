#include "bake/preview/material.h"
#include "bake/relief/map/normal_map.h"
#include "preview/little_scenes.h"
#include <doctest/doctest.h>
#include <random>

using namespace bake;
using namespace bake::test;

namespace {

/// Calls check(point) at random points of every triangle that is not at a pole.
template <class Check> void over_triangles(const Shape& shape, Check&& check) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> uniform(0.05f, 0.45f);
    for (std::uint32_t t = 0; t < shape.surface.triangles.size(); ++t)
        if (shape.surface.sigma[t] != 0) check(ShapePoint{t, uniform(random), uniform(random)});
}

Material with_bump(Texture table) {
    Material material;
    material.bump_table = std::move(table);
    return material;
}

Material with_normals(Texture map) {
    Material material;
    material.normal_map = std::move(map);
    return material;
}

/// Waves of height a: b = a sin(k 2 pi u) sin(m 2 pi v).
struct Waves {
    float a, k, m;
    void slopes(float u, float v, float* out) const {
        const float x = 2 * pi_f * k * u, y = 2 * pi_f * m * v;
        out[0] = a * 2 * pi_f * k * std::cos(x) * std::sin(y);
        out[1] = a * 2 * pi_f * m * std::sin(x) * std::cos(y);
    }
};

/// The sphere with u increasing to the west, as on the mirrored half of a symmetric model.
Mesh mirrored_sphere() {
    Mesh mesh = sphere_mesh();
    for (Vec2f& uv : mesh.uvs) uv.x = 1 - uv.x;
    return mesh;
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("material: a flat normal map and a bump table of zeros change nothing") {
        const auto shape = make_shape(sphere_mesh());
        add_tangents(*shape);
        const Material plain;
        const Material flat = with_normals(texture(4, 4, 3, [](float, float, float* t) { t[0] = t[1] = 0, t[2] = 1; }));
        const Material even = with_bump(texture(4, 4, 2, [](float, float, float* b) { b[0] = b[1] = 0; }));
        over_triangles(*shape, [&](const ShapePoint& at) {
            const Vec3f n = shading_normal(plain, *shape, at);
            CHECK(glm::length(n) == doctest::Approx(1).epsilon(1e-6));
            CHECK(glm::length(shading_normal(flat, *shape, at) - n) <= 1e-6f);
            CHECK(glm::length(shading_normal(even, *shape, at) - n) <= 1e-6f);
        });
    }

    TEST_CASE("material: bump table and normal map of one relief have the same shading, also on mirrored charts") {
        for (const bool mirrored : {false, true}) {
            const auto shape = make_shape(mirrored ? mirrored_sphere() : sphere_mesh());
            add_tangents(*shape);
            const Waves waves{0.01f, 6, 4};
            const int n = 512;
            const Material bump =
                with_bump(texture(2 * n, n, 2, [&](float u, float v, float* out) { waves.slopes(u, v, out); }));
            // The map in closed form on the sphere: |p_u| = 2 pi cos(latitude), |p_v| = pi, and t = (-b_u/|p_u|,
            // -b_v/|p_v|, 1) in the frame of unit p_u and p_v.
            const Material mapped = with_normals(texture(2 * n, n, 3, [&](float u, float v, float* t) {
                float slopes[2];
                waves.slopes(u, v, slopes);
                const Vec3f normal(-slopes[0] / (2 * pi_f * std::cos(pi_f * (v - 0.5f))), -slopes[1] / pi_f, 1);
                for (int c = 0; c < 3; ++c) t[c] = glm::normalize(normal)[c];
            }));
            const Material plain;
            double worst = 0, moved = 0;
            over_triangles(*shape, [&](const ShapePoint& at) {
                const Vec2f uv = uv_at(*shape, at);
                if (uv.y < 0.1f || uv.y > 0.9f)
                    return; // near the poles the metric of the facets differs from that of the sphere
                const Vec3f a = shading_normal(bump, *shape, at), b = shading_normal(mapped, *shape, at);
                worst = std::max(worst, angle_deg(a, b));
                moved = std::max(moved, angle_deg(a, shading_normal(plain, *shape, at)));
            });
            MESSAGE("at most " << worst << " degrees apart, relief of " << moved << " degrees");
            CHECK(worst < 0.5);
            CHECK(moved > 5);
        }
    }

    TEST_CASE("material: a table and a map baked from one height texture have the same shading") {
        HeightTexture height;
        height.values = Image<float>(512, 256, 1);
        for (int y = 0; y < 256; ++y)
            for (int x = 0; x < 512; ++x)
                height.values.at(x, y) =
                    0.5f + 0.5f * std::sin(pi_f * 12 * float(x) / 512) * std::sin(pi_f * 8 * float(y) / 256);
        const double amplitude = 0.02;
        const auto shape = make_shape(sphere_mesh());
        add_tangents(*shape);
        const Material bump = with_bump(std::make_shared<const Image<float>>(
            bump_table(height, {.filter = Filter::order4, .units = SlopeUnits::uv, .amplitude = amplitude})));

        NormalMapOptions options{.width = 512, .height = 256, .method = NormalMethod::surface_gradient};
        options.filter = Filter::order4;
        options.height_options.amplitude = amplitude;
        const HeightField field(height, options.height_options, options.filter, 512, 256);
        const BakeTarget target = make_bake_target(shape->mesh, "sphere", 512, 256);
        NormalMapReport report;
        Image<float> map = normal_map(field, target, options, report);
        for (float* rgb = map.data(); rgb < map.data() + map.size(); rgb += 3) {
            const Vec3f t = decode_normal({rgb[0], rgb[1], rgb[2]}, false);
            for (int c = 0; c < 3; ++c) rgb[c] = t[c];
        }
        const Material mapped = with_normals(std::make_shared<const Image<float>>(std::move(map)));
        double worst = 0;
        over_triangles(*shape, [&](const ShapePoint& at) {
            const float v = uv_at(*shape, at).y;
            if (v < 0.1f || v > 0.9f) return; // near the poles the frame rotates within one texel
            worst = std::max(worst, angle_deg(shading_normal(bump, *shape, at), shading_normal(mapped, *shape, at)));
        });
        MESSAGE("at most " << worst << " degrees apart");
        CHECK(worst < 0.5);
    }

    TEST_CASE("material: relief rises towards growing height on ordinary and mirrored charts") {
        // Height increases along +u, so the normal tilts towards -p_u.
        const Material bump = with_bump(texture(2, 2, 2, [](float, float, float* b) { b[0] = 0.3f, b[1] = 0; }));
        const Material mapped =
            with_normals(texture(2, 2, 3, [](float, float, float* t) { t[0] = -0.6f, t[1] = 0, t[2] = 0.8f; }));
        for (const bool mirrored : {false, true}) {
            Mesh mesh = plane_mesh();
            if (mirrored)
                for (Vec2f& uv : mesh.uvs) uv.x = 1 - uv.x;
            const auto shape = make_shape(std::move(mesh));
            add_tangents(*shape);
            const float along_u = mirrored ? -1.0f : 1.0f;
            // |p_u| = 2, so a slope of .3 per unit of u is .15 per unit of length.
            const Vec3f from_bump = shading_normal(bump, *shape, {0, 0.3f, 0.3f});
            CHECK(glm::length(from_bump - glm::normalize(Vec3f(-0.15f * along_u, 0, 1))) < 1e-6f);
            const Vec3f from_map = shading_normal(mapped, *shape, {0, 0.3f, 0.3f});
            CHECK(glm::length(from_map - Vec3f(-0.6f * along_u, 0, 0.8f)) < 1e-6f);
        }
    }

    TEST_CASE("material: the albedo multiplies ambient and diffuse, not specular") {
        const auto shape = make_shape(plane_mesh());
        Material material;
        material.reflectance.specular = Vec3f(0.5f);
        material.albedo = texture(2, 2, 3, [](float, float, float* c) { c[0] = 0.5f, c[1] = 0.25f, c[2] = 0; });
        const Bsdf bsdf = bsdf_at(material, *shape, {0, 0.2f, 0.2f});
        const Vec3f tinted = 0.8f * Vec3f(0.5f, 0.25f, 0);
        REQUIRE(bsdf.count == 2);
        CHECK(glm::length(bsdf.lobes[0].weight - tinted) < 1e-6f);
        CHECK(glm::length(albedo(bsdf) - tinted) < 1e-6f);
        CHECK(glm::length(bsdf.ambient - tinted) < 1e-6f);
        CHECK(bsdf.lobes[1].weight == Vec3f(0.5f));
    }

    TEST_CASE("material: a mirror ray keeps above the facet, however far the normal is tilted") {
        const Vec3f facet(0, 0, 1);
        std::mt19937 random(4);
        std::uniform_real_distribution<float> uniform(-1, 1);
        int turned = 0;
        for (int i = 0; i < 2000; ++i) {
            const Vec3f v = glm::normalize(Vec3f(uniform(random), uniform(random), 0.01f + std::abs(uniform(random))));
            const Vec3f n = glm::normalize(Vec3f(uniform(random), uniform(random), uniform(random)));
            const Vec3f mirrored = 2 * glm::dot(n, v) * n - v, kept = mirror_above(v, n, facet);
            CHECK(kept.z >= 0);
            CHECK(glm::length(kept) == doctest::Approx(1).epsilon(1e-5));
            if (mirrored.z >= 0) CHECK(kept == mirrored);
            turned += mirrored.z < 0;
        }
        CHECK(turned > 100);
    }

    TEST_CASE("material: flat shading uses the facet normal") {
        const auto shape = make_shape(sphere_mesh(8, 4), {.flat = true});
        const Material plain;
        over_triangles(*shape, [&](const ShapePoint& at) {
            const Vec3f n = shading_normal(plain, *shape, at);
            const auto& c = shape->surface.triangles[at.triangle].corner;
            const auto p = [&](int k) { return shape->mesh.positions[shape->mesh.corner_position[c[k]]]; };
            if (p(0) == p(1) || p(1) == p(2) || p(2) == p(0)) return; // degenerate at a pole: no ray hits it
            CHECK(std::abs(glm::dot(n, p(1) - p(0))) < 1e-6f);
            CHECK(std::abs(glm::dot(n, p(2) - p(0))) < 1e-6f);
            CHECK(glm::dot(n, p(0)) > 0);
        });
    }

} // TEST_SUITE
TEST_SUITE("stability") {

    TEST_CASE("material: without uv area, or if the texture yields no direction, the plain normal is used") {
        Mesh mesh = sphere_mesh(16, 8);
        for (Vec2f& uv : mesh.uvs) uv = Vec2f(0.5f);
        const auto shape = make_shape(std::move(mesh));
        add_tangents(*shape);
        const Material plain;
        const Material bump = with_bump(texture(1, 1, 2, [](float, float, float* b) { b[0] = 3, b[1] = -2; }));
        const Material nowhere = with_normals(texture(1, 1, 3, [](float, float, float* t) { t[0] = t[1] = t[2] = 0; }));
        for (std::uint32_t t = 0; t < shape->surface.triangles.size(); ++t) {
            const ShapePoint at{t, 0.3f, 0.3f};
            const Vec3f n = shading_normal(plain, *shape, at);
            CHECK(shading_normal(bump, *shape, at) == n);
            CHECK(shading_normal(nowhere, *shape, at) == n);
        }
    }

    TEST_CASE("material: corners without uv shade plainly") {
        Mesh mesh = plane_mesh();
        mesh.corner_uv[0] = no_index;
        const auto shape = make_shape(std::move(mesh));
        add_tangents(*shape);
        const Material tilted =
            with_normals(texture(1, 1, 3, [](float, float, float* t) { t[0] = 0.6f, t[1] = 0, t[2] = 0.8f; }));
        const Material bump = with_bump(texture(1, 1, 2, [](float, float, float* b) { b[0] = 3, b[1] = -2; }));
        for (std::uint32_t t = 0; t < 2; ++t)
            for (const Material* material : {&tilted, &bump})
                CHECK(glm::length(shading_normal(*material, *shape, {t, 0.3f, 0.3f})) ==
                      doctest::Approx(1).epsilon(1e-6));
        CHECK(shading_normal(tilted, *shape, {0, 0.3f, 0.3f}) == Vec3f(0, 0, 1));
    }

} // TEST_SUITE
