#include "bake/base/error.h"
#include "bake/relief/transfer/casting.h"
#include "relief/transfer/transfer_meshes.h"

using namespace bake;
using namespace bake::test;

namespace {

constexpr Reach reach{0.2f, 0.3f, 0.25f};

struct LowBox {
    Mesh mesh = sharp_box();
    MeshSurface surface = make_mesh_surface(mesh);
    Casting casting(CastBy by, const Reach& r = reach) const {
        return Casting(surface, by, constant_reach(surface, r));
    }
    /// The point of side `side` at s, t of BoxSide.
    TexelHit at(int side, double s, double t) const {
        const Vec3d p = BoxSide{side}.at(s, t);
        for (std::uint32_t i = 0; i < surface.triangles.size(); ++i) {
            const Triangle& triangle = surface.triangles[i];
            if (int(triangle.face) != side) continue;
            const auto corner = [&](std::size_t k) {
                return Vec3d(mesh.positions[mesh.corner_position[triangle.corner[k]]]);
            };
            const Vec3d e1 = corner(1) - corner(0), e2 = corner(2) - corner(0), d = p - corner(0);
            const Vec3d n = glm::cross(e1, e2);
            const double b1 = glm::dot(glm::cross(d, e2), n) / glm::dot(n, n),
                         b2 = glm::dot(glm::cross(e1, d), n) / glm::dot(n, n);
            if (b1 > -1e-9 && b2 > -1e-9 && b1 + b2 < 1 + 1e-9) return {i, float(b1), float(b2)};
        }
        throw std::logic_error("no such point");
    }
};

Vec3d on_low(const Cast& cast) { return Vec3d(cast.start + cast.reach.front * cast.inward); }

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("blend_width: detail inside needs it, detail outside little; none without detail") {
        CHECK(blend_width(0, 0) == 0);
        CHECK(blend_width(1, 0) == 0.5f);
        // The steepest slope of the smooth step, 1.5 / width, times the tangent of the box's corner, times the depth: below 1,
        // rays do not cross.
        CHECK(1.5f / blend_width(0, 1) * std::sqrt(2.0f) < 1);
    }

    TEST_CASE("casting: every ray meets the low-poly mesh at reach.front, whatever its direction") {
        const LowBox box;
        for (const CastBy by : {CastBy::blend, CastBy::averaged, CastBy::face})
            for (const double s : {0.0, 0.05, 0.4, 1.0})
                for (const double t : {0.0, 0.3, 0.9}) {
                    const Cast cast = box.casting(by).at(box.at(2, s, t));
                    CHECK(glm::length(on_low(cast) - BoxSide{2}.at(s, t)) < 1e-6);
                    CHECK(glm::length(cast.inward) == doctest::Approx(1));
                    CHECK(cast.reach.front == doctest::Approx(reach.front));
                    CHECK(cast.reach.back == doctest::Approx(reach.back));
                }
    }

    TEST_CASE("casting: blended, both sides of a box's edge look the same way, and the middle along its own normal") {
        const LowBox box;
        const Casting casting = box.casting(CastBy::blend);
        CHECK(casting.hard_edges() == 12);
        // The sides along x and y meet at (1, 1, z): t of the first is (y + 1) / 2 ..., the second's s is z.
        for (const double z : {0.0, 0.2, 0.5, 0.9, 1.0}) {
            const Cast a = casting.at(box.at(0, 1, z)), b = casting.at(box.at(1, z, 1));
            REQUIRE(glm::length(on_low(a) - on_low(b)) < 1e-6);
            CHECK(oracle::angle_deg(Vec3d(a.inward), Vec3d(b.inward)) < 1e-3);
            CHECK(a.inward.x == doctest::Approx(a.inward.y));
        }
        for (int side = 0; side < 6; ++side)
            CHECK(glm::length(Vec3d(casting.at(box.at(side, 0.5, 0.6)).inward) + BoxSide{side}.normal()) < 1e-6);
    }

    TEST_CASE(
        "casting: directions turn from the edge's to the side's own within the width of the blend, and no farther") {
        const LowBox box;
        const Casting casting = box.casting(CastBy::blend);
        double before = 1e9;
        for (const double distance : {0.0, 0.05, 0.1, 0.15, 0.2, 0.24}) {
            const double lean =
                oracle::angle_deg(-Vec3d(casting.at(box.at(0, 1 - distance / 2, 0.5)).inward), {1, 0, 0});
            CHECK(lean < before);
            CHECK(lean > 0.01);
            before = lean;
        }
        for (const double distance : {0.2501, 0.3, 0.9})
            CHECK(oracle::angle_deg(-Vec3d(casting.at(box.at(0, 1 - distance / 2, 0.5)).inward), {1, 0, 0}) < 1e-4);
        // Without a width, directions are the side's own everywhere but on the edge.
        const Casting narrow = box.casting(CastBy::blend, {0.2f, 0.3f, 0});
        CHECK(oracle::angle_deg(-Vec3d(narrow.at(box.at(0, 0.999, 0.5)).inward), {1, 0, 0}) < 1e-4);
    }

