#include "bake/base/parallel.h"
#include "bake/mesh/file/mesh_io.h"
#include "bake/mesh/topology.h"
#include "bake/mesh/weld.h"
#include "cli/command.h"
#include "mesh/by_openmesh.h"
#include "mesh/check/triangle_soups.h"
#include <doctest/doctest.h>
#include <random>

using namespace bake;
using namespace bake::test;

namespace {

/// Fans of faces at each vertex.
std::vector<int> fans_at(const Mesh& mesh) {
    const HalfEdges he = make_half_edges(mesh);
    DisjointSets fans = find_fans(he, make_edges(he));
    std::vector<int> count(he.vertices, 0);
    for (std::uint32_t h = 0; h < he.size(); ++h) count[he.origin[h]] += fans.find(h) == h;
    return count;
}

std::uint32_t components(const Mesh& mesh) {
    const HalfEdges he = make_half_edges(mesh);
    return connected_faces(make_edges(he), he.faces(), [&](std::uint32_t h) { return he.face[h]; }).numbers().sets;
}

long euler(const Mesh& mesh) {
    return long(mesh.positions.size()) - long(make_edges(make_half_edges(mesh)).edges()) + long(mesh.faces());
}

/// Edges, mates, fans and orientation of an oriented manifold are those of OpenMesh's half-edges.
void compare_with_openmesh(const Mesh& mesh) {
    const ByOpenMesh other = by_openmesh(mesh);
    REQUIRE(other.refused == 0);
    const HalfEdges he = make_half_edges(mesh);
    const EdgeTable edges = make_edges(he);
    const std::vector<std::uint32_t> mate = find_mates(he, edges);
    CHECK(edges.edges() == other.mesh.n_edges());
    bool same_faces = true;
    for (std::uint32_t h = 0; h < he.size(); ++h) {
        const auto theirs = other.mesh.find_halfedge(OpenMesh::VertexHandle(int(he.origin[h])),
                                                     OpenMesh::VertexHandle(int(he.target(h))));
        const int beyond = mate[h] == no_index ? -1 : int(he.face[mate[h]]);
        same_faces &= theirs.face().idx() == int(he.face[h]) && theirs.opp().face().idx() == beyond;
    }
    CHECK(same_faces);
    // OpenMesh links the fans of a vertex through the gaps between them.
    const std::vector<int> fans = fans_at(mesh);
    bool same_fans = true;
    for (const auto& vertex : other.mesh.vertices()) {
        int gaps = 0;
        for (const auto& h : vertex.outgoing_halfedges()) gaps += h.is_boundary();
        same_fans &= fans[std::size_t(vertex.idx())] == (!vertex.halfedge().is_valid() ? 0 : std::max(gaps, 1));
    }
    CHECK(same_fans);
}

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("DisjointSets: the lowest member represents its set, whatever the order of the joins") {
        std::mt19937 random(3);
        std::vector<std::array<std::uint32_t, 2>> joins;
        for (int i = 0; i < 60; ++i) joins.push_back({std::uint32_t(random() % 100), std::uint32_t(random() % 100)});
        std::vector<std::uint32_t> first;
        for (int round = 0; round < 5; ++round) {
            DisjointSets sets(100);
            for (const auto& [a, b] : joins) round % 2 ? sets.join(a, b) : sets.join(b, a);
            std::vector<std::uint32_t> found;
            for (std::uint32_t i = 0; i < 100; ++i) found.push_back(sets.find(i));
            for (std::uint32_t i = 0; i < 100; ++i) CHECK(found[i] <= i);
            for (const auto& [a, b] : joins) CHECK(found[a] == found[b]);
            if (round == 0) first = found;
            CHECK(found == first);
            std::shuffle(joins.begin(), joins.end(), random);
        }
    }

