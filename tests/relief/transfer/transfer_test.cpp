#include "bake/base/parallel.h"
#include "bake/relief/transfer/transfer.h"
#include "bake/relief/transfer/witness.h"
#include "relief/transfer/transfer_meshes.h"

using namespace bake;
using namespace bake::test;

namespace {

const Vec3d flat(0, 0, 1);

double worst_angle(const Job& job, const Vec3d& exact) {
    double worst = 0;
    for (int y = 0; y < job.result.map.height(); ++y)
        for (int x = 0; x < job.result.map.width(); ++x)
            worst = std::max(worst, oracle::angle_deg(job.normal(x, y), exact));
    return worst;
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("transfer: a mesh on itself gives the flat map") {
        for (const int rays : {1, 3}) {
            JobOptions options = job_options(64, 32);
            options.transfer.rays = rays;
            const Job job(oracle::torus_mesh(24, 12), {oracle::torus_mesh(24, 12)}, options);
            CHECK(job.report().missed == 0);
            CHECK(job.report().hit == 64 * 32);
            double worst = 0;
            for (int y = 0; y < 32; ++y)
                for (int x = 0; x < 64; ++x) worst = std::max(worst, glm::length(job.normal(x, y) - flat));
            CHECK(worst < 2e-6); // of vectors: 1e-6 of colours
        }
    }

    TEST_CASE("transfer: a mesh moved and turned with its detail has the same map") {
        const auto moved = [](Mesh mesh) {
            for (Vec3f& p : mesh.positions) p = Vec3f(-p.y, p.z, -p.x) + Vec3f(3, -2, 1);
            for (Vec3f& n : mesh.normals) n = Vec3f(-n.y, n.z, -n.x);
            return mesh;
        };
        const Mesh low = lat_long_sphere(24, 12, 0.98), high = lat_long_sphere(40, 20);
        const Job here(low, {high}, job_options(32, 16)), there(moved(low), {moved(high)}, job_options(32, 16));
        for (int y = 1; y < 15; ++y)
            for (int x = 0; x < 32; ++x) CHECK(glm::length(here.normal(x, y) - there.normal(x, y)) < 1e-4);
    }

    TEST_CASE("transfer: green is turned round by directx") {
        Mesh high = unit_plane(0.001);
        for (Vec3f& n : high.normals) n = glm::normalize(Vec3f(0.2f, 0.3f, 1));
        JobOptions options = job_options(4, 4);
        const Job up(unit_plane(), {high}, options);
        options.transfer.directx = true;
        const Job down(unit_plane(), {high}, options);
        const Vec3d a = up.normal(2, 2), b = down.normal(2, 2);
        CHECK(oracle::angle_deg(a, {0.2, 0.3, 1}) < 1e-3);
        CHECK(oracle::angle_deg(b, {0.2, -0.3, 1}) < 1e-3);
    }

    TEST_CASE("transfer: a bolt that floats above a surface is seen, of two surfaces the outer one") {
        Mesh lid; // over the left half, tilted normals
        add_patch(lid, 1, 1, [](double s, double t) {
            return PatchPoint{{0.5 * s, t, 0.04}, glm::normalize(Vec3d(1, 0, 2)), {}};
        });
        const Job job(unit_plane(), {unit_plane(), lid}, job_options(16, 16));
        CHECK(oracle::angle_deg(job.normal(3, 8), Vec3d(1, 0, 2)) < 0.01);
        CHECK(oracle::angle_deg(job.normal(12, 8), flat) < 0.01);
    }

    TEST_CASE(
        "transfer: backs are passed through and told; a mesh turned over is behind everywhere, and the map flat") {
        const Job back(unit_plane(), {turned_over(unit_plane(0.001))}, job_options(16, 16));
        CHECK(back.report().behind == 256);
        CHECK(back.report().missed == 256);
        CHECK(back.report().hit == 0);
        CHECK(back.report().empty == 256);
        CHECK(back.result.states.at(3, 3) == TexelState::behind);
        CHECK(worst_angle(back, flat) == 0);
        const Job both(unit_plane(), {turned_over(unit_plane(0.002)), unit_plane(0.001)}, job_options(16, 16));
        CHECK(both.report().hit == 256);
        const Job none(unit_plane(), {unit_plane(40)}, job_options(16, 16));
        CHECK(none.report().missed == 256);
        CHECK(none.report().behind == 0);
        CHECK(none.result.states.at(3, 3) == TexelState::missed);
        CHECK(none.report().nearest == 0);
        CHECK(none.report().farthest == 0);
    }

    TEST_CASE("transfer: the second try goes twice as far out and three times as far in, unless it is not wanted") {
        const auto job = [](double z, bool wider) {
            JobOptions options = job_options(4, 4);
            options.reach = Reach{0.1f, 0.1f, 0};
            options.transfer.try_wider = wider;
            return Job(unit_plane(), {unit_plane(z)}, options).report();
        };
        for (const double z : {0.09, -0.09}) CHECK((job(z, false).hit == 16 && job(z, true).wider == 0));
        for (const double z : {0.19, -0.29}) {
            CHECK(job(z, false).missed == 16);
            // The four centres on the diagonal are tried again a little inside their triangle.
            CHECK(job(z, false).rays == 16 + 4);
            const TransferReport wider = job(z, true);
            CHECK(wider.hit == 16);
            CHECK(wider.wider == 16);
            CHECK(wider.rays == 32);
        }
        for (const double z : {0.21, -0.31}) CHECK(job(z, true).missed == 16);
    }

    TEST_CASE("transfer: ray lengths are counted from the envelope to the end") {
        JobOptions options = job_options(4, 4);
        options.reach = Reach{0.1f, 0.06f, 0};
        options.transfer.try_wider = false;
        for (const auto& [z, slot] : {std::pair(0.099, 0), {0.0, 10}, {-0.055, 15}, {0.045, 5}}) {
            const TransferReport report = Job(unit_plane(), {unit_plane(z)}, options).report();
            CHECK(report.lengths[std::size_t(slot)] == 16);
        }
    }

    TEST_CASE("transfer: a missed texel has the value of the nearest one that is not, as far as the padding goes") {
        Mesh half; // to x < 1/2, with a tilt of its own
        const Vec3d tilt = glm::normalize(Vec3d(0.3, 0.1, 1));
        add_patch(half, 1, 1, [&](double s, double t) { return PatchPoint{{0.5 * s, t, 0.001}, tilt, {}}; });
        JobOptions options = job_options(32, 8, {DetailMap::height});
        options.transfer.padding = 5;
        const Job job(unit_plane(), {half}, options);
        CHECK(job.report().hit == 16 * 8);
        CHECK(job.report().missed == 16 * 8);
        CHECK(job.report().padded == 5 * 8);
        CHECK(job.report().empty == 11 * 8);
        for (int y = 0; y < 8; ++y)
            for (int x = 0; x < 32; ++x) {
                CAPTURE(x);
                CHECK(oracle::angle_deg(job.normal(x, y), x < 21 ? tilt : flat) < 0.01);
                CHECK(std::abs(double(job.result.details[0].at(x, y)) - (x < 21 ? 0.001 : 0)) < 1e-6);
            }
    }

    TEST_CASE("transfer: a normal that points into the mesh is counted") {
        Mesh high = unit_plane(0.001);
        for (Vec3f& n : high.normals) n = glm::normalize(Vec3f(1, 0, -0.1f));
        const Job job(unit_plane(), {high}, job_options(4, 4));
        CHECK(job.report().outward == 16);
        JobOptions object = job_options(4, 4);
        object.transfer.space = Space::object;
        CHECK(Job(unit_plane(), {high}, object).report().outward == 0);
    }

    TEST_CASE("transfer: many rays count the texels of charts once, each with the part of it that lies in them") {
        // A chart that covers 6.5 x 6.5 of 10 x 10 texels over a plane whose detail leans.
        Mesh low = unit_plane(), high = unit_plane(0.001);
        for (Vec2f& uv : low.uvs) uv = Vec2f(0.15f) + 0.65f * uv;
        const Vec3d tilt = glm::normalize(Vec3d(0.2, 0.3, 1));
        for (Vec3f& n : high.normals) n = Vec3f(tilt);
        for (const int rays : {1, 2, 5}) {
            JobOptions options = job_options(10, 10, {DetailMap::height});
            options.transfer.rays = rays, options.transfer.padding = 0;
            const Job job(low, {high}, options);
            CHECK(job.report().hit == 49);
            CHECK(job.report().missed == 0);
            for (int y = 0; y < 10; ++y)
                for (int x = 0; x < 10; ++x) {
                    const bool inside = job.result.states.at(x, y) == TexelState::hit;
                    CHECK(oracle::angle_deg(job.normal(x, y), inside ? tilt : flat) < 0.01);
                    CHECK(std::abs(double(job.result.details[0].at(x, y)) - (inside ? 0.001 : 0)) < 1e-6);
                }
        }
    }

    TEST_CASE("transfer: a texel of which one ray lands is a hit, and has the mean of those that do") {
        Mesh part; // to x = .6, in the middle of the third of four texels
        add_patch(part, 1, 1, [](double s, double t) { return PatchPoint{{0.6 * s, t, 0.001}, {0, 0, 1}, {}}; });
        JobOptions options = job_options(4, 4, {DetailMap::height});
        options.transfer.rays = 2;
        const Job job(unit_plane(), {part}, options);
        CHECK(job.report().hit == 12);
        CHECK(job.report().missed == 4);
        CHECK(std::abs(double(job.result.details[0].at(2, 2)) - 0.001) < 1e-6);
    }

    TEST_CASE("transfer: many rays give the mean of the heights over a texel") {
        // Of .04 x y the mean is that of the centre; samples along a diagonal would give .04 / 12 / 4 more.
        Mesh high;
        add_patch(high, 64, 64, [](double x, double y) { return PatchPoint{{x, y, 0.04 * x * y}, {0, 0, 1}, {}}; });
        JobOptions options = job_options(2, 2, {DetailMap::height});
        options.transfer.rays = 3;
        const Job job(unit_plane(), {high}, options);
        for (int y = 0; y < 2; ++y)
            for (int x = 0; x < 2; ++x)
                CHECK(std::abs(double(job.result.details[0].at(x, y)) - 0.04 * (x + 0.5) / 2 * (1.5 - y) / 2) < 1e-5);
        CHECK(job.report().nearest < 0.001);
        CHECK(job.report().farthest > 0.03);
    }

    TEST_CASE("transfer: a border texel continues the chart linearly to its centre, which lies outside") {
        // The chart ends at 6.2 of 8 texels, .3 before the centre of the seventh.
        Mesh low = unit_plane();
        const float begin = 0.7f / 8, size = 5.5f / 8;
        for (Vec2f& uv : low.uvs) uv = Vec2f(begin + size * uv.x, uv.y);
        const auto value = [](double x) { return glm::normalize(Vec3d(0.3 * x, 0, 1)); };
        Mesh high;
        add_patch(high, 400, 1, [&](double s, double t) {
            return PatchPoint{{1.2 * s - 0.1, t, 0.001}, value(1.2 * s - 0.1), {}};
        });
        const Job job(low, {high}, job_options(8, 8));
        REQUIRE(job.report().border > 0);
        const double beyond = (6.5 / 8 - double(begin)) / double(size); // of the centre, in x
        REQUIRE(beyond > 1.04);
        CHECK(oracle::angle_deg(job.normal(6, 3), value(beyond)) < 0.05);
        CHECK(oracle::angle_deg(value(beyond), value(1)) > 0.5);
    }

    TEST_CASE("transfer: texels whose frame has no volume are counted and flat") {
        const Mesh low = unit_plane();
        BakeTarget target = make_bake_target(low, "low", 4, 4);
        for (Vec4f& tangent : target.tangents) tangent = Vec4f(0, 0, 1, 1);
        const HighSurface high(named({unit_plane(0.001)}), Vec3d(0), HighNormals::smooth, 1);
        const Casting casting(target.surface, CastBy::blend, measured_reach(target.surface, high));
        const Transfer result = transfer(target, high, casting, job_options(4, 4).transfer, "low");
        CHECK(result.report.degenerate == 16);
        CHECK(result.report.hit == 0);
        CHECK(result.states.at(2, 2) == TexelState::outside);
        CHECK(result.map.at(2, 2, 2) == 1);
    }

} // TEST_SUITE

TEST_SUITE("stability") {

    TEST_CASE("transfer: samples on an edge inside a chart are not taken for samples at its border") {
        // The same square, cut along one diagonal and along the other; two rays along each side lie on both.
        Mesh other = unit_plane();
        std::rotate(other.corner_position.begin(), other.corner_position.begin() + 1, other.corner_position.end());
        std::rotate(other.corner_uv.begin(), other.corner_uv.begin() + 1, other.corner_uv.end());
        if (!other.corner_normal.empty())
            std::rotate(other.corner_normal.begin(), other.corner_normal.begin() + 1, other.corner_normal.end());
        const auto waves = [] {
            Mesh mesh = unit_plane(0, 40);
            mesh.normals.clear(), mesh.corner_normal.clear();
            for (Vec3f& p : mesh.positions) p.z = 0.02f * std::sin(20 * p.x) * std::cos(17 * p.y);
            return mesh;
        };
        JobOptions options = job_options(16, 16);
        options.reach = Reach{0.1f, 0.1f, 0};
        options.transfer.rays = 2;
        const Job one(unit_plane(), {waves()}, options), two(other, {waves()}, options);
        CHECK(one.report().rays == 16 * 16 * 4);
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 16; ++x) CHECK(glm::length(one.normal(x, y) - two.normal(x, y)) < 1e-5);
    }