    TEST_CASE("casting: averaged directions lean all over a side, those of facets nowhere") {
        const LowBox box;
        const Casting averaged = box.casting(CastBy::averaged), face = box.casting(CastBy::face);
        for (const double s : {0.1, 0.3, 0.9}) {
            CHECK(oracle::angle_deg(-Vec3d(averaged.at(box.at(0, s, 0.5)).inward), {1, 0, 0}) > 3);
            CHECK(oracle::angle_deg(-Vec3d(face.at(box.at(0, s, 0.5)).inward), {1, 0, 0}) < 1e-4);
        }
        CHECK(oracle::angle_deg(-Vec3d(averaged.at(box.at(0, 1, 1)).inward), {1, 1, 1}) < 1e-3);
        CHECK(averaged.hard_edges() == 12);
        CHECK(face.hard_edges() == 0);
    }

    TEST_CASE("casting: without hard edges every direction is the interpolated normal") {
        const Mesh mesh = lat_long_sphere(32, 16);
        const MeshSurface surface = make_mesh_surface(mesh);
        const Casting casting(surface, CastBy::blend, constant_reach(surface, reach));
        CHECK(casting.hard_edges() == 0);
        for (const std::uint32_t t : {100u, 333u}) {
            const auto& corner = surface.triangles[t].corner;
            const Vec3d n = 0.3 * Vec3d(surface.n[corner[0]]) + 0.5 * Vec3d(surface.n[corner[1]]) +
                            0.2 * Vec3d(surface.n[corner[2]]);
            CHECK(oracle::angle_deg(-Vec3d(casting.at({t, 0.5f, 0.2f}).inward), n) < 1e-3);
        }
    }

    TEST_CASE("casting: by face, every direction is the facet's, however the mesh is shaded") {
        const Mesh mesh = lat_long_sphere(12, 6);
        const MeshSurface surface = make_mesh_surface(mesh);
        const Casting casting(surface, CastBy::face, constant_reach(surface, reach));
        const auto& corner = surface.triangles[40].corner;
        const auto p = [&](std::size_t k) { return Vec3d(mesh.positions[mesh.corner_position[corner[k]]]); };
        for (const TexelHit& at : {TexelHit{40, 0.1f, 0.1f}, {40, 0.5f, 0.4f}})
            CHECK(oracle::angle_deg(-Vec3d(casting.at(at).inward), glm::cross(p(1) - p(0), p(2) - p(0))) < 1e-3);
    }

    TEST_CASE("casting: by face, each triangle of a quad that is not planar has its own direction") {
        Mesh mesh = unit_plane();
        mesh.positions[0].z = 0.5f;
        const MeshSurface surface = make_mesh_surface(mesh);
        REQUIRE(surface.triangles.size() == 2);
        const Casting casting(surface, CastBy::face, constant_reach(surface, reach));
        for (std::uint32_t t = 0; t < 2; ++t) {
            const auto p = [&](std::size_t k) {
                return mesh.positions[mesh.corner_position[surface.triangles[t].corner[k]]];
            };
            const Vec3f n = glm::normalize(glm::cross(p(1) - p(0), p(2) - p(0)));
            for (const float b1 : {0.0f, 0.2f, 0.9f}) CHECK(glm::length(casting.at({t, b1, 0.05f}).inward + n) < 1e-6f);
        }
        CHECK(glm::length(casting.at({0, 0.2f, 0.2f}).inward - casting.at({1, 0.2f, 0.2f}).inward) > 0.1f);
    }

    TEST_CASE("casting: the envelope's corners are where the rays of the corners start; the farthest reach is told") {
        const LowBox box;
        std::vector<Reach> reaches = constant_reach(box.surface, reach);
        reaches[3] = {0.7f, 0.9f, 0.1f};
        const Casting casting(box.surface, CastBy::averaged, reaches);
        CHECK(casting.most_front() == 0.7f);
        CHECK(casting.most_back() == 0.9f);
        for (std::uint32_t t = 0; t < box.surface.triangles.size(); ++t)
            for (const std::uint32_t k : {0u, 1u, 2u})
                CHECK(glm::length(casting.envelope(box.surface.triangles[t].corner[k]) -
                                  casting.at({t, float(k == 1), float(k == 2)}).start) < 1e-6f);
    }

