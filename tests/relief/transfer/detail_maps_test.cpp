#include "bake/relief/transfer/detail_maps.h"
#include "relief/transfer/transfer_meshes.h"
#include <set>

using namespace bake;
using namespace bake::test;

namespace {

JobOptions near_options(int width, int height, std::vector<DetailMap> maps, float front = 0.01f) {
    JobOptions options = job_options(width, height, std::move(maps));
    options.reach = Reach{front, front, 0};
    return options;
}

Vec3d value(const Image<float>& map, int x, int y) {
    const float* v = &map.at(x, y);
    return {v[0], v[1], v[2]};
}

/// A wall of a V-groove along y: from the bottom at the origin along (cos turn, 0, sin turn), which is left of the wall as
/// seen from +y unless it is the other wall.
void add_wall(Mesh& mesh, double turn, double depth, double half_length, bool other) {
    const Vec3d along(std::cos(turn), 0, std::sin(turn)), n = (other ? -1.0 : 1.0) * Vec3d(-along.z, 0, along.x);
    add_patch(mesh, 1, 1, [&](double s, double t) {
        // s runs up the wall; t so that the corners are counter-clockwise about n.
        return PatchPoint{s * depth * along + Vec3d(0, (other ? 1 - 2 * t : 2 * t - 1) * half_length, 0), n, {s, t}};
    });
}

/// By the rule of the strip: the end of the other wall, at depth (cos opening, sin opening) from the bottom, bounds the sky.
double groove_light(double opening, double depth, double s) {
    const double along = depth * std::cos(opening) - s, up = depth * std::sin(opening);
    return (1 - along / std::hypot(along, up)) / 2;
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("detail maps: names are unlike, and colours and vectors have three channels") {
        std::set<std::string> names;
        int three = 0;
        for (const DetailMap map : all_detail_maps) names.insert(name(map)), three += channels(map) == 3;
        CHECK(names.size() == std::size(all_detail_maps));
        CHECK(names.contains("ambient-occlusion"));
        CHECK(three == 3);
        CHECK(channels(DetailMap::height) == 1);
        CHECK(channels(DetailMap::bent_normal) == 3);
    }

    TEST_CASE("height map: a plane lifted by h has the height h, sunk below it -h") {
        for (const double h : {0.03, -0.02, 0.0}) {
            const Job job(unit_plane(), {unit_plane(h, 3)}, near_options(8, 8, {DetailMap::height}, 0.05f));
            for (int y = 0; y < 8; ++y)
                for (int x = 0; x < 8; ++x) CHECK(std::abs(double(job.result.details[0].at(x, y)) - h) < 1e-6);
            CHECK(job.report().nearest == doctest::Approx(h).epsilon(1e-4));
            CHECK(job.report().farthest == doctest::Approx(h).epsilon(1e-4));
        }
    }

    TEST_CASE("height map: along a cast that leans, which meets the lifted plane after h / cosine") {
        Mesh low = unit_plane(), high = unit_plane(0.1);
        for (Vec3f& p : high.positions) p = 3.0f * p - Vec3f(1, 1, 0.2f); // the same height, far to all sides
        const BakeTarget target = make_bake_target(low, "low", 8, 8);
        Mesh cage = low;
        for (Vec3f& p : cage.positions) p += Vec3f(0.3f, 0, 0.4f);
        const Casting casting(target.surface, cage, "cage");
        const HighSurface surface(named({high}), Vec3d(0), HighNormals::smooth, 1);
        const Transfer result =
            transfer(target, surface, casting, near_options(8, 8, {DetailMap::height}).transfer, "low");
        for (int y = 0; y < 8; ++y)
            for (int x = 0; x < 8; ++x) CHECK(result.details[0].at(x, y) == doctest::Approx(0.1 / 0.8).epsilon(1e-5));
        // Per unit of height along the cast, detail moves sideways by the sine of its lean, in texels of 1/8.
        CHECK(result.report.parallax_mean == doctest::Approx(0.1 / 0.8 * 8 * 0.75).epsilon(1e-4));
    }

    TEST_CASE("thickness: straight inward from where a ray lands, however it came there") {
        Mesh low = unit_plane(), top = unit_plane(0), bottom = turned_over(unit_plane(-0.2));
        for (Mesh* mesh : {&top, &bottom})
            for (Vec3f& p : mesh->positions) p.x = 3 * p.x - 1, p.y = 3 * p.y - 1;
        const BakeTarget target = make_bake_target(low, "low", 4, 4);
        Mesh cage = low;
        for (Vec3f& p : cage.positions) p += Vec3f(0.3f, 0, 0.3f);
        const Casting casting(target.surface, cage, "cage");
        const HighSurface surface(named({top, bottom}), Vec3d(0), HighNormals::smooth, 1);
        const Transfer result =
            transfer(target, surface, casting, near_options(4, 4, {DetailMap::thickness}).transfer, "low");
        CHECK(std::abs(double(result.details[0].at(1, 2)) - 0.2) < 1e-5);
    }

    TEST_CASE("position map: where rays land, relative to the origin of the low-poly mesh") {
        Mesh low = lat_long_sphere(24, 12, 0.98), high = lat_long_sphere(96, 48);
        low.origin = high.origin = {1e5, 0, 0};
        const Job job(low, {high}, job_options(48, 24, {DetailMap::position}));
        for (int y = 0; y < 24; ++y)
            for (int x = 0; x < 48; ++x) {
                const Vec3d p = value(job.result.details[0], x, y);
                const Cast cast = job.casting.at(job.at(x, y));
                // On the sphere within the sagitta of a facet of 1/48 of pi, and on the ray.
                CHECK(std::abs(glm::length(p) - 1) < 1.5 * std::pow(oracle::pi / 48, 2) / 4);
                CHECK(glm::length(glm::cross(p - Vec3d(cast.start), Vec3d(cast.inward))) < 1e-5);
            }
    }

    TEST_CASE(
        "id map: one colour for each mesh and each material, of which a texel with many rays has one and no mixture") {
        Mesh parts = unit_plane(0.01, 2);
        parts.materials = {"a", "b"};
        parts.face_material = {0, 1, no_index, 1};
        Mesh disc; // over the middle
        add_patch(disc, 1, 1, [](double s, double t) {
            return PatchPoint{{0.3 + 0.45 * s, 0.35 + 0.3 * t, 0.02}, {0, 0, 1}, {}};
        });
        for (const int rays : {1, 4}) {
            JobOptions options = near_options(16, 16, {DetailMap::id}, 0.05f);
            options.transfer.rays = rays;
            const Job job(unit_plane(), {parts, disc}, options);
            std::set<std::array<double, 3>> colours;
            for (int y = 0; y < 16; ++y)
                for (int x = 0; x < 16; ++x) {
                    const Vec3d c = value(job.result.details[0], x, y);
                    colours.insert({c.x, c.y, c.z});
                    for (int k = 0; k < 3; ++k) CHECK((c[k] >= 0 && c[k] <= 1));
                }
            CHECK(colours.size() == 4);
            for (const auto& a : colours)
                for (const auto& b : colours)
                    if (a != b) CHECK(std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) > 0.2);
        }
    }

