#include "bake/surface/subdivision/subdivision.h"
#include "mesh/file/mesh_files.h"
#include "oracle/surfaces.h"
#include "surface/subdivision/cages.h"
#include <cstring>
#include <map>
#include <random>

using namespace bake;
using namespace bake_tests;

namespace {

LimitPoint point(const SubdivisionSurface& surface, std::uint32_t patch, double s, double t,
                 Derivatives order = Derivatives::second) {
    LimitPoint p{};
    const Vec2d st(s, t);
    surface.evaluate(patch, {&st, 1}, order, {&p, 1});
    return p;
}

// Cages with irregular vertices and faces, uvs in several charts, creases and a corner.
Mesh rich_cage(Scheme scheme) {
    Mesh cage = box();
    cage.positions.emplace_back(1, 0.5f, 2.4f);
    cage.corner_position = {0, 3, 2, 1, 0, 1, 5, 4, 2, 3, 7, 6, 1, 2, 6, 5,
                            0, 4, 7, 3, 4, 5, 8, 5, 6, 8, 6, 7, 8, 7, 4, 8};
    cage.face_begin = {0, 4, 8, 12, 16, 20, 23, 26, 29, 32};
    cage.tags.creases = {{4, 5, 2.3f}, {5, 6, 10}, {1, 2, 10}, {2, 3, 10}};
    cage.tags.corners = {{8, 1.5f}};
    if (scheme == Scheme::loop) cage = in_triangles(cage);
    give_each_face_a_chart(cage);
    return cage;
}

Vec3d moved(const Vec3d& p) { return {0.5 * p.x + 2 * p.y + 1, -1.5 * p.x + p.z - 2, 0.25 * p.y + 0.5 * p.z + 4}; }

// Points of a lattice, by their indices.
template <class Work> void for_lattice(bool triangle, int rate, const Work& work) {
    for (int j = 0, at = 0; j <= rate; ++j)
        for (int i = 0; i <= (triangle ? rate - j : rate); ++i) work(i, j, at++);
}

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("SubdivisionSurface: single points, lattices and bands of rows have the same bits") {
        for (const Scheme scheme : {Scheme::catmark, Scheme::loop}) {
            const bool loop = scheme == Scheme::loop;
            const SubdivisionSurface surface(rich_cage(scheme), {scheme, UvSmoothing::all});
            for (const int rate : {1, 7, 64, 100})
                for (const Derivatives order : {Derivatives::none, Derivatives::first, Derivatives::second}) {
                    std::vector<LimitPoint> lattice(std::size_t((rate + 1) * (rate + 1))), single = lattice,
                                                                                           rows = lattice;
                    std::vector<Vec2d> st;
                    for_lattice(loop, rate,
                                [&](int i, int j, int) { st.emplace_back(double(i) / rate, double(j) / rate); });
                    for (const std::uint32_t patch : {0u, 3u, surface.patches() - 1}) {
                        surface.evaluate_lattice(patch, rate, order, lattice);
                        surface.evaluate(patch, st, order, single);
                        const int half = rate / 2;
                        surface.evaluate_rows(patch, rate, 0, half, order, rows);
                        const int before = loop ? half * (rate + 1) - half * (half - 1) / 2 : half * (rate + 1);
                        surface.evaluate_rows(patch, rate, half, rate + 1, order,
                                              std::span(rows).subspan(std::size_t(before)));
                        CHECK(std::memcmp(lattice.data(), single.data(), st.size() * sizeof(LimitPoint)) == 0);
                        CHECK(std::memcmp(lattice.data(), rows.data(), st.size() * sizeof(LimitPoint)) == 0);
                    }
                }
        }
    }

