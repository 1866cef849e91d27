// Detail that a known height has made, cast back onto the mesh under it: the same heights and the same normals again.
//
// Heights are compared in shares of the amplitude, the height of white above black. Where a corner of HIGH lies on the ray of each
// texel, floats alone are between the height and its map; elsewhere HIGH's triangles are, with an error of the second order in
// their edges.
#include "relief/map/torus_relief.h"
#include "relief/transfer/transfer_meshes.h"

using namespace bake;
using namespace bake::test;
using oracle::TorusRelief;

namespace {

constexpr double amplitude = 0.04, floats = 1e-5;

/// Largest difference of the height map from exact(x, y), in shares of the amplitude. Texels with keeps(x, y) count.
template <class Exact, class Keeps> double height_error(const Job& job, const Exact& exact, const Keeps& keeps) {
    const Image<float>& heights = job.result.details[0];
    double worst = 0;
    for (int y = 0; y < heights.height(); ++y)
        for (int x = 0; x < heights.width(); ++x)
            if (keeps(x, y)) worst = std::max(worst, std::abs(double(heights.at(x, y)) - exact(x, y)));
    return worst / amplitude;
}
template <class Exact> double height_error(const Job& job, const Exact& exact) {
    return height_error(job, exact, [](int, int) { return true; });
}

/// What a height does to a mesh that is displaced, and what a bake finds of it there.
struct Circle {
    double height = 0;      ///< largest error, in shares of the amplitude
    oracle::Spread degrees; ///< between the normal map of the displaced mesh and that of the height
};

Circle circle(Mesh low, int size, int rate) {
    const TorusRelief r{.A = amplitude / 2, .k = 2, .m = 1};
    const HeightTexture height = oracle::relief_texture(r, size);
    const HeightField field(height, {.amplitude = amplitude, .midlevel = 0.5}, Filter::c2, size, size);
    Mesh high =
        displace(BaseSurface(low), relief(oracle::relief_texture(r, size).values, amplitude), levels(rate)).mesh;
    const Job job(std::move(low), {std::move(high)}, job_options(size, size, {DetailMap::height}));
    CHECK(job.report().missed == 0);
    NormalMapReport counts;
    const Image<float> map = normal_map(field, job.target, oracle::relief_options(r, size, Filter::c2), counts);
    Circle out;
    out.height = height_error(job, [&](int x, int y) { return amplitude * (double(height.values.at(x, y)) - 0.5); });
    std::vector<double> angles;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            angles.push_back(oracle::angle_deg(job.normal(x, y),
                                               2.0 * Vec3d(map.at(x, y, 0), map.at(x, y, 1), map.at(x, y, 2)) - 1.0));
    out.degrees = oracle::spread(angles);
    return out;
}

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("height map: of a displaced plane, the displacement up to the rounding of floats") {
        constexpr int size = 32; // centres of texels are every other corner of a grid of 2 size cells
        const auto wave = [](double x, double y) { return amplitude / 2 * std::sin(7 * x) * std::cos(5 * y); };
        Mesh high;
        add_patch(high, 2 * size, 2 * size, [&](double x, double y) {
            return PatchPoint{{x, y, wave(x, y)}, {0, 0, 1}, {}};
        });
        const Job waves(unit_plane(), {high}, job_options(size, size, {DetailMap::height}));
        CHECK(height_error(waves, [&](int x, int y) { return wave((x + 0.5) / size, 1 - (y + 0.5) / size); }) < floats);
        // A linear height is exact between the corners, too.
        const auto slope = [](double x, double y) { return 0.01 + amplitude / 2 * (x - 0.7 * y); };
        Mesh tilted;
        add_patch(tilted, 1, 1, [&](double s, double t) {
            const double x = 1.2 * s - 0.1, y = 1.2 * t - 0.1;
            return PatchPoint{{x, y, slope(x, y)}, {0, 0, 1}, {}};
        });
        const Job plane(unit_plane(), {tilted}, job_options(37, 37, {DetailMap::height}));
        CHECK(height_error(plane, [&](int x, int y) { return slope((x + 0.5) / 37, 1 - (y + 0.5) / 37); }) < floats);
    }

