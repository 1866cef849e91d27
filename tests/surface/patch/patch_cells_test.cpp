// Cells of patches: the refined complex, and where its points lie.
#include "bake/surface/patch/patch_cells.h"
#include "oracle/surfaces.h"
#include "surface/subdivision/cages.h"
#include <doctest/doctest.h>

using namespace bake;

namespace {

/// The largest distance between the points that the cells beside an edge have at its thirds.
double largest_gap(const PatchCells& cells) {
    const PatchComplex& complex = cells.complex();
    std::vector<std::vector<Vec3d>> seen(complex.edges);
    double gap = 0;
    for (std::uint32_t c = 0; c < cells.count(); ++c)
        for (int i = 0; i < complex.patches[c].sides(); ++i) {
            const bool reversed = complex.patches[c].reversed[i];
            std::vector<Vec3d> points;
            for (const std::uint32_t k : {0u, 1u, 2u, 3u}) {
                const Vec2d st = cells.on_side(c, i, reversed ? 3 - k : k, 3);
                SurfacePoint point;
                cells.base().evaluate(cells.patch(c), {&st, 1}, {&point, 1});
                points.push_back(point.jet.p);
            }
            std::vector<Vec3d>& first = seen[complex.patches[c].edge[i]];
            if (first.empty()) first = points;
            for (std::size_t k = 0; k < points.size(); ++k) gap = std::max(gap, glm::length(points[k] - first[k]));
        }
    return gap;
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("patch_cells: cells of quads and of triangles share their edges, within patches and across them") {
        const BaseSurface quads(bake_tests::box(), SubdivisionOptions{});
        const BaseSurface triangles(oracle::torus_mesh(6, 5), SubdivisionOptions{.scheme = Scheme::loop});
        for (const BaseSurface* base : {&quads, &triangles})
            for (const std::uint32_t split : {1u, 2u, 3u, 5u}) {
                CAPTURE(split);
                const PatchCells cells(*base, split);
                CHECK(cells.count() == base->complex().patches.size() * split * split);
                const PatchComplex& complex = cells.complex();
                const long euler = long(complex.vertices) - long(complex.edges) + long(cells.count());
                CHECK(euler == (base == &quads ? 2 : 0));
                std::vector<int> uses(complex.edges);
                for (const PatchComplex::Patch& cell : complex.patches)
                    for (int i = 0; i < cell.sides(); ++i) ++uses[cell.edge[i]];
                CHECK(std::count(uses.begin(), uses.end(), 2) == std::ptrdiff_t(complex.edges));
                CHECK(largest_gap(cells) < 1e-12);
            }
    }

    TEST_CASE("patch_cells: seams and creases of a patch's edge are those of its segments") {
        const BaseSurface base(oracle::torus_mesh(8, 6, true));
        const PatchCells cells(base, 3);
        const auto& [edges, vertices] = base.junctions();
        CHECK(cells.junctions().edges.junctions.size() == 3 * edges.junctions.size());
        CHECK(cells.junctions().vertices.junctions.size() == vertices.junctions.size() + 2 * edges.junctions.size());
    }

    TEST_CASE("patch_cells: each side of the cells of a face without area has an edge of its own") {
        // Beside a quad, a quad and a triangle whose corners are two of its vertices.
        const BaseSurface base(
            bake_tests::cage_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 3}, {0, 0, 1, 1}, {2, 2, 3}}));
        REQUIRE(base.complex().patches.size() == 3);
        const PatchCells cells(base, 3);
        std::vector<int> uses(cells.complex().edges);
        for (std::uint32_t c = 0; c < cells.count(); ++c)
            for (int i = 0; i < cells.complex().patches[c].sides(); ++i) ++uses.at(cells.complex().patches[c].edge[i]);
        for (std::uint32_t c = 9; c < 27; ++c)
            for (int i = 0; i < cells.complex().patches[c].sides(); ++i)
                CHECK(uses[cells.complex().patches[c].edge[i]] == 1);
    }

} // TEST_SUITE
