// The patches of a base surface, their shared edges and vertices.
#include "bake/mesh/file/mesh_io.h"
#include "cli/command.h"
#include "oracle/surfaces.h"
#include "surface/patch/complexes.h"

using namespace bake;
using namespace bake::test;
using oracle::angle_deg;

TEST_SUITE("unit") {

    TEST_CASE("patch_complex: a cube's complex has 8 vertices, 12 edges of two patches, and no crease between averaged "
              "normals") {
        const BaseSurface base(unit_cube());
        check_consistent(base.complex());
        CHECK(base.complex().vertices == 8);
        CHECK(base.complex().edges == 12);
        CHECK(euler(base.complex()) == 2);
        CHECK(boundary_edges(base.complex()) == 0);
        for (std::uint32_t e = 0; e < 12; ++e) {
            CHECK(!base.complex().crease[e]);
            CHECK(!base.complex().seam[e]);
        }
    }

    TEST_CASE("patch_complex: normals split in the file are creases, at edges and vertices") {
        Mesh mesh = unit_cube();
        mesh.normals = {{0, 0, -1}, {0, 0, 1}, {0, -1, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}};
        for (std::uint32_t c = 0; c < mesh.corners(); ++c) mesh.corner_normal.push_back(c / 4);
        const BaseSurface base(mesh);
        for (std::uint32_t e = 0; e < 12; ++e) CHECK(base.complex().crease[e]);
        for (std::uint32_t v = 0; v < 8; ++v) CHECK(base.complex().sharp_vertex[v]);
        CHECK(glm::length(at(base, 0, 0.3, 0.8).jet.n - Vec3d(0, 0, -1)) == 0);
    }

    TEST_CASE("patch_complex: a torus mesh closes, with seams where its uvs jump and nowhere else") {
        const BaseSurface base(oracle::torus_mesh(16, 12, true));
        const PatchComplex& complex = base.complex();
        check_consistent(complex);
        CHECK(euler(complex) == 0);
        CHECK(boundary_edges(complex) == 0);
        CHECK(std::count(complex.seam.begin(), complex.seam.end(), true) == 16 + 12);
        CHECK(std::count(complex.crease.begin(), complex.crease.end(), true) == 0);
        const Disagreement d = edge_disagreement(base);
        CHECK(d.p < 1e-15); // two roundings of numbers near 1
        CHECK(d.n < 1e-15);
        CHECK(d.uv < 1e-15);
    }

    TEST_CASE("patch_complex: a Moebius strip's faces meet the same way round at one edge") {
        const BaseSurface base(moebius(24));
        check_consistent(base.complex());
        CHECK(euler(base.complex()) == 0);
        CHECK(boundary_edges(base.complex()) == 48);
        CHECK(edge_disagreement(base).p < 1e-15);
    }

    TEST_CASE("patch_complex: positions that are bit-equal are one vertex, -0 and 0 too") {
        Mesh mesh = polygons(
            {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, -0.0f, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {7, 7, 7}},
            {{0, 1, 2, 3}, {4, 5, 6, 7}});
        const BaseSurface base(mesh);
        check_consistent(base.complex());
        CHECK(base.complex().vertices == 6);
        CHECK(base.complex().edges == 7);
    }

    TEST_CASE("patch_complex: a cage's limit has the cage's complex; with other faces than quads, its corners'") {
        const BaseSurface whole(unit_cube(), {});
        check_consistent(whole.complex());
        CHECK(whole.complex().patches.size() == 6);
        CHECK(whole.complex().edges == 12);
        CHECK(euler(whole.complex()) == 2);
        Mesh prism = polygons({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}},
                              {{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}});
        const BaseSurface corners(prism, {});
        check_consistent(corners.complex());
        CHECK(corners.complex().patches.size() == 18);
        CHECK(corners.complex().vertices == 6 + 9 + 5);
        CHECK(euler(corners.complex()) == 2);
        CHECK(boundary_edges(corners.complex()) == 0);
        for (const BaseSurface* base : {&whole, &corners}) {
            const Disagreement d = edge_disagreement(*base);
            CHECK(d.p < 1e-12);
            CHECK(d.n < 1e-5); // the limit evaluator promises 0.01 deg
        }
        // The limit of a cage pushed apart has its faces where the patches say.
        for (std::uint32_t i = 0; i < 18; ++i) {
            const std::uint32_t face = corners.complex().patches[i].face;
            CHECK((at(corners, i, 0.5, 0.5).jet.n.z < -0.5) == (face == 0));
            CHECK((at(corners, i, 0.5, 0.5).jet.n.z > 0.5) == (face == 1));
        }
    }

    TEST_CASE("patch_complex: infinitely sharp edges of a cage are creases, semi-sharp ones are not") {
        for (const float sharpness : {0.0f, 2.0f, 10.0f}) {
            Mesh mesh = unit_cube();
            for (const auto& [a, b] : {std::pair(4u, 5u), {5u, 6u}, {6u, 7u}, {7u, 4u}})
                mesh.tags.creases.push_back({a, b, sharpness});
            const BaseSurface base(mesh, {});
            CHECK(std::count(base.complex().crease.begin(), base.complex().crease.end(), true) ==
                  (sharpness == 10 ? 4 : 0));
            CHECK(std::count(base.complex().sharp_vertex.begin(), base.complex().sharp_vertex.end(), true) ==
                  (sharpness == 10 ? 4 : 0));
            // The top's sides are one smooth curve at its corners: no tangents there, but a normal.
            if (sharpness == 10)
                CHECK(angle_deg(at(base, 1, 1, 0).jet.n, {0, 0, 1}) < 0.2); // by second derivatives at the vertex
        }
    }

    TEST_CASE("patch_complex: shapes close where they should, with seams at the borders of the chart") {
        const auto seams = [](const BaseSurface& base) {
            return std::count(base.complex().seam.begin(), base.complex().seam.end(), true);
        };
        const BaseSurface torus(ParametricSurface("torus"), 12, 8);
        check_consistent(torus.complex());
        CHECK(euler(torus.complex()) == 0);
        CHECK(boundary_edges(torus.complex()) == 0);
        CHECK(seams(torus) == 12 + 8);
        const BaseSurface sphere(ParametricSurface("sphere"), 12, 8);
        check_consistent(sphere.complex());
        CHECK(euler(sphere.complex()) == 2);
        CHECK(boundary_edges(sphere.complex()) == 24); // the poles' edges, which have no length
        CHECK(seams(sphere) == 8);
        CHECK(edge_disagreement(sphere).p < 1e-14);
        const BaseSurface strip(ParametricSurface("moebius"), 12, 4);
        check_consistent(strip.complex());
        CHECK(euler(strip.complex()) == 0);
        CHECK(boundary_edges(strip.complex()) == 24);
        CHECK(std::count(strip.complex().crease.begin(), strip.complex().crease.end(), true) ==
              4); // n turns over there
        CHECK(edge_disagreement(strip).p < 1e-14);
    }
}