    TEST_CASE("SubdivisionSurface: derivatives that are not requested are not written, the others have the same bits") {
        const SubdivisionSurface surface(rich_cage(Scheme::catmark));
        LimitPoint all = point(surface, 4, 0.3, 0.6), p{}, first{};
        p.p_s = first.p_ss = Vec3d(7);
        p.uv_t = first.uv_st = Vec2d(7);
        const Vec2d st(0.3, 0.6);
        surface.evaluate(4, {&st, 1}, Derivatives::none, {&p, 1});
        surface.evaluate(4, {&st, 1}, Derivatives::first, {&first, 1});
        CHECK((p.p == all.p && p.uv == all.uv && p.p_s == Vec3d(7) && p.uv_t == Vec2d(7)));
        CHECK((first.p_t == all.p_t && first.uv_s == all.uv_s && first.p_ss == Vec3d(7) && first.uv_st == Vec2d(7)));
    }

    TEST_CASE("SubdivisionSurface: a quad is one patch, another face one patch per corner, a Loop triangle one patch") {
        Mesh cage = rich_cage(Scheme::catmark);
        const SubdivisionSurface surface(cage, {Scheme::catmark, UvSmoothing::none});
        REQUIRE(surface.patches() == 5 + 4 * 3);
        const auto uv = [&](std::uint32_t f, std::uint32_t k) {
            return Vec2d(cage.uvs[cage.corner_uv[cage.face_begin[f] + k]]);
        };
        for (std::uint32_t patch = 0; patch < surface.patches(); ++patch) {
            const std::uint32_t f = surface.face(patch), k = surface.corner(patch);
            CHECK(f == (patch < 5 ? patch : 5 + (patch - 5) / 3));
            CHECK(k == (patch < 5 ? 0 : (patch - 5) % 3));
            CHECK(glm::distance(point(surface, patch, 0, 0).uv, uv(f, k)) < 1e-15);
            const Vec2d next = patch < 5 ? uv(f, 1) : 0.5 * (uv(f, k) + uv(f, (k + 1) % 3));
            const Vec2d across = patch < 5 ? uv(f, 2) : (uv(f, 0) + uv(f, 1) + uv(f, 2)) / 3.0;
            CHECK(glm::distance(point(surface, patch, 1, 0).uv, next) < 1e-15);
            CHECK(glm::distance(point(surface, patch, 1, 1).uv, across) < 1e-15);
        }
        const SubdivisionSurface loop(rich_cage(Scheme::loop), {Scheme::loop, UvSmoothing::none});
        CHECK(loop.patches() == 14);
        CHECK(loop.corner(13) == 0);
        const Mesh triangles = rich_cage(Scheme::loop);
        CHECK(glm::distance(point(loop, 13, 0, 1).uv, Vec2d(triangles.uvs[triangles.corner_uv[41]])) < 1e-15);
        CHECK(glm::distance(point(loop, 13, 1, 0).uv, Vec2d(triangles.uvs[triangles.corner_uv[40]])) < 1e-15);
    }

    TEST_CASE("SubdivisionSurface: derivatives agree with differences of points") {
        std::mt19937 random(1);
        std::uniform_real_distribution<double> unit(0.02, 0.98);
        for (const Scheme scheme : {Scheme::catmark, Scheme::loop}) {
            const SubdivisionSurface surface(rich_cage(scheme), {scheme, UvSmoothing::inside});
            for (int trial = 0; trial < 300; ++trial) {
                double s = unit(random), t = unit(random);
                if (scheme == Scheme::loop && s + t > 0.98) s *= 0.5, t *= 0.5;
                const auto patch = std::uint32_t(random() % surface.patches());
                const LimitPoint p = point(surface, patch, s, t);
                const double h = 1e-5;
                const LimitPoint right = point(surface, patch, s + h, t), left = point(surface, patch, s - h, t);
                const LimitPoint up = point(surface, patch, s, t + h), down = point(surface, patch, s, t - h);
                // The error of the differences is h^2 times the third derivative (up to 1e3 here), and of first order
                // across lines where the third derivative jumps.
                const double small = 1e-6, size = 1 + glm::length(p.p_ss) + glm::length(p.p_tt);
                CHECK(glm::distance((right.p - left.p) / (2 * h), p.p_s) < small * size);
                CHECK(glm::distance((up.p - down.p) / (2 * h), p.p_t) < small * size);
                CHECK(glm::distance((right.uv - left.uv) / (2 * h), p.uv_s) < small * size);
                CHECK(glm::distance((up.uv - down.uv) / (2 * h), p.uv_t) < small * size);
                const double rough = 1e-3 * size;
                CHECK(glm::distance((right.p_s - left.p_s) / (2 * h), p.p_ss) < rough);
                CHECK(glm::distance((right.p_t - left.p_t) / (2 * h), p.p_st) < rough);
                CHECK(glm::distance((up.p_s - down.p_s) / (2 * h), p.p_st) < rough);
                CHECK(glm::distance((up.p_t - down.p_t) / (2 * h), p.p_tt) < rough);
                CHECK(glm::distance((right.uv_s - left.uv_s) / (2 * h), p.uv_ss) < rough);
                CHECK(glm::distance((up.uv_s - down.uv_s) / (2 * h), p.uv_st) < rough);
                CHECK(glm::distance((up.uv_t - down.uv_t) / (2 * h), p.uv_tt) < rough);
            }
        }
    }

