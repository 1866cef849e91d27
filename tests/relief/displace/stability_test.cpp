// Where displacement could break: one case each.
#include "bake/base/error.h"
#include "bake/relief/displace/error.h"
#include "oracle/surfaces.h"
#include "relief/displace/displace_meshes.h"

using namespace bake;
using namespace bake::test;

namespace {

Mesh quad(const std::vector<Vec2f>& uvs) {
    return polygons({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 3}}, uvs);
}
const std::vector<Vec2f> unit_square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};

Relief constant(double b) {
    return relief(picture(1, 1, [](double, double) { return 1.0; }), b, 0);
}

/// Corner normals and face windings agree.
std::size_t opposed(const Mesh& mesh) { return check(mesh).opposed_normals; }

} // namespace

TEST_SUITE("stability") {

    TEST_CASE("displace, pole: one point, triangles around it, a normal from them, and no face without area") {
        const BaseSurface base(ParametricSurface("sphere:R=1"), 12, 6);
        const Displaced out = displace(base, constant(0.25), levels(2));
        check_sound(out.mesh);
        const MeshCheck found = check(out.mesh);
        CHECK(found.topology.boundary_edges == 0);
        CHECK(found.topology.closed_components == 1);
        CHECK(found.repeated_corners == 0);
        CHECK(found.zero_area_faces == 0);
        CHECK(found.faces_of_size[3] == 2 * 48);
        CHECK(out.report.no_tangents == 2);
        for (std::size_t c = 0; c < out.mesh.corners(); ++c) {
            const Vec3d p(out.mesh.positions[out.mesh.corner_position[c]]);
            CHECK(std::abs(glm::length(p) - 1.25) < 1e-6);
            CHECK(oracle::angle_deg(p, Vec3d(out.mesh.normals[out.mesh.corner_normal[c]])) < 0.01);
        }
    }

    TEST_CASE("displace, pole: heights that differ around it meet in their mean, and the report says by how much") {
        const BaseSurface base(ParametricSurface("sphere:R=1"), 12, 6);
        const Relief ramp =
            relief(picture(64, 64, [](double u, double) { return 0.5 + 0.5 * std::sin(2 * pi * u); }), 0.2, 0.5);
        for (const Seam seam : {Seam::average, Seam::blend}) {
            DisplaceOptions options = levels(3);
            options.seam = seam;
            const Displaced out = displace(base, ramp, options);
            check_sound(out.mesh);
            CHECK(check(out.mesh).topology.boundary_edges == 0);
            CHECK(out.report.seam_mismatch == doctest::Approx(0.1).epsilon(0.05));
            CHECK(std::abs(std::abs(out.report.seam_worst.y) - 1) < 1e-9);
            double pole = 0;
            for (const Vec3f& p : out.mesh.positions)
                if (std::abs(p.x) + std::abs(p.z) < 1e-6f) pole = std::max(pole, double(p.y));
            CHECK(pole == doctest::Approx(1).epsilon(1e-6)); // the mean of a sine
        }
    }

    TEST_CASE(
        "displace, extraordinary vertex: the limit surface of a cube is displaced without cracks and turned faces") {
        const BaseSurface base(cube(), SubdivisionOptions{});
        const Displaced out = displace(base, constant(0.1), levels(4));
        check_sound(out.mesh);
        CHECK(check(out.mesh).topology.closed_components == 1);
        CHECK(opposed(out.mesh) == 0);
        CHECK(out.report.no_normal == 0);
    }

    TEST_CASE("displace, extraordinary vertex: no curvature without limit reaches its normal, nor the fold count") {
        // Curvature grows without bound towards the corners of a cube's limit: either sign of b would turn one inside out.
        const BaseSurface base(cube(), SubdivisionOptions{});
        for (const double b : {-0.02, 0.02}) {
            const Displaced out = displace(base, constant(b), levels(5));
            CHECK(out.report.folded == 0);
            CHECK(out.report.fold_margin > 0.5);
            double worst = 0;
            for (std::size_t c = 0; c < out.mesh.corners(); c += 4) {
                const auto at = [&](std::size_t k) {
                    return Vec3d(out.mesh.positions[out.mesh.corner_position[c + k]]);
                };
                const Vec3d facet = glm::cross(at(2) - at(0), at(3) - at(1));
                for (std::size_t k = 0; k < 4; ++k)
                    worst = std::max(worst,
                                     oracle::angle_deg(facet, Vec3d(out.mesh.normals[out.mesh.corner_normal[c + k]])));
            }
            CHECK(worst < 5); // a face of 1/32 of the cube's turns by about 3
        }
    }

    TEST_CASE("displace, boundary: that of an open cage stays one loop with its points displaced") {
        Mesh cage = quad(unit_square);
        cage.tags.boundary = SubdivisionTags::Boundary::edge_only;
        const BaseSurface base(std::move(cage), SubdivisionOptions{});
        const Displaced out = displace(base, constant(0.5), levels(3));
        check_sound(out.mesh);
        CHECK(check(out.mesh).topology.boundary_edges == 32);
        CHECK(check(out.mesh).topology.boundary_loops == 1);
        CHECK(bounds(out.mesh).min.z == doctest::Approx(0.5));
        CHECK(bounds(out.mesh).max.z == doctest::Approx(0.5));
        // A round border, a cubic B-spline: at a control point 2/3 of it and 1/6 of each neighbour, midway 23/48 of two and 1/48.
        CHECK(bounds(out.mesh).min.x == doctest::Approx(1.0 / 24));
        CHECK(glm::length(out.mesh.positions[0] - Vec3f(1.0f / 6, 1.0f / 6, 0.5f)) < 1e-6f);
    }

    TEST_CASE("displace, corner: on the border and inside it stays where the cage has it, one point") {
        Mesh open = quad(unit_square);
        open.tags.boundary = SubdivisionTags::Boundary::edge_and_corner;
        const Displaced sheet = displace(BaseSurface(std::move(open), SubdivisionOptions{}), constant(0.5), levels(3));
        check_sound(sheet.mesh);
        CHECK(sheet.mesh.positions[0] == Vec3f(0, 0, 0.5f));
        Mesh cage = cube();
        cage.tags.corners = {{6, 10}};
        const BaseSurface base(std::move(cage), SubdivisionOptions{});
        const auto nearest = [](const Mesh& mesh) {
            double least = HUGE_VAL;
            for (const Vec3f& p : mesh.positions) least = std::min(least, double(glm::length(p - cube_corners[6])));
            return least;
        };
        CHECK(nearest(displace(base, constant(0), levels(3)).mesh) < 1e-6);
        const Displaced out = displace(base, constant(0.1), levels(3));
        check_sound(out.mesh);
        CHECK(check(out.mesh).topology.closed_components == 1);
        CHECK(check(out.mesh).coincident_positions == 0);
        // The surface comes to a spike there: normals look all ways round, and the point stays.
        CHECK(nearest(out.mesh) < 1e-6);
        CHECK(out.report.no_normal == 1);
    }

    TEST_CASE("displace, pole and zero-area face: what has no area still has a distance") {
        const Vec3d a(0), b(1, 0, 0), c(2, 0, 0), p(1.5, 3, 0);
        for (const auto& [x, y, z] : {std::array{a, b, c}, std::array{a, c, b}, std::array{b, c, a},
                                      std::array{a, a, c}, std::array{a, c, c}, std::array{a, c, a}})
            CHECK(distance_to_triangle(p, x, y, z) == doctest::Approx(3));
        CHECK(distance_to_triangle(p, b, b, b) == doctest::Approx(std::sqrt(9.25)));
        DisplaceOptions options = levels(3);
        options.measure_error = true;
        const Displaced out = displace(BaseSurface(ParametricSurface("sphere:R=1"), 8, 8), constant(0.1), options);
        CHECK(out.report.error_rms > 0);
        CHECK(out.report.error_rms < out.report.error_max);
    }

    TEST_CASE("displace, crease: tangent frames that differ across it are no uv seam") {
        const Mesh roof =
            polygons({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 0, -1}, {1, 1, -1}}, {{0, 1, 2, 3}, {1, 4, 5, 2}},
                     {{0, 0}, {0.5, 0}, {0.5, 1}, {0, 1}, {0.5, 0}, {1, 0}, {1, 1}, {0.5, 1}},
                     {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {1, 0, 0}, {1, 0, 0}, {1, 0, 0}, {1, 0, 0}});
        Relief r;
        r.values = Image<float>(4, 4, 3);
        for (int y = 0; y < 4; ++y)
            for (int x = 0; x < 4; ++x) r.values.at(x, y, 2) = 1;
        r.height = {.amplitude = 0.1, .midlevel = 0};
        r.vector = VectorSpace::tangent;
        for (const Seam seam : {Seam::average, Seam::owner, Seam::blend}) {
            const Displaced out = displace(BaseSurface(Mesh(roof)), r, levels(2, seam));
            CHECK(out.report.seam_points == 0);
            CHECK(out.report.seam_mismatch == 0);
        }
    }

    TEST_CASE("displace, crease: one point along the mean direction, two normals") {
        Mesh cage = cube();
        for (const auto& face : cube_faces)
            for (int k = 0; k < 4; ++k) cage.tags.creases.push_back({face[k], face[(k + 1) % 4], 10.0f});
        const BaseSurface base(std::move(cage), SubdivisionOptions{});
        const Displaced out = displace(base, constant(0.1), levels(3));
        check_sound(out.mesh);
        CHECK(check(out.mesh).topology.closed_components == 1);
        CHECK(out.mesh.normals.size() > out.mesh.positions.size());
        // On the middle of an edge the direction is the diagonal of the two faces'.
        bool found = false;
        for (const Vec3f& p : out.mesh.positions)
            found |= glm::length(Vec3d(p) - Vec3d(1 + 0.1 / std::sqrt(2.0), 1 + 0.1 / std::sqrt(2.0), 0)) < 1e-5;
        CHECK(found);
    }

    TEST_CASE("displace, semi-sharp crease: smooth in the limit, so one normal") {
        Mesh cage = cube();
        for (const auto& face : cube_faces)
            for (int k = 0; k < 4; ++k) cage.tags.creases.push_back({face[k], face[(k + 1) % 4], 1.5f});
        const BaseSurface base(std::move(cage), SubdivisionOptions{});
        const Displaced out = displace(base, constant(0.1), levels(3));
        check_sound(out.mesh);
        CHECK(check(out.mesh).topology.closed_components == 1);
        CHECK(out.mesh.normals.size() == out.mesh.positions.size());
        CHECK(opposed(out.mesh) == 0);
    }

    TEST_CASE("displace, zero-area face: displaced with its neighbours, no NaN") {
        // A sliver between two quads: its corners are on one line.
        const BaseSurface base(
            polygons({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5f, 0, 0}, {1, -1, 0}, {0, -1, 0}},
                     {{0, 4, 1}, {0, 1, 2, 3}, {6, 5, 1, 4}, {6, 4, 0}},
                     {{0, 0},
                      {0.5f, 0},
                      {1, 0},
                      {0, 0},
                      {1, 0},
                      {1, 1},
                      {0, 1},
                      {0, -1},
                      {1, -1},
                      {1, 0},
                      {0.5f, 0},
                      {0, -1},
                      {0.5f, 0},
                      {0, 0}}));
        const Displaced out = displace(base, relief(noise(16), 0.1), levels(3));
        check_sound(out.mesh);
        CHECK(check(out.mesh).topology.boundary_edges == 6 * 8);
    }

    TEST_CASE("displace, zero-area uv: one height for all of the face, moved by it, with the face's normal") {
        const BaseSurface base(quad({{0.25f, 0.25f}, {0.25f, 0.25f}, {0.25f, 0.25f}, {0.25f, 0.25f}}));
        const Displaced out = displace(
            base, relief(picture(2, 2, [](double u, double v) { return u < 0.5 && v < 0.5 ? 1.0 : 0.0; }), 1, 0),
            levels(2));
        check_sound(out.mesh);
        CHECK(bounds(out.mesh).min.z == doctest::Approx(bounds(out.mesh).max.z));
        for (const Vec3f& n : out.mesh.normals) CHECK(n.z == doctest::Approx(1));
    }

    TEST_CASE("displace, mirrored uv: relief still rises outward, and the normals are the faces'") {
        const Relief ramp = relief(picture(64, 64, [](double u, double) { return u; }), 0.5, 0, Wrap::clamp);
        const Displaced out = displace(BaseSurface(quad({{1, 0}, {0, 0}, {0, 1}, {1, 1}})), ramp, levels(3));
        check_sound(out.mesh);
        CHECK(bounds(out.mesh).min.z >= -1e-6f);
        // Highest at x = 0, where u is 1: the slope is -0.5 along x.
        for (const Vec3f& n : out.mesh.normals) CHECK(n.x / n.z == doctest::Approx(0.5).epsilon(1e-3));
    }

    TEST_CASE("displace, udim gap: uvs beyond the unit square follow the wrap") {
        const std::vector<Vec2f> beyond = {{3, 2}, {4, 2}, {4, 3}, {3, 3}};
        const Image<float> values = noise(16);
        const auto run = [&](const std::vector<Vec2f>& uvs, Wrap wrap) {
            return displace(BaseSurface(quad(uvs)), relief(noise(16), 0.1, 0.5, wrap), levels(3)).mesh.positions;
        };
        const auto repeat = run(beyond, Wrap::repeat), here = run(unit_square, Wrap::repeat);
        double worst = 0;
        for (std::size_t i = 0; i < here.size(); ++i) worst = std::max(worst, double(glm::length(repeat[i] - here[i])));
        CHECK(worst < 1e-6);
        const auto clamped = run(beyond, Wrap::clamp);
        for (const Vec3f& p : clamped) CHECK(p.z == doctest::Approx(double(clamped[0].z))); // the corner texel
    }

    TEST_CASE("displace, beyond the focal radius: folded points are counted on both sides, with the worst place") {
        // A torus folds at b = -r, and at b = R - r where v = pi (the inner side).
        const BaseSurface base(ParametricSurface("torus:R=1,r=0.4"), 24, 12);
        const auto run = [&](double b) { return displace(base, constant(b), levels(2)).report; };
        CHECK(run(-0.39).folded == 0);
        CHECK(run(-0.39).fold_margin == doctest::Approx(1 - 0.39 / 0.4));
        CHECK(run(-0.41).folded == 96 * 48);
        CHECK(run(0.59).folded == 0);
        const DisplaceReport inner = run(0.65);
        CHECK(inner.folded > 0);
        CHECK(inner.folded < 96 * 48 / 4);
        CHECK(glm::length(Vec2d(inner.fold_worst.x, inner.fold_worst.z)) ==
              doctest::Approx(0.6)); // R - r from the axis
        CHECK(inner.fold_margin == doctest::Approx(1 - 0.65 / 0.6));
        // A sphere at -1.5 R is inside out with a determinant of +0.25.
        const DisplaceReport everted =
            displace(BaseSurface(ParametricSurface("sphere:R=1"), 12, 6), constant(-1.5), levels(2)).report;
        CHECK(everted.fold_margin == doctest::Approx(-0.5));
        CHECK(everted.folded >= 47u * 23u);
    }

    TEST_CASE("displace, margin: every point has its own when asked for") {
        DisplaceOptions options = levels(2);
        CHECK(displace(BaseSurface(cube()), constant(0.1), options).margin.empty());
        options.margin = true;
        const Displaced out =
            displace(BaseSurface(ParametricSurface("torus:R=1,r=0.4"), 24, 12), constant(0.65), options);
        REQUIRE(out.margin.size() == out.mesh.positions.size());
        CHECK(double(*std::min_element(out.margin.begin(), out.margin.end())) ==
              doctest::Approx(out.report.fold_margin));
        CHECK(std::size_t(std::count_if(out.margin.begin(), out.margin.end(), [](float m) { return m <= 0; })) ==
              out.report.folded);
    }

    TEST_CASE("displace, amplitude 1e6: finite, folded and said so; 1e60 is refused") {
        const BaseSurface base(oracle::torus_mesh(12, 8, true));
        const Displaced out = displace(base, relief(noise(16), 1e6), levels(2));
        check_sound(out.mesh);
        CHECK(out.report.folded > 0);
        CHECK(diagonal(bounds(out.mesh)) > 1e5);
        try {
            displace(base, relief(noise(16), 1e60), levels(2));
            FAIL("not refused");
        } catch (const Error& error) {
            CHECK(error.refusal == Refusal::unsuitable);
            CHECK(std::string(error.what()).find("smaller `amplitude`") != std::string::npos);
        }
    }

    TEST_CASE("displace, one texel: the whole surface is moved by one height") {
        for (const Wrap wrap : {Wrap::repeat, Wrap::clamp, Wrap::mirror})
            for (const Interpolation interpolation :
                 {Interpolation::bilinear, Interpolation::catmull_rom, Interpolation::c2}) {
                Relief one = relief(picture(1, 1, [](double, double) { return 1.0; }), 0.25, 0, wrap);
                one.interpolation = interpolation;
                const Displaced out = displace(BaseSurface(quad(unit_square)), one, levels(2));
                check_sound(out.mesh);
                for (const Vec3f& p : out.mesh.positions) CHECK(p.z == doctest::Approx(0.25));
            }
    }

    TEST_CASE("displace, memory limit: refused with what it needs and the finest level that fits") {
        const BaseSurface base(cube());
        const Relief height = relief(noise(16), 0.1);
        DisplaceOptions options = levels(9);
        const std::uint64_t fits_level_5 = displace(base, height, levels(5)).report.count.bytes;
        options.max_bytes = fits_level_5 + 1;
        try {
            displace(base, height, options);
            FAIL("not refused");
        } catch (const Error& error) {
            CHECK(error.refusal == Refusal::unsuitable);
            const std::string what = error.what();
            CHECK(what.find("`rates.levels` to 5") != std::string::npos);
            CHECK(what.find("1572864 faces") != std::string::npos);
            CHECK(what.find('\n') == std::string::npos);
        }
        options.rates.levels = 5;
        CHECK(displace(base, height, options).mesh.faces() == 6 << 10);
        // More corners than indices hold, whatever the memory.
        options = levels(14);
        options.max_bytes = std::uint64_t(1) << 60;
        CHECK_THROWS_AS(displace(base, height, options), Error);
    }

    TEST_CASE("displace, no surface: a mesh whose every face has no area is left where it is, without NaN") {
        const Displaced out =
            displace(BaseSurface(polygons({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}, {{0, 0}, {1, 0}, {0, 1}})),
                     constant(1), levels(2));
        check_sound(out.mesh);
        CHECK(out.report.no_normal == out.mesh.positions.size());
        CHECK(bounds(out.mesh).max.y == 0);
    }

} // TEST_SUITE