TEST_SUITE("stability") {

    TEST_CASE(
        "patch_complex: faces that repeat a position or have no area leave the complex and their neighbours whole") {
        Mesh mesh = unit_cube();
        const auto add = [&](std::initializer_list<std::uint32_t> face) {
            mesh.corner_position.insert(mesh.corner_position.end(), face);
            mesh.face_begin.push_back(std::uint32_t(mesh.corners()));
        };
        add({0, 1, 0}), add({2, 2, 2}), add({4, 4, 5, 5}), add({0, 1, 1, 2});
        const BaseSurface base(mesh);
        check_consistent(base.complex());
        for (std::uint32_t i = 6; i < 10; ++i)
            for (const auto& [s, t] : {std::pair(0.0, 0.0), {0.3, 0.3}, {1.0, 0.0}}) {
                const SurfacePoint point = at(base, i, s, t);
                CHECK(
                    std::isfinite(glm::length(point.jet.p_u) + glm::length(point.jet.n_u) + glm::length(point.jet.n)));
            }
        CHECK(at(base, 7, 0.2, 0.2).jet.sigma == 0);
        CHECK(glm::length(at(base, 7, 0.2, 0.2).jet.n) == doctest::Approx(1)); // the limit normal, so that it can move
        CHECK(angle_deg(at(base, 1, 0.5, 0.5).jet.n, {0, 0, 1}) < 1e-6);
    }

    TEST_CASE("patch_complex: an edge of three faces is one edge") {
        const BaseSurface base(read_mesh(own_meshes() / "trouble/nonmanifold_edge.obj"));
        check_consistent(base.complex());
        std::vector<int> count(base.complex().edges, 0);
        for (const auto& patch : base.complex().patches)
            for (int k = 0; k < patch.sides(); ++k) ++count[patch.edge[k]];
        CHECK(*std::max_element(count.begin(), count.end()) >= 3);
    }
}

TEST_SUITE("real" * doctest::skip(no_shared_data())) {

    TEST_CASE("patch_complex: Spot is a closed complex of genus 0, cage and triangles; its edges agree") {
        for (const char* name : {"spot_control_mesh.obj", "spot_quadrangulated.obj", "spot_triangulated.obj"}) {
            const BaseSurface base(read_mesh(shared_data() / "meshes/spot" / name));
            check_consistent(base.complex());
            CHECK(euler(base.complex()) == 2);
            CHECK(boundary_edges(base.complex()) == 0);
            const Disagreement d = edge_disagreement(base, {0.5});
            CHECK(d.p < 1e-15);
            CHECK(d.n < 1e-12);
        }
    }

    TEST_CASE("patch_complex: Spot's cage and mixed cages have closed limits whose patches agree at their edges") {
        const BaseSurface spot(read_mesh(shared_data() / "meshes/spot/spot_control_mesh.obj"), {});
        check_consistent(spot.complex());
        CHECK(euler(spot.complex()) == 2);
        CHECK(boundary_edges(spot.complex()) == 0);
        const Disagreement d = edge_disagreement(spot, {0.0, 0.5});
        CHECK(d.p < 1e-14);
        CHECK(d.n < 1e-6);
        CHECK(d.uv < 1e-7);
        const BaseSurface mixed(read_mesh(shared_data() / "meshes/opensubdiv/catmark_nonquads.obj"), {});
        check_consistent(mixed.complex());
        CHECK(edge_disagreement(mixed, {0.0, 0.5}).p < 1e-12);
    }

    TEST_CASE("patch_complex: the teapot is a consistent complex") {
        const BaseSurface base(read_mesh(shared_data() / "meshes/materialx/teapot.obj"));
        check_consistent(base.complex());
        CHECK(edge_disagreement(base, {0.5}).p < 1e-14);
    }
}