    TEST_CASE("SubdivisionSurface: an affine map of the cage maps the surface") {
        for (const Scheme scheme : {Scheme::catmark, Scheme::loop}) {
            const Mesh cage = rich_cage(scheme);
            Mesh other = cage;
            for (Vec3f& p : other.positions) p = moved(Vec3d(p));
            const SubdivisionSurface a(cage, {scheme}), b(other, {scheme});
            for (std::uint32_t patch = 0; patch < a.patches(); ++patch)
                for (const auto& [s, t] : {std::pair(0.3, 0.0), {0.37, 0.21}, {0.001, 0.5}}) {
                    // The mapped cage is rounded to float; its coordinates are below 16.
                    CHECK(glm::distance(point(b, patch, s, t).p, moved(point(a, patch, s, t).p)) < 16 * 1.2e-7);
                    const Vec3d along = moved(point(a, patch, s, t).p_s) - moved(Vec3d(0));
                    CHECK(glm::distance(point(b, patch, s, t).p_s, along) < 16 * 1e-6);
                }
        }
    }

    TEST_CASE("SubdivisionSurface: a flat cage has a flat limit, and linear uvs stay linear") {
        const SubdivisionSurface surface(sheet(4, [](int, int) { return 0.25; }),
                                         {Scheme::catmark, UvSmoothing::inside});
        for (std::uint32_t patch = 0; patch < surface.patches(); ++patch) {
            const LimitPoint p = point(surface, patch, 0.3, 0.9);
            CHECK(p.p.z == doctest::Approx(0.25).epsilon(1e-15));
            CHECK(std::abs(p.p_s.z) + std::abs(p.p_t.z) + std::abs(p.p_ss.z) < 1e-14);
            const bool round_corner =
                patch % 4 % 3 == 0 && patch / 4 % 3 == 0; // a corner of the cage, not of the chart
            if (!round_corner) CHECK(glm::distance(p.uv, Vec2d(p.p) / 4.0) < 1e-14);
        }
    }

    TEST_CASE("SubdivisionSurface: the control points of a cubic reproduce it, with all derivatives") {
        // B-splines with the coefficients 1, i, i^2 - 1/3, i^3 - i are the functions 1, x, x^2, x^3.
        const auto cubic = [](int i) { return 0.25 * (double(i) * i * i - i); };
        const auto square = [](int j) { return 3.0 * j * j - 1; };
        const SubdivisionSurface surface(sheet(6, [&](int i, int j) { return cubic(i) * square(j); }));
        for (const std::uint32_t patch : {7u, 14u, 22u}) // patches with a full ring of faces
            for (const auto& [s, t] : {std::pair(0.0, 0.0), {0.4, 0.7}, {1.0, 0.25}}) {
                const LimitPoint p = point(surface, patch, s, t);
                const double x = patch % 6 + s, y = patch / 6 + t;
                CHECK(p.p.x == doctest::Approx(x).epsilon(1e-14));
                CHECK(p.p.z == doctest::Approx(0.75 * x * x * x * y * y).epsilon(1e-14));
                CHECK(p.p_s.z == doctest::Approx(2.25 * x * x * y * y).epsilon(1e-13));
                CHECK(p.p_t.z == doctest::Approx(1.5 * x * x * x * y).epsilon(1e-13));
                CHECK(p.p_ss.z == doctest::Approx(4.5 * x * y * y).epsilon(1e-12));
                CHECK(p.p_st.z == doctest::Approx(4.5 * x * x * y).epsilon(1e-12));
                CHECK(p.p_tt.z == doctest::Approx(1.5 * x * x * x).epsilon(1e-12));
            }
    }

