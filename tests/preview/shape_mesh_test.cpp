#include "bake/base/error.h"
#include "bake/mesh/triangulate.h"
#include "bake/preview/shape_mesh.h"
#include <doctest/doctest.h>

using namespace bake;

namespace {

Refusal refusal_of(const std::string& shape) {
    try {
        shape_mesh(shape);
    } catch (const Error& error) {
        return error.refusal;
    }
    FAIL("not refused: " << shape);
    return {};
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("shape_mesh: a cube has the volume and the area of its edge, normals outward, and every side all uvs") {
        for (const int cells : {1, 3}) {
            const Mesh mesh = shape_mesh("cube:a=2", cells, cells);
            CHECK(mesh.faces() == std::size_t(6 * cells * cells));
            double volume = 0, area = 0, uv_area = 0;
            Vec3d sum(0); // of area vectors: zero for a closed surface
            for (const Triangle& t : triangulate(mesh)) {
                Vec3d p[3];
                Vec2d uv[3];
                for (int k = 0; k < 3; ++k) {
                    p[k] = Vec3d(mesh.positions[mesh.corner_position[t.corner[std::size_t(k)]]]);
                    uv[k] = Vec2d(mesh.uvs[mesh.corner_uv[t.corner[std::size_t(k)]]]);
                }
                const Vec3d n = glm::cross(p[1] - p[0], p[2] - p[0]);
                area += 0.5 * glm::length(n), sum += n;
                volume += glm::dot(p[0], n) / 6;
                const Vec2d a = uv[1] - uv[0], b = uv[2] - uv[0];
                uv_area += 0.5 * (a.x * b.y - a.y * b.x); // negative where a side is mirrored
                CHECK(glm::dot(n, Vec3d(mesh.normals[mesh.corner_normal[t.corner[0]]])) > 0);
            }
            CHECK(glm::length(sum) < 1e-6);
            CHECK(area == doctest::Approx(24));
            CHECK(volume == doctest::Approx(8));
            CHECK(uv_area == doctest::Approx(6));
        }
    }

    TEST_CASE("shape_mesh: v is up on the four walls of a cube") {
        const Mesh mesh = shape_mesh("cube");
        for (std::size_t c = 0; c < mesh.corners(); ++c) {
            if (mesh.normals[mesh.corner_normal[c]].y != 0) continue;
            CHECK(mesh.positions[mesh.corner_position[c]].y == mesh.uvs[mesh.corner_uv[c]].y - 0.5f);
        }
    }

    TEST_CASE(
        "shape_mesh: an analytic shape has its default cells, or those that are asked for, and no repeated corners") {
        CHECK(shape_mesh("torus:R=2,r=0.7").faces() == 96 * 48);
        CHECK(shape_mesh("torus", 8, 5).faces() == 40);
        const Mesh sphere = shape_mesh("sphere:R=3", 8, 6);
        for (const Vec3f& p : sphere.positions) CHECK(glm::length(p) == doctest::Approx(3));
        for (std::size_t f = 0; f < sphere.faces(); ++f)
            for (std::uint32_t c = sphere.face_begin[f] + 1; c < sphere.face_begin[f + 1]; ++c)
                CHECK(sphere.corner_position[c] != sphere.corner_position[c - 1]);
    }

    TEST_CASE("shape_beside: the file of a shape is relative to the scene, other keys stay") {
        CHECK(shape_beside("scenes/a.toml", "torus:R=2") == "torus:R=2");
        CHECK(shape_beside("scenes/a.toml", "revolution:profile=vase.txt") == "revolution:profile=scenes/vase.txt");
        CHECK(shape_beside("scenes/a.toml", "revolution:pointed=1,profile=../vase.txt") ==
              "revolution:pointed=1,profile=vase.txt");
        CHECK(shape_beside("scenes/a.toml", "bezier:file=/abs/pot.txt,flip=1") == "bezier:file=/abs/pot.txt,flip=1");
    }

} // TEST_SUITE
TEST_SUITE("stability") {

    TEST_CASE("shape_mesh: unknown shapes, keys and values are usage errors") {
        for (const char* shape : {"", "ball", "cube:b=1", "cube:a=0", "cube:a=nan", "cube:a=", "cube:", "torus:R=-1"})
            CHECK(refusal_of(shape) == Refusal::usage);
    }

} // TEST_SUITE
