#include "mesh/file/mesh_files.h"

using namespace bake;
using namespace bake_tests;

namespace {
using Boundary = SubdivisionTags::Boundary;

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";

bool same_tags(const SubdivisionTags& a, const SubdivisionTags& b) {
    const auto crease = [](const auto& x, const auto& y) {
        return x.a == y.a && x.b == y.b && x.sharpness == y.sharpness;
    };
    const auto corner = [](const auto& x, const auto& y) {
        return x.position == y.position && x.sharpness == y.sharpness;
    };
    return a.boundary == b.boundary &&
           std::equal(a.creases.begin(), a.creases.end(), b.creases.begin(), b.creases.end(), crease) &&
           std::equal(a.corners.begin(), a.corners.end(), b.corners.begin(), b.corners.end(), corner);
}
} // namespace

TEST_SUITE("unit") {
    TEST_CASE("read_mesh: OBJ tags of a cage are read, positions counted from 0") {
        const SubdivisionTags tags = read_text("t.obj", "t crease 2/1/0 3 0 2.5 # before its positions\n" + square +
                                                            "t corner 1/1/0  1  10\nt interpolateboundary 1/0/0 1\n"
                                                            "t facevaryinginterpolateboundary 1/0/0 7\n")
                                         .tags;
        REQUIRE(tags.creases.size() == 1);
        CHECK(tags.creases[0].a == 3);
        CHECK(tags.creases[0].b == 0);
        CHECK(tags.creases[0].sharpness == 2.5f);
        REQUIRE(tags.corners.size() == 1);
        CHECK(tags.corners[0].position == 1);
        CHECK(tags.corners[0].sharpness == 10.0f);
        CHECK(tags.boundary == Boundary::edge_and_corner);
    }

    TEST_CASE("read_mesh: the last boundary rule holds, edge_only where there is none") {
        CHECK(read_text("t.obj", square).tags.boundary == Boundary::edge_only);
        const std::string rule = "t interpolateboundary 1/0/0 ";
        CHECK(read_text("t.obj", square + rule + "0\n").tags.boundary == Boundary::none);
        CHECK(read_text("t.obj", square + rule + "1\n" + rule + "2\n").tags.boundary == Boundary::edge_only);
    }

    TEST_CASE("write_mesh: tags come back from an OBJ as they were") {
        const TemporaryFolder folder;
        Mesh mesh = read_text("t.obj", square);
        mesh.tags = {{{0, 1, 0.1f}, {2, 1, 10}}, {{3, 1.4f}}, Boundary::none};
        for (const Boundary boundary : {Boundary::none, Boundary::edge_only, Boundary::edge_and_corner}) {
            mesh.tags.boundary = boundary;
            write_mesh(folder.file("out.obj"), mesh);
            CHECK(same_tags(read_mesh(folder.file("out.obj")).tags, mesh.tags));
        }
    }

    TEST_CASE("write_mesh: a mesh that is no cage gets no tags") {
        const TemporaryFolder folder;
        write_mesh(folder.file("out.obj"), read_text("t.obj", square));
        CHECK(bytes_of(folder.file("out.obj")).find("\nt ") == std::string::npos);
    }
}

TEST_SUITE("stability") {
    TEST_CASE("read_mesh: a damaged tag is refused with its line and its form") {
        const auto refused = [](const std::string& tag, const std::string& what) {
            CAPTURE(tag);
            const Outcome outcome = outcome_of_text("t.obj", square + tag + "\n");
            CHECK(outcome.code == 3);
            CHECK(outcome.reason.rfind("t.obj:6: ", 0) == 0);
            CHECK(outcome.reason.find(what) != std::string::npos);
        };
        refused("t crease 2/1/0 0 1", "write t crease 2/1/0 a b sharpness");
        refused("t crease 2/1/0 0 1 nan", "write t crease");
        refused("t crease 2/1/0 0 1 -1", "write t crease");
        refused("t crease 2/1/0 0 1 2 3", "write t crease");
        refused("t crease 4/1/0 0 1 2 3 4", "write t crease");
        refused("t crease", "write t crease");
        refused("t crease 2/1/0 0 4 1", "position 4 of 4");
        refused("t crease 2/1/0 -1 2 1", "position -1 of 4");
        refused("t corner 1/1/0 0", "write t corner 1/1/0 a sharpness");
        refused("t corner 1/1/0 99999999999999999999 1", "position 1000000000000000000 of 4");
        refused("t interpolateboundary 1/0/0 3", "write t interpolateboundary 1/0/0 n");
        refused("t interpolateboundary 1/0/0 1 2", "write t interpolateboundary");
    }
}

TEST_SUITE("real" * doctest::skip(test::no_shared_data())) {
    TEST_CASE("read_mesh: the tags of OpenSubdiv's shapes") {
        const auto folder = test::shared_data() / "meshes/opensubdiv";
        const SubdivisionTags car = read_mesh((folder / "catmark_car.obj").string()).tags;
        CHECK(car.creases.size() == 314); // as MANIFEST.md counts them
        CHECK(car.creases[0].a == 9);
        CHECK(car.creases[0].b == 27);
        CHECK(car.creases[0].sharpness == 6.0f);
        const SubdivisionTags cubes = read_mesh((folder / "catmark_cubes_semisharp.obj").string()).tags;
        CHECK(cubes.corners.size() == 2);
        CHECK(cubes.creases.size() == 14);
        CHECK(read_mesh((folder / "catmark_nonquads.obj").string()).tags.boundary == Boundary::edge_and_corner);
    }
}
