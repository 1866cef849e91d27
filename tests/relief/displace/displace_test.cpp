// Laws of displacement on small meshes.
#include "bake/surface/patch/surface_mesh.h"
#include "relief/displace/displace_meshes.h"
#include <cstring>

using namespace bake;
using namespace bake::test;

namespace {

/// Whether every point of the one is one of the other, to the bit.
bool are_among(const std::vector<Vec3f>& some, std::vector<Vec3f> all) {
    const auto before = [](const Vec3f& a, const Vec3f& b) { return std::memcmp(&a, &b, sizeof a) < 0; };
    std::sort(all.begin(), all.end(), before);
    return std::all_of(some.begin(), some.end(),
                       [&](const Vec3f& p) { return std::binary_search(all.begin(), all.end(), p, before); });
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("displace: a flat height leaves a smooth mesh's points and normals where they are") {
        const Mesh torus = oracle::torus_mesh(12, 8, true);
        const BaseSurface base{Mesh(torus)};
        const Displaced out = displace(base, relief(picture(4, 4, [](double, double) { return 0.5; }), 0.1), levels(0));
        check_sound(out.mesh);
        CHECK(out.mesh.positions.size() == torus.positions.size());
        CHECK(out.mesh.faces() == torus.faces());
        std::vector<Vec3f> normal(out.mesh.positions.size());
        for (std::size_t c = 0; c < out.mesh.corners(); ++c)
            normal[out.mesh.corner_position[c]] = out.mesh.normals[out.mesh.corner_normal[c]];
        double worst = 0;
        for (std::size_t i = 0; i < normal.size(); ++i)
            for (std::size_t j = 0; j < torus.positions.size(); ++j)
                if (torus.positions[j] == out.mesh.positions[i])
                    worst = std::max(worst, oracle::angle_deg(Vec3d(normal[i]), Vec3d(torus.normals[j])));
        CHECK(worst < 1e-4); // floats
        CHECK(out.report.height_max == 0);
        CHECK(out.report.folded == 0);
    }

    TEST_CASE("displace: a constant height moves every point by it along its normal, whatever the uvs") {
        for (const Seam seam : {Seam::average, Seam::owner, Seam::blend}) {
            const Displaced out =
                displace(BaseSurface(cube(true)), relief(picture(1, 1, [](double, double) { return 1.0; }), 0.5, 0),
                         levels(2, seam));
            check_sound(out.mesh);
            // Faces lie at 1.5; on edges one direction, so half a unit along the diagonal.
            double largest = 0;
            for (const Vec3f& p : out.mesh.positions)
                largest = std::max(largest, double(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)})));
            CHECK(largest == doctest::Approx(1.5));
            CHECK(out.report.seam_mismatch < 1e-15); // weights that sum to one up to rounding
        }
    }

    TEST_CASE("displace: uniform levels give 4^n faces per quad and n^2 triangles, welded") {
        const Displaced cubes = displace(BaseSurface(cube()), relief(noise(16), 0.1), levels(3));
        CHECK(cubes.mesh.faces() == 6 * 64);
        CHECK(cubes.mesh.positions.size() == 6 * 64 + 2);
        CHECK(check(cubes.mesh).topology.boundary_edges == 0);
        CHECK(check(cubes.mesh).coincident_positions == 0);
        const Mesh torus = oracle::torus_mesh(6, 5, false);
        const Displaced triangles = displace(BaseSurface(Mesh(torus)), relief(noise(16), 0.01), levels(2));
        CHECK(triangles.mesh.faces() == torus.faces() * 16);
        CHECK(check(triangles.mesh).topology.boundary_edges == 0);
        CHECK(triangles.mesh.positions.size() == triangles.mesh.faces() / 2);
    }

    TEST_CASE("displace: the count that memory is refused by is that of the result") {
        for (const bool flat : {false, true}) {
            const BaseSurface base(cube(flat));
            const Relief height = relief(noise(16), 0.1);
            const Displaced out = displace(base, height, levels(4));
            const DisplaceCount count = out.report.count;
            CHECK(count.points == out.mesh.positions.size());
            CHECK(count.faces == out.mesh.faces());
            CHECK(count.corners == out.mesh.corners());
            std::size_t bytes = 12 * (out.mesh.positions.size() + out.mesh.normals.size()) + 8 * out.mesh.uvs.size() +
                                12 * out.mesh.corners() + 4 * out.mesh.faces();
            CHECK(count.bytes >= bytes);
        }
    }

    TEST_CASE("displace: without relief a limit surface is that of surface_mesh, point by point") {
        Mesh cage = cube();
        for (Vec2f& uv : cage.uvs) uv = 0.5f * uv;
        const BaseSurface base(std::move(cage), SubdivisionOptions{});
        const Mesh still = displace(base, relief(noise(16), 0), levels(2)).mesh;
        const Mesh limit = surface_mesh(base, SurfaceKind::limit, 4).mesh;
        CHECK(still.positions == limit.positions);
        CHECK(still.corner_position == limit.corner_position);
        CHECK(still.corner_uv == limit.corner_uv);
        CHECK(still.uvs == limit.uvs);
        REQUIRE(still.normals.size() == limit.normals.size());
        for (std::size_t i = 0; i < limit.normals.size(); ++i)
            CHECK(glm::length(still.normals[i] - limit.normals[i]) < 1e-5f);
    }

    TEST_CASE("displace: groups and materials follow their faces") {
        Mesh mesh = cube();
        mesh.groups = {"a", "b"};
        mesh.materials = {"m"};
        mesh.face_group = {0, 1, 1, 0, no_index, 1};
        mesh.face_material = {0, no_index, 0, 0, 0, 0};
        const Displaced out = displace(BaseSurface(std::move(mesh)), relief(noise(8), 0.1), levels(1));
        CHECK(out.mesh.groups == std::vector<std::string>{"a", "b"});
        REQUIRE(out.mesh.face_group.size() == 24);
        for (int i = 0; i < 4; ++i) {
            CHECK(out.mesh.face_group[i] == 0);
            CHECK(out.mesh.face_group[4 + i] == 1);
            CHECK(out.mesh.face_group[16 + i] == no_index);
            CHECK(out.mesh.face_material[4 + i] == no_index);
        }
    }

    TEST_CASE("displace: creases keep one normal per side, seams one uv per side, and points are one") {
        const Displaced flat = displace(BaseSurface(cube(true)), relief(noise(16), 0.1), levels(2));
        const std::size_t points = 6 * 16 + 2, on_edges = 12 * 3, on_corners = 8;
        CHECK(flat.mesh.positions.size() == points);
        CHECK(flat.mesh.normals.size() == points + on_edges + 2 * on_corners);
        CHECK(flat.mesh.uvs.size() == points + on_edges + 2 * on_corners);
        CHECK(flat.report.seam_points == on_edges + on_corners);
        const Displaced smooth = displace(BaseSurface(cube(false)), relief(noise(16), 0.1), levels(2));
        CHECK(smooth.mesh.normals.size() == points);
        CHECK(smooth.mesh.uvs.size() == points + on_edges + 2 * on_corners);
    }

    TEST_CASE("displace: shared points have the same bits at any level") {
        // What meets a finer neighbour, or replaces a coarser mesh, must lie where that lay. Every side of every patch is
        // among them: seams of the cube's charts, a crease, a dart, an extraordinary vertex, poles.
        Mesh cage = cube();
        cage.tags.creases = {{4, 5, 10}, {5, 6, 10}, {0, 4, 2.5f}};
        const BaseSurface surfaces[] = {BaseSurface(std::move(cage), SubdivisionOptions{}), BaseSurface(cube(true)),
                                        BaseSurface(ParametricSurface("torus:R=2,r=0.7"), 6, 4),
                                        BaseSurface(ParametricSurface("sphere:R=1"), 6, 4)};
        for (const BaseSurface& base : surfaces)
            for (const Seam seam : {Seam::average, Seam::owner, Seam::blend}) {
                const Relief height = relief(noise(32), 0.1);
                const Displaced coarse = displace(base, height, levels(3, seam)),
                                fine = displace(base, height, levels(5, seam));
                CHECK(coarse.mesh.positions.size() * 15 < fine.mesh.positions.size());
                CHECK(are_among(coarse.mesh.positions, fine.mesh.positions));
                CHECK_FALSE(are_among(fine.mesh.positions, coarse.mesh.positions));
            }
    }

    TEST_CASE("displace: any number of threads gives the same bytes") {
        const auto run = [](int threads) {
            const ThreadLimit limit(threads);
            return displace(BaseSurface(oracle::torus_mesh(24, 16, true)), relief(noise(64), 0.05),
                            levels(4, Seam::blend));
        };
        const Displaced one = run(1), two = run(2), seven = run(7);
        CHECK(one.mesh.positions == two.mesh.positions);
        CHECK(one.mesh.normals == two.mesh.normals);
        CHECK(one.mesh.corner_uv == two.mesh.corner_uv);
        CHECK(one.mesh.positions == seven.mesh.positions);
        CHECK(one.mesh.uvs == seven.mesh.uvs);
        CHECK(one.report.fold_worst == seven.report.fold_worst);
    }

} // TEST_SUITE
