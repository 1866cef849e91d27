// Rates that follow the relief and the camera.
#include "bake/mesh/file/mesh_io.h"
#include "bake/relief/displace/rates.h"
#include "cli/command.h"
#include "relief/displace/displace_meshes.h"

using namespace bake;
using namespace bake::test;

namespace {

DisplaceOptions by_error(double error) {
    DisplaceOptions options;
    options.rates.rule = Rates::Rule::error;
    options.rates.error = error;
    options.measure_error = true;
    return options;
}

/// A plane of one quad, under a bump on a twentieth of it.
Mesh sheet() {
    return polygons({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 3}}, {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
}
double bump(double u, double v) { return std::exp(-300 * ((u - 0.3) * (u - 0.3) + (v - 0.6) * (v - 0.6))); }

/// Largest distance, along z, of the plane's relief from the mesh: every face at 12 x 12 of its own parameters. On a
/// height over a plane that is an upper bound of the distance.
double error_over_plane(const Mesh& mesh, const std::function<double(double, double)>& height) {
    double worst = 0;
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
        const std::uint32_t first = mesh.face_begin[f], n = mesh.face_begin[f + 1] - first;
        for (std::uint32_t k = 2; k < n; ++k) {
            const Vec3d a(mesh.positions[mesh.corner_position[first]]),
                b(mesh.positions[mesh.corner_position[first + k - 1]]),
                c(mesh.positions[mesh.corner_position[first + k]]);
            const Vec3d normal = glm::normalize(glm::cross(b - a, c - a));
            for (int i = 0; i <= 6; ++i)
                for (int j = 0; i + j <= 6; ++j) {
                    const Vec3d p = a + (i / 6.0) * (b - a) + (j / 6.0) * (c - a);
                    worst = std::max(worst, std::abs(height(p.x, p.y) - p.z) * normal.z);
                }
        }
    }
    return worst;
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE(
        "displace: rates by error keep it, against the closed form, with a fraction of a uniform rate's triangles") {
        const BaseSurface base(sheet());
        const Relief relief_of_bump = relief(picture(256, 256, bump), 0.2, 0, Wrap::clamp);
        for (const double error : {0.004, 0.001}) {
            CAPTURE(error);
            const Displaced out = displace(base, relief_of_bump, by_error(error));
            check_sound(out.mesh);
            CHECK(error_over_plane(out.mesh, [](double u, double v) { return 0.2 * bump(u, v); }) <=
                  1.02 * error); // the texture's own
            CHECK(out.report.error_max <= error);
            CHECK(out.report.error_max > 0.3 * error);
            CHECK(out.report.triangles * 3 < out.report.uniform_triangles);
            CHECK(check(out.mesh).topology.boundary_edges == check(out.mesh).welded.boundary_edges);
        }
    }

    TEST_CASE("displace: the uniform rate reported needs what displace at that rate measures") {
        const Mesh halves =
            polygons(sheet().positions, {{0, 1, 2}, {0, 2, 3}}, {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}});
        const Relief relief_of_bump = relief(picture(256, 256, bump), 0.2, 0, Wrap::clamp);
        for (const Mesh& mesh : {sheet(), halves}) {
            const BaseSurface base(mesh);
            const Displaced out = displace(base, relief_of_bump, by_error(0.002));
            // A quad of rate r is 2 r^2 triangles, as are two triangles.
            const double rate = std::sqrt(double(out.report.uniform_triangles) / 2);
            CHECK(rate == doctest::Approx(std::round(rate)));
            DisplaceOptions finer;
            finer.measure_error = true;
            finer.rates.levels = int(std::ceil(std::log2(rate)));
            CHECK(displace(base, relief_of_bump, finer).report.error_max <= out.report.error_max * 1.05);
            finer.rates.levels = int(std::floor(std::log2(rate * 0.8)));
            CHECK(displace(base, relief_of_bump, finer).report.error_max > out.report.error_max);
        }
    }

    TEST_CASE("displace: without relief, rates by error follow the curvature of the surface") {
        // A chord of angle x on a circle of radius r is r x^2 / 8 off.
        const BaseSurface base(ParametricSurface("cylinder:R=1,h=2"), 4, 1);
        const Relief none = relief(picture(1, 1, [](double, double) { return 0.5; }), 1);
        for (const double error : {1e-2, 1e-3, 1e-4}) {
            const Displaced out = displace(base, none, by_error(error));
            CHECK(out.report.error_max <= error);
            const double around = 2 * pi / std::sqrt(8 * error);
            // One quad along the height for each around, and not much more.
            CHECK(double(out.report.triangles) >= 2 * around);
            CHECK(double(out.report.triangles) <= 2.5 * around + 16);
        }
    }

} // TEST_SUITE

