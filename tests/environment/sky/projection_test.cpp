#include "bake/base/vec.h"
#include "bake/environment/sky/environment.h"
#include "bake/environment/sky/sky_format.h"
#include <cmath>
#include <doctest/doctest.h>
#include <limits>
#include <random>
#include <utility>
#include <vector>

using namespace bake;

namespace {

Vec3d random_direction(std::mt19937& random) {
    std::normal_distribution<double> normal;
    return glm::normalize(Vec3d(normal(random), normal(random), normal(random)));
}

/// Every format that is a projection, with its name and its shape.
std::vector<SkyFormatEntry> projected_formats() {
    std::vector<SkyFormatEntry> found;
    for (const SkyFormatEntry& format : sky_formats)
        if (format.projection) found.push_back(format);
    return found;
}

int height_of(const SkyFormatEntry& format, int width) { return width * format.rows / format.columns; }

/// Derivatives of the direction at a picture point, along the picture's x and y. The difference is taken on the side of the
/// picture's middle, because a step over the border would be clamped.
std::pair<Vec3d, Vec3d> steps_at(const SkyFormatEntry& format, int w, int h, const Vec2d& at) {
    const double dx = at.x < 0.5 * w ? 1e-4 : -1e-4, dy = at.y < 0.5 * h ? 1e-4 : -1e-4;
    const auto direction = [&](double x, double y) { return picture_direction(*format.projection, w, h, x, y); };
    const Vec3d here = direction(at.x, at.y);
    return {(direction(at.x + dx, at.y) - here) / dx, (direction(at.x, at.y + dy) - here) / dy};
}

bool is_near_rim(const Vec2d& at, int w, int h, int discs) {
    const double width = double(w) / discs, u = std::fmod(at.x, width) / width;
    return std::hypot(2 * u - 1, 2 * at.y / h - 1) > 0.99;
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("projection: lat-long in closed form, ahead in the middle, +X at its right, up on top") {
        const Vec3d ahead = picture_direction(Projection::latlong, 8, 4, 4, 2);
        CHECK(glm::length(ahead - Vec3d(0, 0, 1)) < 1e-15);
        CHECK(glm::length(picture_direction(Projection::latlong, 8, 4, 6, 2) - Vec3d(1, 0, 0)) < 1e-15);
        CHECK(glm::length(picture_direction(Projection::latlong, 8, 4, 3, 0) - Vec3d(0, 1, 0)) < 1e-15);
        CHECK(glm::length(picture_direction(Projection::latlong, 8, 4, 0, 2) - Vec3d(0, 0, -1)) < 1e-15);
    }

    TEST_CASE("projection: OpenEXR's lat-long has the poles in its outer rows and one meridian twice") {
        for (int x = 0; x < 8; ++x)
            CHECK(picture_direction(Projection::latlong_edges, 8, 4, x + 0.5, 0.5).y == doctest::Approx(1));
        for (int y = 0; y < 4; ++y)
            CHECK(glm::length(picture_direction(Projection::latlong_edges, 8, 4, 0.5, y + 0.5) -
                              picture_direction(Projection::latlong_edges, 8, 4, 7.5, y + 0.5)) < 1e-14);
        // OpenEXR's own words: latitude from pi/2 down, longitude from +pi, x = sin(longitude) cos(latitude) in world axes.
        const double latitude = pi / 2 - pi * 1 / 3, longitude = pi - 2 * pi * 2 / 7;
        const Vec3d world(std::sin(longitude) * std::cos(latitude), std::sin(latitude),
                          std::cos(longitude) * std::cos(latitude));
        CHECK(glm::length(picture_direction(Projection::latlong_edges, 8, 4, 2.5, 1.5) - world_to_cube(world)) < 1e-14);
    }

    TEST_CASE("projection: the octahedral map is equal-area") {
        // Areas of small quadrilaterals on the sphere, over the whole picture: all 4 pi / n^2.
        const int n = 24;
        double worst = 0;
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x) {
                const double h = 1e-3;
                const auto at = [&](double dx, double dy) {
                    return picture_direction(Projection::octahedral, n, n, x + 0.4 + dx, y + 0.3 + dy);
                };
                const double area = glm::length(glm::cross(at(h, 0) - at(-h, 0), at(0, h) - at(0, -h))) / (4 * h * h);
                worst = std::max(worst, std::abs(area / (4 * pi / (n * n)) - 1));
            }
        CHECK(worst < 1e-5); // second order in h
    }

    TEST_CASE("projection: a mirror ball reflects by the law of reflection, a probe's angle is its radius") {
        const int n = 100;
        for (const double x : {20.0, 50.0, 71.0})
            for (const double y : {33.0, 60.0}) {
                const double u = 2 * x / n - 1, v = 1 - 2 * y / n;
                const Vec3d normal(u, v, -std::sqrt(1 - u * u - v * v)), seen(0, 0, 1);
                CHECK(glm::length(picture_direction(Projection::ball, n, n, x, y) -
                                  (seen - 2 * glm::dot(seen, normal) * normal)) < 1e-14);
                const Vec3d d = picture_direction(Projection::probe, n, n, x, y);
                CHECK(std::acos(d.z) / pi == doctest::Approx(std::hypot(u, v)));
                CHECK(d.x * v == doctest::Approx(d.y * u));
                CHECK(d.x * u >= 0);
            }
    }

