#include "bake/mesh/topology.h"
#include "bake/surface/subdivision/subdivision.h"
#include "mesh/file/mesh_files.h"
#include "oracle/surfaces.h"
#include "surface/subdivision/cages.h"
#include <random>

using namespace bake;
using namespace bake_tests;

namespace {

/// What check_cage says, the name of the file left out; empty when it is content.
std::string refusal(const Mesh& cage, Scheme scheme = Scheme::catmark) {
    try {
        check_cage(cage, scheme, "cage.obj");
        return "";
    } catch (const Error& error) {
        CHECK(error.refusal == Refusal::unsuitable);
        const std::string what = error.what();
        CHECK(what.rfind("cage.obj: ", 0) == 0);
        CHECK(what.find('\n') == std::string::npos);
        CHECK(what.find("; ") != std::string::npos); // the mend
        return what.substr(10);
    }
}

std::string refusal_of_file(const std::string& name, Scheme scheme = Scheme::catmark) {
    return refusal(read_mesh((source_folder() / "meshes/trouble" / name).string()), scheme);
}

bool begins(const std::string& text, const std::string& start) { return text.rfind(start, 0) == 0; }

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("check_cage: closed, open, mixed and triangle cages are taken, tags and loose vertices too") {
        CHECK(refusal(box()) == "");
        CHECK(refusal(dome(5)) == "");
        CHECK(refusal(in_triangles(box()), Scheme::loop) == "");
        CHECK(refusal(oracle::torus_mesh(8, 5, true)) == "");
        Mesh tagged = box();
        tagged.positions.emplace_back(9, 9, 9);
        tagged.tags = {{{5, 4, 2}, {0, 1, 10}}, {{3, 1}}, SubdivisionTags::Boundary::none};
        CHECK(refusal(tagged) == "");
    }

    TEST_CASE("check_cage: two faces of the same vertices count as duplicates however they are turned") {
        const std::vector<Vec3f> points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
        CHECK(begins(refusal(cage_of(points, {{0, 1, 2, 3}, {2, 3, 0, 1}})),
                     "face 1 and face 2 lie on the same vertices"));
        CHECK(begins(refusal(cage_of(points, {{0, 1, 2, 3}, {3, 2, 1, 0}})),
                     "face 1 and face 2 lie on the same vertices"));
        CHECK(begins(refusal(cage_of(points, {{0, 1, 2, 3}, {0, 2, 1, 3}})),
                     "face 1 and face 2 lie on the same vertices"));
    }

    TEST_CASE("check_cage: exactly the oriented manifolds are taken, in any order of their faces") {
        // Parts of a torus, with holes that may touch at a vertex; in some a face is turned.
        const Mesh whole = oracle::torus_mesh(6, 4, true);
        std::mt19937 random(5);
        int taken = 0, refused = 0;
        for (int round = 0; round < 400; ++round) {
            std::vector<std::size_t> order;
            for (std::size_t f = 0; f < whole.faces(); ++f)
                if (random() % 16 > unsigned(round % 8)) order.push_back(f);
            std::shuffle(order.begin(), order.end(), random);
            Faces faces;
            for (const std::size_t f : order)
                faces.emplace_back(whole.corner_position.begin() + whole.face_begin[f],
                                   whole.corner_position.begin() + whole.face_begin[f + 1]);
            if (round % 5 == 0) std::reverse(faces[0].begin(), faces[0].end());
            const Mesh cage = cage_of(whole.positions, faces);
            const HalfEdges he = make_half_edges(cage);
            const EdgeTable edges = make_edges(he);
            bool manifold = true;
            for (std::uint32_t e = 0; e < edges.edges(); ++e) {
                const auto sides = edges.of(e);
                manifold &= sides.size() == 1 || (sides.size() == 2 && he.origin[sides[0]] != he.origin[sides[1]]);
            }
            DisjointSets fans = find_fans(he, edges);
            std::vector<int> fans_at(he.vertices, 0);
            for (std::uint32_t h = 0; h < he.size(); ++h) manifold &= fans.find(h) != h || ++fans_at[he.origin[h]] == 1;
            CHECK((refusal(cage) == "") == manifold);
            ++(manifold ? taken : refused);
        }
        CHECK(taken > 50);
        CHECK(refused > 50);
    }

    TEST_CASE("check_cage: cages with a pole of many faces, in any order of the faces") {
        // Linear time: with a walk around the pole per face the large pole takes minutes.
        std::mt19937 random(7);
        for (const std::uint32_t count : {63u, 64u, 300u, 60000u}) {
            std::vector<Vec3f> points = {{0, 0, 1}};
            Faces faces;
            for (std::uint32_t i = 0; i < count; ++i) {
                const double angle = 2 * pi * i / count;
                points.emplace_back(std::cos(angle), std::sin(angle), 0);
                faces.push_back({0, 1 + i, 1 + (i + 1) % count});
            }
            std::shuffle(faces.begin(), faces.end(), random);
            Mesh cage = cage_of(points, faces);
            cage.tags.creases = {{0, 5, 1}, {6, 5, 2}};
            CHECK(refusal(cage) == "");
            cage.tags.creases.push_back({5, 7, 2});
            CHECK(begins(refusal(cage), "there is a crease between vertex 6 and vertex 8, but no edge"));
            std::swap(faces[1][1], faces[1][2]);
            CHECK(refusal(cage_of(points, faces)).find("the same way") != std::string::npos);
            std::swap(faces[1][1], faces[1][2]);
            faces.erase(faces.begin() + 2); // opens the fan
            CHECK(refusal(cage_of(points, faces)) == "");
            faces.erase(faces.begin() + 9); // two fans, unless the two faces are adjacent
            CHECK(refusal(cage_of(points, faces)).find("touch at vertex 1 without") != std::string::npos);
        }
    }

