#include "bake/base/parallel.h"
#include "bake/relief/transfer/reach.h"
#include "relief/transfer/transfer_meshes.h"

using namespace bake;
using namespace bake::test;

namespace {

std::vector<Reach> reach_of(const Mesh& low, std::vector<Mesh> high) {
    const MeshSurface surface = make_mesh_surface(low);
    return measured_reach(surface, HighSurface(named(std::move(high)), low.origin, HighNormals::smooth, 1));
}

/// The plane 0 <= x <= 2, 0 <= y <= 1 of eight squares per unit.
Mesh strip(const std::function<double(double)>& height) {
    Mesh mesh;
    add_patch(mesh, 16, 8, [&](double s, double t) {
        return PatchPoint{{2 * s, t, height(2 * s)}, {0, 0, 1}, {s, t}};
    });
    return mesh;
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("reach: detail above is within the front, detail below within the back, each wider by a part") {
        const std::vector<Reach> above = reach_of(unit_plane(), {unit_plane(0.05, 4)});
        const std::vector<Reach> below = reach_of(unit_plane(), {unit_plane(-0.05, 4)});
        for (std::size_t i = 0; i < above.size(); ++i) {
            CHECK(above[i].front > 0.05f);
            CHECK(above[i].front < 0.07f);
            CHECK(above[i].back < 0.02f);
            CHECK(below[i].back > 0.05f);
            CHECK(below[i].back < 0.14f);
            CHECK(below[i].front < 0.01f);
            CHECK(above[i].blend == doctest::Approx(blend_width(1.2f * 0.05f, 0)).epsilon(1e-3));
            CHECK(below[i].blend == doctest::Approx(blend_width(0, 1.2f * 0.05f)).epsilon(1e-3));
        }
    }

    TEST_CASE("reach: is that of the region, so that a hill does not widen the envelope elsewhere") {
        const Mesh low = strip([](double) { return 0; });
        const std::vector<Reach> reach = reach_of(low, {strip([](double x) { return x < 0.5 ? 0.1 : 0.01; })});
        for (std::size_t i = 0; i < reach.size(); ++i) {
            // One face farther than the hill, for what hangs over an edge.
            if (low.positions[i].x < 0.63f) CHECK(reach[i].front > 0.1f);
            if (low.positions[i].x > 0.8f) CHECK(reach[i].front < 0.02f);
            CHECK(reach[i].front > 0.01f);
        }
    }

    TEST_CASE("reach: what faces the other way or is a tenth of the mesh away belongs to something else") {
        const float near = reach_of(unit_plane(), {unit_plane(0.02, 4)})[0].front;
        CHECK(reach_of(unit_plane(), {unit_plane(0.02, 4), turned_over(unit_plane(0.1, 4))})[0].front == near);
        CHECK(reach_of(unit_plane(), {unit_plane(0.02, 4), unit_plane(0.15, 4)})[0].front == near);
        CHECK(reach_of(unit_plane(), {unit_plane(0.02, 4), unit_plane(0.13, 4)})[0].front > 0.13f);
    }

    TEST_CASE(
        "reach: where nothing is near, the whole mesh's; where nothing is near at all, a fiftieth of the diagonal") {
        const Mesh low = strip([](double) { return 0; });
        Mesh part;
        add_patch(part, 4, 8, [](double s, double t) { return PatchPoint{{0.5 * s, t, 0.1}, {0, 0, 1}, {}}; });
        for (const Reach& each : reach_of(low, {part})) CHECK(each.front > 0.1f);
        for (const Reach& each : reach_of(low, {unit_plane(50)})) {
            CHECK(each.front > 0.02f * std::sqrt(5.0f));
            CHECK(each.front < 0.04f * std::sqrt(5.0f));
        }
    }

    TEST_CASE("reach: at a box's corner it is longer by the lean of its diagonal") {
        Mesh larger = sharp_box();
        for (Vec3f& p : larger.positions) p *= 1.05f;
        const std::vector<Reach> reach = reach_of(sharp_box(), {larger});
        // The corners of the larger box are .05 sqrt 3 away; along the averaged direction the sides are that far, too.
        for (const Reach& each : reach) CHECK(each.front > 0.05f * 3);
        const std::vector<Reach> flat = reach_of(unit_plane(), {unit_plane(0.05f * std::sqrt(3.0f), 4)});
        CHECK(reach[0].front / flat[0].front == doctest::Approx(std::sqrt(3)).epsilon(0.02));
    }

    TEST_CASE("reach: constant_reach is one for all positions") {
        const Mesh low = sharp_box();
        const std::vector<Reach> reach = constant_reach(make_mesh_surface(low), {1, 2, 3});
        REQUIRE(reach.size() == low.positions.size());
        for (const Reach& each : reach) CHECK((each.front == 1 && each.back == 2 && each.blend == 3));
    }

    TEST_CASE("reach: covers a rounded box with bolts, so that no ray misses at the first try") {
        const Job job(sharp_box(), {rounded_box(40, 0.08, true)}, job_options(96, 64));
        CHECK(job.report().missed == 0);
        CHECK(job.report().wider == 0);
        CHECK(job.report().farthest == doctest::Approx(bolt_height).epsilon(0.1));
    }

} // TEST_SUITE

TEST_SUITE("stability") {

    TEST_CASE("reach: the number of threads does not change a bit") {
        const Mesh low = sharp_box();
        std::vector<Reach> one;
        for (const int threads : {1, 2, 7}) {
            const ThreadLimit limit(threads);
            const std::vector<Reach> reach = reach_of(low, {rounded_box(48, 0.08, true)});
            if (threads == 1) one = reach;
            REQUIRE(one.size() == reach.size());
            CHECK(std::memcmp(one.data(), reach.data(), reach.size() * sizeof(Reach)) == 0);
        }
    }

    TEST_CASE("reach: meshes without area, and of one point, give finite reaches") {
        Mesh point = unit_plane();
        for (Vec3f& p : point.positions) p = Vec3f(0.5f);
        for (const Mesh& low : {point, unit_plane()})
            for (const Reach& each : reach_of(low, {point})) {
                CHECK(std::isfinite(each.front));
                CHECK((std::isfinite(each.back) && each.back >= 0 && each.front >= 0));
            }
    }

} // TEST_SUITE
