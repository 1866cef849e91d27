#include "bake/relief/transfer/map_frame.h"
#include "relief/transfer/transfer_meshes.h"

using namespace bake;
using namespace bake::test;

namespace {

struct Target {
    Mesh mesh;
    BakeTarget target;
    Target(Mesh m, int width, int height) : mesh(std::move(m)), target(make_bake_target(mesh, "low", width, height)) {}
};

Vec2d uv_of(const BakeTarget& target, const TexelHit& at) {
    const Mesh& mesh = *target.surface.mesh;
    const auto& corner = target.surface.triangles[at.triangle].corner;
    const auto uv = [&](std::size_t k) { return Vec2d(mesh.uvs[mesh.corner_uv[corner[k]]]); };
    return uv(0) + double(at.b1) * (uv(1) - uv(0)) + double(at.b2) * (uv(2) - uv(0));
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("map_frame: in tangent space the frame's own normal is (0, 0, 1), in object space nothing is changed") {
        const Target sphere(lat_long_sphere(24, 12), 48, 24);
        for (const auto& [x, y] : {std::pair(3, 5), {20, 12}, {40, 18}}) {
            const TexelHit& at = sphere.target.raster.hits.at(x, y);
            const auto& corner = sphere.target.surface.triangles[at.triangle].corner;
            const auto& n = sphere.target.surface.n;
            const Vec3f normal =
                glm::normalize((1 - at.b1 - at.b2) * n[corner[0]] + at.b1 * n[corner[1]] + at.b2 * n[corner[2]]);
            const MapFrame tangent(sphere.target, at.triangle, Space::tangent),
                object(sphere.target, at.triangle, Space::object);
            CHECK(glm::length(tangent.in_map(normal, at) - Vec3f(0, 0, 1)) < 1e-6f);
            CHECK((object.in_map(normal, at) == normal));
        }
    }

    TEST_CASE("map_frame: on a plane with uv = (x, y) tangent space is object space, and x is turned round on a "
              "mirrored one") {
        const Target plane(unit_plane(), 8, 8);
        Mesh turned = unit_plane();
        for (Vec2f& uv : turned.uvs) uv.x = 1 - uv.x;
        const Target mirrored(turned, 8, 8);
        const Vec3f n = glm::normalize(Vec3f(0.3f, 0.5f, 1));
        const auto in = [&](const Target& t) {
            const TexelHit& at = t.target.raster.hits.at(3, 4);
            return MapFrame(t.target, at.triangle, Space::tangent).in_map(n, at);
        };
        CHECK(glm::length(in(plane)-n) < 1e-6f);
        CHECK(glm::length(in(mirrored)-Vec3f(-n.x, n.y, n.z)) < 1e-6f);
    }

    TEST_CASE("map_frame: a frame without volume gives zero") {
        Target plane(unit_plane(), 8, 8);
        for (Vec4f& tangent : plane.target.tangents) tangent = Vec4f(0, 0, 1, 1);
        const TexelHit& at = plane.target.raster.hits.at(3, 4);
        CHECK((MapFrame(plane.target, at.triangle, Space::tangent).in_map({0, 0, 1}, at) == Vec3f(0)));
    }

    TEST_CASE(
        "facets: a ray that leans by 45 degrees moves detail by the texels of its height, an upright one not at all") {
        Mesh wide = unit_plane();
        for (Vec3f& p : wide.positions) p.x *= 2;
        const Target plane(wide, 60, 30);
        const Facets facets(plane.target, 60, 30);
        CHECK(facets.texels_per_height(0, {0, 0, -1}) == 0);
        CHECK(facets.texels_per_height(1, glm::normalize(Vec3f(1, 0, -1))) == doctest::Approx(30));
        CHECK(facets.texels_per_height(1, glm::normalize(Vec3f(3, 4, -12))) == doctest::Approx(30 * 5 / 12.0));
        // As at a cosine of .1 where the ray runs along the facet.
        CHECK(facets.texels_per_height(0, {1, 0, 0}) == doctest::Approx(30 * std::sqrt(0.99) / 0.1));
    }

    TEST_CASE("mirrored_at_border: the point as far inside of the nearest one as the centre is outside") {
        // A chart that ends .3 of a texel before the centres of its border texels, in one tile or another.
        for (const double tile : {0.0, 2.0}) {
            Mesh mesh = unit_plane();
            for (Vec2f& uv : mesh.uvs)
                uv = Vec2f(2.8f / 16 + uv.x * 9.4f / 16, 3.8f / 16 + uv.y * 8.4f / 16) + float(tile);
            const Target chart(mesh, 16, 16);
            int outside = 0, found = 0;
            for (int y = 0; y < 16; ++y)
                for (int x = 0; x < 16; ++x) {
                    const TexelHit& at = chart.target.raster.hits.at(x, y);
                    if (at.triangle == no_index) continue;
                    const Vec2d centre = Vec2d((x + 0.5) / 16, 1 - (y + 0.5) / 16) + tile;
                    const Vec2d edge = uv_of(chart.target, at);
                    const auto mirrored = mirrored_at_border(chart.target, at, x, y, 16, 16);
                    if (glm::length(edge - centre) < 1e-4) {
                        CHECK(!mirrored);
                        continue;
                    }
                    ++outside;
                    if (!mirrored) continue; // beyond the diagonal, in the other triangle
                    ++found;
                    CHECK(mirrored->triangle == at.triangle);
                    CHECK(glm::length(uv_of(chart.target, *mirrored) - (2.0 * edge - centre)) < 1e-5);
                }
            CHECK(outside > 20);
            CHECK(found > outside / 2);
        }
    }

    TEST_CASE("mirrored_at_border: nothing where the triangle is too small to hold the point") {
        Mesh mesh = unit_plane();
        for (Vec2f& uv : mesh.uvs) uv = Vec2f((3.6f + 0.05f * uv.x) / 16, (0.5f + 15 * uv.y) / 16);
        const Target chart(mesh, 16, 16);
        const TexelHit& at = chart.target.raster.hits.at(3, 8);
        REQUIRE(at.triangle != no_index);
        CHECK(!mirrored_at_border(chart.target, at, 3, 8, 16, 16));
    }

} // TEST_SUITE
