// Normals that follow from the smoothing groups of an OBJ.
#include "mesh/file/mesh_files.h"
#include "oracle/surfaces.h"

using namespace bake;
using namespace bake_tests;

namespace {

const std::string points = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n";

/// A cube; before each face stands the line that `line` gives for it.
template <class Line> Mesh cube(const Line& line, const std::string& head = "", const std::string& corner_end = "") {
    const char* const faces[6][4] = {{"1", "4", "3", "2"}, {"5", "6", "7", "8"}, {"1", "2", "6", "5"},
                                     {"3", "4", "8", "7"}, {"2", "3", "7", "6"}, {"1", "5", "8", "4"}};
    std::string text = head + points;
    for (int f = 0; f < 6; ++f) {
        text += line(f) + "f";
        for (const char* corner : faces[f]) text += std::string(" ") + corner + (f < 2 ? corner_end : "");
        text += "\n";
    }
    return read_text("t.obj", text);
}

Vec3f normal(const Mesh& mesh, std::size_t corner) { return mesh.normals[mesh.corner_normal[corner]]; }

const Vec3f axes[6] = {{0, 0, -1}, {0, 0, 1}, {0, -1, 0}, {0, 1, 0}, {1, 0, 0}, {-1, 0, 0}};

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("read_mesh: OBJ smoothing groups split normals where there are no vn") {
        for (const Mesh& mesh : {cube([](int f) { return "s " + std::to_string(f + 1) + "\n"; }),
                                 cube([](int f) { return f == 0 ? std::string("s off\n") : std::string(); }),
                                 cube([](int f) { return f == 3 ? std::string("s 0\n") : std::string(); })}) {
            REQUIRE(mesh.corner_normal.size() == 24);
            for (std::size_t c = 0; c < 24; ++c) CHECK(glm::distance(normal(mesh, c), axes[c / 4]) < 1e-6f);
            CHECK(mesh.notes.size() == 1);
        }
    }

    TEST_CASE("read_mesh: within a smoothing group normals are averaged, wherever in the file its faces stand") {
        // Groups 1 (z), 2 (y) and 1 again (x): the sides along x and z are smooth to each other, those along y are flat.
        const Mesh mesh =
            cube([](int f) { return f % 2 ? std::string() : "s " + std::string(f == 2 ? "2" : "1") + "\n"; });
        for (std::size_t c = 0; c < 24; ++c) {
            const Vec3f n = normal(mesh, c), p = mesh.positions[mesh.corner_position[c]];
            const bool y = c / 4 == 2 || c / 4 == 3;
            const Vec3f expected = y ? axes[c / 4] : Vec3f(Vec3f(p.x * 2 - 1, 0, p.z * 2 - 1) * float(std::sqrt(0.5)));
            CHECK(glm::distance(n, expected) < 1e-6f);
        }
        // The two faces along y that meet at no edge share no normal.
        CHECK(mesh.corner_normal[8] != mesh.corner_normal[12]);
        CHECK(mesh.notes[0] == "normals follow the smoothing groups of the file: 0 of 6 faces are flat");
    }

    TEST_CASE("read_mesh: one smoothing group, or none, is a smooth mesh without normals of its own") {
        for (const Mesh& mesh : {cube([](int) { return std::string(); }),
                                 cube([](int f) { return f == 0 ? std::string("s 1\n") : std::string(); }),
                                 cube([](int f) { return f == 0 ? std::string("s on\n") : std::string(); }),
                                 cube([](int f) { return f == 0 ? std::string("s 7 # all\n") : std::string(); })}) {
            CHECK(mesh.corner_normal.empty());
            CHECK(mesh.normals.empty());
            CHECK(mesh.notes.empty());
        }
    }

    TEST_CASE("read_mesh: corners with vn keep it, the others follow their group") {
        const Mesh mesh =
            cube([](int f) { return f == 0 ? std::string("s off\n") : std::string(); }, "vn 1 2 3\n", "//1");
        for (std::size_t c = 0; c < 24; ++c)
            CHECK(glm::distance(normal(mesh, c), c < 8 ? Vec3f(1, 2, 3) : axes[c / 4]) < 1e-6f);
    }

    TEST_CASE("read_mesh: smoothing groups and faces without area, polygons and many pieces of the file") {
        CHECK(read_text("t.obj", "s off\nv 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 4\n").corner_normal[0] ==
              no_index);
        std::string text = "s off\n";
        const int faces = 30000; // more than one piece
        for (int i = 0; i < faces; ++i) {
            const std::string x = std::to_string(i);
            text += "v " + x + " 0 0\nv " + x + ".5 0 0\nv " + x + " 1 1\nf -3 -2 -1\n";
            if (i == faces / 2) text += "s 1\n";
        }
        const Mesh mesh = read_text("t.obj", text);
        REQUIRE(mesh.corner_normal.size() == std::size_t(3 * faces));
        for (std::size_t c = 0; c < mesh.corners(); ++c)
            CHECK(glm::distance(normal(mesh, c), Vec3f(0, -1, 1) * float(std::sqrt(0.5))) < 1e-5f);
        CHECK(mesh.normals.size() == std::size_t(faces / 2 + 1 + 3 * (faces - faces / 2 - 1)));
    }
}
