#include "bake/base/error.h"
#include "bake/base/parallel.h"
#include "bake/base/vec.h"
#include "bake/environment/resample/resample.h"
#include "bake/environment/sky/sky_format.h"
#include "bake/environment/sky/solid_angle.h"
#include "environment/smooth_skies.h"
#include <cstring>
#include <doctest/doctest.h>
#include <random>

using namespace bake;
using test::smooth_cube;
using test::smooth_picture;
using test::smooth_sky;
using test::texel_direction;

namespace {

struct CubeError {
    double rms = 0;   ///< over all texels, against the closed form at their centres
    double shift = 0; ///< largest by which a face lies beside it, in texels
};

CubeError error_of(const Cube& cube, bool edges) {
    CubeError error{test::rms(test::smooth_errors(cube, edges)), 0};
    const int n = cube.size(), step = n > 100 ? 4 : 1;
    for (const CubeFace face : all_cube_faces) {
        // Least squares of the error over the slopes: (a, b) is the shift.
        double xx = 0, xy = 0, yy = 0, xe = 0, ye = 0;
        for (int y = 0; y < n; y += step)
            for (int x = 0; x < n; x += step) {
                const auto at = [&](double dx, double dy) {
                    return smooth_sky(texel_direction(face, n, edges, x + dx, y + dy));
                };
                const double e = cube[face].at(x, y) - at(0, 0), slope_x = at(0.5, 0) - at(-0.5, 0),
                             slope_y = at(0, 0.5) - at(0, -0.5);
                xx += slope_x * slope_x;
                xy += slope_x * slope_y;
                yy += slope_y * slope_y;
                xe += slope_x * e;
                ye += slope_y * e;
            }
        const double det = xx * yy - xy * xy;
        error.shift = std::max({error.shift, std::abs((yy * xe - xy * ye) / det), std::abs((xx * ye - xy * xe) / det)});
    }
    return error;
}

double rms_of(const Image<float>& picture, Projection p) { return test::rms(test::smooth_errors(picture, p)); }

/// 250 suns of one texel and one unit of flux each, at least 5 degrees apart.
struct Suns {
    Environment sky;
    std::vector<Vec3d> directions;
};

Suns make_suns(int width) {
    const int height = width / 2;
    Suns suns;
    suns.sky.picture = Image<float>(width, height, 1);
    std::fill_n(suns.sky.picture.data(), suns.sky.picture.size(), 0.0f);
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    while (suns.directions.size() < 250) {
        const Vec2d at =
            picture_point(Projection::latlong, width, height, {normal(random), normal(random), normal(random)});
        const int x = std::min(width - 1, int(at.x)), y = std::min(height - 1, int(at.y));
        const Vec3d d = picture_direction(Projection::latlong, width, height, x + 0.5, y + 0.5);
        bool alone = true;
        for (const Vec3d& other : suns.directions) alone &= glm::dot(other, d) < std::cos(0.087);
        if (!alone) continue;
        suns.directions.push_back(d);
        const double top = pi * (0.5 - double(y) / height), bottom = pi * (0.5 - double(y + 1) / height);
        suns.sky.picture.at(x, y) = float(1 / (2 * pi / width * (std::sin(top) - std::sin(bottom))));
    }
    return suns;
}

double flux_of(const Image<float>& latlong) {
    const int w = latlong.width(), h = latlong.height();
    double flux = 0;
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x)
            flux += latlong.at(x, y) * 2 * pi / w * (std::cos(pi * y / h) - std::cos(pi * (y + 1) / h));
    return flux;
}

double flux_of(const Cube& cube) {
    const std::vector<double> omega = texel_solid_angles(cube.size());
    double flux = 0;
    for (const Image<float>& face : cube.faces)
        for (std::size_t i = 0; i < omega.size(); ++i) flux += face.data()[i] * omega[i];
    return flux;
}

