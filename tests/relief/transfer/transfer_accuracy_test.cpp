// How near the normals of a bake are to those of shapes given by formulas.
#include "bake/relief/transfer/seams.h"
#include "relief/transfer/transfer_meshes.h"

using namespace bake;
using namespace bake::test;

namespace {

constexpr double flattened = 0.7;

/// The sphere flattened along z, with its normals.
Mesh ellipsoid(int columns, double radius) {
    Mesh mesh = lat_long_sphere(columns, columns / 2, radius);
    for (Vec3f& p : mesh.positions) p.z *= float(flattened);
    for (Vec3f& n : mesh.normals) n = glm::normalize(Vec3f(n.x, n.y, n.z / float(flattened)));
    return mesh;
}

/// Where the ray of a texel meets the ellipsoid of radius 1: the normal there, by the sphere that it is a picture of.
Vec3d on_ellipsoid(const Cast& cast) {
    const Vec3d scale(1, 1, 1 / flattened), o = scale * Vec3d(cast.start), d = scale * Vec3d(cast.inward);
    const double a = glm::dot(d, d), half = glm::dot(o, d), c = glm::dot(o, o) - 1;
    const double t = (-half - std::sqrt(half * half - a * c)) / a;
    return glm::normalize(scale * (o + t * d));
}

/// Angles between the normals of a fine ellipsoid on a coarse one and the exact ones.
oracle::Spread ellipsoid_error(int columns, Space space) {
    // A size without a common factor with the facets, so that texels lie anywhere in them.
    JobOptions options = job_options(67, 35);
    options.transfer.space = space;
    const Job job(ellipsoid(24, 0.99), {ellipsoid(columns, 1)}, options);
    REQUIRE(job.report().missed == 0);
    std::vector<double> angles;
    for (int y = 2; y < 33; ++y)
        for (int x = 0; x < 67; ++x) {
            const Vec3d ours = space == Space::object
                                   ? job.normal(x, y)
                                   : Vec3d(shaded_normal(job.target, job.result.map, job.at(x, y), space, false));
            angles.push_back(oracle::angle_deg(ours, on_ellipsoid(job.casting.at(job.at(x, y)))));
        }
    return oracle::spread(angles);
}

/// The plane wave A sin(k x) with normals of its own in columns of a fine grid.
constexpr double wave_height = 0.002, wave = 2 * oracle::pi * 2;
Vec3d wave_normal(double x) { return glm::normalize(Vec3d(-wave_height * wave * std::cos(wave * x), 0, 1)); }
Mesh waves_along_x() {
    Mesh mesh;
    add_patch(mesh, 8192, 1, [](double s, double t) {
        const double x = 1.2 * s - 0.1;
        return PatchPoint{{x, 1.2 * t - 0.1, wave_height * std::sin(wave * x)}, wave_normal(x), {}};
    });
    return mesh;
}

/// Of rays x rays per texel against the mean of the exact normals over a texel, 8 texels wide.
double average_error(int rays) {
    JobOptions options = job_options(8, 2);
    options.transfer.rays = rays, options.transfer.padding = 0;
    options.reach = Reach{0.1f, 0.1f, 0};
    const Job job(unit_plane(), {waves_along_x()}, options);
    double worst = 0;
    for (int x = 0; x < 8; ++x) {
        Vec3d mean(0);
        for (int i = 0; i < 4000; ++i) mean += wave_normal((x + (i + 0.5) / 4000) / 8);
        worst = std::max(worst, glm::length(job.normal(x, 1) - glm::normalize(mean)));
    }
    return worst;
}

/// The largest distance of a bolt's top in the map to where it belongs, in texels: where the normals around it, which lean in
/// proportion to their distance from it, are level.
double worst_bolt(CastBy by) {
    constexpr int width = 768, height = 512, around = 4; // of a bolt with a radius of 12.3 texels
    JobOptions options = job_options(width, height);
    options.cast = by;
    const Job job(sharp_box(), {rounded_box(80, 0.08, true)}, options);
    double worst = 0;
    for (int side = 0; side < 6; ++side)
        for (const double u : bolt_places)
            for (const double v : bolt_places) {
                const BoxSide box{side};
                const Vec2d uv = box.uv((1 + u) / 2, (1 + box.sign() * v) / 2);
                const Vec2d centre(uv.x * width - 0.5, (1 - uv.y) * height - 0.5);
                Vec2d at(0), lean(0), product(0), square(0);
                constexpr double count = (2 * around + 1) * (2 * around + 1);
                for (int j = -around; j <= around; ++j)
                    for (int i = -around; i <= around; ++i) {
                        const int x = int(std::round(centre.x)) + i, y = int(std::round(centre.y)) + j;
                        const Vec2d d = Vec2d(x, y) - centre, t(job.normal(x, y));
                        at += d / count, lean += t / count, product += d * t / count, square += d * d / count;
                    }
                // The line through the leans along each axis, and where it is 0.
                const Vec2d slope = (product - at * lean) / (square - at * at);
                worst = std::max(worst, glm::length(at - lean / slope));
            }
    return worst;
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("transfer: a finer sphere on a coarse one has the exact normals, whatever its facets") {
        // Rays, positions and normals are radial, so that facets do not matter.
        const Job job(lat_long_sphere(24, 12, 0.99), {lat_long_sphere(32, 16)}, job_options(64, 32));
        REQUIRE(job.report().missed == 0);
        for (int y = 2; y < 30; ++y)
            for (int x = 0; x < 64; ++x) {
                const Vec3d ours(shaded_normal(job.target, job.result.map, job.at(x, y), Space::tangent, false));
                CHECK(oracle::angle_deg(ours, Vec3d(job.casting.at(job.at(x, y)).start)) < 1e-4);
            }
    }

    TEST_CASE("transfer: the normals of a finer ellipsoid, with an error of the second order in its edges") {
        for (const Space space : {Space::object, Space::tangent}) {
            const oracle::Spread coarse = ellipsoid_error(30, space), fine = ellipsoid_error(60, space),
                                 finest = ellipsoid_error(120, space);
            CHECK(coarse.max < 1);
            CHECK(coarse.mean / fine.mean == doctest::Approx(4).epsilon(0.15));
            CHECK(fine.mean / finest.mean == doctest::Approx(4).epsilon(0.15));
        }
    }

    TEST_CASE("transfer: k x k rays average a texel as Gauss and Legendre promise, exact to the degree 2 k - 1") {
        const double one = average_error(1), two = average_error(2), three = average_error(3);
        // Of the mean of a cosine whose phase turns by pi / 2 over the texel, times the slope 2 k A = .025:
        // .11, .0014 and 9e-6 of it. Float normals and 1.5e-4 wide columns leave 1e-7.
        CHECK(one == doctest::Approx(0.11 * wave_height * wave).epsilon(0.1));
        CHECK(one / two > 50);
        CHECK(two / three > 50);
        CHECK(average_error(6) < 5e-7);
    }

    TEST_CASE(
        "transfer: the bolts on a box stay where they are, which they do not if directions are averaged all over") {
        CHECK(worst_bolt(CastBy::blend) < 0.5);
        CHECK(worst_bolt(CastBy::averaged) > 0.5);
    }

} // TEST_SUITE
