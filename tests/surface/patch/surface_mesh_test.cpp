#include "bake/mesh/check/mesh_check.h"
#include "bake/surface/patch/surface_mesh.h"
#include "bake/surface/patch/surface_summary.h"
#include "cli/command.h"
#include "oracle/surfaces.h"
#include "surface/analytic/shapes.h"
#include <doctest/doctest.h>

using namespace bake;
using doctest::Approx;

namespace {

SurfaceMesh of_shape(const std::string& text, int columns, int rows) {
    return surface_mesh(BaseSurface(ParametricSurface(text), columns, rows), SurfaceKind::shape);
}

/// Every triangle's places are where its corners are.
double misplaced(const BaseSurface& surface, const SurfaceMesh& mesh) {
    double worst = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        SurfacePoint points[3];
        surface.evaluate(mesh.places[t].patch, mesh.places[t].st, points);
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3d p(mesh.mesh.positions[mesh.mesh.corner_position[mesh.triangles[t].corner[k]]]);
            worst = std::max(worst, glm::length(points[k].jet.p - p));
        }
    }
    return worst;
}

const Attribute& attribute(const Mesh& mesh, const std::string& name) {
    const auto found = std::find_if(mesh.attributes.begin(), mesh.attributes.end(),
                                    [&](const Attribute& a) { return a.name == name; });
    REQUIRE(found != mesh.attributes.end());
    REQUIRE(found->values.size() == mesh.corners());
    return *found;
}