    TEST_CASE("DisjointSets: sets are numbered in the order of their lowest members") {
        DisjointSets sets(6);
        sets.join(5, 1);
        sets.join(4, 2);
        const DisjointSets::Numbers numbers = sets.numbers();
        CHECK(numbers.sets == 4);
        CHECK(numbers.set == std::vector<std::uint32_t>{0, 1, 2, 3, 2, 1});
    }

    TEST_CASE("make_edges: edges are sorted by their vertices, their sides by number") {
        const HalfEdges he = make_half_edges(unit_sphere(12, 7));
        const EdgeTable edges = make_edges(he);
        std::array<std::uint32_t, 2> before = {0, 0};
        std::size_t sides = 0;
        for (std::uint32_t e = 0; e < edges.edges(); ++e) {
            REQUIRE(edges.of(e).size() == 2);
            std::array<std::uint32_t, 2> ends{};
            for (const std::uint32_t h : edges.of(e)) {
                CHECK(edges.edge[h] == e);
                const auto [low, high] = std::minmax({he.origin[h], he.target(h)});
                if (h != edges.of(e)[0]) CHECK(ends == std::array{low, high});
                ends = {low, high};
                ++sides;
            }
            CHECK(before < ends);
            CHECK(edges.of(e)[0] < edges.of(e)[1]);
            before = ends;
        }
        CHECK(sides == he.size());
    }

    TEST_CASE("make_edges: absent sides have no edge, sides without length one each") {
        const std::vector<SideEnds> ends = {{3, 1}, {no_index, no_index}, {2, 2}, {1, 3}, {2, 2}, {2, 3}};
        const EdgeTable edges = make_edges(4, 6, [&](std::uint32_t side) { return ends[side]; });
        CHECK(edges.edges() == 4);
        CHECK(edges.edge == std::vector<std::uint32_t>{0, no_index, 1, 0, 2, 3});
    }

    TEST_CASE("make_edges: any number of threads gives the same table") {
        const HalfEdges he = make_half_edges(unit_sphere(300, 200));
        const EdgeTable many = make_edges(he);
        const ThreadLimit one(1);
        const EdgeTable single = make_edges(he);
        CHECK(many.edge == single.edge);
        CHECK(many.begin == single.begin);
        CHECK(many.sides == single.sides);
    }

    TEST_CASE("half-edges: next and previous are inverse and stay in the face; the mate of the mate is the half-edge") {
        const Mesh mesh = unit_sphere(9, 6);
        const HalfEdges he = make_half_edges(mesh);
        const std::vector<std::uint32_t> mate = find_mates(he, make_edges(he));
        CHECK(he.size() == mesh.corners());
        for (std::uint32_t h = 0; h < he.size(); ++h) {
            CHECK(he.origin[h] == mesh.corner_position[h]);
            CHECK(he.previous(he.next(h)) == h);
            CHECK(he.face[he.next(h)] == he.face[h]);
            REQUIRE(mate[h] != no_index);
            CHECK(mate[mate[h]] == h);
            CHECK(he.target(mate[h]) == he.origin[h]);
        }
    }

    TEST_CASE("Euler: V - E + F is 2 for a sphere, 0 for a torus, 1 for a disc") {
        CHECK(euler(unit_sphere(8, 5)) == 2);
        CHECK(euler(oracle::torus_mesh(8, 5, true)) == 0);
        CHECK(euler(mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}})) == 1);
    }

    TEST_CASE("fans and components: faces that share a vertex only are two of each") {
        const Mesh bow = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}, {{0, 1, 2}, {0, 3, 4}});
        CHECK(fans_at(bow) == std::vector<int>{2, 1, 1, 1, 1});
        CHECK(components(bow) == 2);
        CHECK(components(together(cube(), moved(cube(), 1, {5, 0, 0}))) == 2);
        CHECK(components(cube()) == 1);
    }

    TEST_CASE("fans: faces of both orientations are one fan where they share an edge") {
        Faces faces = unit_cube_faces;
        std::reverse(faces[2].begin(), faces[2].end());
        CHECK(fans_at(mesh_of(unit_cube_corners, faces)) == std::vector<int>(8, 1));
    }

    TEST_CASE("half-edges of welded vertices: two triangles with points of their own share the edge") {
        const Mesh apart =
            mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {3, 4, 5}});
        CHECK(make_edges(make_half_edges(apart)).edges() == 6);
        const EdgeTable welded = make_edges(make_half_edges(apart, first_equal(apart.positions)));
        CHECK(welded.edges() == 5);
    }
}

