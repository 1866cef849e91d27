#include "bake/base/error.h"
#include "bake/preview/shape_mesh.h"
#include "bake/verdict/compare/twin_points.h"
#include "verdict/compare/relief_pair.h"
#include <doctest/doctest.h>

using namespace bake;
using namespace bake::test;

namespace {

Vec3f point_of(const Shape& shape, const ShapePoint& at) {
    const auto& c = shape.surface.triangles[at.triangle].corner;
    const auto p = [&](std::size_t k) { return shape.mesh.positions[shape.mesh.corner_position[c[k]]]; };
    return (1 - at.b1 - at.b2) * p(0) + at.b1 * p(1) + at.b2 * p(2);
}

TwinShape shown(const Scene& scene, const Scene& base) { return {scene.instances[0].shape, base.instances[0].shape}; }

/// Largest distance in uv between a point and its counterpart, away from the ends of the charts.
double worst_uv(const TwinShape& from, const TwinShape& to) {
    const TwinPoints twin(from, to);
    double worst = 0;
    const std::size_t count = from.shown->surface.triangles.size();
    for (std::size_t t = 0; t < count; t += 1 + count / 500) {
        const ShapePoint at{std::uint32_t(t), 0.21f, 0.43f};
        const Vec2f uv = uv_at(*from.shown, at);
        worst = std::max(worst, double(glm::length(uv_at(*to.shown, twin(at)) - uv)));
    }
    return worst;
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("twin points: on a plane the counterpart has the same uv, whatever the heights and segments") {
        const HeightTexture height = eggs(0.2, 2);
        const ReliefPair pair(plane_mesh(3), {}, height, "bump", "displace:16", [](Scene&) {});
        const ReliefPair coarse(plane_mesh(3), {}, height, "displace:2", "displace:8", [](Scene&) {});
        const TwinShape base = shown(pair.method, pair.method_base), fine = shown(pair.reference, pair.reference_base);
        const TwinShape two = shown(coarse.method, coarse.method_base);
        CHECK(worst_uv(base, fine) < 1e-6);
        CHECK(worst_uv(fine, base) < 1e-6);
        CHECK(worst_uv(two, fine) < 1e-6);
        CHECK(worst_uv(fine, two) < 1e-6);
        CHECK(worst_uv(two, shown(coarse.reference, coarse.reference_base)) < 1e-6);
    }

    TEST_CASE("twin points: a displaced point is its counterpart plus b n") {
        const HeightTexture height = eggs(0.2, 2, 64);
        const ReliefPair pair(plane_mesh(4), {}, height, "bump", "displace:32", [](Scene&) {});
        const TwinPoints twin(shown(pair.method, pair.method_base), shown(pair.reference, pair.reference_base));
        const Shape &plane = *pair.method.instances[0].shape, &displaced = *pair.reference.instances[0].shape;
        double worst = 0;
        for (std::uint32_t t = 0; t < plane.surface.triangles.size(); ++t) {
            const ShapePoint at{t, 0.31f, 0.17f};
            const Vec3f p = point_of(plane, at), q = point_of(displaced, twin(at));
            const double b = 0.2 * std::sin(2 * pi * (p.x + 1)) * std::sin(2 * pi * (p.y + 1));
            worst = std::max(worst, glm::length(Vec3d(q) - Vec3d(p.x, p.y, b)));
        }
        CHECK(worst < 2e-3); // chords of facets 1/64 wide: (2 pi / 64)^2 / 8 * 0.2 * 2
    }

    TEST_CASE("twin points: in a cube whose sides are sunk, points near an edge stay on their side") {
        const HeightTexture dent = height_of(8, [](double, double) { return -0.3; });
        const ReliefPair pair(shape_mesh("cube:a=2", 4, 4), {}, dent, "bump", "displace:4", [](Scene&) {});
        const TwinShape base = shown(pair.method, pair.method_base), sunk = shown(pair.reference, pair.reference_base);
        CHECK(worst_uv(base, sunk) < 1e-6);
        CHECK(worst_uv(sunk, base) < 1e-6);
    }

    TEST_CASE("twin points: a quad that is not plane and split along its other diagonal keeps the parameters") {
        // The displaced quads are split where they are shorter in uv, which a second set of uvs changes.
        Mesh mesh = plane_mesh(4), skewed = mesh;
        for (Vec2f& uv : skewed.uvs) uv.x += 0.3f * uv.y;
        for (Vec2f& uv : mesh.uvs) uv.x -= 0.3f * uv.y;
        const auto one = make_shape(std::move(mesh)), other = make_shape(std::move(skewed));
        REQUIRE(one->surface.triangles[0].corner != other->surface.triangles[0].corner);
        const TwinPoints twin({one.get(), one.get()}, {other.get(), one.get()});
        for (std::uint32_t t = 0; t < one->surface.triangles.size(); ++t)
            for (const Vec2f& b : {Vec2f(0.1f, 0.2f), Vec2f(0.6f, 0.3f), Vec2f(0.05f, 0.9f)}) {
                const ShapePoint at{t, b.x, b.y};
                CHECK(glm::length(point_of(*one, at) - point_of(*other, twin(at))) < 1e-6f);
            }
    }

} // TEST_SUITE

TEST_SUITE("unit") {

    TEST_CASE("twin points: other segments than the base's are refused") {
        const ReliefPair pair(plane_mesh(2), {}, eggs(0.1, 1), "displace:2", "displace:4", [](Scene&) {});
        const TwinShape mixed = shown(pair.method, pair.reference_base), good = shown(pair.method, pair.method_base);
        CHECK_THROWS_AS(TwinPoints(mixed, good), Error);
        CHECK_THROWS_AS(TwinPoints(good, mixed), Error);
    }

    TEST_CASE("twin points: entries without heights have no sky, no ground and no relief") {
        SceneEntries entries;
        entries.labels = true;
        entries.ground.emplace();
        entries.materials.emplace_back();
        entries.materials[0].relief.amplitude = 2.0f;
        entries.meshes.emplace_back();
        const SceneEntries flat = without_heights(entries);
        CHECK_FALSE(flat.labels);
        CHECK_FALSE(flat.ground);
        CHECK_FALSE(flat.meshes[0].lights);
        CHECK(flat.materials[0].relief.amplitude == 0.0f);
        CHECK(flat.settings.sky_light == SkyLighting::off);
    }

} // TEST_SUITE
