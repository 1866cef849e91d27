#include "bake/mesh/check/mesh_check.h"
#include "bake/mesh/file/mesh_io.h"
#include "folders.h"
#include "growth.h"
#include "mesh/by_openmesh.h"
#include "mesh/check/triangle_soups.h"
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <doctest/doctest.h>
#include <filesystem>
#include <random>
#include <set>

using namespace bake;
using namespace bake::test;

namespace {

MeshCheck check(const Mesh& mesh) { return check_mesh(mesh, triangulate(mesh)); }

// n x n quads over the unit square, those for which keep(x, y) is false left out.
template <class Keep> Mesh sheet(int n, const Keep& keep) {
    std::vector<Vec3f> positions;
    for (int y = 0; y <= n; ++y)
        for (int x = 0; x <= n; ++x) positions.push_back({float(x) / n, float(y) / n, 0});
    Faces faces;
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            const auto at = [n](int i, int j) { return std::uint32_t(j * (n + 1) + i); };
            if (keep(x, y)) faces.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)});
        }
    return mesh_of(positions, faces);
}

// Boundary loops and components of OpenMesh's half-edges; the mesh must be manifold.
std::pair<std::size_t, std::size_t> loops_and_components(const Mesh& mesh) {
    const ByOpenMesh other = by_openmesh(mesh);
    REQUIRE(other.refused == 0);
    const OpenMesh::PolyConnectivity& open = other.mesh;
    std::set<int> seen;
    std::size_t loops = 0, components = 0;
    for (const auto& h : open.halfedges()) {
        if (!h.is_boundary() || seen.count(h.idx())) continue;
        ++loops;
        for (auto e = h; seen.insert(e.idx()).second; e = e.next()) {
        }
    }
    std::set<int> reached;
    for (const auto& f : open.faces()) {
        if (!reached.insert(f.idx()).second) continue;
        ++components;
        std::vector<OpenMesh::SmartFaceHandle> stack = {f};
        while (!stack.empty()) {
            const auto top = stack.back();
            stack.pop_back();
            for (const auto& g : top.faces())
                if (reached.insert(g.idx()).second) stack.push_back(g);
        }
    }
    return {loops, components};
}

