// Rounded edges from the low-poly mesh alone, against the rounded box and other shapes given by formulas.
#include "bake/mesh/weld.h"
#include "bake/relief/transfer/bevel.h"
#include "bake/relief/transfer/seams.h"
#include "relief/transfer/closed_forms.h"
#include "relief/transfer/transfer_meshes.h"

using namespace bake;
using namespace bake::test;

namespace {

struct Beveled {
    Beveled(Mesh low, BevelOptions with, double radius, int width, int height)
        : mesh(std::move(low)), options(with), target(make_bake_target(mesh, "low", width, height)) {
        options.radius = radius, options.width = width, options.height = height;
        result = bevel(target, options);
    }
    Vec3d point(const TexelHit& at) const {
        const auto& corner = target.surface.triangles[at.triangle].corner;
        const auto p = [&](std::size_t k) { return Vec3d(mesh.positions[mesh.corner_position[corner[k]]]); };
        return (1.0 - double(at.b1) - double(at.b2)) * p(0) + double(at.b1) * p(1) + double(at.b2) * p(2);
    }
    /// Angles to `exact(point)` of the texels whose centre lies in a chart.
    template <class Exact> oracle::Spread error(const Exact& exact) const {
        std::vector<double> angles;
        for (int y = 0; y < options.height; ++y)
            for (int x = 0; x < options.width; ++x) {
                const TexelHit& at = target.raster.hits.at(x, y);
                if (at.triangle == no_index || is_border(at)) continue;
                const float* rgb = &result.map.at(x, y);
                const Vec3d map = 2.0 * Vec3d(rgb[0], rgb[1], rgb[2]) - 1.0;
                const Vec3d ours = options.space == Space::object ? map : in_object_space(at, map);
                angles.push_back(oracle::angle_deg(ours, exact(point(at))));
            }
        return oracle::spread(angles);
    }