    TEST_CASE("SubdivisionSurface: Loop's control points of a quadratic reproduce it") {
        // The limit mask (1/2, six times 1/12) maps i^2 - 1/3 to x^2 and i j - 1/6 to x y, because diagonals rise to the right.
        const Mesh cage = in_triangles(sheet(6, [](int i, int j) { return 3.0 * i * i - 1 + 12.0 * i * j - 2; }));
        const SubdivisionSurface surface(cage, {Scheme::loop});
        for (const std::uint32_t patch : {28u, 29u, 44u, 45u})
            for (const auto& [s, t] : {std::pair(0.0, 0.0), {0.2, 0.3}, {0.4, 0.6}, {0.45, 0.45}}) {
                const LimitPoint p = point(surface, patch, s, t);
                CHECK(p.p.z == doctest::Approx(3 * p.p.x * p.p.x + 12 * p.p.x * p.p.y).epsilon(1e-13));
                const double z_s = (6 * p.p.x + 12 * p.p.y) * p.p_s.x + 12 * p.p.x * p.p_s.y;
                CHECK(p.p_s.z == doctest::Approx(z_s).epsilon(1e-13));
            }
    }

    TEST_CASE("SubdivisionSurface: adjacent faces have equal points on their common edge") {
        const auto gap = [](const Mesh& cage, Scheme scheme) {
            const SubdivisionSurface surface(cage, {scheme});
            struct Side {
                std::uint32_t patch;
                Vec2d from, to;
            };
            std::map<std::pair<std::uint32_t, std::uint32_t>, Side> sides;
            for (std::uint32_t patch = 0; patch < surface.patches(); ++patch) {
                const std::uint32_t f = surface.face(patch), begin = cage.face_begin[f],
                                    size = cage.face_begin[f + 1] - begin;
                const std::vector<Vec2d> corners = scheme == Scheme::loop
                                                       ? std::vector<Vec2d>{{0, 0}, {1, 0}, {0, 1}}
                                                       : std::vector<Vec2d>{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
                for (std::uint32_t k = 0; k < size; ++k)
                    sides[{cage.corner_position[begin + k], cage.corner_position[begin + (k + 1) % size]}] = {
                        patch, corners[k], corners[(k + 1) % size]};
            }
            double worst = 0;
            for (const auto& [edge, side] : sides) {
                const auto other = sides.find({edge.second, edge.first});
                if (other == sides.end()) continue;
                for (int i = 0; i <= 300; ++i) {
                    const double x = i / 300.0;
                    const Vec2d here = side.from + x * (side.to - side.from);
                    const Vec2d there = other->second.to + x * (other->second.from - other->second.to);
                    worst = std::max(worst, glm::distance(point(surface, side.patch, here.x, here.y).p,
                                                          point(surface, other->second.patch, there.x, there.y).p));
                }
            }
            return worst;
        };
        Mesh cage = box();
        cage.tags.creases = {{4, 5, 2.3f}, {5, 6, 10}};
        // The two sides are rounded independently in about twenty levels; coordinates are up to 3.
        CHECK(gap(cage, Scheme::catmark) < 3e-14);
        CHECK(gap(dome(7), Scheme::catmark) < 3e-14);
        CHECK(gap(in_triangles(cage), Scheme::loop) < 3e-14);
    }

    TEST_CASE("SubdivisionSurface: corners with equal uvs belong to one chart, even with different indices") {
        Mesh cage = sheet(4, [](int i, int j) { return 0.1 * i * j; });
        for (Vec2f& uv : cage.uvs) uv.x += uv.y * uv.y;
        Mesh split = cage;
        split.uvs.clear();
        for (std::size_t c = 0; c < cage.corners(); ++c) {
            split.uvs.push_back(cage.uvs[cage.corner_uv[c]]);
            split.corner_uv[c] = std::uint32_t(c);
        }
        const SubdivisionSurface a(cage), b(split);
        const LimitPoint p = point(a, 5, 0.3, 0.2), q = point(b, 5, 0.3, 0.2);
        CHECK((p.uv == q.uv && p.uv_st == q.uv_st));
        // The uv is smoothed, so it differs from the bilinear value.
        CHECK(std::abs(p.uv.x - (p.p.x / 4 + p.p.y * p.p.y / 16)) > 1e-3);
    }
}

TEST_SUITE("stability") {
    TEST_CASE(
        "SubdivisionSurface: an extraordinary vertex of any valence has a point, a normal and finite derivatives") {
        for (const int n : {3, 5, 6, 16, 60})
            for (const Scheme scheme : {Scheme::catmark, Scheme::loop}) {
                const Mesh cage = scheme == Scheme::loop ? in_triangles(dome(n)) : dome(n);
                const SubdivisionSurface surface(cage, {scheme});
                const LimitPoint first = point(surface, 0, 0, 0);
                const Vec3d normal = unit_or_zero(glm::cross(first.p_s, first.p_t));
                CHECK(glm::length(normal) == doctest::Approx(1));
                for (std::uint32_t patch = 0; patch < surface.patches(); ++patch) {
                    if (cage.corner_position[cage.face_begin[surface.face(patch)]] != 0) continue;
                    const LimitPoint p = point(surface, patch, 0, 0);
                    CHECK(glm::distance(p.p, first.p) < 1e-13);
                    // Pieces at the vertex have a size of 1e-9, points a rounding error of 1e-16: about 1e-5 degrees, more
                    // in narrow sectors.
                    CHECK(oracle::angle_deg(glm::cross(p.p_s, p.p_t), normal) < 1e-3);
                    CHECK(std::isfinite(glm::length(p.p_ss) + glm::length(p.p_st) + glm::length(p.p_tt)));
                }
            }
    }

    TEST_CASE("SubdivisionSurface: the boundary is the B-spline of the cage's border, independent of the interior") {
        const SubdivisionSurface surface(sheet(5, [](int i, int j) { return j == 0 ? 0.3 * (i % 2) : 5.0 * (i + j); }));
        for (const double s : {0.0, 0.25, 0.7}) {
            const LimitPoint p = point(surface, 2, s, 0); // between border points 2 and 3 of height 0 and 0.3
            const double z = 0.3 * (std::pow(1 - s, 3) + 1 + 3 * (s + s * s - s * s * s)) / 6;
            CHECK(glm::distance(p.p, Vec3d(2 + s, 0, double(0.3f) / 0.3 * z)) < 1e-14);
        }
    }

    TEST_CASE("SubdivisionSurface: a corner stays where it is when corners are kept, is rounded when not, and goes "
              "with no border") {
        Mesh cage = sheet(4, [](int i, int j) { return 0.25 * i * j; });
        cage.tags.boundary = SubdivisionTags::Boundary::edge_and_corner;
        CHECK(point(SubdivisionSurface(cage), 0, 0, 0).p == Vec3d(cage.positions[0]));
        cage.tags.boundary = SubdivisionTags::Boundary::edge_only;
        const Vec3d rounded =
            (4.0 * Vec3d(cage.positions[0]) + Vec3d(cage.positions[1]) + Vec3d(cage.positions[5])) / 6.0;
        CHECK(glm::distance(point(SubdivisionSurface(cage), 0, 0, 0).p, rounded) < 1e-15);
        cage.tags.boundary = SubdivisionTags::Boundary::none;
        const SubdivisionSurface inner(cage);
        REQUIRE(inner.patches() == 4);
        CHECK(inner.face(0) == 5);
        CHECK(inner.face(3) == 10);
        const Mesh all = box();
        Mesh tagged = all;
        tagged.tags.corners = {{6, 10}};
        CHECK(glm::distance(point(SubdivisionSurface(tagged), 1, 1, 1).p, Vec3d(all.positions[6])) < 3e-14);
    }

    TEST_CASE("SubdivisionSurface: a crease has one line of points and two normals; a semi-sharp one lies between it "
              "and none") {
        const auto at = [](float sharpness, std::uint32_t patch, double s, double t) {
            Mesh cage = box();
            for (const auto& [a, b] : {std::pair(4u, 5u), {5u, 6u}, {6u, 7u}, {7u, 4u}})
                cage.tags.creases.push_back({a, b, sharpness});
            return point(SubdivisionSurface(cage), patch, s, t);
        };
        // The first edge of face 1 is the last edge of face 2.
        const LimitPoint top = at(10, 1, 0.3, 0), side = at(10, 2, 0.3, 1);
        CHECK(glm::distance(top.p, side.p) < 1e-15);
        CHECK(oracle::angle_deg(glm::cross(top.p_s, top.p_t), glm::cross(side.p_s, side.p_t)) > 40);
        const LimitPoint smooth_top = at(0, 1, 0.3, 0), smooth_side = at(0, 2, 0.3, 1);
        CHECK(oracle::angle_deg(glm::cross(smooth_top.p_s, smooth_top.p_t),
                                glm::cross(smooth_side.p_s, smooth_side.p_t)) < 1e-9);
        double before = smooth_top.p.z;
        for (const float sharpness : {0.5f, 1.0f, 1.5f, 3.0f, 6.0f, 9.5f, 10.0f}) {
            const double z = at(sharpness, 1, 0.3, 0).p.z;
            CHECK(z > before);
            before = z;
        }
        // Each level of sharpness halves the width of the rounded part.
        CHECK((top.p.z - at(2, 1, 0.3, 0).p.z) / (top.p.z - at(3, 1, 0.3, 0).p.z) == doctest::Approx(2).epsilon(0.01));
        CHECK(at(99, 1, 0.3, 0).p == top.p);
    }

    TEST_CASE("SubdivisionSurface: faces and uvs without area give finite points") {
        for (const Scheme scheme : {Scheme::catmark, Scheme::loop}) {
            Mesh cage = rich_cage(scheme);
            cage.positions[1] = cage.positions[2] = cage.positions[0];
            for (Vec2f& uv : cage.uvs) uv = Vec2f(0.5f);
            cage.corner_uv[3] = no_index;
            const SubdivisionSurface surface(cage, {scheme});
            for (std::uint32_t patch = 0; patch < surface.patches(); ++patch)
                for (const auto& [s, t] : {std::pair(0.0, 0.0), {0.5, 0.5}, {0.0, 1.0}, {0.3, 0.1}}) {
                    const LimitPoint p = point(surface, patch, s, t);
                    const double* number = &p.p.x;
                    for (int i = 0; i < 30; ++i) CHECK(std::isfinite(number[i]));
                }
        }
    }

    TEST_CASE("SubdivisionSurface: a cage of equal points has that point as its limit; without uvs all uvs are zero") {
        Mesh cage = box();
        for (Vec3f& p : cage.positions) p = {1, 2, 3};
        const SubdivisionSurface surface(cage);
        CHECK_FALSE(surface.has_uv());
        const LimitPoint p = point(surface, 3, 0.2, 0.9);
        CHECK(glm::distance(p.p, Vec3d(1, 2, 3)) < 1e-14);
        CHECK((p.uv == Vec2d(0) && p.uv_s == Vec2d(0) && p.uv_tt == Vec2d(0)));
    }
}