TEST_SUITE("stability") {
    TEST_CASE("topology: an empty mesh has nothing") {
        const HalfEdges he = make_half_edges(Mesh{});
        const EdgeTable edges = make_edges(he);
        CHECK(he.size() == 0);
        CHECK(he.faces() == 0);
        CHECK(edges.edges() == 0);
        CHECK(find_mates(he, edges).empty());
        CHECK(find_fans(he, edges).numbers().sets == 0);
        CHECK(components(Mesh{}) == 0);
    }

    TEST_CASE("topology: one triangle has three edges without mates, three fans, one component") {
        const Mesh triangle = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
        const HalfEdges he = make_half_edges(triangle);
        CHECK(make_edges(he).edges() == 3);
        CHECK(find_mates(he, make_edges(he)) == std::vector<std::uint32_t>(3, no_index));
        CHECK(fans_at(triangle) == std::vector<int>{1, 1, 1});
        CHECK(components(triangle) == 1);
    }

    TEST_CASE("topology: an edge of three faces keeps all of them, in one fan and one component, without mates") {
        const Mesh book =
            mesh_of({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}}, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
        const HalfEdges he = make_half_edges(book);
        const EdgeTable edges = make_edges(he);
        CHECK(edges.edges() == 7);
        CHECK(std::vector<std::uint32_t>(edges.of(0).begin(), edges.of(0).end()) ==
              std::vector<std::uint32_t>{0, 3, 6});
        CHECK(find_mates(he, edges) == std::vector<std::uint32_t>(9, no_index));
        CHECK(fans_at(book) == std::vector<int>(5, 1));
        CHECK(components(book) == 1);
    }

    TEST_CASE(
        "topology: corners that repeat their predecessor are skipped, and a face without three others has no edges") {
        const Mesh mesh =
            mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 0, 1, 2, 0}, {0, 1, 0, 1}, {0, 0, 1}, {1, 1, 1}});
        const HalfEdges he = make_half_edges(mesh);
        CHECK(he.face_begin == std::vector<std::uint32_t>{0, 3, 7, 7, 7});
        CHECK(he.origin == std::vector<std::uint32_t>{0, 1, 2, 0, 1, 0, 1});
        CHECK(make_edges(he).edges() == 3); // the second face passes along one edge four times
        CHECK(make_edges(he).of(0).size() == 5);
        CHECK(components(mesh) == 3);
    }
}

TEST_SUITE("oracle") {
    TEST_CASE("topology: edges, mates and fans of the project's shapes are OpenMesh's") {
        compare_with_openmesh(unit_sphere(40, 23));
        compare_with_openmesh(oracle::torus_mesh(12, 9, true));
        for (const char* name :
             {"sphere.obj", "torus.obj", "trouble/nonmanifold_vertex.obj", "trouble/missing_uvs.obj"}) {
            CAPTURE(name);
            compare_with_openmesh(read_mesh((own_meshes() / name).string()));
        }
    }
}

TEST_SUITE("real" * doctest::skip(no_shared_data())) {
    TEST_CASE("topology: edges, mates and fans of real meshes are OpenMesh's") {
        for (const char* name : {"materialx/teapot.obj", "opensubdiv/catmark_car.obj", "materialx/boombox.obj",
                                 "gltf/NormalTangentTest.obj", "opensubdiv/catmark_nonquads.obj",
                                 "spot/spot_control_mesh.obj", "leeperrysmith/LeePerrySmith.obj"}) {
            CAPTURE(name);
            compare_with_openmesh(read_mesh((shared_data() / "meshes" / name).string()));
        }
    }
}
