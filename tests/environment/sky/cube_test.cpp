#include "bake/environment/sky/cube.h"
#include <cmath>
#include <doctest/doctest.h>
#include <limits>
#include <random>

using namespace bake;

namespace {

constexpr auto& all_faces = all_cube_faces;

/// Every texel of its own colour.
Cube random_cube(int n) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> uniform(0, 1);
    Cube cube;
    for (Image<float>& face : cube.faces) {
        face = Image<float>(n, n, 3);
        for (std::size_t i = 0; i < face.size(); ++i) face.data()[i] = uniform(random);
    }
    return cube;
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("cube: the lecture's example lies on nz at s = .690476, t = .196429") {
        const CubePoint<double> at = cube_point(Vec3d(-3.2, 5.1, -8.4));
        CHECK(at.face == CubeFace::nz);
        CHECK(at.s == doctest::Approx(0.690476).epsilon(1e-6));
        CHECK(at.t == doctest::Approx(0.196429).epsilon(1e-6));
    }

    TEST_CASE("cube: the OpenGL table, row by row") {
        const double a = 0.25, b = -0.5;
        const auto check = [](const Vec3d& d, CubeFace face, double sc, double tc) {
            const CubePoint<double> at = cube_point(3.0 * d);
            CHECK(at.face == face);
            CHECK(at.s == doctest::Approx((sc + 1) / 2));
            CHECK(at.t == doctest::Approx((tc + 1) / 2));
        };
        check({1, a, b}, CubeFace::px, -b, -a);
        check({-1, a, b}, CubeFace::nx, b, -a);
        check({a, 1, b}, CubeFace::py, a, b);
        check({a, -1, b}, CubeFace::ny, a, -b);
        check({a, b, 1}, CubeFace::pz, a, -b);
        check({a, b, -1}, CubeFace::nz, -a, -b);
    }

} // TEST_SUITE
TEST_SUITE("unit") {

    TEST_CASE("cube: a point of a face has the direction that leads back to it") {
        for (const CubeFace face : all_faces)
            for (const double s : {0.01, 0.3, 0.99})
                for (const double t : {0.01, 0.6, 0.99}) {
                    const CubePoint<double> back = cube_point(cube_direction(CubePoint<double>{face, s, t}));
                    CHECK(back.face == face);
                    CHECK(back.s == doctest::Approx(s));
                    CHECK(back.t == doctest::Approx(t));
                }
    }

    TEST_CASE("cube: equal magnitudes go to z before y before x") {
        CHECK(cube_point(Vec3d(1, 1, -1)).face == CubeFace::nz);
        CHECK(cube_point(Vec3d(-1, 0, 1)).face == CubeFace::pz);
        CHECK(cube_point(Vec3d(1, -1, 0.5)).face == CubeFace::ny);
        CHECK(cube_point(Vec3d(-1, 0.5, 0.5)).face == CubeFace::nx);
    }

    TEST_CASE("cube: the flip to the world turns x alone, and is its own inverse") {
        const Vec3d d(1, 2, 3);
        CHECK(world_to_cube(d) == Vec3d(-1, 2, 3));
        CHECK(world_to_cube(world_to_cube(d)) == d);
    }

    TEST_CASE("cube: lookup at a texel's centre is the texel") {
        const Cube cube = random_cube(5);
        for (const CubeFace face : all_faces)
            for (int y = 0; y < 5; ++y)
                for (int x = 0; x < 5; ++x) {
                    const CubePoint<float> centre{face, (x + 0.5f) / 5, (y + 0.5f) / 5};
                    const Vec3f value = lookup(cube, cube_direction(centre));
                    for (int c = 0; c < 3; ++c)
                        CHECK(value[c] == doctest::Approx(cube.faces[int(face)].at(x, y, c)).epsilon(1e-5));
                }
    }

    TEST_CASE("cube: lookups of one to four channels agree channel by channel") {
        const Cube three = random_cube(6);
        for (int channels = 1; channels <= 4; ++channels) {
            Cube some = make_cube(6, channels);
            for (int f = 0; f < 6; ++f)
                for (int y = 0; y < 6; ++y)
                    for (int x = 0; x < 6; ++x)
                        for (int c = 0; c < channels; ++c) some.faces[f].at(x, y, c) = three.faces[f].at(x, y, c % 3);
            for (const Vec3d d : {Vec3d(1, 0.97, -0.2), Vec3d(-1, 1, 0.99), Vec3d(0.3, -0.2, 1)}) {
                float value[4], whole[3];
                lookup(some, d, value);
                lookup(three, d, whole);
                for (int c = 0; c < channels; ++c) CHECK(value[c] == whole[c % 3]);
            }
        }
    }

    TEST_CASE("cube: a step across an edge and back ends where it began") {
        for (const int n : {1, 4, 7})
            for (const CubeFace face : all_faces)
                for (int i = 0; i < n; ++i) {
                    const CubeTexel there = texel_across(n, face, n, i);
                    int back = 0;
                    for (const auto& [dx, dy] :
                         {std::pair(1, 0), std::pair(-1, 0), std::pair(0, 1), std::pair(0, -1)}) {
                        const int x = there.x + dx, y = there.y + dy;
                        if (x >= 0 && y >= 0 && x < n && y < n) continue;
                        const CubeTexel here = texel_across(n, there.face, x, y);
                        back += here.face == face && here.x == n - 1 && here.y == i;
                    }
                    CHECK(back == 1);
                }
    }

    TEST_CASE("cube: all 12 edges and 8 corners are continuous, for faces of any size") {
        for (const int n : {1, 2, 3, 8}) {
            const Cube cube = random_cube(n);
            const float step = 1e-4f;
            for (int axis = 0; axis < 3; ++axis)
                for (const float side_a : {-1.0f, 1.0f})
                    for (const float side_b : {-1.0f, 1.0f})
                        for (float along = -1; along <= 1.001f; along += 0.0625f) {
                            Vec3f edge;
                            edge[axis] = along;
                            edge[(axis + 1) % 3] = side_a;
                            edge[(axis + 2) % 3] = side_b;
                            Vec3f one = edge, other = edge;
                            one[(axis + 1) % 3] *= 1 - step;
                            other[(axis + 2) % 3] *= 1 - step;
                            const Vec3f jump = lookup(cube, one) - lookup(cube, other);
                            // Texels differ by at most 1; the two points are two steps of n/2 texels apart.
                            for (int c = 0; c < 3; ++c) CHECK(std::abs(jump[c]) <= 2 * step * float(n) + 1e-5f);
                        }
        }
    }

    TEST_CASE("cube: a smooth picture stays smooth across the edges: second differences are those inside a face") {
        // Colour = direction: at an edge the bilinear value must be near the direction itself, as inside.
        const int n = 64;
        Cube cube;
        for (const CubeFace face : all_faces) {
            Image<float>& image = cube.faces[int(face)] = Image<float>(n, n, 3);
            for (int y = 0; y < n; ++y)
                for (int x = 0; x < n; ++x) {
                    const Vec3f d =
                        glm::normalize(cube_direction(CubePoint<float>{face, (x + 0.5f) / n, (y + 0.5f) / n}));
                    for (int c = 0; c < 3; ++c) image.at(x, y, c) = d[c];
                }
        }
        std::mt19937 random(3);
        std::uniform_real_distribution<float> uniform(-1, 1);
        float worst = 0;
        for (int i = 0; i < 20000; ++i) {
            Vec3f d(uniform(random), uniform(random), uniform(random));
            if (i % 2) d[i % 3] = d[(i + 1) % 3] * (i % 4 == 1 ? 1.0f : -1.0f); // on an edge
            d = unit_or_zero(d);
            worst = std::max(worst, glm::length(lookup(cube, d) - d));
        }
        CHECK(worst < 0.006f); // at a corner; a clamped lookup is off by half a texel there, .016
    }

} // TEST_SUITE
TEST_SUITE("stability") {

    TEST_CASE("cube: directions without a direction have a defined place") {
        const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
        const auto check = [](const Vec3d& d, CubeFace face, double s, double t) {
            const CubePoint<double> at = cube_point(d);
            CHECK(at.face == face);
            CHECK(at.s == doctest::Approx(s));
            CHECK(at.t == doctest::Approx(t));
        };
        check({0, 0, 0}, CubeFace::pz, 0.5, 0.5);
        check({-0.0, -0.0, -0.0}, CubeFace::pz, 0.5, 0.5);
        check({nan, nan, nan}, CubeFace::pz, 0.5, 0.5);
        check({nan, -2, 1}, CubeFace::ny, 0.5, 0.25);
        check({-inf, 3, 1e300}, CubeFace::nx, 0.5, 0.5);
        check({inf, 0, -inf}, CubeFace::nz, 0, 0.5);
    }

    TEST_CASE("cube: denormal and huge directions are found as well as others") {
        for (const float scale : {1e-44f, 1e-40f, 1e-30f, 1.0f, 1e30f, 3e38f}) {
            const CubePoint<float> at = cube_point(Vec3f(0, 0, scale));
            CHECK(at.face == CubeFace::pz);
            CHECK(at.s == 0.5f);
            CHECK(at.t == 0.5f);
            const CubePoint<float> corner = cube_point(Vec3f(-scale, scale, scale));
            CHECK(corner.s == 0.0f);
            CHECK(corner.t == 0.0f);
        }
    }

    TEST_CASE("cube: lookups anywhere stay within the texels' values") {
        const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
        const Cube cube = random_cube(3);
        for (const float x : {0.0f, 1.0f, -1.0f, nan, inf, 1e-45f})
            for (const float y : {0.0f, 1.0f, -1.0f, nan, -inf, 3e38f})
                for (const float z : {0.0f, 1.0f, -1.0f, nan, inf, -1e-45f}) {
                    const Vec3f value = lookup(cube, {x, y, z});
                    for (int c = 0; c < 3; ++c) CHECK((value[c] >= 0 && value[c] <= 1));
                }
    }

} // TEST_SUITE