    TEST_CASE("casting: rays of a cage start on it, go through the mesh and as far beyond it") {
        const LowBox box;
        Mesh cage = box.mesh;
        for (Vec3f& p : cage.positions) p = p * 1.5f + Vec3f(0.1f, 0, 0);
        const Casting casting(box.surface, cage, "cage.obj");
        for (const double s : {0.0, 0.3, 1.0}) {
            const Cast cast = casting.at(box.at(1, s, 0.4));
            const Vec3d p = BoxSide{1}.at(s, 0.4), start = p * 1.5 + Vec3d(0.1, 0, 0);
            CHECK(glm::length(Vec3d(cast.start) - start) < 1e-6);
            CHECK(glm::length(on_low(cast) - p) < 1e-6);
            CHECK(cast.reach.front == doctest::Approx(glm::length(start - p)));
            CHECK(cast.reach.back == cast.reach.front);
        }
        CHECK(casting.most_front() == doctest::Approx(std::sqrt(0.6 * 0.6 + 0.5 * 0.5 + 0.5 * 0.5)));
        CHECK(casting.most_back() == casting.most_front());
        for (std::uint32_t c = 0; c < cage.corners(); ++c)
            CHECK(glm::length(casting.envelope(c) - cage.positions[cage.corner_position[c]]) < 1e-6f);
    }

    TEST_CASE("casting: a cage far from zero is where its origin puts it") {
        const LowBox box;
        Mesh cage = box.mesh;
        for (Vec3f& p : cage.positions) p = p * 1.5f - Vec3f(100, 0, 0);
        cage.origin = {100, 0, 0};
        const Cast cast = Casting(box.surface, cage, "cage.obj").at(box.at(0, 0.5, 0.5));
        CHECK(glm::length(cast.start - Vec3f(1.5f, 0, 0)) < 1e-4f);
    }

    TEST_CASE("casting: a cage with other faces is refused, which names its file") {
        const LowBox box;
        for (Mesh cage : {unit_plane(), unit_plane(0, 3), cube()}) {
            if (cage.faces() == 6) cage.face_begin[1] = 3; // as many faces, with other corners
            try {
                const Casting casting(box.surface, cage, "cage.obj");
                FAIL("was not refused");
            } catch (const Error& error) {
                CHECK(error.refusal == Refusal::unsuitable);
                CHECK(std::string(error.what()).starts_with("cage.obj: has other faces"));
            }
        }
    }

} // TEST_SUITE

TEST_SUITE("stability") {

    TEST_CASE("casting: a facet without area and a cage on the mesh give a zero direction, no NaN") {
        Mesh mesh = unit_plane();
        mesh.positions[1] = mesh.positions[0];
        const MeshSurface surface = make_mesh_surface(mesh);
        const Casting face(surface, CastBy::face, constant_reach(surface, reach));
        const Casting flat(surface, mesh, "cage.obj");
        int zero = 0;
        for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
            const Cast a = face.at({t, 0.3f, 0.3f}), b = flat.at({t, 0.3f, 0.3f});
            for (const Cast& cast : {a, b})
                for (int c = 0; c < 3; ++c) CHECK((std::isfinite(cast.start[c]) && std::isfinite(cast.inward[c])));
            CHECK((b.inward == Vec3f(0)));
            zero += a.inward == Vec3f(0);
            for (const std::uint32_t corner : surface.triangles[t].corner)
                CHECK(glm::length(face.envelope(corner)) < 2);
        }
        CHECK(zero <= 1);
    }

    TEST_CASE("casting: a cage whose faces meet elsewhere is refused") {
        const Mesh low = unit_plane(0, 2);
        const MeshSurface surface = make_mesh_surface(low);
        Mesh cage = unit_plane(0.1, 2);
        CHECK_NOTHROW(Casting(surface, cage, "cage.obj"));
        std::rotate(cage.corner_position.begin(), cage.corner_position.begin() + 4, cage.corner_position.end());
        try {
            const Casting casting(surface, cage, "cage.obj");
            FAIL("not refused");
        } catch (const Error& error) {
            CHECK(error.refusal == Refusal::unsuitable);
            CHECK(std::string(error.what()).find("cage.obj: its faces do not meet where") == 0);
        }
    }

} // TEST_SUITE