bool same_bytes(const Image<float>& a, const Image<float>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("resample: a smooth lat-long of 2048 gives faces of 512 to 2e-6, in their place to .001 texel, in both "
              "sample conventions") {
        for (const bool edges : {false, true}) {
            const Environment sky = smooth_picture(edges ? Projection::latlong_edges : Projection::latlong, 2048, 1024);
            for (const Samples samples : {Samples::exact, Samples::one}) {
                const CubeError error = error_of(to_cube(sky, {512, edges}, {samples}), edges);
                const std::string what = std::string(edges ? "edge" : "centre") + " samples, " +
                                         (samples == Samples::exact ? "exact" : "one look");
                MESSAGE(what << ": rms " << error.rms << ", shift " << error.shift << " texel");
                CHECK(error.rms <= 2e-6);
                CHECK(error.shift <= 0.001);
            }
        }
    }

    TEST_CASE("resample: the error of exact falls with the square of the texel") {
        const auto error = [](int width) {
            return error_of(to_cube(smooth_picture(Projection::latlong, width, width / 2), {width / 4, false},
                                    {Samples::exact}),
                            false)
                .rms;
        };
        CHECK(error(256) / error(512) > 3.4);
    }

    TEST_CASE("resample: of 250 suns of one texel none is lost, and each keeps its flux to .1 %") {
        const Suns suns = make_suns(2048);
        for (const int n : {512, 128}) {
            const Cube cube = to_cube(suns.sky, {n, false}, {Samples::exact});
            for (const CubeFace face : all_cube_faces)
                CHECK(*std::min_element(cube[face].data(), cube[face].data() + std::size_t(n) * n) >= 0);
            const std::vector<double> flux = test::fluxes(cube, suns.directions);
            double mean = 0, square = 0, least = 1e9;
            for (const double f : flux) mean += f / 250, least = std::min(least, f);
            for (const double f : flux) square += (f - mean) * (f - mean) / 250;
            MESSAGE(n << " texels: mean " << mean << ", standard deviation " << std::sqrt(square) << ", least "
                      << least);
            CHECK(least > 0.99);
            CHECK(mean == doctest::Approx(1).epsilon(1e-4));
            CHECK(std::sqrt(square) <= 0.001);
        }
    }

    TEST_CASE("resample: cubes become lat-longs and octahedral maps as exactly, turned or not") {
        const glm::dmat3 turn = turn_of(30, 20, 10);
        const Environment cube = smooth_cube(128);
        for (const Projection p : {Projection::latlong, Projection::latlong_edges, Projection::octahedral}) {
            CAPTURE(name(p));
            const int w = p == Projection::octahedral ? 256 : 512, h = p == Projection::octahedral ? 256 : 256;
            // A quarter of the size above has 16 times its error, 1.3e-5; the octahedral map's folds and poles add to it.
            CHECK(rms_of(to_picture(cube, p, w, h, {Samples::exact}), p) < 1.5e-4);
            const Image<float> picture = to_picture(cube, p, w, h, {Samples::exact, turn});
            double worst = 0;
            for (int y = 2; y < h - 2; ++y)
                for (int x = 0; x < w; ++x) {
                    const Vec3d d = glm::transpose(turn) * picture_direction(p, w, h, x + 0.5, y + 0.5);
                    worst = std::max(worst, std::abs(picture.at(x, y) - smooth_sky(d)));
                }
            CHECK(worst < 2e-3);
        }
    }

    TEST_CASE("resample: edge-sampled cubes are read and written where their samples lie") {
        CHECK(error_of(to_cube(smooth_cube(65, true), {64, false}, {Samples::exact}), false).shift < 0.01);
        CHECK(error_of(to_cube(smooth_cube(64), {65, true}, {Samples::exact}), true).shift < 0.01);
        CHECK(rms_of(to_picture(smooth_cube(129, true), Projection::latlong, 512, 256, {Samples::exact}),
                     Projection::latlong) < 1e-4);
        // Read as texel-centred, it would be half a texel off at the edges: the test can tell.
        Environment mistaken = smooth_cube(65, true);
        mistaken.edge_samples = false;
        CHECK(error_of(to_cube(mistaken, {64, false}, {Samples::exact}), false).rms >
              10 * error_of(to_cube(smooth_cube(65, true), {64, false}, {Samples::exact}), false).rms);
    }

} // TEST_SUITE
TEST_SUITE("unit") {

    TEST_CASE("resample: a sky that is nowhere negative stays so, on edges, corners and poles too") {
        // Steep noise down to black: slopes reach the darkest neighbour everywhere.
        std::mt19937 random(11);
        std::uniform_real_distribution<float> uniform(0, 1);
        const auto noise = [&](Image<float>& image) {
            for (std::size_t i = 0; i < image.size(); ++i) image.data()[i] = std::max(0.0f, uniform(random) - 0.3f);
        };
        const auto darkest = [](const Image<float>& image) {
            return *std::min_element(image.data(), image.data() + image.size());
        };
        for (const bool edges : {false, true}) {
            Environment cube, latlong;
            cube.edge_samples = edges;
            cube.cube = make_cube(64, 1);
            for (Image<float>& face : cube.cube.faces) noise(face);
            latlong.projection = edges ? Projection::latlong_edges : Projection::latlong;
            latlong.picture = Image<float>(128, 64, 1);
            noise(latlong.picture);
            const ResampleOptions exact{Samples::exact, turn_of(20, 30, 0)};
            for (const Environment* sky : {&cube, &latlong}) {
                const Cube made = to_cube(*sky, {150, edges}, exact);
                for (const Image<float>& face : made.faces) CHECK(darkest(face) >= 0);
            }
            CHECK(darkest(to_picture(cube, Projection::latlong, 400, 200, exact)) >= 0);
        }
    }

    TEST_CASE("resample: all light arrives, whatever becomes what") {
        std::mt19937 random(3);
        std::uniform_real_distribution<float> uniform(0, 1);
        const auto spots = [&](Image<float>& image) {
            for (std::size_t i = 0; i < image.size(); ++i)
                image.data()[i] = uniform(random) < 0.02f ? 100 * uniform(random) : 0.01f;
        };
        Environment latlong, cube, octahedral;
        latlong.picture = Image<float>(256, 128, 1);
        spots(latlong.picture);
        cube.cube = make_cube(48, 1);
        for (Image<float>& face : cube.cube.faces) spots(face);
        octahedral.projection = Projection::octahedral;
        octahedral.picture = Image<float>(96, 96, 1);
        spots(octahedral.picture);
        double octahedral_flux = 0;
        for (std::size_t i = 0; i < octahedral.picture.size(); ++i)
            octahedral_flux += octahedral.picture.data()[i] * 4 * pi / (96 * 96);

        const ResampleOptions exact{Samples::exact, turn_of(17, 5, -40)};
        for (const int n : {7, 40}) {
            CHECK(flux_of(to_cube(latlong, {n, false}, exact)) ==
                  doctest::Approx(flux_of(latlong.picture)).epsilon(2e-4));
            CHECK(flux_of(to_cube(cube, {n, false}, exact)) == doctest::Approx(flux_of(cube.cube)).epsilon(2e-4));
            CHECK(flux_of(to_cube(octahedral, {n, false}, exact)) == doctest::Approx(octahedral_flux).epsilon(2e-4));
            CHECK(flux_of(to_picture(cube, Projection::latlong, 4 * n, 2 * n, exact)) ==
                  doctest::Approx(flux_of(cube.cube)).epsilon(1e-3));
        }
        CHECK(flux_of(to_picture(octahedral, Projection::latlong, 200, 100, exact)) ==
              doctest::Approx(octahedral_flux).epsilon(1e-3));
        // Halving unturned faces is a mean of four weighted by solid angle.
        CHECK(flux_of(to_cube(cube, {24, false}, {Samples::exact})) ==
              doctest::Approx(flux_of(cube.cube)).epsilon(1e-5));
    }

    TEST_CASE("resample: a white sky stays white to the last bits, at any size and coarseness") {
        for (const int w : {2, 4, 10, 64, 300}) {
            Environment sky;
            sky.picture = Image<float>(w, w / 2, 2);
            for (std::size_t i = 0; i < sky.picture.size(); ++i) sky.picture.data()[i] = 1;
            for (const Samples samples : {Samples::one, Samples::grid4, Samples::exact})
                for (const int n : {1, 3, 16, 50}) {
                    const Cube cube = to_cube(sky, {n, false}, {samples, turn_of(10, 20, 30)});
                    float worst = 0;
                    for (const Image<float>& face : cube.faces)
                        for (std::size_t i = 0; i < face.size(); ++i)
                            worst = std::max(worst, std::abs(face.data()[i] - 1));
                    CHECK(worst <= 5e-7f);
                }
        }
    }

    TEST_CASE(
        "resample: between lattices of the same kind and size texels stay as they are, turned by right angles too") {
        std::mt19937 random(4);
        std::uniform_real_distribution<float> uniform(0, 1e4f);
        Environment sky;
        sky.cube = make_cube(9, 3);
        for (Image<float>& face : sky.cube.faces)
            for (std::size_t i = 0; i < face.size(); ++i) face.data()[i] = uniform(random);
        const Cube same = to_cube(sky, {9, false});
        for (int k = 0; k < 6; ++k) CHECK(same_bytes(same.faces[k], sky.cube.faces[k]));
        // Ahead to the right: the picture of pz stands on px.
        const Cube yawed = to_cube(sky, {9, false}, {Samples::automatic, turn_of(90, 0, 0)});
        CHECK(same_bytes(yawed[CubeFace::px], sky.cube[CubeFace::pz]));
        CHECK(same_bytes(yawed[CubeFace::nz], sky.cube[CubeFace::px]));
        Environment back;
        back.cube = to_cube(sky, {9, false}, {Samples::automatic, turn_of(90, 90, 180)});
        const Cube again = to_cube(back, {9, false}, {Samples::automatic, glm::transpose(turn_of(90, 90, 180))});
        for (int k = 0; k < 6; ++k) CHECK(same_bytes(again.faces[k], sky.cube.faces[k]));
        Environment latlong;
        latlong.picture = Image<float>(16, 8, 1);
        for (std::size_t i = 0; i < latlong.picture.size(); ++i) latlong.picture.data()[i] = uniform(random);
        CHECK(same_bytes(to_picture(latlong, Projection::latlong, 16, 8), latlong.picture));
    }

    TEST_CASE("resample: turns are what their names say") {
        const Vec3d ahead(0, 0, 1), up(0, 1, 0);
        CHECK(glm::length(turn_of(90, 0, 0) * ahead - Vec3d(1, 0, 0)) < 1e-12);
        CHECK(glm::length(turn_of(0, 90, 0) * ahead - up) < 1e-12);
        CHECK(glm::length(turn_of(0, 0, 90) * up - Vec3d(1, 0, 0)) < 1e-12);
        CHECK(glm::length(turn_of(90, 0, 90) * ahead - Vec3d(0, -1, 0)) < 1e-12);
        glm::dmat3 slight = turn_of(90.001, 0, 0);
        CHECK(!snap_to_axes(slight));
    }

    TEST_CASE("resample: a yaw by whole columns moves the columns of a lat-long") {
        std::mt19937 random(5);
        std::uniform_real_distribution<float> uniform(0, 1);
        for (const auto& [projection, width] : {std::pair(Projection::latlong, 16), {Projection::latlong_edges, 17}}) {
            Environment sky;
            sky.projection = projection;
            sky.picture = Image<float>(width, 8, 1);
            for (std::size_t i = 0; i < sky.picture.size(); ++i) sky.picture.data()[i] = uniform(random);
            for (int y = 0; y < 8 && width == 17; ++y) sky.picture.at(16, y) = sky.picture.at(0, y);
            for (const double yaw : {22.5, 90.0, -45.0, 180.0}) {
                const auto turned = to_picture(sky, projection, width, 8, {.turn = turn_of(yaw, 0, 0)});
                const int columns = int(std::lround(yaw / 22.5));
                double most = 0;
                for (int y = projection == Projection::latlong ? 0 : 1; y < 7; ++y)
                    for (int x = 0; x < 16; ++x)
                        most = std::max(most, std::abs(double(turned.at((x + columns + 16) % 16, y)) -
                                                       double(sky.picture.at(x, y))));
                CHECK(most < 1e-6);
            }
            CHECK(resolve(sky, sky.density(), true, {.turn = turn_of(23, 0, 0)}) == Samples::exact);
            CHECK(resolve(sky, sky.density(), true, {.turn = turn_of(22.5, 10, 0)}) == Samples::exact);
            CHECK(resolve(sky, sky.density() / 2, false, {.turn = turn_of(90, 0, 0)}) == Samples::exact);
        }
    }

    TEST_CASE("resample: what automatic takes") {
        Environment cube = smooth_cube(8), ball = smooth_picture(Projection::ball, 16, 16);
        CHECK(resolve(cube, cube.density(), true, {}) == Samples::one);
        CHECK(resolve(cube, cube.density(), true, {Samples::automatic, turn_of(5, 0, 0)}) == Samples::exact);
        CHECK(resolve(cube, cube.density() / 3, false, {}) == Samples::exact);
        CHECK(resolve(cube, cube.density() * 3, false, {}) == Samples::grid4);
        CHECK(resolve(ball, cube.density(), false, {}) == Samples::grid4);
        CHECK_THROWS_AS(resolve(ball, cube.density(), false, {Samples::exact}), Error);
    }

    TEST_CASE("resample: balls and probes give the sky they show") {
        for (const Projection p : {Projection::ball, Projection::probe}) {
            CAPTURE(name(p));
            const Cube cube = to_cube(smooth_picture(p, 512, 512), {32, false});
            double worst = 0;
            for (const CubeFace face : all_cube_faces)
                for (int y = 0; y < 32; ++y)
                    for (int x = 0; x < 32; ++x) {
                        const Vec3d d = glm::normalize(texel_direction(face, 32, false, x, y));
                        // What lies behind the rim is on no texel: a ball's within .1 rad, a probe's within .02.
                        if (p == Projection::ball ? d.z < 0.95 : d.z > -0.99)
                            worst = std::max(worst, std::abs(cube[face].at(x, y) - smooth_sky(d)));
                    }
            CHECK(worst < 0.01);
        }
    }

} // TEST_SUITE
TEST_SUITE("stability") {

    TEST_CASE("resample: the same bytes for 1, 2 and 7 threads") {
        const Environment picture = smooth_picture(Projection::latlong, 120, 60), cube = smooth_cube(40);
        const ResampleOptions options{Samples::exact, turn_of(33, 44, 55)};
        std::vector<Cube> cubes;
        std::vector<Image<float>> pictures;
        for (const int threads : {1, 2, 7}) {
            const ThreadLimit limit(threads);
            cubes.push_back(to_cube(picture, {50, true}, options));
            pictures.push_back(to_picture(cube, Projection::octahedral, 90, 90, options));
        }
        for (int i = 1; i < 3; ++i) {
            for (int k = 0; k < 6; ++k) CHECK(same_bytes(cubes[0].faces[k], cubes[i].faces[k]));
            CHECK(same_bytes(pictures[0], pictures[i]));
        }
    }

    TEST_CASE("each_band: its bands are the rows of the faces, of turned ones from the last row on") {
        const Environment source = smooth_picture(Projection::latlong, 64, 32);
        const FaceGrid grid{200, false};
        const ResampleOptions options{Samples::grid4};
        const Cube cube = to_cube(source, grid, options);
        std::array<TurnedFace, 6> places;
        std::array<Image<float>, 6> faces;
        for (int k = 0; k < 6; ++k) {
            places[k] = {all_cube_faces[5 - k], k % 2 == 0 ? 2 : 0};
            faces[k] = turned(cube[places[k].face], places[k].turns);
        }
        int bands = 0;
        std::int64_t rows = 0;
        each_band(source, grid, options, places, [&](int k, int y, Image<float>& band) {
            CHECK(std::memcmp(band.data(), faces[k].row(y), band.size() * sizeof(float)) == 0);
            ++bands, rows += band.height();
        });
        CHECK(bands > 6); // a face is more than one
        CHECK(rows == 6 * 200);
    }

    TEST_CASE("resample: texels that faces share are equal in an edge-sampled cube") {
        const Cube cube = to_cube(smooth_picture(Projection::latlong, 128, 64), {17, true}, {Samples::exact});
        int compared = 0;
        for (const CubeFace a : all_cube_faces)
            for (const CubeFace b : all_cube_faces)
                for (int i = 0; i < 17; ++i)
                    for (int side = 0; side < 4; ++side) {
                        const int x = side == 0 ? 0 : side == 1 ? 16 : i, y = side == 2 ? 0 : side == 3 ? 16 : i;
                        const Vec3d d = texel_direction(a, 17, true, x, y);
                        for (int v = 0; v < 17; ++v)
                            for (int u = 0; u < 17; ++u)
                                if (a < b && texel_direction(b, 17, true, u, v) == d) {
                                    CHECK(cube[a].at(x, y) == cube[b].at(u, v));
                                    ++compared;
                                }
                    }
        CHECK(compared >= 12 * 17);
    }

} // TEST_SUITE