/// At each of n places a cube that looks outwards and one of half its size that looks inwards, inside it at every third
/// place, beside it at the next and around its corner at the one after.
Mesh cubes_in_cubes(int n) {
    std::vector<Vec3f> positions;
    Faces faces;
    for (int i = 0; i < 2 * n; ++i) {
        const bool inwards = i % 2;
        const int place = i / 2;
        const float inside[] = {0.25f, 1.25f, 0.75f};
        const Vec3f at(4 * float(place % 100), 4 * float(place / 100), 0);
        const auto first = std::uint32_t(positions.size());
        for (const Vec3f& p : unit_cube_corners)
            positions.push_back(at + (inwards ? Vec3f(inside[place % 3]) + 0.5f * p : p));
        for (auto face : unit_cube_faces) {
            for (auto& k : face) k += first;
            if (inwards) std::reverse(face.begin(), face.end());
            faces.push_back(face);
        }
    }
    return mesh_of(positions, faces);
}

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("check_mesh: a cube is one closed component, nothing wrong with it") {
        const MeshCheck c = check(cube());
        CHECK(c.positions == 8);
        CHECK(c.faces == 6);
        CHECK(c.corners == 24);
        CHECK(c.triangles == 12);
        CHECK(c.faces_of_size[4] == 6);
        CHECK(c.topology.edges == 12);
        CHECK(c.topology.boundary_edges == 0);
        CHECK(c.topology.boundary_loops == 0);
        CHECK(c.topology.components == 1);
        CHECK(c.topology.closed_components == 1);
        CHECK(c.topology.inside_out_components == 0);
        CHECK(c.topology.flipped_faces == 0);
        CHECK(c.topology.nonmanifold_edges == 0);
        CHECK(c.topology.nonmanifold_vertices == 0);
        CHECK(c.area == doctest::Approx(6));
        CHECK(c.diagonal == doctest::Approx(std::sqrt(3.0)));
        CHECK(c.faces_without_uv == 6);
        CHECK(c.zero_area_faces == 0);
    }

    TEST_CASE("check_mesh: one turned face is flipped, and makes no boundary") {
        Faces faces = unit_cube_faces;
        std::reverse(faces[3].begin(), faces[3].end());
        const MeshCheck c = check(mesh_of(unit_cube_corners, faces));
        CHECK(c.topology.flipped_faces == 1);
        CHECK(c.topology.boundary_edges == 0);
        CHECK(c.topology.boundary_loops == 0);
        CHECK(c.topology.closed_components == 0);
        CHECK(c.topology.nonmanifold_vertices == 0);
    }

    TEST_CASE("check_mesh: turned faces do not break the loop of a hole beside them") {
        Faces faces = unit_cube_faces;
        faces.pop_back();
        for (std::size_t turned = 0; turned < faces.size(); ++turned) {
            Faces some = faces;
            std::reverse(some[turned].begin(), some[turned].end());
            const MeshCheck c = check(mesh_of(unit_cube_corners, some));
            CHECK(c.topology.flipped_faces == 1);
            CHECK(c.topology.boundary_edges == 4);
            CHECK(c.topology.boundary_loops == 1);
        }
    }

    TEST_CASE("check_mesh: all faces turned are none flipped, but the component is inside out") {
        Faces faces = unit_cube_faces;
        for (auto& f : faces) std::reverse(f.begin(), f.end());
        const MeshCheck c = check(mesh_of(unit_cube_corners, faces));
        CHECK(c.topology.flipped_faces == 0);
        CHECK(c.topology.inside_out_components == 1);
    }

    TEST_CASE("check_mesh: the inner wall of a hollow cube rightly looks inwards") {
        std::vector<Vec3f> positions = unit_cube_corners;
        Faces faces = unit_cube_faces;
        for (const Vec3f& p : unit_cube_corners) positions.push_back(Vec3f(0.25f) + 0.5f * p);
        for (auto face : unit_cube_faces) {
            for (auto& i : face) i += 8;
            std::reverse(face.begin(), face.end());
            faces.push_back(face);
        }
        const MeshCheck c = check(mesh_of(positions, faces));
        CHECK(c.topology.components == 2);
        CHECK(c.topology.closed_components == 2);
        CHECK(c.topology.inside_out_components == 0);
    }

    TEST_CASE("check_mesh: of many cubes those with a larger one around them may look inwards") {
        const MeshCheck c = check(cubes_in_cubes(60));
        CHECK(c.topology.closed_components == 120);
        CHECK(c.topology.inside_out_components == 40); // those at 1 and 2 of each three places
    }

    TEST_CASE("check_mesh: a third face on an edge, and two fans at a vertex, are non-manifold") {
        const std::vector<Vec3f> positions = {{0, 0, 0}, {1, 0, 0},  {0, 1, 0}, {0, -1, 0},
                                              {0, 0, 1}, {-1, 1, 0}, {-1, 0, 0}};
        const MeshCheck fin = check(mesh_of(positions, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}));
        CHECK(fin.topology.nonmanifold_edges == 1);
        CHECK(fin.topology.nonmanifold_vertices == 2);
        CHECK(fin.topology.boundary_edges == 6);
        CHECK(fin.topology.components == 1);
        CHECK(fin.unused_positions == 2);
        const MeshCheck bow = check(mesh_of(positions, {{0, 1, 2}, {0, 5, 6}}));
        CHECK(bow.topology.nonmanifold_edges == 0);
        CHECK(bow.topology.nonmanifold_vertices == 1);
        CHECK(bow.topology.components == 2);
        CHECK(bow.topology.boundary_loops == 2);
    }

    TEST_CASE("check_mesh: a Moebius strip has one loop and cannot agree") {
        const int n = 12;
        std::vector<Vec3f> positions;
        for (int i = 0; i < n; ++i)
            for (const float w : {-0.3f, 0.3f}) {
                const float a = 2 * 3.14159265f * i / n;
                positions.push_back({(1 + w * std::cos(a / 2)) * std::cos(a), (1 + w * std::cos(a / 2)) * std::sin(a),
                                     w * std::sin(a / 2)});
            }
        Faces faces;
        for (std::uint32_t i = 0; i + 1 < n; ++i) faces.push_back({2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1});
        faces.push_back({2 * n - 2, 1, 0, 2 * n - 1});
        const MeshCheck c = check(mesh_of(positions, faces));
        CHECK(c.topology.unorientable_edges == 1);
        CHECK(c.topology.flipped_faces == 0);
        CHECK(c.topology.boundary_edges == 2 * n);
        CHECK(c.topology.boundary_loops == 1);
        CHECK(c.topology.nonmanifold_edges == 0);
    }

    TEST_CASE("check_mesh: duplicate faces are found turned and reversed, and only once each") {
        Faces faces = unit_cube_faces;
        faces.push_back({6, 7, 4, 5});
        faces.push_back({7, 6, 5, 4});
        faces.push_back({4, 6, 5, 7}); // the same positions in another order: another face
        CHECK(check(mesh_of(unit_cube_corners, faces)).duplicate_faces == 2);
    }

    TEST_CASE("check_mesh: coincident positions are welded for the topology, and told apart as indexed") {
        const MeshCheck c =
            check(mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {3, 4, 5}}));
        CHECK(c.coincident_positions == 2);
        CHECK(c.topology.components == 2);
        CHECK(c.topology.boundary_edges == 6);
        CHECK(c.welded.components == 1);
        CHECK(c.welded.boundary_edges == 4);
        CHECK(c.welded.boundary_loops == 1);
    }

    TEST_CASE("check_mesh: zero area is exact collinearity or 1e-12 of the squared diagonal") {
        const std::vector<Vec3f> positions = {{0, 0, 0}, {1, 0, 0}, {0.3f, 0, 0}, {0.3f, 1e-13f, 0}, {0.3f, 1e-9f, 0}};
        CHECK(check(mesh_of(positions, {{0, 1, 2}})).zero_area_faces == 1);
        CHECK(check(mesh_of(positions, {{0, 1, 3}})).zero_area_faces == 1);
        CHECK(check(mesh_of(positions, {{0, 1, 4}})).zero_area_faces == 0);
    }

    TEST_CASE(
        "check_mesh: repeated corners, and a polygon along one of its own edges twice, are counted and no crash") {
        const MeshCheck twice = check(mesh_of(unit_cube_corners, {{0, 1, 1, 2}, {0, 0, 0}, {0, 1, 0, 1}}));
        CHECK(twice.repeated_corners == 3);
        CHECK(twice.zero_area_faces == 2);
        // A square with a square hole, cut open from 0 to 4 and back.
        const std::vector<Vec3f> ring = {{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0},
                                         {1, 1, 0}, {1, 2, 0}, {2, 2, 0}, {2, 1, 0}};
        const MeshCheck keyhole = check(mesh_of(ring, {{0, 1, 2, 3, 0, 4, 5, 6, 7, 4}}));
        CHECK(keyhole.topology.boundary_edges == 8);
        CHECK(keyhole.topology.boundary_loops == 2);
        CHECK(keyhole.topology.components == 1);
    }

    TEST_CASE("check_mesh: normals of length zero and against their face") {
        Mesh mesh = mesh_of(unit_cube_corners, {{4, 5, 6}});
        mesh.normals = {{0, 0, 1}, {0, 0, 0}, {0, 0.1f, -1}};
        mesh.corner_normal = {0, 1, 2};
        const MeshCheck c = check(mesh);
        CHECK(c.bad_normals == 1);
        CHECK(c.opposed_normals == 1);
        CHECK(c.faces_without_normal == 0);
    }
}

