// Flat polygons: which meshes are, and what a camera sees of them in closed form.
#include "bake/preview/shape_mesh.h"
#include "bake/verdict/plan/flat_patch.h"
#include "preview/little_scenes.h"
#include <doctest/doctest.h>

using namespace bake;

namespace {

Scene placed(Mesh mesh, const Placement& placement = {}) {
    Scene scene;
    scene.shapes.push_back(make_shape(std::move(mesh), {.derivatives = false}));
    scene.materials.push_back(std::make_unique<Material>());
    add_instance(scene, *scene.shapes[0], *scene.materials[0], placement);
    build(scene);
    return scene;
}

std::optional<FlatPatch> patch_of(Mesh mesh) { return flat_patch(placed(std::move(mesh)), 0); }

Camera above(double angle, float height_of_view) {
    Camera camera;
    camera.position = 4.f * Vec3f(float(std::sin(angle)), 0, float(std::cos(angle)));
    camera.orthographic = true, camera.view_height = height_of_view;
    return camera;
}

/// The plane without the faces for which `gone` is true of their number.
template <class Gone> Mesh plane_without(int cells, const Gone& gone) {
    const Mesh all = test::plane_mesh(cells);
    Mesh mesh = all;
    mesh.face_begin = {0};
    for (auto* corners : {&mesh.corner_position, &mesh.corner_normal, &mesh.corner_uv}) corners->clear();
    for (std::uint32_t f = 0; f + 1 < all.face_begin.size(); ++f) {
        if (gone(f)) continue;
        for (std::uint32_t c = all.face_begin[f]; c < all.face_begin[f + 1]; ++c) {
            mesh.corner_position.push_back(all.corner_position[c]);
            mesh.corner_normal.push_back(all.corner_normal[c]);
            mesh.corner_uv.push_back(all.corner_uv[c]);
        }
        mesh.face_begin.push_back(std::uint32_t(mesh.corner_position.size()));
    }
    return mesh;
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("flat_patch: area, border and shift of a square in a slanting orthographic view") {
        const Scene scene = placed(test::plane_mesh(3));
        const auto patch = flat_patch(scene, 0);
        REQUIRE(patch);
        CHECK(patch->corners.size() == 4);
        const double angle = 0.6, px = 50;
        const auto seen = in_picture(*patch, 0.02, PictureView(scene, above(angle, 4), 200, 200));
        REQUIRE(seen);
        CHECK(seen->area == doctest::Approx(100 * 100 * std::cos(angle)));
        CHECK(seen->border == doctest::Approx(200 + 200 * std::cos(angle)));
        CHECK(seen->edges == 4);
        CHECK(seen->shift == doctest::Approx(0.02 * px * std::sin(angle)));
        CHECK(seen->most_tangent == doctest::Approx(std::tan(angle)));
        CHECK(seen->most_density == doctest::Approx(px * px * std::cos(angle)));
        CHECK(seen->uv_low.x == doctest::Approx(0).epsilon(1e-6));
        CHECK(seen->uv_high.y == doctest::Approx(1));
    }

    TEST_CASE("flat_patch: a picture inside the square has no border, one beside it no area") {
        const Scene scene = placed(test::plane_mesh(3), {.rotate_deg = Vec3f(0, 0, 30)});
        const auto patch = flat_patch(scene, 0);
        REQUIRE(patch);
        const auto seen = in_picture(*patch, 0.01, PictureView(scene, above(0.6, 0.5), 100, 100));
        REQUIRE(seen);
        CHECK(seen->area == doctest::Approx(100 * 100));
        CHECK(seen->edges == 0);
        Camera beside = above(0.6, 0.5);
        beside.position += Vec3f(0, 9, 0), beside.target += Vec3f(0, 9, 0);
        CHECK(in_picture(*patch, 0.01, PictureView(scene, beside, 100, 100))->area == 0);
    }

    TEST_CASE("flat_patch: no point of the relief moves further than `shift`, from any camera") {
        const Scene scene = placed(test::plane_mesh(2), {.rotate_deg = Vec3f(20, 40, 10), .scale = Vec3f(1, 2, 1)});
        const auto patch = flat_patch(scene, 0);
        REQUIRE(patch);
        for (int k = 0; k < 200; ++k) {
            const auto draw = [&](int i) { return std::fmod(0.37 + 0.754877 * k * (i + 1) + 0.13 * i, 1.0); };
            Camera camera;
            camera.position = Vec3f(Vec3d(6 * draw(0) - 3, 6 * draw(1) - 3, 6 * draw(2) - 3));
            camera.fov_deg = float(20 + 60 * draw(3));
            const PictureView view(scene, camera, 64, 48);
            const auto seen = in_picture(*patch, 0.01, view);
            if (!seen || seen->area == 0) continue;
            for (int i = 0; i <= 20; ++i)
                for (int j = 0; j <= 20; ++j) {
                    const Vec3d p = patch->p0 + i / 20.0 * patch->p_u + j / 20.0 * patch->p_v;
                    if (!view.before(p) || !view.inside(view.pixels(p))) continue;
                    for (const double side : {-0.01, 0.01})
                        CHECK(glm::length(view.pixels(p + side * patch->n) - view.pixels(p)) <=
                              seen->shift * (1 + 1e-9));
                }
        }
    }

    TEST_CASE("flat_patch: slopes are per length in the world") {
        Mesh mesh = test::plane_mesh(2);
        for (Vec2f& uv : mesh.uvs) uv = Vec2f(3 * uv.x + uv.y, 2 * uv.y);
        const auto patch =
            flat_patch(placed(std::move(mesh), {.rotate_deg = Vec3f(10, 20, 30), .scale = Vec3f(2, 1, 1)}), 0);
        REQUIRE(patch);
        const auto [g_u, g_v] = patch->slopes();
        // u grows by 3 along 4 units of x; v by 2 along 2 units of y, and u by 1.
        CHECK(glm::length(g_v) == doctest::Approx(1));
        CHECK(glm::length(g_u) == doctest::Approx(std::hypot(3 / 4.0, 1 / 2.0)));
        CHECK(glm::dot(g_u, g_v) == doctest::Approx(0.5));
    }
}

TEST_SUITE("unit") {

    TEST_CASE("flat_patch: what is not a flat, convex polygon covered once is none") {
        CHECK(patch_of(test::plane_mesh(4)));
        CHECK(patch_of(shape_mesh("plane", 4, 4)));
        CHECK_FALSE(patch_of(test::sphere_mesh(16, 8)));
        CHECK_FALSE(patch_of(shape_mesh("cube:a=1", 2, 2)));
        CHECK_FALSE(patch_of(plane_without(4, [](std::uint32_t f) { return f == 0; }))); // a corner is missing
        CHECK_FALSE(patch_of(plane_without(4, [](std::uint32_t f) { return f == 5; }))); // a hole
        CHECK(patch_of(plane_without(4, [](std::uint32_t f) { return f < 4; })));        // a row is missing
        Mesh bent = test::plane_mesh(4);
        bent.positions[7].z = 1e-3f;
        CHECK_FALSE(patch_of(bent));
        Mesh stretched = test::plane_mesh(4);
        stretched.uvs[7].x += 1e-3f;
        CHECK_FALSE(patch_of(stretched));
        Mesh shaded = test::plane_mesh(4);
        shaded.normals[7] = glm::normalize(Vec3f(0.01f, 0, 1));
        CHECK_FALSE(patch_of(shaded));
        Mesh no_uvs = test::plane_mesh(4);
        no_uvs.uvs.clear(), no_uvs.corner_uv.clear();
        CHECK_FALSE(patch_of(no_uvs));
        CHECK_FALSE(patch_of(Mesh()));
    }

    TEST_CASE("flat_patch: it does not depend on the unit of length") {
        for (const float unit : {1e-8f, 1.f, 1e6f}) {
            const Scene scene =
                placed(test::plane_mesh(7), {.rotate_deg = Vec3f(20, 40, 10), .scale = Vec3f(unit, 2 * unit, unit)});
            const auto patch = flat_patch(scene, 0);
            CAPTURE(unit);
            REQUIRE(patch);
            CHECK(patch->corners.size() == 4);
            for (const Vec3d& corner : patch->corners)
                CHECK(glm::length(corner) == doctest::Approx(std::sqrt(5.0) * double(unit)));
            CHECK(glm::length(patch->p_v) == doctest::Approx(4 * double(unit)));
        }
    }

    TEST_CASE("flat_patch: twice over the same place is not once") {
        Mesh twice = test::plane_mesh(1);
        for (int k = 0; k < 4; ++k) {
            twice.corner_position.push_back(std::uint32_t(k == 0 ? 0 : k == 1 ? 1 : k == 2 ? 3 : 2));
            twice.corner_normal.push_back(twice.corner_position.back());
            twice.corner_uv.push_back(twice.corner_position.back());
        }
        twice.face_begin.push_back(8);
        CHECK_FALSE(patch_of(twice));
        // With corners of its own, which are not quite those of the first.
        for (int k = 0; k < 4; ++k) {
            twice.positions.push_back(twice.positions[std::size_t(k)] * (1 - 1e-6f));
            twice.corner_position[std::size_t(4 + k)] += 4;
        }
        CHECK_FALSE(patch_of(twice));
    }

    TEST_CASE("flat_patch: cameras in the plane or too close to it see nothing that is known") {
        const Scene scene = placed(test::plane_mesh(2));
        const auto patch = flat_patch(scene, 0);
        REQUIRE(patch);
        CHECK_FALSE(in_picture(*patch, 0.01, PictureView(scene, above(pi / 2, 4), 64, 64)));
        Camera close;
        close.position = Vec3f(0, 0, 0.1f), close.target = Vec3f(0.3f, 0, 0);
        CHECK_FALSE(in_picture(*patch, 0.01, PictureView(scene, close, 64, 64)));
        close.target = close.position;
        CHECK_FALSE(in_picture(*patch, 0.001, PictureView(scene, close, 64, 64)));
    }
}
