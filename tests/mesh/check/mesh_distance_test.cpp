#include "bake/base/parallel.h"
#include "bake/mesh/check/mesh_distance.h"
#include "bake/mesh/file/mesh_io.h"
#include "bake/mesh/triangle_tree.h"
#include "cli/command.h"
#include "mesh/check/triangle_soups.h"
#include <doctest/doctest.h>

using namespace bake;
using namespace bake::test;

namespace {

MeshDistance distance(const Mesh& a, const Mesh& b, const MeshDistanceOptions& options = {}) {
    return mesh_distance(a, triangulate(a), b, triangulate(b), options);
}

MeshDistanceOptions few_samples(std::size_t samples = 20000) {
    MeshDistanceOptions options;
    options.samples = samples;
    return options;
}

Mesh square() { return mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 3}}); }

void check_bounds(const MeshDistance& d, double exact, double rounding) {
    CHECK(d.lower <= exact + rounding);
    CHECK(d.upper >= exact - rounding);
    CHECK(d.upper <= 1.01 * d.lower + rounding); // the gap asked for
}

} // namespace

TEST_SUITE("oracle") {
    TEST_CASE("mesh_distance: nothing between a mesh and itself, however it is ordered or cut") {
        const Mesh torus = oracle::torus_mesh(48, 24);
        const MeshDistance d = distance(torus, torus, few_samples());
        CHECK(d.upper < 1e-15 * d.diagonal); // samples are not exactly in their triangle's plane
        CHECK(d.there.mean < 1e-16 * d.diagonal);
        CHECK(d.there.facet.max == 0);
        CHECK(d.there.shading.max < 1e-5); // atan2 of two interpolations
        CHECK(d.shading);
        // The same squares in quarters.
        const Mesh coarse = moved(square(), 2, Vec3f(0));
        Mesh fine = square();
        for (const Vec3f& by : {Vec3f(1, 0, 0), Vec3f(0, 1, 0), Vec3f(1, 1, 0)})
            fine = together(fine, moved(square(), 1, by));
        const MeshDistance cut = distance(coarse, fine, few_samples());
        CHECK(cut.upper <= 1e-7 * cut.diagonal);
        CHECK(cut.back.upper <= 1e-7 * cut.diagonal);
        CHECK_FALSE(cut.shading);
    }

    TEST_CASE("mesh_distance: a plane moved along its normal is that far everywhere") {
        const MeshDistance d = distance(square(), moved(square(), 1, {0, 0, 0.125f}), few_samples());
        for (const OneWayDistance& way : {d.there, d.back})
            for (const double value : {way.lower, way.upper, way.mean, way.rms})
                CHECK(value == doctest::Approx(0.125).epsilon(1e-12));
        CHECK(d.there.facet.max == 0);
        CHECK(std::abs(d.there.farthest.z - d.there.nearest.z) == doctest::Approx(0.125));
    }

    TEST_CASE("mesh_distance: a plane moved in itself overhangs") {
        const double s = 0.25;
        const MeshDistance d = distance(square(), moved(square(), 1, {float(s), 0, 0}), few_samples(100000));
        check_bounds(d, s, 1e-15);
        // Of the strip of width s the mean distance is s / 2, of its square s^2 / 3. The rule of centroids is off by
        // the curvature of d at the strip's edge: half a sub-triangle, 1e-5 of the area, and s^2 times its own step.
        CHECK(d.there.mean == doctest::Approx(s * s / 2).epsilon(1e-4));
        CHECK(d.back.rms == doctest::Approx(std::sqrt(s * s * s / 3)).epsilon(1e-4));
    }

    TEST_CASE("mesh_distance: one sphere in another") {
        const double d = 0.1;
        const Mesh inner = unit_sphere(48, 24), outer = moved(inner, float(1 + d), Vec3f(0));
        const MeshDistance m = distance(inner, outer, few_samples());
        // A vertex of the outer one stands right over one of the inner one. Triangles lie under the sphere by up to
        // 1 - cos(half a quad's diagonal), and d with them.
        const double chord = 1 - std::cos(pi / 48 * std::sqrt(2.0));
        check_bounds(m, d, 1e-7);
        for (const OneWayDistance& way : {m.there, m.back}) {
            CHECK(way.mean < d);
            CHECK(way.mean > d * (1 - chord) - 1e-7);
            CHECK(way.rms >= way.mean);
            CHECK(way.facet.mean < 1); // nearest triangles are mostly those of the same place
        }
    }

    TEST_CASE("mesh_distance: a tetrahedron with one vertex moved") {
        const std::vector<std::vector<std::uint32_t>> faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
        const float s = std::sqrt(3.0f) / 2;
        const auto tetra = [&](float apex) {
            return mesh_of({{1, 0, 0}, {-0.5f, s, 0}, {-0.5f, -s, 0}, {0, 0, apex}}, faces);
        };
        const MeshDistance d = distance(tetra(1), tetra(1.5f), few_samples());
        check_bounds(d, 0.5, 1e-15); // the new apex from the old one
        CHECK(d.back.farthest == Vec3d(0, 0, 1.5));
        CHECK(d.back.nearest == Vec3d(0, 0, 1));
        // The old apex from the new sides, whose planes pass (0.5, 0, 0) on average and (0, 0, 1.5).
        const double exact = 0.5 * 0.5 / std::sqrt(0.5 * 0.5 + 1.5 * 1.5);
        CHECK(d.there.lower == doctest::Approx(exact).epsilon(1e-6));
        CHECK(d.there.upper == doctest::Approx(exact).epsilon(0.0101));
    }

    TEST_CASE("mesh_distance: a plane turned by an angle deviates by that angle") {
        Mesh tilted = square();
        const double angle = glm::radians(7.5);
        for (Vec3f& p : tilted.positions) p = {p.x * float(std::cos(angle)), p.y, p.x * float(std::sin(angle))};
        for (Mesh* mesh : {&tilted}) {
            mesh->normals = {{0, 0, 1}};
            mesh->corner_normal = {0, 0, 0, 0};
        }
        Mesh flat = square();
        flat.normals = {{0, 0, 3}, {0, 1, 1}}; // of any length
        flat.corner_normal = {0, 0, 0, 0};
        const MeshDistance d = distance(flat, tilted, few_samples());
        for (const double value : {d.there.facet.mean, d.there.facet.p95, d.there.facet.max, d.back.facet.mean})
            CHECK(value == doctest::Approx(7.5).epsilon(1e-5)); // positions are floats
        CHECK(d.there.shading.max == 0);
        flat.corner_normal = {1, 1, 1, 1};
        CHECK(distance(flat, tilted, few_samples()).back.shading.mean == doctest::Approx(45));
        check_bounds(d, std::sin(angle), 1e-7);
    }

    TEST_CASE("mesh_distance: two tessellations of a torus come together by order 2") {
        const Mesh fine = oracle::torus_mesh(192, 96);
        const auto apart = [&](int n) { return distance(oracle::torus_mesh(2 * n, n), fine, few_samples()); };
        const MeshDistance coarse = apart(8), half = apart(16);
        // The fine one's own distance from the torus is 1/36 of the second and 1/144 of the first.
        CHECK(coarse.lower / half.lower == doctest::Approx(4).epsilon(0.06));
        CHECK(coarse.there.mean / half.there.mean == doctest::Approx(4).epsilon(0.06));
        CHECK(coarse.back.rms / half.back.rms == doctest::Approx(4).epsilon(0.06));
        CHECK(half.upper <= 1.01 * half.lower * (1 + 1e-12));
        // Facet normals by order 1.
        CHECK(coarse.there.facet.mean / half.there.facet.mean == doctest::Approx(2).epsilon(0.06));
    }

    TEST_CASE("mesh_distance: the bounds hold at every point tried") {
        for (const std::uint32_t seed : {1u, 2u, 3u}) {
            Mesh a = oracle::torus_mesh(20, 10), b = oracle::torus_mesh(23, 11);
            std::mt19937 random(seed);
            const auto unit = [&] { return double(random()) / 4294967295.0; };
            const float noise = seed == 1 ? 0.002f : seed == 2 ? 0.05f : 0.3f;
            for (Mesh* mesh : {&a, &b})
                for (Vec3f& p : mesh->positions) p += noise * Vec3f(unit(), unit(), unit());
            const std::vector<Triangle> triangles = triangulate(a);
            const TriangleTree other(b, triangulate(b));
            const MeshDistance d = distance(a, b, few_samples(1));
            CHECK(d.there.upper <= 1.01 * d.there.lower * (1 + 1e-12));
            double met = 0;
            for (const Triangle& t : triangles)
                for (int i = 0; i < 40; ++i) {
                    double b1 = unit(), b2 = unit();
                    if (b1 + b2 > 1) b1 = 1 - b1, b2 = 1 - b2;
                    const auto at = [&](int k) { return Vec3d(a.positions[a.corner_position[t.corner[k]]]); };
                    const Vec3d p = (1 - b1 - b2) * at(0) + b1 * at(1) + b2 * at(2);
                    met = std::max(met, std::sqrt(other.nearest(p).distance2));
                }
            CHECK(met <= d.there.upper * (1 + 1e-12));
            CHECK(met >= 0.8 * d.there.lower); // dense enough to be a trial of it
            // Where it says the farthest point is, it is.
            CHECK(std::sqrt(other.nearest(d.there.farthest).distance2) ==
                  doctest::Approx(d.there.lower).epsilon(1e-12));
        }
    }

    TEST_CASE("mesh_distance: there and back change places with the meshes") {
        const Mesh a = unit_sphere(16, 8), b = moved(oracle::torus_mesh(12, 6), 0.8f, {0.2f, 0, 0});
        const MeshDistance ab = distance(a, b, few_samples()), ba = distance(b, a, few_samples());
        CHECK(ab.lower == ba.lower);
        CHECK(ab.upper == ba.upper);
        CHECK(ab.there.mean == ba.back.mean);
        CHECK(ab.back.facet.p95 == ba.there.facet.p95);
    }
}