    Mesh mesh;
    BevelOptions options;
    BakeTarget target;
    Bevel result;

private:
    static bool is_border(const TexelHit& at) { return std::min({at.b1, at.b2, 1 - at.b1 - at.b2}) <= 1e-6f; }
    Vec3d in_object_space(const TexelHit& at, const Vec3d& t) const {
        const auto& corner = target.surface.triangles[at.triangle].corner;
        const double b[3] = {1.0 - double(at.b1) - double(at.b2), double(at.b1), double(at.b2)};
        Vec3d T(0), N(0);
        for (std::size_t k = 0; k < 3; ++k)
            T += b[k] * Vec3d(Vec3f(target.tangents[corner[k]])), N += b[k] * Vec3d(target.surface.n[corner[k]]);
        return t.x * T + t.y * double(target.tangents[corner[0]].w) * glm::cross(N, T) + t.z * N;
    }
};

/// The box with one normal and one position per corner of the box.
Mesh smooth_box() {
    Mesh box = sharp_box();
    box.normals.clear(), box.corner_normal.clear();
    weld_positions(box);
    return box;
}

/// |x| + |y| + |z| <= 1 with the normals of its facets.
Mesh sharp_octahedron() {
    Mesh mesh;
    for (int i = 0; i < 8; ++i) {
        const Vec3f s(i & 1 ? -1 : 1, i & 2 ? -1 : 1, i & 4 ? -1 : 1);
        const Vec3f corners[] = {{s.x, 0, 0}, {0, s.y, 0}, {0, 0, s.z}};
        const bool turned = s.x * s.y * s.z < 0;
        mesh.normals.push_back(glm::normalize(s));
        const Vec2f at(float(i % 4) / 4, float(i / 4) / 2); // NOLINT(bugprone-integer-division)
        const Vec2f uvs[] = {at + Vec2f(0.01f, 0.02f), at + Vec2f(0.24f, 0.02f), at + Vec2f(0.12f, 0.46f)};
        for (const int k : {0, turned ? 2 : 1, turned ? 1 : 2}) {
            mesh.corner_position.push_back(std::uint32_t(mesh.positions.size()));
            mesh.corner_uv.push_back(std::uint32_t(mesh.uvs.size()));
            mesh.corner_normal.push_back(std::uint32_t(i));
            mesh.positions.push_back(corners[k]), mesh.uvs.push_back(uvs[k]);
        }
        mesh.face_begin.push_back(std::uint32_t(mesh.corners()));
    }
    return mesh;
}

/// Of radius 1 and height 2 with two caps; the sides have smooth normals. The uvs of the caps are the lower half.
Mesh cylinder(int sides) {
    Mesh mesh;
    const auto around = [&](double s) {
        const double turn = 2 * pi * (s < 1 ? s : 0);
        return Vec3d(std::cos(turn), std::sin(turn), 0);
    };
    add_patch(mesh, sides, 1, [&](double s, double t) {
        return PatchPoint{around(s) + Vec3d(0, 0, 2 * t - 1), around(s), {0.01 + 0.98 * s, 0.52 + 0.46 * t}};
    });
    for (const double up : {1.0, -1.0}) {
        for (int i = 0; i < sides; ++i) {
            const Vec3d p = around(up * i / sides + (up < 0 ? 1 : 0)) + Vec3d(0, 0, up);
            for (auto* corners : {&mesh.corner_position, &mesh.corner_uv, &mesh.corner_normal})
                corners->push_back(std::uint32_t(mesh.positions.size()));
            mesh.positions.emplace_back(p), mesh.normals.emplace_back(0, 0, up);
            mesh.uvs.emplace_back((up > 0 ? 0.25 : 0.75) + 0.23 * p.x * up, 0.25 + 0.23 * p.y);
        }
        mesh.face_begin.push_back(std::uint32_t(mesh.corners()));
    }
    return mesh;
}

/// The prism over an outline, 1 high, each of its faces with a chart of its own.
Mesh prism(const std::vector<Vec2d>& outline) {
    const auto corners = std::uint32_t(outline.size());
    std::vector<std::vector<std::uint32_t>> faces(2);
    for (std::uint32_t i = 0; i < corners; ++i) {
        const std::uint32_t next = (i + 1) % corners;
        faces[0].push_back(corners + i), faces[1].push_back(corners - 1 - i);
        faces.push_back({i, next, corners + next, corners + i});
    }
    Mesh mesh;
    for (const double z : {0.0, 1.0})
        for (const Vec2d& p : outline) mesh.positions.emplace_back(p.x, p.y, z);
    for (const auto& face : faces) {
        const auto at = [&](std::size_t k) { return Vec3d(mesh.positions[face[k % face.size()]]); };
        Vec3d n(0);
        for (std::size_t k = 0; k < face.size(); ++k) n += glm::cross(at(k), at(k + 1));
        n = glm::normalize(n);
        const Vec3d u = glm::normalize(at(1) - at(0)), v = glm::cross(n, u);
        Vec2d least(1e9);
        for (std::size_t k = 0; k < face.size(); ++k)
            least = glm::min(least, Vec2d(glm::dot(at(k), u), glm::dot(at(k), v)));
        const std::size_t cell = mesh.faces();
        for (std::size_t k = 0; k < face.size(); ++k) {
            mesh.corner_position.push_back(face[k]), mesh.corner_uv.push_back(std::uint32_t(mesh.uvs.size()));
            mesh.corner_normal.push_back(std::uint32_t(mesh.normals.size()));
            const Vec2d in_cell = Vec2d(glm::dot(at(k), u), glm::dot(at(k), v)) - least;
            mesh.uvs.emplace_back((Vec2d(double(cell % 3), double(cell / 3)) + 0.05 + 0.45 * in_cell) / 3.0);
        }
        mesh.normals.emplace_back(n);
        mesh.face_begin.push_back(std::uint32_t(mesh.corners()));
    }
    return mesh;
}

constexpr double radius = 0.2;
const auto rounded = [](const Vec3d& p) { return oracle::RoundedBox{Vec3d(1), radius}.nearest(p).n; };

} // namespace