    TEST_CASE("ambient occlusion and bent normals: on a plane all light arrives, from the normal in the mean") {
        const std::vector<DetailMap> maps = {DetailMap::ambient_occlusion, DetailMap::bent_normal};
        JobOptions options = near_options(8, 8, maps);
        options.transfer.details.sky_rays = 256;
        const Job job(unit_plane(), {unit_plane()}, options);
        for (int y = 0; y < 8; ++y)
            for (int x = 0; x < 8; ++x) {
                CHECK(job.result.details[0].at(x, y) == 1);
                const Vec3d bent = 2.0 * value(job.result.details[1], x, y) - 1.0;
                CHECK(oracle::angle_deg(bent, {0, 0, 1}) < 1);
            }
    }

    TEST_CASE("ambient occlusion: what is beyond the distance of the sky is not in the way") {
        const auto light = [](float distance) {
            JobOptions options = near_options(2, 2, {DetailMap::ambient_occlusion}, 0.01f);
            options.transfer.details.sky_distance = distance;
            Mesh roof = unit_plane(1);
            for (Vec3f& p : roof.positions) p = {1000 * (p.x - 0.5f), 1000 * (p.y - 0.5f), 1};
            return double(Job(unit_plane(), {unit_plane(), turned_over(roof)}, options).result.details[0].at(1, 1));
        };
        CHECK(light(INFINITY) == 0);
        CHECK(light(0.5f) == 1);
        // The roof at 1 is nearer than 2 within 60 degrees of the normal: three quarters of the light.
        CHECK(light(2) == doctest::Approx(0.25).epsilon(0.2));
    }

} // TEST_SUITE