    TEST_CASE("transfer: meshes that end at the same place miss nothing at the border, whatever the size") {
        Mesh low = unit_plane();
        for (Vec2f& uv : low.uvs) uv = 0.1f + 0.777f * uv;
        for (const int size : {89, 97, 150})
            CHECK(Job(low, {unit_plane()}, job_options(size, size)).report().missed == 0);
    }

    TEST_CASE("transfer: parts without a source are flat, not padded, and counted apart") {
        Mesh low = unit_plane(0, 2); // four faces
        const BakeTarget target = make_bake_target(low, "low", 16, 16);
        const HighSurface high(named({unit_plane(0.01)}), Vec3d(0), HighNormals::smooth, 1);
        const Casting casting(target.surface, CastBy::blend, constant_reach(target.surface, {0.1f, 0.1f, 0}));
        TransferOptions options = job_options(16, 16).transfer;
        options.alpha = true;
        const TransferSources sources{{{&high, &casting}}, {0, no_index, 0, 0}};
        const Transfer result = transfer(target, sources, options, "low");
        CHECK(result.report.unmatched == 64);
        CHECK(result.report.hit == 192);
        CHECK(result.report.missed == 0);
        CHECK(missed_texels(target, sources, result, 9).empty());
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 16; ++x)
                if (result.states.at(x, y) == TexelState::unmatched) {
                    CHECK(result.map.at(x, y, 2) == 1);
                    CHECK(result.alpha.at(x, y) == 0);
                }
    }

    TEST_CASE("transfer: the number of threads does not change a bit of any map or count") {
        const auto run = [](int threads, int rays) {
            const ThreadLimit limit(threads);
            JobOptions options = job_options(90, 62, {std::begin(all_detail_maps), std::end(all_detail_maps)});
            options.transfer.details.sky_rays = 16, options.transfer.rays = rays;
            return std::make_unique<Job>(sharp_box(), std::vector<Mesh>{rounded_box(24, 0.08, true)}, options);
        };
        for (const int rays : {1, 2}) {
            const auto one = run(1, rays);
            for (const int threads : {2, 7}) {
                const auto other = run(threads, rays);
                CHECK(same_bytes(one->result.map, other->result.map));
                CHECK(same_bytes(one->result.states, other->result.states));
                for (std::size_t m = 0; m < one->result.details.size(); ++m) {
                    CAPTURE(std::string(name(all_detail_maps[m])));
                    CHECK(same_bytes(one->result.details[m], other->result.details[m]));
                }
                CHECK(one->report().rays == other->report().rays);
                CHECK((one->report().lengths == other->report().lengths));
                CHECK(one->report().parallax_mean == other->report().parallax_mean);
                CHECK(one->report().farthest == other->report().farthest);
                CHECK(one->result.far.size() == other->result.far.size());
            }
        }
    }

    TEST_CASE("transfer: maps of one texel, one triangle, and triangles without area in space or in uv") {
        const Mesh triangle = polygons({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {{0, 0}, {1, 0}, {0, 1}});
        for (const auto& [width, height] : {std::pair(1, 1), {1, 9}, {9, 1}, {5, 7}})
            for (const int rays : {1, 2, 16}) {
                JobOptions options = job_options(width, height, {DetailMap::height});
                options.transfer.rays = rays;
                const Job job(triangle, {triangle}, options);
                CHECK(job.report().missed == 0);
                CHECK(job.report().hit >= 1);
                CHECK(worst_angle(job, flat) < 1e-3);
            }
        Mesh low = unit_plane(0, 4), high = unit_plane(0.001, 4);
        low.positions[7] = low.positions[6] = high.positions[8] = low.positions[8]; // in space
        low.uvs[12] = low.uvs[13] = low.uvs[18];                                    // in uv
        const Job job(low, {high}, job_options(33, 17));
        for (std::size_t i = 0; i < job.result.map.size(); ++i) REQUIRE(std::isfinite(job.result.map.data()[i]));
        std::int64_t outside = 0;
        for (std::size_t i = 0; i < job.result.states.size(); ++i)
            outside += job.result.states.data()[i] == TexelState::outside;
        CHECK(job.report().hit + job.report().missed + outside == 33 * 17);
    }

} // TEST_SUITE
