#include "bake/relief/transfer/witness.h"
#include "relief/transfer/transfer_meshes.h"

using namespace bake;
using namespace bake::test;

namespace {

/// The plane z = .01 without 1/4 < x < 1/2.
Mesh with_gap() {
    Mesh mesh;
    for (const auto& [begin, end] : {std::pair(0.0, 0.25), {0.5, 1.0}})
        add_patch(mesh, 1, 1, [&](double s, double t) {
            return PatchPoint{{begin + s * (end - begin), t, 0.01}, {0, 0, 1}, {}};
        });
    return mesh;
}

/// A wave that is highest where x and y are 1.
Mesh slope() {
    Mesh mesh;
    add_patch(mesh, 16, 16, [](double x, double y) { return PatchPoint{{x, y, 0.04 * x * y - 0.01}, {0, 0, 1}, {}}; });
    return mesh;
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("missed_texels: the first misses in the order of texels, with the nearest corner of the high-poly mesh") {
        const Job job(unit_plane(), {with_gap()}, job_options(16, 16));
        REQUIRE(job.report().missed == 4 * 16);
        const std::vector<Witness> witnesses = missed_texels(job.target, job.sources(), job.result, 6);
        REQUIRE(witnesses.size() == 6);
        for (std::size_t i = 0; i < witnesses.size(); ++i) {
            const Witness& w = witnesses[i];
            CHECK(w.x == int(4 + i % 4));
            CHECK(w.y == int(i / 4));
            CHECK(w.face == 0);
            CHECK(w.state == TexelState::missed);
            const Vec2d uv((w.x + 0.5) / 16, 1 - (w.y + 0.5) / 16);
            CHECK(glm::length(w.uv - uv) < 1e-6);
            // On the plane, uv is the point: the gap's nearer border at its upper end.
            const Vec3d corner(w.x < 6 ? 0.25 : 0.5, 1, 0.01);
            CHECK(glm::length(Vec3d(w.nearest) - corner) < 1e-6);
            CHECK(w.distance == doctest::Approx(glm::length(corner - Vec3d(uv, 0))).epsilon(1e-5));
            CHECK(w.mesh == "high0");
            CHECK((w.cast.inward == Vec3f(0, 0, -1)));
        }
        CHECK(missed_texels(job.target, job.sources(), job.result, 1000).size() == 64);
    }

    TEST_CASE(
        "missed_texels: none where all rays land; a texel that sees a back says so, and of which mesh is nearest") {
        const Job whole(unit_plane(), {unit_plane(0.01)}, job_options(8, 8));
        CHECK(missed_texels(whole.target, whole.sources(), whole.result, 9).empty());
        const Job back(unit_plane(), {unit_plane(5), turned_over(unit_plane(0.01))}, job_options(8, 8));
        const std::vector<Witness> witnesses = missed_texels(back.target, back.sources(), back.result, 3);
        REQUIRE(witnesses.size() == 3);
        CHECK(witnesses[0].state == TexelState::behind);
        CHECK(witnesses[0].mesh == "high1");
    }

    TEST_CASE("farthest_texels: the largest heights first, one of each four rows") {
        const Job job(unit_plane(), {slope()}, job_options(16, 16));
        const std::vector<Witness> witnesses = farthest_texels(job.target, job.sources(), job.result, 3);
        REQUIRE(witnesses.size() == 3);
        const double highest = 0.04 * (15.5 / 16) * (15.5 / 16) - 0.01;
        CHECK(witnesses[0].x == 15);
        CHECK(witnesses[0].y == 0);
        CHECK(witnesses[0].height == doctest::Approx(highest).epsilon(0.01));
        for (std::size_t i = 1; i < witnesses.size(); ++i) {
            CHECK(std::abs(witnesses[i].height) <= std::abs(witnesses[i - 1].height));
            for (std::size_t k = 0; k < i; ++k) CHECK(witnesses[i].y / 4 != witnesses[k].y / 4);
            CHECK(witnesses[i].state == TexelState::hit);
        }
        CHECK(farthest_texels(job.target, job.sources(), job.result, 100).size() == 4);
    }

} // TEST_SUITE