TEST_SUITE("oracle") {

    TEST_CASE("ambient occlusion: the walls of a V-groove, within .002 in the mean over its texels") {
        for (const double opening : {0.8, oracle::pi / 2, 2.2}) {
            CAPTURE(opening);
            Mesh low, high;
            add_wall(low, 0, 1, 1, false);
            add_wall(high, 0, 1, 500, false), add_wall(high, opening, 1, 500, true);
            JobOptions options = near_options(32, 32, {DetailMap::ambient_occlusion}, 1e-4f);
            options.transfer.details.sky_rays = 256;
            const Job job(low, {high}, options);
            REQUIRE(job.report().missed == 0);
            double mean = 0, worst = 0;
            for (int y = 0; y < 32; ++y)
                for (int x = 0; x < 32; ++x) {
                    const double error =
                        double(job.result.details[0].at(x, y)) - groove_light(opening, 1, (x + 0.5) / 32);
                    mean += error / 1024, worst = std::max(worst, std::abs(error));
                }
            CHECK(std::abs(mean) < 0.002);
            CHECK(worst < 0.06); // of 256 rays
        }
    }

    TEST_CASE("ambient occlusion: the error in the mean of rays falls faster than that of random rays") {
        Mesh low, high;
        add_wall(low, 0, 1, 1, false);
        add_wall(high, 0, 1, 500, false), add_wall(high, 1, 1, 500, true);
        const auto rms = [&](int rays) {
            JobOptions options = near_options(32, 8, {DetailMap::ambient_occlusion}, 1e-4f);
            options.transfer.details.sky_rays = rays;
            const Job job(low, {high}, options);
            double sum = 0;
            for (int y = 0; y < 8; ++y)
                for (int x = 0; x < 32; ++x)
                    sum += std::pow(double(job.result.details[0].at(x, y)) - groove_light(1, 1, (x + 0.5) / 32), 2);
            return std::sqrt(sum / 256);
        };
        const double few = rms(16), many = rms(1024);
        // Random rays would gain 8, and have sqrt(light (1 - light) / rays), at least .0045 for 1024 here.
        CHECK(few / many > 12);
        CHECK(many < 0.004);
    }

    TEST_CASE("bent normals: beside a wall without end light comes from (1, 0, pi / 2), half of it") {
        // The directions (cos e cos f, sin e, cos e sin f) with f below pi / 2: the integrals of cos f sin f and sin^2 f.
        Mesh high;
        add_patch(high, 1, 1, [](double s, double t) {
            return PatchPoint{{2000 * s, 4000 * (t - 0.5), 0}, {0, 0, 1}, {}};
        });
        add_patch(high, 1, 1, [](double s, double t) {
            return PatchPoint{{0, 4000 * (s - 0.5), 2000 * t}, {1, 0, 0}, {}};
        });
        for (const bool directx : {false, true}) {
            JobOptions options = near_options(8, 8, {DetailMap::ambient_occlusion, DetailMap::bent_normal}, 1e-3f);
            options.transfer.details.sky_rays = 1024;
            options.transfer.directx = directx;
            Mesh low; // beside the wall, with x along v, so that green is tested
            add_patch(low, 1, 1, [](double s, double t) {
                return PatchPoint{{0.2 + 0.8 * s, t, 0}, {0, 0, 1}, {1 - t, s}};
            });
            const Job job(low, {high}, options);
            REQUIRE(job.report().missed == 0);
            Vec3d mean(0);
            for (int y = 0; y < 8; ++y)
                for (int x = 0; x < 8; ++x) {
                    CHECK(job.result.details[0].at(x, y) == doctest::Approx(0.5).epsilon(0.04));
                    mean += 2.0 * value(job.result.details[1], x, y) - 1.0;
                }
            CHECK(oracle::angle_deg(mean, {0, directx ? -1 : 1, oracle::pi / 2}) < 0.5);
        }
    }

    TEST_CASE("thickness: of a shell between spheres, of a ball, and 0 of an open plane") {
        const Mesh low = lat_long_sphere(24, 12, 0.99), outer = lat_long_sphere(96, 48);
        const double facet = 1.5 * std::pow(oracle::pi / 48, 2) / 4; // sagitta
        const auto check_all = [](const Job& job, double exact, double within) {
            for (int y = 2; y < 22; ++y)
                for (int x = 0; x < 48; ++x) CHECK(std::abs(double(job.result.details[0].at(x, y)) - exact) < within);
        };
        const std::vector<DetailMap> maps = {DetailMap::thickness};
        // Each sphere is off by the sagitta, and the ray along an interpolated normal leans by as much of a facet.
        check_all(Job(low, {outer, turned_over(lat_long_sphere(96, 48, 0.7))}, near_options(48, 24, maps, 0.05f)), 0.3,
                  4 * facet);
        check_all(Job(low, {outer}, near_options(48, 24, maps, 0.05f)), 2, 4 * facet);
        check_all(Job(unit_plane(), {unit_plane()}, near_options(48, 24, maps)), 0, 0.0 + 1e-12);
    }

    TEST_CASE("curvature maps: a sphere and a torus, outward bends positive") {
        const std::vector<DetailMap> maps = {DetailMap::position, DetailMap::mean_curvature,
                                             DetailMap::gauss_curvature};
        const Job sphere(lat_long_sphere(24, 12, 1.98), {lat_long_sphere(128, 64, 2)}, job_options(48, 24, maps));
        for (int y = 3; y < 21; ++y)
            for (int x = 0; x < 48; ++x) {
                CHECK(sphere.result.details[1].at(x, y) == doctest::Approx(1 / 2.0).epsilon(0.01));
                CHECK(sphere.result.details[2].at(x, y) == doctest::Approx(1 / 4.0).epsilon(0.01));
            }
        const Job hollow(turned_over(lat_long_sphere(24, 12, 1.98)), {turned_over(lat_long_sphere(128, 64, 2))},
                         job_options(48, 24, maps));
        CHECK(hollow.result.details[1].at(20, 12) == doctest::Approx(-1 / 2.0).epsilon(0.01));
        CHECK(hollow.result.details[2].at(20, 12) == doctest::Approx(1 / 4.0).epsilon(0.01));
    }

    TEST_CASE("curvature maps: on a torus the error is of the first order in the edges of the high-poly mesh") {
        const auto worst = [](int columns) {
            const Job job(
                oracle::torus_mesh(32, 16), {oracle::torus_mesh(columns, columns / 2)},
                job_options(48, 24, {DetailMap::position, DetailMap::mean_curvature, DetailMap::gauss_curvature}));
            double mean = 0, gauss = 0;
            for (int y = 0; y < 24; ++y)
                for (int x = 0; x < 48; ++x) {
                    const Vec3d p = value(job.result.details[0], x, y);
                    // The parallel at this distance from the axis bends by its cosine over it.
                    const double ring = std::hypot(p.x, p.y), parallel = (ring - 1) / 0.4 / ring;
                    mean = std::max(mean, std::abs(double(job.result.details[1].at(x, y)) - (1 / 0.4 + parallel) / 2));
                    gauss = std::max(gauss, std::abs(double(job.result.details[2].at(x, y)) - parallel / 0.4));
                }
            return Vec2d(mean, gauss);
        };
        const Vec2d coarse = worst(256), fine = worst(512);
        CHECK(fine.x < 0.02); // of curvatures from -1.67 to 2.5
        CHECK(fine.y < 0.1);
        CHECK(coarse.x / fine.x == doctest::Approx(2).epsilon(0.25));
        CHECK(coarse.y / fine.y == doctest::Approx(2).epsilon(0.25));
    }

} // TEST_SUITE

TEST_SUITE("stability") {

    TEST_CASE("detail maps: triangles without area and normals that cancel out put no NaN into any map") {
        Mesh high = unit_plane(0.001, 4);
        high.positions[6] = high.positions[7];
        for (const std::uint32_t k : {10u, 11u, 12u}) high.normals[k] = Vec3f(0, 0, -1); // against the facet
        high.normals[13] = Vec3f(0);
        JobOptions options = near_options(32, 32, {std::begin(all_detail_maps), std::end(all_detail_maps)});
        options.transfer.rays = 2;
        const Job job(unit_plane(), {high}, options);
        for (const Image<float>& map : job.result.details)
            for (std::size_t i = 0; i < map.size(); ++i) REQUIRE(std::isfinite(map.data()[i]));
        for (std::size_t i = 0; i < job.result.map.size(); ++i) REQUIRE(std::isfinite(job.result.map.data()[i]));
    }

} // TEST_SUITE