TEST_SUITE("unit") {
    TEST_CASE("mesh_distance: the same figures for 1, 2 and 7 threads") {
        const Mesh a = unit_sphere(40, 20), b = moved(oracle::torus_mesh(30, 16), 0.9f, {0.1f, 0, 0});
        const auto run = [&](int threads) {
            const ThreadLimit limit(threads);
            return distance(a, b, few_samples());
        };
        const MeshDistance one = run(1);
        for (const int threads : {2, 7}) {
            const MeshDistance more = run(threads);
            CHECK(more.lower == one.lower);
            CHECK(more.upper == one.upper);
            CHECK(more.there.mean == one.there.mean);
            CHECK(more.back.facet.mean == one.back.facet.mean);
        }
    }

    TEST_CASE("mesh_distance: without cuts the upper bound still holds") {
        MeshDistanceOptions options = few_samples(1);
        options.most_cuts = 0;
        const Mesh a = oracle::torus_mesh(20, 10), b = oracle::torus_mesh(23, 11);
        const MeshDistance loose = distance(a, b, options), tight = distance(a, b);
        CHECK(loose.upper >= tight.lower);
        CHECK(loose.lower <= tight.upper);
    }
}

TEST_SUITE("stability") {
    TEST_CASE("mesh_distance: meshes without area, single points and huge coordinates give finite figures") {
        const Mesh point = mesh_of({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}, {{0, 1, 2}});
        const Mesh line = mesh_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}});
        const Mesh huge = moved(cube(), 1e18f, Vec3f(0));
        for (const Mesh* a : {&point, &line, &huge})
            for (const Mesh* b : {&point, &line, &huge}) {
                const MeshDistance d = distance(*a, *b, few_samples(100));
                for (const OneWayDistance& way : {d.there, d.back})
                    for (const double value : {way.lower, way.upper, way.mean, way.rms, way.facet.mean, way.facet.max})
                        CHECK(std::isfinite(value));
                CHECK(d.lower <= d.upper * (1 + 1e-12));
            }
        CHECK(distance(point, line).there.lower == doctest::Approx(std::sqrt(13.0)));
        CHECK(distance(line, point).there.upper == doctest::Approx(std::sqrt(14.0)).epsilon(0.01));
    }

    TEST_CASE("mesh_distance: soups of needles keep their bounds") {
        const Mesh a = random_soup(150, 21), b = random_soup(150, 22);
        const MeshDistance d = distance(a, b, few_samples(2000));
        CHECK(d.lower > 0);
        CHECK(d.upper <= 1.01 * d.lower * (1 + 1e-12));
    }
}

TEST_SUITE("real" * doctest::skip(test::no_shared_data())) {
    TEST_CASE("mesh_distance: Spot as quads and as triangles are one figure in two triangulations") {
        const auto data = test::shared_data();
        const auto load = [&](const char* name) { return read_mesh((data / "meshes/spot" / name).string()); };
        const MeshDistance d = distance(load("spot_quadrangulated.obj"), load("spot_triangulated.obj"));
        // They share their vertices; quads split along the other diagonal differ by up to 0.4 % of the size.
        CHECK(d.upper < 0.004 * d.diagonal);
        CHECK(d.upper <= 1.01 * d.lower);
        CHECK(d.there.mean < 1e-4 * d.diagonal);
    }
}
