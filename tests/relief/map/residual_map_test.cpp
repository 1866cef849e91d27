// A displaced mesh with the map of what its normals lack, against full displacement.
#include "bake/mesh/file/mesh_io.h"
#include "bake/relief/displace/displace.h"
#include "bake/relief/map/residual_map.h"
#include "bake/surface/analytic/parametric.h"
#include "bake/surface/patch/surface_mesh.h"
#include "folders.h"
#include "relief/map/torus_relief.h"
#include <algorithm>
#include <doctest/doctest.h>
#include <numeric>

using namespace bake;
using namespace bake::test;

namespace {

Mesh displaced(const Mesh& mesh, const HeightTexture& height, const HeightOptions& options, int levels,
               Seam seam = Seam::blend) {
    Relief relief{
        .values = Image<float>(height.values.width(), height.values.height(), 1), .height = options, .vector = {}};
    std::copy_n(height.values.data(), height.values.size(), relief.values.data());
    DisplaceOptions displacement;
    displacement.rates.levels = levels;
    displacement.seam = seam;
    return displace(BaseSurface{Mesh(mesh)}, relief, displacement).mesh;
}

double mean(const std::vector<double>& errors) {
    return std::accumulate(errors.begin(), errors.end(), 0.0) / double(errors.size());
}

/// The map that says what normals the mesh itself shows.
Image<float> flat_map(int size) {
    Image<float> map(size, size, 3);
    for (std::size_t i = 0; i < map.size(); ++i) map.data()[i] = i % 3 == 2 ? 1 : 0.5f;
    return map;
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("residual_map: a coarsely displaced torus with its map has the closed-form normal within .3 degrees") {
        constexpr int size = 512;
        const oracle::TorusRelief r;
        const HeightTexture height = oracle::relief_texture(r, size);
        const NormalMapOptions options = oracle::relief_options(r, size, Filter::c2);
        const Mesh torus = tessellate(ParametricSurface("torus:R=1,r=0.4"), 128, 64);
        const Mesh diced = displaced(torus, height, options.height_options, 0);
        const BakeTarget base = make_bake_target(torus, "torus", size, size),
                         target = make_bake_target(diced, "diced", size, size);
        const HeightField field(height, options.height_options, options.filter, size, size);
        NormalMapReport report;
        const Image<float> residual = residual_map(field, base, target, options, report);
        const Image<float> whole = normal_map(field, base, options, report);
        // The axis of the shape is y, that of the closed form z.
        const auto truth = [&](double u, double v) {
            const Vec3d n = oracle::relief_normal(r, u, v);
            return Vec3d(n.x, n.z, -n.y);
        };
        const auto errors = [&](const Image<float>& map) { return oracle::map_errors(map, target, 0, truth); };
        const auto with_map = errors(residual);
        const double without = mean(errors(flat_map(size))), twice = mean(errors(whole));
        const double worst = *std::max_element(with_map.begin(), with_map.end());
        MESSAGE("degrees: " << mean(with_map) << " with the map, at most " << worst << "; " << without
                            << " of the mesh alone, " << twice << " with a map of the whole height");
        CHECK(worst < 0.3);
        CHECK(mean(with_map) < 0.1);
        CHECK(without > 10 * mean(with_map));
        CHECK(twice > without);
        CHECK(report.uncovered == 0);
    }

} // TEST_SUITE

TEST_SUITE("unit") {

    TEST_CASE("residual_map: without relief it is flat, and green turns for DirectX") {
        constexpr int size = 64;
        const oracle::TorusRelief r{.A = 0.01, .k = 6, .m = 3};
        const HeightTexture height = oracle::relief_texture(r, size);
        NormalMapOptions options = oracle::relief_options(r, size, Filter::c2);
        const Mesh torus = tessellate(ParametricSurface("torus:R=1,r=0.4"), 32, 16);
        const BakeTarget base = make_bake_target(torus, "torus", size, size);
        NormalMapReport report;
        HeightOptions flat = options.height_options;
        flat.amplitude = 0;
        const Image<float> none =
            residual_map(HeightField(height, flat, options.filter, size, size), base, base, options, report);
        for (std::size_t i = 0; i < none.size(); ++i) CHECK(std::abs(none.data()[i] - (i % 3 == 2 ? 1 : 0.5f)) < 1e-5f);
        // Relative to the mesh that is not displaced, it is the normal map itself.
        const HeightField field(height, options.height_options, options.filter, size, size);
        const Image<float> map = normal_map(field, base, options, report);
        const Image<float> same = residual_map(field, base, base, options, report);
        options.directx = true;
        const Image<float> turned = residual_map(field, base, base, options, report);
        for (std::size_t i = 0; i < map.size(); ++i) {
            CHECK(std::abs(same.data()[i] - map.data()[i]) < 1e-5f);
            CHECK(std::abs(turned.data()[i] - (i % 3 == 1 ? 1 - map.data()[i] : map.data()[i])) < 1e-5f);
        }
    }

} // TEST_SUITE

TEST_SUITE("real" * doctest::skip(no_shared_data())) {

    TEST_CASE("residual_map: the limit of Spot's cage, coarsely displaced, with its map is the finely displaced one") {
        constexpr int size = 256;
        const std::string cage = shared_data() / "meshes/spot/spot_control_mesh.obj";
        const BaseSurface limit(read_mesh(cage), SubdivisionOptions{}, cage);
        const Mesh spot = surface_mesh(limit, SurfaceKind::limit, 4).mesh;
        const HeightTexture height = read_height(own_meshes() / "ripples.png");
        NormalMapOptions options{.width = size, .height = size};
        options.height_options.amplitude = 0.01 * diagonal(bounds(spot));
        options.filter = Filter::c2;
        // Averaged seams, because a map does not know how displacement blends heights near seams.
        const Mesh diced = displaced(spot, height, options.height_options, 0, Seam::average);
        const Mesh fine = displaced(spot, height, options.height_options, 2, Seam::average);
        const BakeTarget base = make_bake_target(spot, "spot", size, size);
        const BakeTarget coarse = make_bake_target(diced, "diced", size, size);
        const MeshSurface full = make_mesh_surface(fine);
        const UvRaster texels = chart_raster(fine, full.triangles, size, size, 0, "fine");
        NormalMapReport report;
        const HeightField field(height, options.height_options, options.filter, size, size);
        const Image<float> map = residual_map(field, base, coarse, options, report);
        const auto full_normal = [&](double u, double v) {
            const TexelHit& hit = texels.hits.at(int(u * size), int((1 - v) * size));
            Vec3d n(0, 0, 0);
            if (hit.triangle == no_index) return n;
            const auto& c = full.triangles[hit.triangle].corner;
            const double b[3] = {1.0 - hit.b1 - hit.b2, hit.b1, hit.b2};
            for (int k = 0; k < 3; ++k) n += b[k] * Vec3d(full.n[c[k]]);
            return n;
        };
        const auto errors = [&](const Image<float>& of) { return oracle::map_errors(of, coarse, 0, full_normal); };
        std::vector<double> with_map = errors(map), without = errors(flat_map(size));
        // Not the mean: near borders of charts, which are many, texels of the two meshes are at different points.
        const auto middle = std::ptrdiff_t(with_map.size() / 2);
        std::nth_element(with_map.begin(), with_map.begin() + middle, with_map.end());
        std::nth_element(without.begin(), without.begin() + middle, without.end());
        MESSAGE("every second texel: " << with_map[middle] << " degrees with the map, " << without[middle]
                                       << " without");
        CHECK(with_map[middle] < 0.1);
        CHECK(without[middle] > 3 * with_map[middle]);
    }

} // TEST_SUITE