    TEST_CASE("projection: arc tangents are those of the library to 1e-11, signs and axes included") {
        std::vector<double> y, x;
        std::mt19937 random(1);
        std::normal_distribution<double> normal;
        for (int i = 0; i < 20000; ++i) {
            y.push_back(normal(random) * std::pow(10.0, i % 7 - 3));
            x.push_back(normal(random));
        }
        for (const double a : {-1.0, 0.0, 1.0})
            for (const double b : {-1.0, 0.0, 1.0}) y.push_back(a), x.push_back(b);
        std::vector<double> angles = y;
        arc_tangents(angles.data(), x.data(), int(x.size()));
        double worst = 0;
        for (std::size_t i = 0; i < x.size(); ++i)
            worst = std::max(worst, std::abs(angles[i] - std::atan2(y[i], x[i])));
        CHECK(worst < 1e-11);
    }

} // TEST_SUITE
TEST_SUITE("unit") {

    TEST_CASE("projection: points and directions lead back to each other") {
        std::mt19937 random(2);
        for (const SkyFormatEntry& format : projected_formats()) {
            CAPTURE(std::string(format.name));
            const Projection p = *format.projection;
            const int w = 64, h = height_of(format, w);
            for (int i = 0; i < 2006; ++i) {
                Vec3d d = random_direction(random);
                if (i < 6) d = Vec3d(0), d[i / 2] = i % 2 ? -1 : 1; // the axes lie on the seams of many projections
                const Vec2d at = picture_point(p, w, h, 3.0 * d);
                const Vec3d back = picture_direction(p, w, h, at.x, at.y);
                // Near the rim of the disc the ball's radius hardly changes with the direction.
                CHECK(glm::length(back - d) < (format.discs > 0 ? 1e-6 : 1e-7));
            }
        }
    }

    TEST_CASE("projection: a texel in the middle of the picture, or of each disc, is square") {
        for (const SkyFormatEntry& format : projected_formats()) {
            CAPTURE(std::string(format.name));
            const int w = 240, h = height_of(format, w), discs = std::max(1, format.discs);
            for (int disc = 0; disc < discs; ++disc) {
                const Vec2d middle((disc + 0.5) * w / discs, 0.5 * h);
                const auto [across, down] = steps_at(format, w, h, middle);
                CHECK(glm::length(across) > 0);
                CHECK(glm::length(across) ==
                      doctest::Approx(glm::length(down)).epsilon(format.is_openexr() ? 0.02 : 1e-3));
            }
        }
    }

    TEST_CASE("projection: the middle of the picture, or of each disc, is an axis") {
        for (const SkyFormatEntry& format : projected_formats()) {
            CAPTURE(std::string(format.name));
            const int w = 240, h = height_of(format, w), discs = std::max(1, format.discs);
            for (int disc = 0; disc < discs; ++disc) {
                const Vec3d d = picture_direction(*format.projection, w, h, (disc + 0.5) * w / discs, 0.5 * h);
                CHECK(std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}) == doctest::Approx(1).epsilon(1e-12));
            }
        }
    }

    TEST_CASE("projection: every direction is in a disc, and discs touch where they show the same direction") {
        std::mt19937 random(5);
        for (const SkyFormatEntry& format : projected_formats()) {
            if (format.discs == 0) continue;
            CAPTURE(std::string(format.name));
            const int w = 240, h = height_of(format, w);
            const double width = double(w) / format.discs;
            CHECK(width == h); // discs are round
            for (int i = 0; i < 500; ++i) {
                const Vec2d at = picture_point(*format.projection, w, h, random_direction(random));
                const double u = std::fmod(at.x, width) / width;
                CHECK(std::hypot(2 * u - 1, 2 * at.y / h - 1) < 1 + 1e-6);
            }
            for (int disc = 1; disc < format.discs; ++disc) {
                const auto beside = [&](double dx) {
                    return picture_direction(*format.projection, w, h, disc * width + dx, 0.5 * h);
                };
                CHECK(glm::length(beside(-1e-3) - beside(1e-3)) < 0.01);
            }
        }
    }

    TEST_CASE("projection: no part of a picture is mirrored, but a photograph of a mirror is mirrored everywhere") {
        std::mt19937 random(3);
        for (const SkyFormatEntry& format : projected_formats()) {
            CAPTURE(std::string(format.name));
            const double side =
                format.projection == Projection::ball ? 1 : -1; // of (right x down) . d, seen from inside
            const int w = 240, h = height_of(format, w);
            for (int i = 0; i < 500; ++i) {
                const Vec3d d = random_direction(random);
                const Vec2d at = picture_point(*format.projection, w, h, d);
                if (format.discs > 0 && is_near_rim(at, w, h, format.discs)) continue;
                const auto [across, down] = steps_at(format, w, h, at);
                CAPTURE(i);
                CHECK(side * glm::dot(glm::cross(across, down), d) > 0);
            }
        }
    }

    TEST_CASE(
        "projection: a picture of width_per_edge times the edge of a face holds about as many texels as the cube") {
        for (const SkyFormatEntry& format : projected_formats()) {
            if (format.width_per_edge == 0) continue;
            CAPTURE(std::string(format.name));
            const int edge = 60, w = edge * format.width_per_edge, h = height_of(format, w);
            const double texels = double(w) * h * (format.discs > 0 ? pi / 4 : 1);
            // In ratio, no other whole number comes nearer to the texels of the cube.
            const auto off = [&](int width_per_edge) {
                const double scale = double(width_per_edge) / format.width_per_edge;
                return std::abs(std::log(scale * scale * texels / (6.0 * edge * edge)));
            };
            CHECK(off(format.width_per_edge) <= off(format.width_per_edge + 1) + 1e-9);
            if (format.width_per_edge > 1) CHECK(off(format.width_per_edge) <= off(format.width_per_edge - 1) + 1e-9);
            Environment sky;
            sky.picture = Image<float>(w, h, 1);
            sky.projection = *format.projection;
            CHECK(sky.face_edge() == edge);
        }
    }

    TEST_CASE("projection: the texel across a border is on the other side of the border, equally far from it") {
        for (const SkyFormatEntry& format : projected_formats()) {
            if (format.discs > 0) continue; // sampled inside the rim only
            CAPTURE(std::string(format.name));
            const Projection p = *format.projection;
            const int w = 64, h = height_of(format, w);
            const auto direction = [&](const PictureTexel& at) {
                return picture_direction(p, w, h, at.x + 0.5, at.y + 0.5);
            };
            // Where the outer samples lie on the border, the neighbours are the second samples.
            const int first = format.is_openexr() ? 1 : 0;
            for (int side = 0; side < 4; ++side)
                for (int i = 0; i < (side < 2 ? w : h); ++i) {
                    const int last = (side < 2 ? h : w) - 1;
                    const int in = side % 2 ? last - first : first, out = side % 2 ? last + 1 : -1;
                    const double edge = side % 2 ? last + 1 : 0;
                    const auto border_at = [&](double at) {
                        return side < 2 ? picture_direction(p, w, h, at, edge) : picture_direction(p, w, h, edge, at);
                    };
                    const Vec3d border = border_at(i + 0.5);
                    const Vec3d inside = direction(side < 2 ? PictureTexel{i, in} : PictureTexel{in, i});
                    const Vec3d outside =
                        direction(side < 2 ? texel_across(p, w, h, i, out) : texel_across(p, w, h, out, i));
                    if (glm::length(inside - border) < 1e-9) continue; // rows at a pole
                    CAPTURE(side);
                    CAPTURE(i);
                    CHECK(glm::length(outside - border) == doctest::Approx(glm::length(inside - border)).epsilon(0.01));
                    // The plane of the border; at a pole, where the border of a lat-long is a point, that half way.
                    const Vec3d along = glm::cross(border_at(i + 0.25), border_at(i + 0.75));
                    const Vec3d normal = glm::length(along) > 1e-9 ? along : inside - border;
                    CHECK(glm::dot(inside - border, normal) * glm::dot(outside - border, normal) < 0);
                }
        }
    }

} // TEST_SUITE
TEST_SUITE("stability") {

    TEST_CASE("projection: every direction has a place in every picture, and every place a direction") {
        const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
        for (const SkyFormatEntry& format : projected_formats()) {
            CAPTURE(std::string(format.name));
            const Projection p = *format.projection;
            for (const Vec3d d : {Vec3d(0), Vec3d(nan, 1, 0), Vec3d(inf, 0, 0), Vec3d(1e-320, 0, 0), Vec3d(0, 0, -1),
                                  Vec3d(0, 0, 1), Vec3d(0, -1, 0), Vec3d(0, 1e300, 0)}) {
                const Vec2d at = picture_point(p, 16, height_of(format, 16), d);
                CHECK((at.x >= 0 && at.x <= 16 && at.y >= 0 && at.y <= 16));
            }
            // What has no direction is looked up at +z.
            const int h = height_of(format, 16);
            CHECK(picture_point(p, 16, h, Vec3d(0)) == picture_point(p, 16, h, Vec3d(0, 0, 1)));
            for (const double x : {-1e9, 0.0, 8.0, 16.0, 1e9})
                for (const double y : {-1e9, 0.0, 8.0, 16.0, 1e9})
                    CHECK(glm::length(picture_direction(p, 16, height_of(format, 16), x, y)) == doctest::Approx(1));
        }
    }

} // TEST_SUITE
