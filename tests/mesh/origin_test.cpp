// Meshes far from zero: their positions keep the digits that the file has.
#include "bake/mesh/check/mesh_distance.h"
#include "bake/mesh/origin.h"
#include "mesh/file/mesh_files.h"
#include "oracle/surfaces.h"

using namespace bake;
using namespace bake_tests;

namespace {

const Vec3d grid(448262.25, 120.5, 5411932.75); // a place in coordinates of a map grid

Mesh far_torus(const Vec3d& place) {
    Mesh mesh = oracle::torus_mesh(48, 24, true);
    mesh.origin = place;
    return mesh;
}

/// Largest distance between the points of two meshes with the same indices, in double.
double deviation(const Mesh& a, const Mesh& b) {
    REQUIRE(a.corners() == b.corners());
    double worst = 0;
    for (std::size_t c = 0; c < a.corners(); ++c) {
        const Vec3d p = a.origin + Vec3d(a.positions[a.corner_position[c]]);
        const Vec3d q = b.origin + Vec3d(b.positions[b.corner_position[c]]);
        worst = std::max(worst, glm::distance(p, q));
    }
    return worst;
}

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("origin_for: far boxes alone have one, close to their centre and with few digits") {
        CHECK(origin_for({-1, -1, -1}, {1, 1, 1}) == Vec3d(0));
        CHECK(origin_for({5, 5, 5}, {7, 7, 7}) == Vec3d(0)); // diagonal 3.5, largest coordinate 7
        CHECK(origin_for({99, 0, 0}, {101, 0, 0}) == Vec3d(100, 0, 0));
        CHECK(origin_for({-101, 0, 0}, {-99, 0, 0}) == Vec3d(-100, 0, 0));
        CHECK(origin_for({7, 7, 7}, {7, 7, 7}) == Vec3d(0)); // a point has no size
        CHECK(origin_for({0, 0, 0}, {0, 0, 0}) == Vec3d(0));
        const Vec3d origin = origin_for(grid - 1.0, grid + 1.0);
        for (int k = 0; k < 3; ++k) {
            CHECK(std::abs(origin[k] - grid[k]) <= 1);
            CHECK(origin[k] == std::floor(origin[k]));
        }
    }

    TEST_CASE("write_mesh, read_mesh: a mesh far from zero comes back to 1e-6 of its size in every format") {
        const TemporaryFolder folder;
        for (const Vec3d& place : {grid, Vec3d(1e6), Vec3d(-3e8, 0, 12)}) {
            const Mesh mesh = far_torus(place);
            const double size = diagonal(bounds(mesh));
            for (const char* name : {"t.obj", "t.ply", "t.glb", "t.gltf"}) {
                write_mesh(folder.file(name), mesh);
                const Mesh back = read_mesh(folder.file(name));
                CAPTURE(name);
                CHECK(back.origin != Vec3d(0));
                CHECK(back.notes.empty());
                if (std::string(name).find(".gl") == std::string::npos) CHECK(deviation(back, mesh) < 1e-7 * size);
                else CHECK(std::abs(diagonal(bounds(back)) / size - 1) < 1e-6); // glTF is in triangles
            }
        }
    }

    TEST_CASE("read_mesh: numbers of a text file near zero are read as before") {
        const Mesh mesh = read_text("t.obj", "v 0.1 0 0\nv 1.1 0 0\nv 0.1 1 0\nf 1 2 3\n");
        CHECK(mesh.origin == Vec3d(0));
        CHECK(mesh.positions[0].x == 0.1f);
    }

    TEST_CASE("read_mesh: OBJ and PLY with coordinates of a map grid, in several pieces of the file and in every PLY "
              "format") {
        std::string obj, rows;
        const int count = 40000;
        for (int i = 0; i < count; ++i) {
            const std::string p =
                "448262." + std::to_string(100000 + i) + " 120.25 5411932." + std::to_string(200000 + 7 * i);
            obj += "v " + p + "\n";
            rows += p + "\n";
        }
        const auto right = [&](const Mesh& mesh) {
            double worst = 0;
            for (int i = 0; i < count; ++i) {
                const Vec3d expected(448262 + (100000 + i) * 1e-6, 120.25, 5411932 + (200000 + 7 * i) * 1e-6);
                worst = std::max(worst, glm::distance(mesh.origin + Vec3d(mesh.positions[std::size_t(i)]), expected));
            }
            return worst < 1e-6 * diagonal(bounds(mesh));
        };
        CHECK(right(read_text("t.obj", obj + "f 1 2 3\n")));
        const std::string head = "element vertex " + std::to_string(count) +
                                 "\nproperty double x\nproperty double y\nproperty double z\nelement face 1\n"
                                 "property list uchar int vertex_indices\nend_header\n";
        const Mesh ascii = read_text("t.ply", "ply\nformat ascii 1.0\n" + head + rows + "3 0 1 2\n");
        CHECK(right(ascii));
        CHECK(ascii.notes.empty());
    }

    TEST_CASE("read_mesh: 32-bit positions far from zero have lost their digits, which a note says") {
        std::string bytes =
            "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
            "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
        const float values[] = {1e6f, 0, 0, 1e6f + 1, 0, 0, 1e6f, 1, 0};
        bytes.append(reinterpret_cast<const char*>(values), sizeof values);
        bytes += char(3);
        const std::uint32_t index[] = {0, 1, 2};
        bytes.append(reinterpret_cast<const char*>(index), sizeof index);
        const Mesh mesh = read_text("t.ply", bytes);
        REQUIRE(mesh.notes.size() == 1);
        CHECK(mesh.notes[0].rfind("the positions are 32-bit floats far from zero", 0) == 0);
        CHECK(mesh.origin + Vec3d(mesh.positions[1]) == Vec3d(1e6 + 1, 0, 0));
    }

    TEST_CASE("move_origin: distances between meshes with different origins are those of their points") {
        const Mesh a = far_torus(grid);
        Mesh b = far_torus(grid + Vec3d(0, 0.01, 0));
        move_origin(b, a.origin);
        const MeshDistance d = mesh_distance(a, triangulate(a), b, triangulate(b));
        CHECK(d.upper == doctest::Approx(0.01).epsilon(0.02));
        CHECK(d.diagonal == doctest::Approx(diagonal(bounds(a))).epsilon(0.01));
    }
}
