// What becomes of heights that differ across a UV seam.
#include "bake/mesh/file/mesh_io.h"
#include "bake/relief/displace/seam_blend.h"
#include "folders.h"
#include "relief/displace/displace_meshes.h"

using namespace bake;
using namespace bake::test;

namespace {

/// The ramp of peers/seam.py: value u, clamped, lowest at u = 0.
Relief ramp() {
    return relief(picture(256, 256, [](double u, double) { return u; }), 0.3, 0, Wrap::clamp);
}

std::size_t long_edges(const Mesh& mesh) {
    const std::vector<double> lengths = edge_lengths(mesh);
    const double limit = 5 * lengths[lengths.size() / 2];
    return std::size_t(lengths.end() - std::upper_bound(lengths.begin(), lengths.end(), limit));
}

/// In medians.
double longest(const Mesh& mesh) {
    const std::vector<double> lengths = edge_lengths(mesh);
    return lengths.back() / lengths[lengths.size() / 2];
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("displace: with blend no edge at a seam is longer than five times the median, where Blender leaves 863") {
        const BaseSurface base(cube());
        const auto result = [&](Seam seam) { return displace(base, ramp(), levels(6, seam)); };
        const Displaced blend = result(Seam::blend), average = result(Seam::average), owner = result(Seam::owner);
        CHECK(check(blend.mesh).topology.boundary_edges == 0);
        CHECK(blend.report.seam_mismatch == doctest::Approx(0.3).epsilon(1e-4));
        CHECK(long_edges(blend.mesh) == 0);
        // The ramp's whole height lies across a seam: half of it with average, all with owner, nothing with blend.
        CHECK(longest(blend.mesh) < 2);
        CHECK(longest(average.mesh) > 3);
        CHECK(longest(average.mesh) < 5);
        CHECK(longest(owner.mesh) > 8);
        CHECK(long_edges(owner.mesh) > 300);
    }

    TEST_CASE("displace: with blend creases do not tear either, and other policies step there as Blender does") {
        const BaseSurface base(cube(true));
        const auto result = [&](Seam seam) { return displace(base, ramp(), levels(6, seam)); };
        const Displaced blend = result(Seam::blend);
        CHECK(check(blend.mesh).topology.boundary_edges == 0);
        CHECK(blend.report.seam_mismatch == doctest::Approx(0.3).epsilon(1e-4)); // of heights, whatever the directions
        CHECK(long_edges(blend.mesh) == 0);
        CHECK(longest(blend.mesh) < 2);
        CHECK(long_edges(result(Seam::average).mesh) > 300);
    }

    TEST_CASE("displace: with blend a constant height makes a larger cube of a cube, flat and square, and a cut mitre "
              "of a fin") {
        const Relief half = relief(picture(1, 1, [](double, double) { return 1.0; }), 0.5, 0);
        const Displaced larger = displace(BaseSurface(cube(true)), half, levels(3, Seam::blend));
        double off = 0;
        for (const Vec3f& p : larger.mesh.positions)
            off = std::max(off, std::abs(double(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)})) - 1.5));
        CHECK(off < 1e-6);
        CHECK(glm::length(larger.mesh.positions[0]) == doctest::Approx(1.5 * std::sqrt(3.0)));
        double turned = 0;
        for (const Vec3f& n : larger.mesh.normals)
            turned = std::max(turned, 1 - double(std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)})));
        CHECK(turned < 1e-6);
        // Two faces 5 degrees apart: their planes would meet 11 heights away.
        const float slope = std::tan(float(2.5 * pi / 180));
        const std::vector<Vec3f> points = {{0, -1, 0},      {0, 1, 0},       {-1, 1, slope},
                                           {-1, -1, slope}, {-1, 1, -slope}, {-1, -1, -slope}};
        const Vec3f up = glm::normalize(Vec3f(slope, 0, 1)), down = glm::normalize(Vec3f(slope, 0, -1));
        const Mesh fin = polygons(points, {{0, 1, 2, 3}, {1, 0, 5, 4}}, std::vector<Vec2f>(8, Vec2f(0.5f)),
                                  {up, up, up, up, down, down, down, down});
        const Displaced cut = displace(BaseSurface(Mesh(fin)), half, levels(3, Seam::blend));
        double farthest = 0;
        for (const Vec3f& p : cut.mesh.positions) farthest = std::max(farthest, double(p.x));
        CHECK(farthest == doctest::Approx(1).epsilon(1e-5)); // twice the height
    }

    TEST_CASE("displace: with blend the faces beside a seam stay flat where another edge of theirs is hard, in any "
              "position") {
        // Two triangles in a plane with a seam between them; a third stands on them, behind a hard edge.
        const std::vector<Vec3f> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.5, 0, -1}};
        const std::vector<Vec2f> uvs = {{0, 0},       {0.3f, 0}, {0, 0.3f}, {0.9f, 0.5f}, {0.9f, 0.9f},
                                        {0.5f, 0.9f}, {0.3f, 0}, {0, 0},    {0.2f, 0.3f}};
        const Relief half = relief(picture(1, 1, [](double, double) { return 1.0; }), 0.5, 0);
        for (int turn = 0; turn < 12; ++turn) {
            CAPTURE(turn);
            const double a = 0.5 * turn, b = 0.3 * turn;
            const auto turned = [&](const Vec3f& p) {
                const Vec3d q(p.x, std::cos(b) * p.y - std::sin(b) * p.z, std::sin(b) * p.y + std::cos(b) * p.z);
                return Vec3f(Vec3d(std::cos(a) * q.x - std::sin(a) * q.y, std::sin(a) * q.x + std::cos(a) * q.y, q.z));
            };
            std::vector<Vec3f> there;
            for (const Vec3f& p : points) there.push_back(turned(p));
            const Vec3f up = turned({0, 0, 1}), front = turned({0, -1, 0});
            const Mesh mesh =
                polygons(there, {{0, 1, 2}, {1, 3, 2}, {1, 0, 4}}, uvs, {up, up, up, up, up, up, front, front, front});
            const Displaced out = displace(BaseSurface(Mesh(mesh)), half, levels(3, Seam::blend));
            double off = 0; // of the faces in the plane
            for (std::size_t f = 0; f < out.mesh.faces(); ++f)
                for (std::uint32_t c = out.mesh.face_begin[f]; c < out.mesh.face_begin[f + 1]; ++c)
                    if (out.mesh.face_begin[f] < 2 * out.mesh.corners() / 3)
                        off = std::max(
                            off, std::abs(double(glm::dot(out.mesh.positions[out.mesh.corner_position[c]], up)) - 0.5));
            CHECK(off < 1e-6);
            CHECK(out.report.height_min == doctest::Approx(0.5));
            CHECK(out.report.height_max == doctest::Approx(0.5));
        }
    }

    TEST_CASE("displace: with blend no point moves by more than twice the height, even where normals turn far along a "
              "side between two mitres") {
        // The normals of the first triangle are nearly opposite at the ends of its first side; each end is a mitre.
        const std::vector<Vec3f> points = {{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {-0.5, 0, 1}, {1.5, 0, 1}};
        const auto unit = [](float x, float y, float z) { return glm::normalize(Vec3f(x, y, z)); };
        const Vec3f left = unit(-1, 0, 0.3f), right = unit(1, 0, 0.3f), far_left = unit(1, 0, 0.3f),
                    far_right = unit(-1, 0, 0.3f), top = unit(0, 0, 1);
        const Mesh mesh = polygons(points, {{0, 1, 2}, {0, 2, 3}, {1, 4, 2}}, std::vector<Vec2f>(9, Vec2f(0.5f)),
                                   {left, right, top, far_left, top, far_left, far_right, far_right, top});
        const Relief waves = relief(picture(1, 1, [](double, double) { return 1.0; }), 0.5, 0);
        const Relief none = relief(picture(1, 1, [](double, double) { return 0.0; }), 0.5, 0);
        const Displaced out = displace(BaseSurface(Mesh(mesh)), waves, levels(4, Seam::blend)),
                        base = displace(BaseSurface(Mesh(mesh)), none, levels(4, Seam::blend));
        double moved = 0;
        for (std::size_t i = 0; i < out.mesh.positions.size(); ++i)
            moved = std::max(moved, double(glm::length(out.mesh.positions[i] - base.mesh.positions[i])));
        CHECK(moved < 1 + 1e-6);
        CHECK(moved > 0.99); // the ends' mitres are cut
    }

    TEST_CASE("displace: a texture that fits across its seams is not changed by any policy") {
        // A torus whose u = 0 and 1, v = 0 and 1 are seams in number only: repeats meet.
        const BaseSurface base(ParametricSurface("torus:R=1,r=0.4"), 8, 6);
        const Relief height = relief(noise(64), 0.02);
        const Displaced average = displace(base, height, levels(3, Seam::average));
        for (const Seam seam : {Seam::owner, Seam::blend}) {
            const Displaced other = displace(base, height, levels(3, seam));
            CHECK(other.report.seam_points > 0);
            CHECK(other.report.seam_mismatch < 1e-12);
            double moved = 0, turned = 0;
            for (std::size_t i = 0; i < other.mesh.positions.size(); ++i)
                moved = std::max(moved, double(glm::length(other.mesh.positions[i] - average.mesh.positions[i])));
            for (std::size_t i = 0; i < other.mesh.normals.size(); ++i)
                turned = std::max(turned, double(glm::length(other.mesh.normals[i] - average.mesh.normals[i])));
            CHECK(moved < 1e-6);
            CHECK(turned < 1e-5);
        }
    }

    TEST_CASE("displace: the blend's normals are those of the faces it makes, on meshes and limit surfaces") {
        const std::vector<Vec3f> points = {{-1, 0, 0}, {0, 0, 0}, {1, 0, 0}, {-1, 1, 0}, {0, 1, 0}, {1, 1, 0}};
        const Mesh quads = polygons(points, {{0, 1, 4, 3}, {1, 2, 5, 4}},
                                    {{0, 0}, {0.5, 0}, {0.5, 1}, {0, 1}, {0.3, 0}, {0.7, 0.1}, {0.6, 1.1}, {0.2, 1}});
        const Mesh triangles = polygons(points, {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}},
                                        {{0, 0},
                                         {0.5, 0},
                                         {0.5, 1},
                                         {0, 0},
                                         {0.5, 1},
                                         {0, 1},
                                         {0.3, 0},
                                         {0.7, 0.1},
                                         {0.6, 1.1},
                                         {0.3, 0},
                                         {0.6, 1.1},
                                         {0.2, 1}});
        const Relief waves = relief(
            picture(256, 256, [](double u, double v) { return std::sin(2 * pi * u) * std::cos(2 * pi * v); }), 0.1, 0);
        for (int which = 0; which < 4; ++which) {
            CAPTURE(which);
            const BaseSurface base = which == 0   ? BaseSurface(Mesh(quads))
                                     : which == 1 ? BaseSurface(Mesh(triangles))
                                     : which == 2 ? BaseSurface(cube(), SubdivisionOptions{})
                                                  : BaseSurface(cube(true));
            double before = 0;
            for (const int level : {4, 5, 6}) {
                const Displaced out = displace(base, waves, levels(level, Seam::blend));
                CHECK(out.report.seam_mismatch > 0.05);
                std::vector<Vec3d> sum(out.mesh.positions.size(), Vec3d(0));
                for (std::size_t f = 0; f < out.mesh.faces(); ++f) {
                    const std::uint32_t first = out.mesh.face_begin[f], n = out.mesh.face_begin[f + 1] - first;
                    for (std::uint32_t k = 0; k < n; ++k) {
                        const auto at = [&](std::uint32_t i) {
                            return Vec3d(out.mesh.positions[out.mesh.corner_position[first + i % n]]);
                        };
                        const Vec3d a = at(k + 1) - at(k), b = at(k + n - 1) - at(k);
                        sum[out.mesh.corner_position[first + k]] +=
                            glm::cross(a, b) / (glm::dot(a, a) * glm::dot(b, b));
                    }
                }
                // Points inside the patches are the last ones; at a seam the displaced surface has an edge.
                const std::size_t n = std::size_t(1) << level, inside = which == 0   ? 2 * (n - 1) * (n - 1)
                                                                        : which == 1 ? 2 * (n - 1) * (n - 2)
                                                                                     : 6 * (n - 1) * (n - 1);
                double worst = 0;
                // At the cube's corners, of three faces each, the limit's own curvature is not continuous.
                const auto near_corner = [&](std::size_t i) {
                    const Vec3f p = glm::abs(out.mesh.positions[i]);
                    return which == 2 && std::min({p.x, p.y, p.z}) > 0.25f;
                };
                for (std::size_t i = sum.size() - inside; i < sum.size(); ++i)
                    if (!near_corner(i)) worst = std::max(worst, oracle::angle_deg(sum[i], Vec3d(out.mesh.normals[i])));
                CAPTURE(level);
                // Second derivatives of a triangle's correction depend on the direction at the corner across from a seam.
                if (level > 4) CHECK(std::log2(before / worst) > (which == 1 ? 0.8 : 1.5));
                before = worst;
            }
        }
    }

    TEST_CASE("SeamBlend: with the correction both sides of a seam meet under noise, at its samples and between them") {
        const Mesh sheet =
            polygons({{-1, 0, 0}, {0, 0, 0}, {1, 0, 0}, {-1, 1, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 4, 3}, {1, 2, 5, 4}},
                     {{0, 0}, {0.5, 0}, {0.5, 1}, {0, 1}, {0.3, 0}, {0.7, 0.1}, {0.6, 1.1}, {0.2, 1}});
        const BaseSurface base(sheet);
        const Relief rough = relief(noise(32), 1);
        const SeamedRelief scene = seamed(base, rough, Seam::blend);
        double before = 0, after = 0;
        const int count = 1000;
        for (int i = 0; i <= count; ++i) {
            double own[2], blended[2];
            for (const std::uint32_t patch : {0u, 1u}) {
                const Vec2d st(patch == 0 ? 1 : 0, double(i) / count);
                SurfacePoint point;
                ReliefValue value;
                base.evaluate(patch, {&st, 1}, {&point, 1});
                scene.surface.values(patch, {&st, 1}, {&point, 1}, {&value, 1});
                own[patch] = value.at.x;
                scene.blend.add(patch, st, point, value);
                blended[patch] = value.at.x;
            }
            before = std::max(before, std::abs(own[0] - own[1]));
            after = std::max(after, std::abs(blended[0] - blended[1]));
        }
        CHECK(before > 0.5);
        CHECK(after < 0.05 * before);
    }

    TEST_CASE("displace: the report names the largest mismatch and where it lies") {
        // One side of the edge x = 0 sees the texture shifted by a quarter: its height differs most where the bump is.
        const Mesh sheet =
            polygons({{-1, 0, 0}, {0, 0, 0}, {1, 0, 0}, {-1, 1, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 4, 3}, {1, 2, 5, 4}},
                     {{0, 0}, {0.5, 0}, {0.5, 1}, {0, 1}, {0, 0}, {0.5, 0}, {0.5, 1}, {0, 1}});
        const Relief bump =
            relief(picture(128, 128,
                           [](double u, double v) {
                               return std::exp(-200 * ((u - 0.5) * (u - 0.5) + (v - 0.25) * (v - 0.25)));
                           }),
                   0.1, 0, Wrap::clamp);
        const Displaced out = displace(BaseSurface(Mesh(sheet)), bump, levels(6, Seam::average));
        CHECK(out.report.seam_points == 65);
        CHECK(out.report.seam_mismatch == doctest::Approx(0.1).epsilon(1e-3));
        CHECK(glm::length(out.report.seam_worst - Vec3d(0, 0.25, 0)) < 1e-6);
        // Half of it is there.
        double highest = 0;
        for (const Vec3f& p : out.mesh.positions)
            if (p.x == 0) highest = std::max(highest, double(p.z));
        CHECK(highest == doctest::Approx(0.05).epsilon(1e-3));
    }

} // TEST_SUITE

TEST_SUITE("real" * doctest::skip(test::no_shared_data())) {

    TEST_CASE("displace: on Spot under noise the default leaves no edge that is longer for lying on a seam") {
        const BaseSurface base(read_mesh((shared_data() / "meshes/spot/spot_quadrangulated.obj").string()));
        const double size = diagonal(bounds(base.mesh()));
        const Relief height = relief(noise(32), 0.02 * size);
        DisplaceOptions by_default;
        by_default.rates.levels = 3;
        const double blend = longest(displace(base, height, by_default).mesh),
                     average = longest(displace(base, height, levels(3, Seam::average)).mesh);
        MESSAGE("longest edge in medians: " << blend << " by default, " << average << " averaged");
        CHECK(blend < 3); // as without relief: 2.6
        CHECK(average > 4);
    }

} // TEST_SUITE
