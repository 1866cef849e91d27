#include "bake/environment/face_files.h"
#include "bake/base/error.h"
#include <cmath>
#include <cstdlib>
#include <doctest/doctest.h>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <random>
#include <unistd.h>

using namespace bake;
namespace fs = std::filesystem;

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

struct Folder {
    fs::path path = fs::temp_directory_path() / ("bake_cube_test_" + std::to_string(getpid()) + "_" + std::to_string(std::rand()));
    Folder() { fs::create_directories(path); }
    ~Folder() { fs::remove_all(path); }
    std::string operator/(const std::string& name) const { return (path / name).string(); }
};

Image<float> flat_image(int width, int height, int channels, float value) {
    Image<float> image(width, height, channels);
    for (std::size_t i = 0; i < image.size(); ++i) image.data()[i] = value;
    return image;
}

/// Runs `work`, which must refuse with `why` and name `file`.
template <class Work> void check_refused(Refusal why, const std::string& file, Work&& work) {
    try {
        work();
        FAIL("not refused");
    } catch (const Error& error) {
        CHECK(error.refusal == why);
        CHECK_MESSAGE(std::string(error.what()).rfind(file, 0) == 0, error.what());
        CHECK_MESSAGE(std::string(error.what()).find(';') != std::string::npos, error.what());
    }
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
                const Vec3f d = glm::normalize(cube_direction(CubePoint<float>{face, (x + 0.5f) / n, (y + 0.5f) / n}));
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

TEST_CASE("cube: a pattern stands for six names") {
    const auto files = cube_files("sky/a_%s.jpg");
    CHECK(files[0] == "sky/a_px.jpg");
    CHECK(files[5] == "sky/a_nz.jpg");
    for (const char* bad : {"sky.jpg", "%s/%s.jpg"}) check_refused(Refusal::usage, bad, [&] { cube_files(bad); });
}

TEST_CASE("cube: 8-bit faces are decoded from sRGB, float faces are not, and either can be told") {
    const Folder folder;
    for (const char* name : cube_face_names) {
        write_image(folder / (std::string(name) + ".png"), flat_image(2, 2, 3, 0.5f), {.depth = Depth::u8});
        write_image(folder / (std::string(name) + ".exr"), flat_image(2, 2, 4, 0.5f), {.depth = Depth::float32});
    }
    const double decoded = std::pow((128 / 255.0 + 0.055) / 1.055, 2.4);
    CHECK(read_cube(cube_files(folder / "%s.png")).faces[3].at(1, 1, 2) == doctest::Approx(decoded).epsilon(1e-5));
    const Cube as_data = read_cube(cube_files(folder / "%s.png"), ColourSpace::linear);
    CHECK(as_data.faces[0].at(0, 0) == doctest::Approx(128 / 255.0));
    const Cube floats = read_cube(cube_files(folder / "%s.exr"));
    CHECK(floats.faces[5].at(0, 1, 1) == doctest::Approx(0.5));
    CHECK(floats.faces[5].channels() == 3);
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

TEST_CASE("cube: a faulty face is refused by its name") {
    const Folder folder;
    const auto files = cube_files(folder / "%s.exr");
    const auto write = [&](int i, const Image<float>& image) {
        write_image(files[i], image, {.depth = Depth::float32});
    };
    for (int i = 0; i < 6; ++i) write(i, flat_image(4, 4, 3, 0.5f));
    CHECK(read_cube(files).size() == 4);

    write(2, flat_image(4, 5, 3, 0.5f));
    check_refused(Refusal::unsuitable, files[2], [&] { read_cube(files); });
    write(2, flat_image(8, 8, 3, 0.5f));
    check_refused(Refusal::unsuitable, files[2], [&] { read_cube(files); });
    write(2, flat_image(4, 4, 1, 0.5f));
    check_refused(Refusal::unsuitable, files[2], [&] { read_cube(files); });
    write(2, flat_image(4, 4, 3, std::numeric_limits<float>::quiet_NaN()));
    check_refused(Refusal::unsuitable, files[2], [&] { read_cube(files); });
    fs::remove(files[2]);
    check_refused(Refusal::unreadable, files[2], [&] { read_cube(files); });
}

} // TEST_SUITE
TEST_SUITE("real") {

TEST_CASE("cube: the seams of a photographed sky are invisible") {
    const char* source = std::getenv("BAKE_SOURCE");
    const fs::path folder = fs::path(source ? source : ".") / "../shared/data/environments/sixface/studio_garden";
    if (!fs::exists(folder)) {
        MESSAGE("not here: " << folder.string());
        return;
    }
    const Cube cube = read_cube(cube_files((folder / "studio_garden_%s.jpg").string()));
    // Mean step from edge texel to edge texel across the 12 edges, over the mean step between rows inside the faces.
    const int n = cube.size();
    double across = 0, inside = 0;
    for (int axis = 0; axis < 3; ++axis)
        for (const float a : {-1.0f, 1.0f})
            for (const float b : {-1.0f, 1.0f})
                for (int i = 0; i < n; ++i) {
                    Vec3f one;
                    one[axis] = 2 * (i + 0.5f) / n - 1;
                    one[(axis + 1) % 3] = a;
                    one[(axis + 2) % 3] = b * (1 - 1.0f / n);
                    Vec3f other = one;
                    other[(axis + 1) % 3] = a * (1 - 1.0f / n);
                    other[(axis + 2) % 3] = b;
                    across += glm::length(lookup(cube, one) - lookup(cube, other)) / (12.0 * n);
                }
    for (const Image<float>& face : cube.faces)
        for (int y = 0; y + 1 < n; ++y)
            for (int x = 0; x < n; ++x)
                inside += glm::length(Vec3f(face.at(x, y, 0), face.at(x, y, 1), face.at(x, y, 2)) -
                                      Vec3f(face.at(x, y + 1, 0), face.at(x, y + 1, 1), face.at(x, y + 1, 2))) /
                          (6.0 * n * (n - 1));
    MESSAGE("seam measure " << across / inside);
    CHECK(across / inside < 1);
}

} // TEST_SUITE