TEST_SUITE("real" * doctest::skip(test::no_shared_data())) {

    TEST_CASE(
        "displace: rates by error keep it on real heights, with two thirds of a uniform rate's triangles and fewer") {
        const auto pairs = shared_data() / "textures" / "pairs";
        for (const std::string file :
             {"ambientcg_Rock020/Rock020_1K_Displacement.jpg", "ambientcg_Tiles036/Tiles036_1K_Displacement.jpg",
              "cube2_metal_tech_01/metal_tech_01_hm.png", "bevy_parallax_cube/cube_depth.png"}) {
            CAPTURE(file);
            Image<float> values = box_minify(read_height((pairs / file).string()).values, 96, 96);
            const auto [low, high] = std::minmax_element(values.data(), values.data() + values.size());
            const double amplitude = 0.05 / double(*high - *low);
            const Relief height = relief(std::move(values), amplitude);
            const HeightSampler<float> sampler(height.values, height.interpolation, height.height);
            const Displaced out = displace(BaseSurface(sheet()), height, by_error(0.005)); // a tenth of the range
            CHECK(out.report.error_max <= 0.005);
            CHECK(error_over_plane(out.mesh, [&](double u, double v) { return sampler.sample(u, v).b; }) <=
                  1.05 * 0.005); // denser than measured
            CHECK(out.report.triangles * 3 < out.report.uniform_triangles * 2);
            check_sound(out.mesh);
        }
    }

    TEST_CASE("displace: rates by error do not cut a cell without end whose sides are coarser than what they bound") {
        // Tiles at 1K over a cage: cliffs inside cells whose sides are straight. No lattice makes up for such sides.
        const auto tiles = shared_data() / "textures/pairs/ambientcg_Tiles036/Tiles036_1K_Displacement.jpg";
        const auto cage = shared_data() / "meshes/opensubdiv/catmark_cubes_semisharp.obj";
        const BaseSurface base(read_mesh(cage.string()), SubdivisionOptions{});
        const double size = diagonal(bounds(base.mesh()));
        const Displaced out =
            displace(base, relief(read_height(tiles.string()).values, 0.01 * size), by_error(0.001 * size));
        CHECK(out.report.error_max <= 0.001 * size);
        CHECK(out.report.triangles * 8 < out.report.uniform_triangles);
    }

} // TEST_SUITE

TEST_SUITE("unit") {

    TEST_CASE("rates_by_error: before cells are fitted, a search tells of no more triangles than the result has") {
        // A roof along one side of the sheet, which falls to nothing at the side across: three triangles.
        const BaseSurface base(sheet());
        for (const bool turned : {false, true})
            for (const bool across : {false, true}) {
                const auto roof = [&](double u, double v) {
                    const double along = turned ? v : u, off = turned ? u : v;
                    return std::min(2 * along, 2 - 2 * along) * (across ? off : 1 - off);
                };
                const Relief height = relief(picture(64, 64, roof), 0.17, 0, Wrap::clamp);
                const SeamedRelief scene = seamed(base, height, Seam::average);
                std::vector<double> told;
                const auto note = [&](std::uint32_t, double least, double) { told.push_back(least); };
                const RatePlan plan = rates_by_error(scene.surface, scene.blend, by_error(0.1).rates, note, nullptr);
                CHECK(triangles_of(plan) == 3);
                REQUIRE(told.size() > 2); // of the split alone, then of the edges, then of the cells
                CHECK(told[1] > 0);
                CHECK(told[1] <= double(triangles_of(plan)));
            }
    }

    TEST_CASE("displace: edges are cut short enough under the measure that is given") {
        const BaseSurface base(cube());
        const Relief height = relief(noise(16), 0.02);
        DisplaceOptions options;
        options.rates.rule = Rates::Rule::edge_size;
        options.rates.size = 0.21;
        const Displaced plain = displace(base, height, options);
        CHECK(check(plain.mesh).topology.boundary_edges == 0);
        CHECK(plain.mesh.faces() >= 6 * 100);
        CHECK(plain.mesh.faces() <= 6 * 200);
        // Nearer things are larger: finer towards x = 1.
        options.rates.measure = [](const Vec3d& a, const Vec3d& b) {
            return glm::length(b - a) * (1.5 + 0.5 * (a.x + b.x));
        };
        options.rates.size = 0.2;
        const Displaced out = displace(base, height, options);
        CHECK(check(out.mesh).topology.boundary_edges == 0);
        CHECK(check(out.mesh).welded.boundary_edges == 0);
        std::size_t near = 0, far = 0;
        for (const Vec3f& p : out.mesh.positions) (p.x > 0.5f ? near : far) += std::abs(p.x) > 0.5f;
        CHECK(near > 2 * far);
    }

    TEST_CASE("cut_poles_as_cells: a side without length gets the rate along it, so that the cell stays a lattice") {
        const BaseSurface base(ParametricSurface("sphere"), 4, 2);
        const PatchCells cells(base, 1);
        const PatchComplex& complex = cells.complex();
        CellRates rates;
        rates.edge.assign(complex.edges, 1);
        rates.across.assign(cells.count(), 6), rates.up.assign(cells.count(), 3);
        std::size_t poles = 0;
        for (const PatchComplex::Patch& patch : complex.patches)
            for (int i = 0; i < 4; ++i) {
                poles += is_point(patch, i);
                if (!is_point(patch, i)) rates.edge[patch.edge[i]] = i % 2 == 0 ? 6 : 3;
            }
        CHECK(poles == 2 * 4);
        cut_poles_as_cells(complex, rates);
        for (std::uint32_t c = 0; c < cells.count(); ++c)
            CHECK(pattern(rates_of_cell(cells, rates, c)) == PatchPattern::lattice);
    }

    TEST_CASE("displace: rates by error give the same mesh with any number of threads") {
        const auto run = [](int threads) {
            const ThreadLimit limit(threads);
            return displace(BaseSurface(cube()), relief(noise(24), 0.1), by_error(0.02));
        };
        const Displaced one = run(1), two = run(2), seven = run(7);
        CHECK(one.mesh.positions == two.mesh.positions);
        CHECK(one.mesh.corner_position == seven.mesh.corner_position);
        CHECK(one.report.uniform_triangles == seven.report.uniform_triangles);
        CHECK(one.report.count.points == one.mesh.positions.size());
    }

} // TEST_SUITE