/// A box: its top a fan of four triangles, its front a pentagon, its bottom a quad and a triangle. No uvs.
Mesh mixed_box() {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},     {0, 0, 1},
                      {1, 0, 1}, {1, 1, 1}, {0, 1, 1}, {0.5, 1, 0.5}, {0.5, 0, 1}};
    const std::vector<std::vector<std::uint32_t>> faces = {{3, 2, 1, 0}, {4, 9, 5, 6, 7}, {0, 1, 9, 4}, {1, 2, 6, 5},
                                                           {0, 4, 7, 3}, {3, 7, 8},       {7, 6, 8},    {6, 2, 8},
                                                           {2, 3, 8},    {1, 5, 9}};
    for (const auto& face : faces) {
        mesh.corner_position.insert(mesh.corner_position.end(), face.begin(), face.end());
        mesh.face_begin.push_back(std::uint32_t(mesh.corner_position.size()));
        mesh.face_group.push_back(std::uint32_t(mesh.face_group.size() % 2));
    }
    mesh.groups = {"even", "odd"};
    return mesh;
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("surface_mesh: a shape's corners carry its curvature, poles included") {
        const SurfaceMesh mesh = of_shape("sphere:R=2", 16, 8);
        for (const float value : attribute(mesh.mesh, "mean_curvature").values)
            CHECK(value == Approx(0.5).epsilon(1e-5));
        for (const float value : attribute(mesh.mesh, "gauss_curvature").values)
            CHECK(value == Approx(0.25).epsilon(1e-5));
        CHECK(mesh.mesh.tangents.size() == mesh.mesh.corners());
        CHECK(misplaced(BaseSurface(ParametricSurface("sphere:R=2"), 16, 8), mesh) < 1e-6);
    }

    TEST_CASE("surface_mesh: a mesh stays as it is, and gets unit normals and its places") {
        const Mesh box = mixed_box();
        const BaseSurface surface{Mesh(box)};
        const SurfaceMesh mesh = surface_mesh(surface, SurfaceKind::mesh);
        CHECK(mesh.mesh.faces() == box.faces());
        CHECK(mesh.mesh.groups == box.groups);
        CHECK(mesh.mesh.face_group == box.face_group);
        CHECK(mesh.mesh.tangents.empty()); // no uvs
        CHECK(mesh.mesh.positions.size() == box.positions.size());
        CHECK(mesh.triangles.size() == mesh.places.size());
        CHECK(misplaced(surface, mesh) == 0);
        for (const Vec3f& n : mesh.mesh.normals) CHECK(glm::length(n) == Approx(1));
        CHECK(mesh.mesh.normals.size() == box.positions.size()); // one each, shared by its corners
    }

    TEST_CASE("surface_mesh: a limit's lattice is closed, shares its points and keeps groups") {
        const Mesh box = mixed_box();
        for (const int rate : {1, 2, 5}) {
            const BaseSurface surface(Mesh(box), SubdivisionOptions{});
            const SurfaceMesh mesh = surface_mesh(surface, SurfaceKind::limit, rate);
            const MeshCheck check = check_mesh(mesh.mesh, mesh.triangles);
            CHECK(check.topology.boundary_edges == 0);
            CHECK(check.topology.nonmanifold_edges == 0);
            CHECK(check.topology.flipped_faces == 0);
            CHECK(check.topology.inside_out_components == 0);
            CHECK(long(check.positions) - long(check.topology.edges) + long(check.faces) == 2);
            CHECK(check.unused_positions == 0);
            CHECK(mesh.mesh.faces() == surface.complex().patches.size() * std::size_t(rate * rate));
            CHECK(mesh.mesh.normals.size() == mesh.mesh.positions.size()); // smooth everywhere
            CHECK(mesh.mesh.face_group.size() == mesh.mesh.faces());
            CHECK(misplaced(surface, mesh) < 1e-6);
            for (const Vec3f& n : mesh.mesh.normals) CHECK(glm::length(n) == Approx(1).epsilon(1e-5));
        }
    }

    TEST_CASE("surface_mesh: Loop's triangles too, rate^2 to a patch") {
        const Mesh torus = oracle::torus_mesh(8, 6);
        const BaseSurface surface(Mesh(torus), SubdivisionOptions{.scheme = Scheme::loop});
        const SurfaceMesh mesh = surface_mesh(surface, SurfaceKind::limit, 3);
        CHECK(mesh.mesh.faces() == torus.faces() * 9);
        const MeshCheck check = check_mesh(mesh.mesh, mesh.triangles);
        CHECK(check.topology.boundary_edges + check.topology.nonmanifold_edges + check.topology.flipped_faces == 0);
        CHECK(long(check.positions) - long(check.topology.edges) + long(check.faces) == 0);
        CHECK(misplaced(surface, mesh) < 1e-6);
    }

    TEST_CASE("surface_mesh: uvs differ at seams and nowhere else") {
        const int columns = 8, rows = 6, rate = 3;
        const BaseSurface surface(oracle::torus_mesh(columns, rows, true), SubdivisionOptions{});
        const SurfaceMesh mesh = surface_mesh(surface, SurfaceKind::limit, rate);
        // One uv per point of the unrolled torus: the seams' points have two, their crossing four.
        CHECK(mesh.mesh.positions.size() == std::size_t(columns * rate * rows * rate));
        CHECK(mesh.mesh.uvs.size() == std::size_t((columns * rate + 1) * (rows * rate + 1)));
        CHECK(mesh.mesh.tangents.size() == mesh.mesh.corners());
    }

    TEST_CASE("surface_values: chart derivatives come from those of the patch, mirrored charts change sigma alone") {
        const Jet<double> jet = oracle::torus(2, 0.7, 0.4, 1.1);
        // u = 2 s + t, v = 3 t: p_s = 2 p_u, p_t = p_u + 3 p_v.
        const SurfacePoint point{oracle::rechart(jet, 2, 1, 0, 3), {}, {2, 0}, {1, 3}};
        const SurfaceValues values = surface_values(point, true);
        CHECK(glm::length(values.p_u - jet.p_u) < 1e-14);
        CHECK(glm::length(values.p_v - jet.p_v) < 1e-14);
        CHECK(values.sigma == 1);
        const SurfaceValues mirrored = surface_values({jet, {}, {-1, 0}, {0, 1}}, true);
        CHECK(mirrored.sigma == -1);
        CHECK(glm::length(mirrored.p_u + jet.p_u) < 1e-14);
        CHECK(mirrored.mean_curvature == Approx(values.mean_curvature));
    }

    TEST_CASE("surface_summary: a torus's ranges, means and area are the closed forms") {
        const double R = 2, r = 0.7;
        const SurfaceSummary s = summarise(of_shape("torus:R=2,r=0.7", 256, 128));
        CHECK(s.area == Approx(4 * pi * pi * R * r).epsilon(1e-3));
        CHECK(s.x.max == Approx(R + r));
        CHECK(s.y.min == Approx(-r));
        CHECK(s.length_u.min == Approx(2 * pi * (R - r)).epsilon(1e-6));
        CHECK(s.length_u.max == Approx(2 * pi * (R + r)).epsilon(1e-6));
        CHECK(s.length_v.mean == Approx(2 * pi * r).epsilon(1e-6));
        CHECK(s.gauss_curvature.min == Approx(-1 / (r * (R - r))).epsilon(1e-6));
        CHECK(std::abs(s.gauss_curvature.mean) < 1e-3);                    // Gauss and Bonnet
        CHECK(s.mean_curvature.mean == Approx(1 / (2 * r)).epsilon(1e-3)); // the integral of H is 2 pi^2 R
        CHECK(s.degenerate.empty());
    }
}