TEST_SUITE("oracle") {

    TEST_CASE("bevel: a box has the normals of the rounded box, in both spaces, shaded flat or smooth") {
        for (const Space space : {Space::tangent, Space::object})
            for (const bool smooth : {false, true}) {
                CAPTURE(smooth);
                const Beveled box(smooth ? smooth_box() : sharp_box(), {.space = space}, radius, 192, 128);
                const oracle::Spread error = box.error(rounded);
                CHECK(error.mean < 1e-4);
                CHECK(error.max < 1e-3);
                CHECK(box.result.report.convex == 12);
                CHECK(box.result.report.concave == 0);
                CHECK(box.result.report.narrow == 0);
            }
    }

    TEST_CASE("bevel: a room, the box turned over, has concave edges with the same normals, inward") {
        const Beveled room(turned_over(sharp_box()), {.space = Space::object}, radius, 192, 128);
        CHECK(room.result.report.concave == 12);
        CHECK(room.result.report.convex == 0);
        CHECK(room.error([](const Vec3d& p) { return -rounded(p); }).max < 1e-3);
    }

    TEST_CASE("bevel: an octahedron, where four facets meet, has the normals of balls around the smaller octahedron") {
        // The nearest point of |x| + |y| + |z| <= s is p with all coordinates moved towards 0 by the same amount, none across it
        // (Duchi et al., Efficient Projections onto the l1-Ball, 2008).
        const auto exact = [](const Vec3d& p) {
            const double s = 1 - std::sqrt(3.0) * 0.1;
            double low = 0, high = 1;
            const auto moved = [&](double by) { return glm::max(glm::abs(p) - by, 0.0); };
            for (int i = 0; i < 60; ++i) {
                const double by = 0.5 * (low + high);
                const Vec3d q = moved(by);
                (q.x + q.y + q.z > s ? low : high) = by;
            }
            return glm::normalize(p - glm::sign(p) * moved(low));
        };
        const Beveled octahedron(sharp_octahedron(), {.space = Space::object}, 0.1, 128, 64);
        CHECK(octahedron.result.report.convex == 12);
        const oracle::Spread error = octahedron.error(exact);
        CHECK(error.mean < 1e-3);
        CHECK(error.max < 0.02);
    }

    TEST_CASE("bevel: on a plate that is thinner than the ball, the largest ball that fits rolls, and its texels are "
              "counted") {
        Mesh plate = sharp_box();
        for (Vec3f& p : plate.positions) p.z *= 0.1f;
        const Beveled thin(plate, {.space = Space::object}, radius, 192, 128);
        CHECK(thin.result.report.narrow > 1000);
        const oracle::RoundedBox largest{Vec3d(1, 1, 0.1), 0.1};
        CHECK(thin.error([&](const Vec3d& p) { return largest.nearest(p).n; }).max < 0.5);
        // Whatever the radius.
        const Beveled huge(plate, {.space = Space::object}, 1e6, 96, 64);
        CHECK(huge.error([&](const Vec3d& p) { return largest.nearest(p).n; }).max < 0.5);
    }

    TEST_CASE("bevel: both sides of an edge agree, of a box, of a bracket and of the rim of a smooth cylinder") {
        const auto seams = [](const Beveled& b) {
            return seam_disagreement(b.target, b.result.map, Space::tangent, false);
        };
        const SeamDisagreement box = seams(Beveled(sharp_box(), {}, radius, 360, 240));
        CHECK(box.seams == 12);
        CHECK(box.mean < 0.05);
        CHECK(box.max < 1);
        // A bracket, whose concave edge ends in convex ones.
        const Beveled bracket(prism({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}), {}, radius, 512, 512);
        CHECK(bracket.result.report.convex == 17);
        CHECK(bracket.result.report.concave == 1);
        CHECK(seams(bracket).mean < 0.15);
        CHECK(seams(bracket).percentile_95 < 0.2);
        // Its sides have smooth normals and flat facets, which differ by half the angle between the facets.
        const SeamDisagreement coarse = seams(Beveled(cylinder(12), {}, radius, 512, 512)),
                               fine = seams(Beveled(cylinder(48), {}, radius, 512, 512));
        CHECK(coarse.max < 7.5);
        CHECK(fine.percentile_95 < 0.25 * coarse.percentile_95);
    }

} // TEST_SUITE

TEST_SUITE("unit") {

    TEST_CASE("bevel: a smooth mesh stays flat, and so does the middle of a box") {
        const Beveled sphere(lat_long_sphere(24, 12), {}, 0.3, 96, 48);
        CHECK(sphere.result.report.convex + sphere.result.report.concave == 0);
        CHECK(sphere.result.report.tilted == 0);
        for (int y = 0; y < 48; ++y)
            for (int x = 0; x < 96; ++x)
                for (int c = 0; c < 3; ++c)
                    CHECK(std::abs(sphere.result.map.at(x, y, c) - (c == 2 ? 1.0f : 0.5f)) < 1e-5f);
        const Beveled box(sharp_box(), {}, radius, 96, 64);
        CHECK(box.result.map.at(16, 16, 0) == 0.5f);
        // Of each side of length 2 the bevels take (1.6 / 2)^2 away.
        CHECK(double(box.result.report.tilted) / double(box.result.report.texels.hit) ==
              doctest::Approx(1 - 0.64).epsilon(0.1));
    }

    TEST_CASE("bevel: green points down on request, and nothing is padded without padding") {
        const Beveled up(sharp_box(), {}, radius, 360, 240), down(sharp_box(), {.directx = true}, radius, 360, 240),
            bare(sharp_box(), {.padding = 0}, radius, 360, 240);
        double most = 0;
        for (int y = 5; y < 110; ++y) {
            most = std::max(most, std::abs(double(up.result.map.at(60, y, 1)) - 0.5));
            CHECK(std::abs(up.result.map.at(60, y, 1) + down.result.map.at(60, y, 1) - 1) < 1e-5f);
        }
        CHECK(most > 0.25);
        CHECK(bare.result.report.texels.padded == 0);
        CHECK(up.result.report.texels.padded > 0);
    }

} // TEST_SUITE