TEST_SUITE("oracle") {
    TEST_CASE("check_mesh: loops and components of sheets with holes are OpenMesh's") {
        std::mt19937 random(7);
        for (int round = 0; round < 20; ++round) {
            // Holes apart from each other, so that the sheet stays manifold; one cut across parts it now and then.
            std::vector<char> hole(16 * 16, 0);
            for (int y = 0; y < 16; y += 2)
                for (int x = 0; x < 16; x += 2) hole[y * 16 + x] = random() % 3 == 0;
            const int cut = int(random() % 16);
            if (round % 2) std::fill(hole.begin() + cut * 16, hole.begin() + (cut + 1) * 16, char(1));
            const Mesh mesh = sheet(16, [&](int x, int y) { return !hole[y * 16 + x]; });
            const Connectivity t = check(mesh).topology;
            if (t.nonmanifold_vertices > 0) continue; // a hole met the cut at a corner
            const auto [loops, components] = loops_and_components(mesh);
            CHECK(t.boundary_loops == loops);
            CHECK(t.components == components);
        }
    }
}

TEST_SUITE("real" * doctest::skip(test::no_shared_data())) {
    TEST_CASE("check_mesh: the facts known of real meshes") {
        const auto data = test::shared_data();
        const auto load = [&](const char* name) { return check(read_mesh((data / name).string())); };
        const MeshCheck head = load("meshes/leeperrysmith/LeePerrySmith.obj");
        CHECK(head.triangles == 17684);
        CHECK(head.welded.boundary_edges == 0);
        CHECK(head.welded.closed_components == 1);
        CHECK(load("meshes/trimesh/cycloidal.ply").welded.nonmanifold_edges == 242);
        CHECK(load("meshes/gltf/armor.obj").welded.nonmanifold_edges == 104);
        CHECK(load("meshes/materialx/teapot.obj").welded.boundary_edges == 360);
        CHECK(load("meshes/opensubdiv/catmark_car.obj").welded.boundary_edges == 60);
        CHECK(load("meshes/trimesh/capsule.obj").zero_area_faces == 200);
        CHECK(load("bad/meshes/trimesh_joined_tetrahedra.obj").welded.nonmanifold_edges == 3);
        const MeshCheck spot = load("meshes/spot/spot_control_mesh.obj");
        CHECK(spot.faces_of_size[3] == 4);
        CHECK(spot.faces_of_size[4] == 160);
        CHECK(spot.faces_of_size[5] == 16);
        CHECK(load("bad/meshes/osd_catmark_nonman_verts.obj").unused_positions == 1);
    }

    TEST_CASE("check_mesh: loops and components of real meshes are OpenMesh's") {
        const auto data = test::shared_data();
        for (const char* name :
             {"meshes/materialx/teapot.obj", "meshes/opensubdiv/catmark_car.obj", "meshes/materialx/boombox.obj",
              "meshes/gltf/NormalTangentTest.obj", "meshes/opensubdiv/catmark_nonquads.obj"}) {
            CAPTURE(name);
            const Mesh mesh = read_mesh((data / name).string());
            const Connectivity t = check(mesh).topology;
            const auto [loops, components] = loops_and_components(mesh);
            CHECK(t.boundary_loops == loops);
            CHECK(t.components == components);
        }
    }
}

TEST_SUITE("stability") {
    TEST_CASE("check_mesh: the time grows with the number of components, not with its square") {
        CHECK(test::growth([](int n) { check(cubes_in_cubes(n)); }, 8000) < test::most_growth);
    }
}