TEST_SUITE("stability") {

    TEST_CASE("surface_summary: a sphere has two poles with a normal, a cone a tip without, a disc one centre") {
        const SurfaceSummary sphere = summarise(of_shape("sphere", 12, 6));
        REQUIRE(sphere.degenerate.size() == 2);
        CHECK(sphere.degenerate[0].what == Degenerate::pole);
        CHECK(glm::length(sphere.degenerate[0].p - Vec3d(0, -1, 0)) < 1e-6);
        CHECK(glm::length(sphere.degenerate[1].p - Vec3d(0, 1, 0)) < 1e-6);
        CHECK(sphere.degenerate[1].uv.y == 1);
        CHECK(sphere.length_u.min > 0); // poles do not count
        const SurfaceSummary cone = summarise(of_shape("cone:R=1,h=2", 12, 6));
        REQUIRE(cone.degenerate.size() == 1);
        CHECK(cone.degenerate[0].what == Degenerate::without_normal);
        const SurfaceSummary disc = summarise(of_shape("disc", 12, 6));
        REQUIRE(disc.degenerate.size() == 1);
        CHECK(disc.degenerate[0].what == Degenerate::pole);
    }

    TEST_CASE("surface_summary: what is listed of a mesh without uvs has uv 0") {
        Mesh line; // a triangle without area
        line.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
        line.corner_position = {0, 1, 2};
        line.face_begin = {0, 3};
        const SurfaceSummary s = summarise(surface_mesh(BaseSurface(std::move(line)), SurfaceKind::mesh));
        REQUIRE_FALSE(s.degenerate.empty());
        for (const DegeneratePoint& d : s.degenerate) CHECK(d.uv == Vec2f(0));
    }

    TEST_CASE("surface_summary: corners without area in uv are listed with their place; the normal stays") {
        Mesh mesh = oracle::torus_mesh(8, 6, true);
        for (std::size_t k = 0; k < 4; ++k) mesh.corner_uv[40 + k] = mesh.corner_uv[40];
        const SurfaceMesh surface = surface_mesh(BaseSurface(Mesh(mesh)), SurfaceKind::mesh);
        const SurfaceSummary s = summarise(surface);
        CHECK(s.degenerate.size() == 4);
        for (const DegeneratePoint& d : s.degenerate) {
            CHECK(d.what == Degenerate::no_chart);
            CHECK(d.face == 10);
        }
        for (const Vec3f& n : surface.mesh.normals) CHECK(glm::length(n) == Approx(1));
    }

    TEST_CASE("surface_mesh: a face of no size and a mesh of one triangle give finite values") {
        Mesh mesh;
        mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
        mesh.corner_position = {0, 1, 2, 1, 1, 2};
        mesh.face_begin = {0, 3, 6};
        const SurfaceMesh surface = surface_mesh(BaseSurface(Mesh(mesh)), SurfaceKind::mesh);
        const SurfaceSummary s = summarise(surface);
        CHECK(s.area == Approx(0.5));
        for (const Vec3f& n : surface.mesh.normals) CHECK(glm::dot(n, Vec3f(0)) == 0);
        for (const SurfaceSample& sample : surface.samples) CHECK(sample.mean * 0 == 0);
    }
}

TEST_SUITE("real" * doctest::skip(test::no_shared_data())) {

    TEST_CASE("surface_mesh: cages of the shared collection give closed limits where they are closed") {
        const auto data = test::shared_data();
        for (const char* file :
             {"spot/spot_control_mesh.obj", "opensubdiv/catmark_nonquads.obj", "opensubdiv/catmark_torus.obj",
              "opensubdiv/catmark_cubes_semisharp.obj", "opensubdiv/catmark_fvar_bound1.obj"}) {
            INFO(std::string(file));
            const std::string path = (data / "meshes" / file).string();
            Mesh cage = read_mesh(path);
            check_cage(cage, Scheme::catmark, path);
            const std::size_t boundary = check_mesh(cage, triangulate(cage)).welded.boundary_edges;
            const BaseSurface surface(std::move(cage), SubdivisionOptions{});
            const bool quarters = surface.complex().patches.size() > surface.mesh().faces();
            const SurfaceMesh mesh = surface_mesh(surface, SurfaceKind::limit, 2);
            const MeshCheck check = check_mesh(mesh.mesh, mesh.triangles);
            CHECK(check.topology.boundary_edges == boundary * 2 * (quarters ? 2 : 1));
            CHECK(check.topology.nonmanifold_edges == 0);
            CHECK(misplaced(surface, mesh) < 1e-5);
        }
    }
}
