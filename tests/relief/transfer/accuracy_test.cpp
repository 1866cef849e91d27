// What transfer() finds, against closed forms of the relief and of shapes around a point.
#include "bake/relief/transfer/reach.h"
#include "bake/relief/transfer/transfer.h"
#include "relief/transfer/closed_forms.h"
#include "relief/transfer/relief_torus.h"
#include <doctest/doctest.h>

using namespace oracle;
using bake::DetailMap;
using bake::Image;
using bake::Mesh;

namespace {

/// Adds a face with these corners, counter-clockwise from outside.
void add_quad(Mesh& mesh, const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
    for (const Vec3d& p : {a, b, c, d}) {
        mesh.corner_position.push_back(std::uint32_t(mesh.positions.size()));
        mesh.positions.emplace_back(p);
    }
    mesh.face_begin.push_back(std::uint32_t(mesh.corner_position.size()));
}

/// A low-poly mesh of one face in a plane z: x and y are the directions of u and v.
Mesh rectangle(const Vec2d& from, const Vec2d& to, double z) {
    Mesh mesh;
    add_quad(mesh, {from, z}, {to.x, from.y, z}, {to, z}, {from.x, to.y, z});
    mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    mesh.corner_uv = {0, 1, 2, 3};
    return mesh;
}

/// An open grid of `columns` x `rows` quads with the positions and normals of point(i, j).
template <class Point> Mesh grid(int columns, int rows, bool inward, const Point& point) {
    Mesh mesh;
    for (int i = 0; i <= columns; ++i)
        for (int j = 0; j <= rows; ++j) {
            const auto [p, n] = point(i, j);
            mesh.positions.emplace_back(p);
            mesh.normals.emplace_back(inward ? -n : n);
        }
    const auto number = [&](int i, int j) { return std::uint32_t(i * (rows + 1) + j); };
    for (int i = 0; i < columns; ++i)
        for (int j = 0; j < rows; ++j) {
            std::uint32_t corner[] = {number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)};
            if (inward) std::swap(corner[1], corner[3]);
            mesh.corner_position.insert(mesh.corner_position.end(), corner, corner + 4);
            mesh.face_begin.push_back(std::uint32_t(mesh.corner_position.size()));
        }
    mesh.corner_normal = mesh.corner_position;
    return mesh;
}

struct Manner {
    int rays = 1;
    bake::HighNormals normals = bake::HighNormals::smooth;
    double max_error_deg = 0;
};

bake::Transfer baked(const Mesh& low, std::vector<Mesh> meshes, int size, const Manner& manner,
                     std::vector<DetailMap> maps = {}, float reach = 0.05f) {
    const bake::BakeTarget target = bake::make_bake_target(low, "low", size, size);
    std::vector<bake::HighMesh> named;
    for (Mesh& mesh : meshes) named.push_back({std::move(mesh), "high"});
    const bake::HighSurface high(std::move(named), low.origin, manner.normals, double(size) * size);
    const bake::Casting casting(target.surface, bake::CastBy::blend,
                                bake::constant_reach(target.surface, {reach, reach}));
    bake::TransferOptions options;
    options.width = options.height = size;
    options.rays = manner.rays, options.max_error_deg = manner.max_error_deg, options.padding = 0;
    options.details.maps = std::move(maps);
    options.details.sky_rays = 1024;
    return bake::transfer(target, high, casting, options, "low");
}

Vec3d decoded(const Image<float>& map, int x, int y) {
    return 2.0 * Vec3d(map.at(x, y, 0), map.at(x, y, 1), map.at(x, y, 2)) - 1.0;
}

/// Mean angle between a map of the relief and truth(u, v), both in the tangent space of LOW.
template <class Truth> double mean_angle(const Image<float>& map, const Truth& truth) {
    double sum = 0;
    for (int y = 0; y < map.height(); ++y)
        for (int x = 0; x < map.width(); ++x)
            sum += angle_deg(decoded(map, x, y), truth((x + 0.5) / map.width(), 1 - (y + 0.5) / map.height()));
    return sum / (double(map.width()) * map.height());
}

/// Two walls that meet along y, one of them along x with the normal z, the other at the angle `opening` to it.
Mesh groove(double opening, double own, double other) {
    constexpr double y = 300;
    const double c = other * cos(opening), s = other * sin(opening);
    Mesh mesh;
    add_quad(mesh, {0, -y, 0}, {own, -y, 0}, {own, y, 0}, {0, y, 0});
    add_quad(mesh, {0, -y, 0}, {0, y, 0}, {c, y, s}, {c, -y, s});
    return mesh;
}

