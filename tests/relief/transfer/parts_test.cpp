// Bakes of a low-poly mesh of which a part has no high-poly mesh, and of charts whose borders cut texels.
#include "bake/relief/transfer/debug_rays.h"
#include "bake/relief/transfer/reach.h"
#include "bake/relief/transfer/witness.h"
#include "relief/transfer/transfer_meshes.h"

using namespace bake;
using namespace bake::test;

namespace {

/// The unit square as two faces that meet at x = cut.
Mesh cut_plane(double cut) {
    Mesh mesh;
    for (const auto& [from, to] : {std::pair(0.0, cut), {cut, 1.0}})
        add_patch(mesh, 1, 1, [from = from, to = to](double s, double t) {
            const double x = from + s * (to - from);
            return PatchPoint{{x, t, 0}, {0, 0, 1}, {x, t}};
        });
    return mesh;
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE(
        "transfer: a texel that rays on a matched part reach is a hit, though its centre lies on a part without a "
        "counterpart") {
        const Mesh low = cut_plane(0.53);
        Mesh slope;
        add_patch(slope, 1, 1, [](double s, double t) {
            return PatchPoint{{1.2 * s - 0.1, t, 0.1 * s}, glm::normalize(Vec3d(-1.0 / 12, 0, 1)), {}};
        });
        const int width = 16, height = 37;
        const BakeTarget target = make_bake_target(low, "low", width, height);
        const HighSurface high(named({slope}), Vec3d(0), HighNormals::smooth, 1);
        const Casting casting(target.surface, CastBy::blend, constant_reach(target.surface, {0.4f, 0.2f}));
        const TransferSources sources{{{&high, &casting}}, {0, no_index}};
        for (const int rays : {1, 2, 5, 7})
            for (const double error : {0.0, 0.5}) {
                CAPTURE(rays);
                TransferOptions options;
                options.width = width, options.height = height, options.padding = 0, options.rays = rays;
                options.max_error_deg = error;
                const Transfer result = transfer(target, sources, options, "low");
                CHECK(result.report.hit == (rays == 1 ? 8 : 9) * height);
                CHECK(result.report.hit + result.report.unmatched == width * height);
                for (int y = 0; y < height; ++y)
                    for (int x = 0; x < width; ++x)
                        CHECK((result.map.at(x, y, 0) < 0.49f) == (result.states.at(x, y) == TexelState::hit));
                const std::vector<Witness> far = farthest_texels(target, sources, result, 8);
                for (const Witness& witness : far) CHECK(witness.face == 0);
                CHECK(debug_rays(target, sources, result, far, 1000).faces() > 0);
            }
    }

    TEST_CASE("transfer: texels at the border of a chart get all rays where others get as many as they need") {
        Mesh low; // one triangle, which cuts texels at all angles
        low.positions = {{0.03f, 0.02f, 0}, {0.97f, 0.11f, 0}, {0.37f, 0.93f, 0}};
        low.normals = {{0, 0, 1}};
        low.corner_position = low.corner_uv = {0, 1, 2}, low.corner_normal = {0, 0, 0}, low.face_begin = {0, 3};
        for (const Vec3f& p : low.positions) low.uvs.emplace_back(p);
        Mesh waves;
        add_patch(waves, 200, 200, [](double x, double y) {
            const double k = 20; // 20 texels of 64 per wave
            return PatchPoint{{x, y, 0}, glm::normalize(Vec3d(0.3 * std::sin(k * x), 0.3 * std::sin(k * y), 1)), {}};
        });
        const int size = 64;
        const BakeTarget target = make_bake_target(low, "low", size, size);
        const HighSurface high(named({waves}), Vec3d(0), HighNormals::smooth, 1e6);
        const Casting casting(target.surface, CastBy::blend, constant_reach(target.surface, {0.1f, 0.1f}));
        const auto baked = [&](double error) {
            TransferOptions options;
            options.width = options.height = size, options.padding = 0, options.rays = 8;
            options.max_error_deg = error;
            return transfer(target, high, casting, options, "low");
        };
        const Transfer all = baked(0), some = baked(0.05);
        CHECK(some.report.rays < all.report.rays / 3);
        double most = 0;
        const auto normal = [](const Transfer& of, int x, int y) {
            return 2.0 * Vec3d(of.map.at(x, y, 0), of.map.at(x, y, 1), of.map.at(x, y, 2)) - 1.0;
        };
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x)
                most = std::max(most, oracle::angle_deg(normal(all, x, y), normal(some, x, y)));
        CHECK(most < 0.05);
        CHECK(most > 0);
    }
}