    TEST_CASE("check_cage: of several places the first is named") {
        Mesh cage = box();
        for (const std::uint32_t f : {5u, 2u})
            std::swap(cage.corner_position[4 * f + 1], cage.corner_position[4 * f + 3]);
        CHECK(begins(refusal(cage), "face 1 and face 6 run along the edge between vertex 1 and vertex 4 the same way"));
    }
}

TEST_SUITE("stability") {
    TEST_CASE("check_cage: a non-manifold edge is refused with its place") {
        CHECK(begins(refusal_of_file("nonmanifold_edge.obj"),
                     "three faces or more, among them face 1 and face 2, share the "
                     "edge between vertex 1 and vertex 2; "));
    }
    TEST_CASE("check_cage: a non-manifold vertex is refused with its place") {
        CHECK(begins(refusal_of_file("nonmanifold_vertex.obj"),
                     "face 1 and face 2 touch at vertex 3 without sharing an edge"));
        // Two closed fans, where counting corners and edges sees nothing.
        Mesh twins = box();
        const Mesh other = box();
        for (std::size_t v = 1; v < other.positions.size(); ++v) twins.positions.push_back(-other.positions[v]);
        for (std::size_t f = 0; f < other.faces(); ++f) {
            for (int k = 3; k >= 0; --k) {
                const std::uint32_t v = other.corner_position[4 * f + std::size_t(k)];
                twins.corner_position.push_back(v == 0 ? 0 : v + 7);
            }
            twins.face_begin.push_back(std::uint32_t(twins.corners()));
        }
        CHECK(begins(refusal(twins), "face 1 and face 7 touch at vertex 1 without sharing an edge"));
    }
    TEST_CASE("check_cage: a flipped face is refused with its place") {
        CHECK(begins(refusal_of_file("flipped_face.obj"),
                     "face 1 and face 6 run along the edge between vertex 1 and vertex 4 "
                     "the same way; turn one of them round"));
    }
    TEST_CASE("check_cage: a duplicate face is refused with its place") {
        CHECK(begins(refusal_of_file("duplicate_face.obj"), "face 2 and face 7 lie on the same vertices; remove one"));
    }
    TEST_CASE("check_cage: a face that uses a position twice is refused with its place") {
        CHECK(begins(refusal_of_file("zero_area_face.obj"), "face 3 uses vertex 2 twice"));
    }
    TEST_CASE("check_cage: a crease that is no edge is refused with its place") {
        CHECK(begins(refusal_of_file("crease_without_edge.obj"),
                     "there is a crease between vertex 1 and vertex 7, but no edge"));
        Mesh cage = box();
        cage.tags.creases = {{3, 999, 1}};
        CHECK(begins(refusal(cage), "there is a crease between vertex 4 and vertex 1000, but no edge"));
        cage.tags.creases.clear();
        cage.tags.corners = {{999, 1}};
        CHECK(begins(refusal(cage), "a corner is tagged at vertex 1000, which is not there"));
    }
    TEST_CASE("check_cage: Loop refuses the first face that is no triangle") {
        Mesh cage = in_triangles(box());
        CHECK(refusal(cage, Scheme::loop) == "");
        CHECK(begins(refusal(dome(3), Scheme::loop), "face 1 has 4 corners, and Loop subdivision takes triangles"));
    }
    TEST_CASE("check_cage: a Moebius strip has no way round and is refused") {
        const Mesh strip = cage_of({{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {2, 0, 0}, {2, 1, 0}},
                                   {{0, 2, 3, 1}, {2, 4, 5, 3}, {4, 1, 0, 5}});
        CHECK(refusal(strip).find("the same way") != std::string::npos);
    }
    TEST_CASE("cage, 2-gon: refused by the reader") {
        CHECK(outcome_of(source_folder() / "meshes/trouble/two_index_face.obj").code == 3);
    }
    TEST_CASE("cage, bad index: refused by the reader, beyond the last and zero") {
        for (const char* name : {"index_out_of_range.obj", "index_zero.obj"})
            CHECK_MESSAGE(outcome_of(source_folder() / "meshes/trouble" / name).code == 3, name);
    }
    TEST_CASE("cage, NaN vertex: refused by the reader") {
        CHECK(outcome_of(source_folder() / "meshes/trouble/nan_vertex.obj").code == 3);
    }
}

TEST_SUITE("real" * doctest::skip(test::no_shared_data())) {
    TEST_CASE("check_cage: the collection's cages are taken, its broken ones refused") {
        const auto data = test::shared_data();
        for (const char* name : {"catmark_car", "catmark_cubes_semisharp", "catmark_fvar_bound1", "catmark_nonquads",
                                 "catmark_righthanded", "catmark_torus", "reference/catmark_dart_edgecorner_level1"})
            CHECK_MESSAGE(refusal(read_mesh((data / "meshes/opensubdiv" / name).string() + ".obj")) == "", name);
        CHECK(refusal(read_mesh((data / "meshes/spot/spot_control_mesh.obj").string())) == "");
        CHECK(refusal(read_mesh((data / "meshes/leeperrysmith/LeePerrySmith.obj").string()), Scheme::loop) == "");
        const auto bad = [&](const char* name) { return refusal(read_mesh((data / "bad/meshes" / name).string())); };
        CHECK(bad("osd_catmark_nonman_verts.obj").find("touch at vertex") != std::string::npos);
        CHECK(bad("trimesh_joined_tetrahedra.obj").find("face 4 and face 8 lie on the same vertices") !=
              std::string::npos);
    }
}