    TEST_CASE("height map: of a displaced sphere over the facets of a coarse one, up to the rounding of floats") {
        constexpr int width = 64, height = 32;
        const Mesh low = lat_long_sphere(24, 12);
        const BakeTarget target = make_bake_target(low, "low", width, height);
        const auto point = [&](int x, int y) { // of the facets, under the centre of a texel
            const TexelHit& at = target.raster.hits.at(x, y);
            const auto& corner = target.surface.triangles[at.triangle].corner;
            const auto p = [&](std::size_t k) { return Vec3d(low.positions[low.corner_position[corner[k]]]); };
            return double(1 - at.b1 - at.b2) * p(0) + double(at.b1) * p(1) + double(at.b2) * p(2);
        };
        const auto radius = [](int x, int y) { return 1 + amplitude / 2 * std::sin(0.7 * x) * std::cos(0.5 * y); };
        // Rays are radial, and a corner lies on each.
        Mesh high;
        add_patch(high, width, height - 1, [&](double s, double t) {
            const int x = int(std::round(s * width)) % width, y = int(std::round((1 - t) * (height - 1)));
            const Vec3d n = glm::normalize(point(x, y));
            return PatchPoint{radius(x, y) * n, n, {}};
        });
        JobOptions options = job_options(width, height, {DetailMap::height});
        options.reach = Reach{0.1f, 0.1f, 0};
        const Job job(low, {high}, options);
        CHECK(height_error(
                  job, [&](int x, int y) { return radius(x, y) - glm::length(point(x, y)); },
                  // Half of each quad at a pole has no area, and its texels share points.
                  [](int, int y) { return y > 3 && y < height - 4; }) < floats);
    }

    TEST_CASE("circle: a displaced mesh gives back the height and its normal map") {
        // Texels at corners of HIGH, where rounding is all; and anywhere.
        const Circle corners = circle(oracle::torus_mesh(16, 8), 64, 4);
        CHECK(corners.height < floats);
        CHECK(corners.degrees.max < 1e-3);
        const Circle coarse = circle(oracle::torus_mesh(16, 8), 60, 4), fine = circle(oracle::torus_mesh(16, 8), 60, 5);
        CHECK(fine.height < 1.2e-4);
        CHECK(fine.degrees.mean < 0.005);
        CHECK(fine.degrees.max < 0.05);
        CHECK(coarse.height / fine.height == doctest::Approx(4).epsilon(0.1));
        // A chart that is mirrored.
        Mesh mirrored = oracle::torus_mesh(16, 8);
        for (Vec2f& uv : mirrored.uvs) uv.x = 1 - uv.x;
        const Circle turned = circle(mirrored, 64, 4);
        CHECK(turned.height < floats);
        CHECK(turned.degrees.max < 1e-3);
    }

    TEST_CASE("circle: quads are displaced as bilinear patches and baked as triangles, second order in their size") {
        const Circle coarse = circle(oracle::torus_mesh(16, 8, true), 60, 4),
                     fine = circle(oracle::torus_mesh(32, 16, true), 60, 3);
        CHECK(coarse.height < 0.03);
        CHECK(coarse.height / fine.height == doctest::Approx(4).epsilon(0.15));
        CHECK(coarse.degrees.mean / fine.degrees.mean == doctest::Approx(4).epsilon(0.15));
    }

    TEST_CASE("circle: the sides of a box, away from its hard edges") {
        constexpr int width = 96, height = 64;
        Image<float> values = picture(width, height, [](double u, double v) {
            return 0.5 + 0.5 * std::sin(2 * oracle::pi * 3 * u) * std::sin(2 * oracle::pi * 2 * v);
        });
        const Image<float> heights = picture(width, height, [](double u, double v) {
            return amplitude / 2 * std::sin(2 * oracle::pi * 3 * u) * std::sin(2 * oracle::pi * 2 * v);
        });
        const Job job(sharp_box(),
                      {displace(BaseSurface(sharp_box()), relief(std::move(values), amplitude), levels(8)).mesh},
                      job_options(width, height, {DetailMap::height}));
        CHECK(job.report().missed == 0);
        const auto inside = [&](int x, int y) {
            const Vec3d p = glm::abs(job.point(x, y));
            const double edge = 1 - (p.x + p.y + p.z - std::max({p.x, p.y, p.z}) - std::min({p.x, p.y, p.z}));
            return edge > 0.1; // rays lean beside the edges
        };
        CHECK(height_error(
                  job, [&](int x, int y) { return double(heights.at(x, y)); }, inside) < 1e-4);
    }

} // TEST_SUITE
