// Junctions: which sides of a vertex or edge share a uv and a normal.
#include "bake/surface/patch/base_surface.h"
#include "oracle/surfaces.h"
#include "surface/subdivision/cages.h"
#include <doctest/doctest.h>

using namespace bake;

namespace {

/// The junction of the vertex at the top of a surface of revolution.
const Junction* top_junction(const BaseSurface& surface) {
    const PatchComplex& complex = surface.complex();
    const PatchComplex::Patch& last = complex.patches.back();
    return surface.junctions().vertices.find(last.vertex[2]);
}

/// A box with one normal per face.
Mesh box_with_facet_normals() {
    Mesh mesh = bake_tests::box();
    for (std::uint32_t f = 0; f < mesh.faces(); ++f) {
        const auto at = [&](std::uint32_t k) { return mesh.positions[mesh.corner_position[mesh.face_begin[f] + k]]; };
        mesh.normals.push_back(glm::normalize(glm::cross(at(1) - at(0), at(2) - at(0))));
        mesh.corner_normal.insert(mesh.corner_normal.end(), 4, f);
    }
    return mesh;
}

} // namespace

TEST_SUITE("unit") {

    TEST_CASE("junctions: a smooth closed surface without seams has none") {
        const BaseSurface surface(bake_tests::box(), SubdivisionOptions{});
        CHECK(surface.junctions().edges.junctions.empty());
        CHECK(surface.junctions().vertices.junctions.empty());
        CHECK(surface.junctions().vertices.find(0) == nullptr);
    }

    TEST_CASE("junctions: the edges and corners of a faceted box have one normal group per face") {
        const BaseSurface surface(box_with_facet_normals());
        const auto& [edges, vertices] = surface.junctions();
        REQUIRE(edges.junctions.size() == 12);
        REQUIRE(vertices.junctions.size() == 8);
        for (const Junction& j : edges.junctions) CHECK(j.normal_groups == 2);
        for (const Junction& j : vertices.junctions) {
            CHECK(j.normal_groups == 3);
            CHECK(vertices.sides_of(j).size() == 3);
        }
        // Every side of the tables belongs to a junction.
        CHECK(edges.sides.size() == 12 * 2);
        CHECK(vertices.sides.size() == 8 * 3);
    }

    TEST_CASE("junctions: a uv seam splits uvs and not normals, and four groups meet where two seams cross") {
        const BaseSurface surface(oracle::torus_mesh(8, 6, true));
        const auto& [edges, vertices] = surface.junctions();
        CHECK(edges.junctions.size() == 8 + 6);
        std::size_t crossings = 0;
        for (const Junction& j : vertices.junctions) {
            CHECK(j.normal_groups == 1);
            CHECK((j.uv_groups == 2 || j.uv_groups == 4));
            crossings += j.uv_groups == 4;
        }
        CHECK(crossings == 1);
    }

    TEST_CASE("junctions: at the tip of a cone each meridian keeps its normal, at the pole of a sphere all share one") {
        const std::uint32_t columns = 6;
        const BaseSurface cone(ParametricSurface("cone:R=1,r=0,h=2"), int(columns), 2);
        const Junction* tip = top_junction(cone);
        REQUIRE(tip != nullptr);
        CHECK(cone.junctions().vertices.sides_of(*tip).size() == 2 * columns); // both ends of the sides without length
        CHECK(tip->normal_groups == columns);
        const BaseSurface sphere(ParametricSurface("sphere"), int(columns), 2);
        const Junction* pole = top_junction(sphere);
        REQUIRE(pole != nullptr);
        CHECK(pole->normal_groups == 1);
    }

} // TEST_SUITE
