#include "bake/relief/displace/cell_fit.h"
#include "relief/displace/displace_meshes.h"

using namespace bake;
using namespace bake::test;

namespace {

/// Fits the one cell of a face under a height, with sides that are fine enough.
CellFitter::Fit fit(const Mesh& mesh, Image<float> height, double error) {
    const BaseSurface base(mesh);
    const Relief waves = relief(std::move(height), 0.2, 0, Wrap::clamp);
    const SeamedRelief seamed_waves = seamed(base, waves, Seam::average);
    const PatchCells cells(base, 1);
    CellFitter fitter(seamed_waves.surface, seamed_waves.blend, cells);
    const int sides = cells.complex().patches[0].sides();
    return fitter.fit(0, {.sides = sides, .side = {64, 64, 64, 64}, .across = 1, .up = 1}, error, 64, Vec2d(1), false);
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("cell_fit: the samples of a direction are as many as its texels, and denser where faces are smaller") {
        // 600 texels across the waves' crests and 8 along their slope, which needs more faces than 8 texels allow.
        const Mesh quad =
            polygons({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 3}}, {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
        const auto wave = [](double x) { return 0.5 + 0.5 * std::sin(2 * pi * x); };
        const CellFitter::Fit flat = fit(quad, picture(600, 8, [&](double, double v) { return wave(v); }), 0.003);
        const CellFitter::Fit upright = fit(quad, picture(8, 600, [&](double u, double) { return wave(u); }), 0.003);
        CHECK(flat.up > 8);
        CHECK(flat.density.x == 1);
        CHECK(flat.density.y * 8 >= 2 * flat.up);
        CHECK(upright.across == flat.up);
        CHECK(upright.density.x == flat.density.y);
        CHECK(upright.density.y == 1);
    }

    TEST_CASE("cell_fit: a height and its transpose have lattices that are each other's transpose") {
        const Mesh quad =
            polygons({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 3}}, {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
        const auto ridge = [](double x, double at) { return std::exp(-400 * (x - at) * (x - at)); };
        for (const double at : {0.0, 0.02, 0.05, 0.4, 1.0})
            for (const double error : {0.05, 0.02, 0.01, 0.004}) {
                const auto lattice = [&](bool turned) {
                    return fit(quad, picture(32, 32, [&](double u, double v) { return ridge(turned ? 1 - v : u, at); }),
                               error);
                };
                const CellFitter::Fit one = lattice(false), other = lattice(true);
                CHECK(one.across == other.up);
                CHECK(one.up == other.across);
            }
    }
}