/// The sky over points (x, 0, 0) for x in [from, to] against sky(x).
template <class SkyAt> void check_sky(Mesh high, double from, double to, const SkyAt& sky) {
    constexpr int size = 8;
    std::vector<Mesh> meshes;
    meshes.push_back(std::move(high));
    const bake::Transfer found = baked(rectangle({from, -0.1}, {to, 0.1}, 0), std::move(meshes), size, {},
                                       {DetailMap::ambient_occlusion, DetailMap::bent_normal}, 0.01f);
    REQUIRE(found.report.hit == size * size);
    for (int x = 0; x < size; ++x) {
        CAPTURE(x);
        const Sky exact = sky(from + (x + 0.5) / size * (to - from));
        double visible = 0;
        Vec3d bent(0);
        for (int y = 0; y < size; ++y)
            visible += double(found.details[0].at(x, y)) / size, bent += decoded(found.details[1], x, y);
        CHECK(std::abs(visible - exact.visible) < 0.002);
        CHECK(angle_deg(bent, exact.bent) < 0.3);
    }
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("transfer: curved normals of the high-poly mesh leave a tenth of the error, and several rays then less "
              "than one") {
        const TorusRelief relief{.A = 0.01, .k = 6, .m = 3};
        const LowTorus low(32, 16);
        const GaussRule rule(8);
        constexpr int size = 64;
        const auto one_ray = [&](double u, double v) { return one_ray_normal(low, relief, u, v); };
        const auto box = [&](double u, double v) {
            return box_normal(low, relief, rule, u, v, 1.0 / size, 1.0 / size);
        };
        const auto map = [&](int rays, bake::HighNormals normals) {
            return baked(low.mesh(), {relief_mesh(relief, 150, 75)}, size, {rays, normals}).map;
        };
        const Image<float> one = map(1, bake::HighNormals::curved), many = map(4, bake::HighNormals::curved);
        CHECK(mean_angle(one, one_ray) < 0.1 * mean_angle(map(1, bake::HighNormals::smooth), one_ray));
        CHECK(mean_angle(many, box) < 0.1 * mean_angle(one, box));
    }

    TEST_CASE(
        "transfer: with an error that is asked for, half the rays of 4 x 4 give the mean of waves of few texels, one "
        "ray that of long ones") {
        // 64 texels: a wave is 2.7 texels long, as in the reference job for aliasing, or 16.
        const LowTorus low(32, 16);
        const GaussRule rule(8);
        constexpr int size = 64;
        for (const auto& [k, m, most_rays] : {std::tuple(24, 12, 8.5), {4, 2, 3.0}}) {
            const TorusRelief relief{.A = 0.002, .k = k, .m = m};
            const auto box = [&](double u, double v) {
                return box_normal(low, relief, rule, u, v, 1.0 / size, 1.0 / size);
            };
            const auto found = [&](double error) {
                return baked(low.mesh(), {relief_mesh(relief, 480, 240)}, size, {4, bake::HighNormals::smooth, error});
            };
            const bake::Transfer all = found(0), some = found(0.2);
            CHECK(all.report.rays == size * size * 16);
            CHECK(double(some.report.rays) < most_rays * size * size);
            CHECK(some.report.hit == size * size);
            CHECK(mean_angle(some.map, box) < (k == 24 ? 1.1 * mean_angle(all.map, box) : 0.1));
        }
    }

    TEST_CASE(
        "transfer: the only error of a map is that of the high-poly mesh's interpolated normals, of second order") {
        const TorusRelief relief{.A = 0.01, .k = 6, .m = 3};
        const LowTorus low(32, 16);
        const GaussRule rule(8);
        constexpr int size = 64; // edges of LOW's quads lie between texels: a mean over a kink converges slowly
        const auto one_ray = [&](double u, double v) { return one_ray_normal(low, relief, u, v); };
        const auto box = [&](double u, double v) {
            return box_normal(low, relief, rule, u, v, 1.0 / size, 1.0 / size);
        };
        const auto error = [&](int columns, int rays) {
            const bake::Transfer found = baked(low.mesh(), {relief_mesh(relief, columns, columns / 2)}, size, {rays});
            CHECK(found.report.hit == size * size);
            return rays == 1 ? mean_angle(found.map, one_ray) : mean_angle(found.map, box);
        };
        const double coarse = error(150, 1), fine = error(300, 1);
        CHECK(fine < 0.01);
        CHECK(coarse / fine == doctest::Approx(4).epsilon(0.1));
        const double coarse_box = error(150, 4), fine_box = error(300, 4);
        CHECK(fine_box < 0.01);
        CHECK(coarse_box / fine_box == doctest::Approx(4).epsilon(0.1));
        // One ray is not the mean of a texel with a tenth of a wave.
        CHECK(mean_angle(baked(low.mesh(), {relief_mesh(relief, 300, 150)}, size, {}).map, box) > 5 * fine_box);
    }

    TEST_CASE("transfer: occlusion and bent normals of a groove, of a wall and under an overhang") {
        for (const double opening : {0.7, pi / 2, 2.3})
            check_sky(groove(opening, 1.3, 1.3), 0.1, 1.2, [&](double s) { return groove_sky(opening, 1.3, s); });
        check_sky(groove(pi / 2, 300, 0.7), 0.1, 2, [](double x) { return wall_sky(x, 0.7); });
        Mesh overhang;
        add_quad(overhang, {-300, -300, 0}, {300, -300, 0}, {300, 300, 0}, {-300, 300, 0});
        add_quad(overhang, {-300, -300, 0.6}, {-300, 300, 0.6}, {0, 300, 0.6}, {0, -300, 0.6});
        check_sky(std::move(overhang), -1, 1, [](double x) { return overhang_sky(-x, 0.6); });
    }

    TEST_CASE("transfer: thickness of a shell between two spheres") {
        const auto ball = [](double R, bool inward) {
            return grid(128, 64, inward, [&](int i, int j) {
                const Jet<double> s = sphere(R, 2 * pi * i / 128, pi * j / 64 - pi / 2);
                return std::pair(Vec3d(s.p.z, s.p.x, s.p.y), Vec3d(s.n.z, s.n.x, s.n.y)); // the poles aside
            });
        };
        std::vector<Mesh> shell;
        shell.push_back(ball(1, false)), shell.push_back(ball(0.7, true));
        const bake::Transfer found =
            baked(rectangle({-0.3, -0.3}, {0.3, 0.3}, 1), std::move(shell), 16, {}, {DetailMap::thickness}, 0.2f);
        CHECK(found.report.hit == 256);
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 16; ++x)
                CHECK(std::abs(double(found.details[0].at(x, y)) - shell_thickness(1, 0.7, 1)) < 0.002);
    }

    TEST_CASE("transfer: mean curvature of a torus") {
        const LowTorus low(32, 16);
        constexpr int size = 24;
        const bake::Transfer found = baked(low.mesh(), {torus_mesh(512, 256)}, size, {}, {DetailMap::mean_curvature});
        CHECK(found.report.hit == size * size);
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                const double exact = torus_mean_curvature(1, 0.4, 2 * pi * (1 - (y + 0.5) / size));
                CHECK(std::abs(double(found.details[0].at(x, y)) - exact) < 0.02 * exact);
            }
    }

    TEST_CASE("transfer: the bevel of a rounded box on a face of the sharp one") {
        const RoundedBox box{{1, 0.7, 0.5}, 0.2};
        constexpr int cells = 300;
        // Seen from the plane of the face, so that the bevel is sampled to a slope of 2.
        const Mesh high = grid(cells, cells, false, [&](int i, int j) {
            const RoundedBox::Point q =
                box.nearest(Vec3d((2.0 * i / cells - 1) * (box.half.x + box.radius),
                                  (2.0 * j / cells - 1) * (box.half.y + box.radius), box.half.z));
            return std::pair(q.p, q.n);
        });
        const Vec2d to = Vec2d(box.half) - 0.2 * box.radius;
        constexpr int size = 40;
        const bake::Transfer found = baked(rectangle(-to, to, box.half.z), {high}, size, {}, {DetailMap::height}, 0.2f);
        int bevelled = 0;
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                const RoundedBox::Point exact =
                    box.below((2 * (x + 0.5) / size - 1) * to.x, (1 - 2 * (y + 0.5) / size) * to.y);
                if (exact.n.z < 0.6) continue; // the grid ends there
                bevelled += exact.n.z < 0.99;
                CHECK(angle_deg(decoded(found.map, x, y), exact.n) < 0.4);
                CHECK(std::abs(double(found.details[0].at(x, y)) - (exact.p.z - box.half.z)) < 1e-4);
            }
        CHECK(bevelled > 200);
    }
}
