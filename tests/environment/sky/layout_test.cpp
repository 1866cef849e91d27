#include "bake/base/error.h"
#include "bake/environment/sky/layout.h"
#include <cmath>
#include <doctest/doctest.h>
#include <string>

using namespace bake;

namespace {

/// Every texel of its own colour.
Cube numbered_cube(int n) {
    Cube cube = make_cube(n, 1);
    for (int f = 0; f < 6; ++f)
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x) cube.faces[f].at(x, y) = float(f * 10000 + y * 100 + x);
    return cube;
}

bool equal(const Cube& a, const Cube& b) {
    for (int f = 0; f < 6; ++f)
        for (std::size_t i = 0; i < a.faces[f].size(); ++i)
            if (a.faces[f].data()[i] != b.faces[f].data()[i]) return false;
    return a.size() == b.size();
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("layout: OpenEXR's order holds the pictures its own axes ask for") {
        // OpenEXR, world axes, u right and v down: +X u=+z v=-y; -X u=-z v=-y; +Y u=+x v=-z; -Y u=+x v=+z; +Z u=-x v=-y; -Z u=+x v=-y.
        const Vec3d middle[6] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
        const Vec3d right[6] = {{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {1, 0, 0}, {-1, 0, 0}, {1, 0, 0}};
        const Vec3d down[6] = {{0, -1, 0}, {0, -1, 0}, {0, 0, -1}, {0, 0, 1}, {0, -1, 0}, {0, -1, 0}};
        const int n = 5;
        Cube directions = make_cube(n, 3); // world directions as colours
        for (const CubeFace face : all_cube_faces)
            for (int y = 0; y < n; ++y)
                for (int x = 0; x < n; ++x) {
                    const Vec3d d =
                        world_to_cube(cube_direction(CubePoint<double>{face, (x + 0.5) / n, (y + 0.5) / n}));
                    for (int c = 0; c < 3; ++c) directions[face].at(x, y, c) = float(d[c]);
                }
        const Image<float> strip = paste_faces(directions, CubeLayout::strip, FaceOrder::openexr);
        for (int k = 0; k < 6; ++k)
            for (int y = 0; y < n; ++y)
                for (int x = 0; x < n; ++x) {
                    const Vec3d d = middle[k] + ((2 * x + 1.0) / n - 1) * right[k] + ((2 * y + 1.0) / n - 1) * down[k];
                    for (int c = 0; c < 3; ++c) CHECK(strip.at(x, k * n + y, c) == doctest::Approx(d[c]));
                }
    }

} // TEST_SUITE
TEST_SUITE("unit") {

    TEST_CASE("layout: every layout gives the faces back texel by texel") {
        for (const int n : {1, 2, 5}) {
            const Cube cube = numbered_cube(n);
            for (const CubeLayout layout :
                 {CubeLayout::hcross, CubeLayout::vcross, CubeLayout::strip, CubeLayout::hstrip})
                CHECK(equal(cut_faces(paste_faces(cube, layout), layout, FaceOrder::gl, "sky"), cube));
            CHECK(equal(cut_faces(paste_faces(cube, CubeLayout::strip, FaceOrder::openexr), CubeLayout::strip,
                                  FaceOrder::openexr, "sky"),
                        cube));
        }
    }

    TEST_CASE("layout: in crosses neighbouring cells continue each other") {
        // Colour = direction: across every inner border of a cross that joins two cells the step is that inside a face.
        const int n = 8;
        Cube cube = make_cube(n, 3);
        for (const CubeFace face : all_cube_faces)
            for (int y = 0; y < n; ++y)
                for (int x = 0; x < n; ++x) {
                    const Vec3d d =
                        glm::normalize(cube_direction(CubePoint<double>{face, (x + 0.5) / n, (y + 0.5) / n}));
                    for (int c = 0; c < 3; ++c) cube[face].at(x, y, c) = float(d[c]);
                }
        for (const CubeLayout layout : {CubeLayout::hcross, CubeLayout::vcross}) {
            const Image<float> cross = paste_faces(cube, layout);
            const auto step = [&](int x0, int y0, int x1, int y1) {
                Vec3f d;
                for (int c = 0; c < 3; ++c) d[c] = cross.at(x1, y1, c) - cross.at(x0, y0, c);
                return glm::length(d);
            };
            for (int i = 0; i < n; ++i) {
                CHECK(step(n + i, n - 1, n + i, n) < 0.3f);         // py over pz
                CHECK(step(n - 1, n + i, n, n + i) < 0.3f);         // nx beside pz
                CHECK(step(2 * n - 1, n + i, 2 * n, n + i) < 0.3f); // px beside pz
                CHECK(step(n + i, 2 * n - 1, n + i, 2 * n) < 0.3f); // ny under pz
                if (layout == CubeLayout::hcross) CHECK(step(3 * n - 1, n + i, 3 * n, n + i) < 0.3f);
                else CHECK(step(n + i, 3 * n - 1, n + i, 3 * n) < 0.3f);
            }
        }
    }

    TEST_CASE("layout: a face turned four times is itself, and once puts its right side on top") {
        const Cube cube = numbered_cube(3);
        const Image<float>& face = cube.faces[0];
        CHECK(turned(face, 1).at(0, 0) == face.at(2, 0));
        CHECK(turned(face, 1).at(2, 0) == face.at(2, 2));
        CHECK(turned(face, -1).at(0, 0) == face.at(0, 2));
        const Image<float> round = turned(turned(face, 3), 1);
        for (int i = 0; i < 9; ++i) CHECK(round.data()[i] == face.data()[i]);
    }

    TEST_CASE("layout: a picture whose size does not fit its layout is refused") {
        CHECK_THROWS_AS(cut_faces(Image<float>(10, 7, 1), CubeLayout::hcross, FaceOrder::gl, "sky"), Error);
        CHECK_THROWS_AS(cut_faces(Image<float>(5, 31, 1), CubeLayout::strip, FaceOrder::gl, "sky"), Error);
    }

} // TEST_SUITE
