// bake surface from outside: shapes, meshes and cages as meshes and as maps, and everything it refuses.
#include "bake/base/vec.h"
#include "bake/mesh/check/mesh_check.h"
#include "bake/picture/image_io.h"
#include "cli/command.h"
#include "mesh/file/mesh_files.h"
#include <cmath>
#include <nlohmann/json.hpp>

using namespace bake;
using namespace bake::test;
using doctest::Approx;

namespace {

const std::string torus = (own_meshes() / "torus.obj").string(),
                  no_uvs = (own_meshes() / "trouble" / "missing_uvs.obj").string(),
                  nonmanifold = (own_meshes() / "trouble" / "nonmanifold_edge.obj").string();

nlohmann::json surface(const Folder& folder, std::vector<std::string> options) {
    options.insert(options.begin(), {"surface", "--json"});
    const Run run = run_bake(folder, options, {.seconds = 60});
    REQUIRE_MESSAGE(run.code == 0, run.err);
    CHECK(run.err == "");
    return nlohmann::json::parse(run.out);
}

const Attribute& attribute(const Mesh& mesh, const std::string& name) {
    for (const Attribute& a : mesh.attributes)
        if (a.name == name) return a;
    FAIL("no attribute " << name);
    return mesh.attributes[0];
}

/// A cage with uvs: an open sheet of 3 x 3 quads.
std::string sheet() {
    std::string text;
    for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i)
            text += "v " + std::to_string(i) + " " + std::to_string((i * j) % 3) + " " + std::to_string(-j) + "\n";
    for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i)
            text += "vt " + std::to_string(0.1 + i * 0.25) + " " + std::to_string(0.1 + j * 0.2) + "\n";
    for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i) {
            text += "f";
            for (const int v : {4 * j + i, 4 * j + i + 1, 4 * j + i + 5, 4 * j + i + 4})
                text += " " + std::to_string(v + 1) + "/" + std::to_string(v + 1);
            text += "\n";
        }
    return text;
}

/// A cube whose faces have charts of their own: no two of its 24 corners have the same position and uv.
std::string cube_of_charts() {
    std::string text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n";
    const int faces[6][4] = {{1, 4, 3, 2}, {5, 6, 7, 8}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 4, 8, 7}, {4, 1, 5, 8}};
    for (int f = 0; f < 6; ++f)
        for (const auto& [x, y] : {std::pair(0.0, 0.0), {0.9, 0.0}, {0.9, 0.9}, {0.0, 0.9}})
            text += "vt " + std::to_string((f + x) / 6) + " " + std::to_string(y) + "\n";
    for (int f = 0; f < 6; ++f) {
        text += "f";
        for (int k = 0; k < 4; ++k) text += " " + std::to_string(faces[f][k]) + "/" + std::to_string(4 * f + k + 1);
        text += "\n";
    }
    return text;
}

Connectivity topology(const std::string& file) {
    const Mesh mesh = read_mesh(file);
    return check_mesh(mesh, triangulate(mesh)).welded;
}

} // namespace

TEST_SUITE("cli") {

    TEST_CASE("surface: a shape becomes a mesh with normals, tangents and curvatures, in PLY and glTF alike") {
        const Folder folder;
        for (const char* file : {"sphere.ply", "sphere.glb", "sphere.gltf"}) {
            INFO(std::string(file));
            const auto said = surface(folder, {"--shape", "sphere:R=2", "--resolution", "24x12", "--attributes",
                                               "normal,tangent,curvature", "-o", file});
            CHECK(said["faces"] == 24 * 12);
            CHECK(said["degenerate_count"] == 2);
            CHECK(said["degenerate"][0]["what"] == "pole, with a limit normal");
            CHECK(said["degenerate"][0]["position"][1] == -2);
            CHECK(said["mean_curvature"]["mean"].get<double>() == Approx(0.5));
            CHECK(said["area"].get<double>() == Approx(16 * 3.14159).epsilon(0.02));
            const Mesh mesh = read_mesh(folder / file);
            CHECK(mesh.faces() >= 24 * 12);
            CHECK(mesh.tangents.size() == mesh.corners());
            for (const float value : attribute(mesh, "mean_curvature").values)
                CHECK(value == Approx(0.5).epsilon(1e-4));
            for (std::size_t c = 0; c < mesh.corners(); ++c)
                CHECK(glm::length(2.0f * mesh.normals[mesh.corner_normal[c]] -
                                  mesh.positions[mesh.corner_position[c]]) < 1e-5f);
        }
    }

    TEST_CASE("surface: the attributes that are asked for are written, and corners of one vertex share them") {
        const Folder folder;
        const auto vertices = [&](const std::string& names) {
            surface(folder, {torus, "-o", "t.ply", "--attributes", names});
            return std::stoul(
                contents(folder / "t.ply").substr(contents(folder / "t.ply").find("element vertex ") + 15));
        };
        const auto plain = vertices("normal");
        CHECK(read_mesh(folder / "t.ply").tangents.empty());
        CHECK(vertices("normal,curvature") == plain); // one value of each vertex, not one of each corner
        CHECK(attribute(read_mesh(folder / "t.ply"), "gauss_curvature").components == 1);
        CHECK(vertices("curvature") <= plain);
        CHECK(read_mesh(folder / "t.ply").corner_normal.empty());
        surface(folder, {torus, "-o", "t.ply"});
        CHECK(read_mesh(folder / "t.ply").attributes.empty());
        CHECK(read_mesh(folder / "t.ply").tangents.size() == read_mesh(folder / "t.ply").corners());
        check_refused(folder, {"surface", torus, "-o", "a.ply", "--attributes", "normals"}, 2,
                      "normal,tangent,curvature");
    }

    TEST_CASE("surface: an OBJ has the normals, and no more vertices than the mesh") {
        const Folder folder;
        surface(folder, {torus, "-o", "t.obj"});
        const Mesh given = read_mesh(torus), written = read_mesh(folder / "t.obj");
        CHECK(written.positions.size() == given.positions.size());
        CHECK(written.faces() == given.faces());
        REQUIRE(written.corner_normal.size() == written.corners());
        for (const Vec3f& n : written.normals) CHECK(glm::length(n) == doctest::Approx(1).epsilon(1e-5));
        surface(folder, {torus, "-o", "u.obj", "--attributes", "normal"});
        CHECK(contents(folder / "u.obj").substr(contents(folder / "u.obj").find('\n')) ==
              contents(folder / "t.obj").substr(contents(folder / "t.obj").find('\n')));
    }

    TEST_CASE("surface: the text has ranges, the area, and where the degenerate points are") {
        const Folder folder;
        const Run run = run_bake(folder, {"surface", "--shape", "cone:R=1,h=2", "-o", "cone.ply"});
        REQUIRE(run.code == 0);
        CHECK(run.err == "");
        for (const char* words :
             {"min", "max", "mean", "|p_u|", "|p_v|", "mean curvature", "gauss curvature", "area 7.0",
              "degenerate points: 1", "(0, 1, 0), uv (0.015625, 1)", "no normal", "64 x 16 cells"})
            CHECK_MESSAGE(run.out.find(words) != std::string::npos, run.out);
        CHECK(folder.names() == std::set<std::string>{"cone.ply"});
    }

    TEST_CASE("surface: a mesh's own faces and uvs stay, and maps are written beside it or alone") {
        const Folder folder;
        const auto said = surface(folder, {torus, "-o", "out.ply", "--maps", "normal,mean-curvature", "--size", "64x32",
                                           "--maps-out", "map"});
        CHECK(folder.names() == std::set<std::string>{"out.ply", "map_normal.exr", "map_mean-curvature.exr"});
        CHECK(read_mesh(folder / "out.ply").faces() == read_mesh(torus).faces());
        CHECK(said["maps"]["normal"] == "map_normal.exr");
        CHECK(said["texels"]["covered"] == 64 * 32);
        ImageInfo info;
        const Image<float> normal = read_image(folder / "map_normal.exr", &info);
        CHECK(normal.width() == 64);
        CHECK(normal.height() == 32);
        CHECK(info.type == SampleType::float32);
        double worst = 0;
        for (std::size_t i = 0; i < normal.size(); i += 3) {
            const float* n = normal.data() + i;
            worst = std::max(worst, std::abs(std::hypot(double(n[0]), double(n[1]), double(n[2])) - 1));
        }
        CHECK(worst < 1e-6); // raw vectors, not encoded
    }

    TEST_CASE("surface: all maps when none are named, tangents with their sign") {
        const Folder folder;
        surface(folder, {"--shape", "torus:R=2,r=0.5", "--size", "16", "--maps-out", "t"});
        CHECK(folder.names() == std::set<std::string>{"t_position.exr", "t_normal.exr", "t_pu.exr", "t_pv.exr",
                                                      "t_tangent.exr", "t_mean-curvature.exr",
                                                      "t_gauss-curvature.exr"});
        const Image<float> tangent = read_image(folder / "t_tangent.exr"),
                           gauss = read_image(folder / "t_gauss-curvature.exr");
        CHECK(tangent.channels() == 4);
        CHECK(gauss.channels() == 1);
        CHECK(tangent.at(3, 3, 3) == 1);
        const double v = 2 * pi * (1 - 3.5 / 16), ring = std::cos(v) / (2 + 0.5 * std::cos(v));
        CHECK(gauss.at(5, 3) == Approx(ring / 0.5));
    }

    TEST_CASE("surface: a cage gives its limit, four cells to an edge or as many as asked") {
        const Folder folder;
        write_file(folder / "cage.obj", sheet());
        CHECK(surface(folder, {"cage.obj", "--subdivide", "catmark", "-o", "limit.ply"})["faces"] == 9 * 16);
        const auto said = surface(folder, {"cage.obj", "--subdivide", "catmark", "--resolution", "7", "-o", "limit.glb",
                                           "--maps-out", "m", "--size", "64"});
        CHECK(said["faces"] == 9 * 49);
        CHECK(said["texels"]["largest_uv_distance"].get<double>() < 1e-9);
        CHECK(said["texels"]["covered"].get<int>() > 1500);
        CHECK(said["texels"]["padded"].get<int>() > 500);
    }

    TEST_CASE("surface: a cage whose format splits vertices at seams gives one closed limit surface") {
        const Folder folder;
        write_file(folder / "cube.obj", cube_of_charts());
        write_mesh(folder / "cube.ply", read_mesh(folder / "cube.obj"));
        REQUIRE(read_mesh(folder / "cube.ply").positions.size() == 24);
        for (const char* cage : {"cube.ply", "cube.glb"}) {
            INFO(std::string(cage));
            write_mesh(folder / cage, read_mesh(folder / "cube.obj"));
            surface(folder, {cage, "--subdivide", "catmark", "-o", "limit.ply"});
            const Connectivity limit = topology(folder / "limit.ply");
            CHECK(limit.components == 1);
            CHECK(limit.boundary_edges == 0);
        }
    }

    TEST_CASE("surface: the same bytes for 1, 2 and 7 threads") {
        const Folder folder;
        write_file(folder / "cage.obj", sheet());
        const auto files = [&](const std::string& threads) {
            surface(folder, {"cage.obj", "--subdivide", "catmark", "-o", "limit.ply", "--maps", "pu,gauss-curvature",
                             "--size", "50", "--maps-out", "m", "--threads", threads});
            return contents(folder / "limit.ply") + contents(folder / "m_pu.exr") +
                   contents(folder / "m_gauss-curvature.exr");
        };
        const std::string one = files("1");
        CHECK(one == files("2"));
        CHECK(one == files("7"));
    }

    TEST_CASE("surface: a mesh without uvs gives a mesh, and no maps") {
        const Folder folder;
        write_file(folder / "plain.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.2\nf 1 2 3 4\n");
        const auto said = surface(folder, {"plain.obj", "-o", "out.ply"});
        CHECK(said["faces"] == 1);
        CHECK_FALSE(said.contains("|p_u|"));
        CHECK(read_mesh(folder / "out.ply").tangents.empty());
        fs::remove(folder / "out.ply");
        check_refused(folder, {"surface", "plain.obj", "--maps-out", "m"}, 4, "no uvs");
    }

    TEST_CASE("surface: usage errors are exit 2, one line that names the fault, and nothing written") {
        const Folder folder;
        write_file(folder / "cage.obj", sheet());
        const auto refused = [&](std::vector<std::string> arguments, const std::string& named) {
            arguments.insert(arguments.begin(), "surface");
            check_refused(folder, arguments, 2, named);
        };
        refused({}, "neither a mesh nor a --shape");
        refused({"-o", "a.ply"}, "neither a mesh nor a --shape");
        refused({torus, "--shape", "torus", "-o", "a.ply"}, "give one of them");
        refused({torus}, "nothing to write");
        refused({"--shape", "torus"}, "nothing to write");
        refused({"--shape", "tours", "-o", "a.ply"}, "did you mean torus?");
        refused({"--shape", "torus:R=x", "-o", "a.ply"}, "needs a number");
        refused({"--shape", "torus:R=1,r=2", "-o", "a.ply"}, "less than R");
        refused({"--shape", "", "-o", "a.ply"}, "--shape");
        refused({"--shape", "torus", "--subdivide", "catmark", "-o", "a.ply"}, "--subdivide");
        refused({"--shape", "torus", "--flip-v", "-o", "a.ply"}, "--flip-v");
        refused({"--shape", "torus", "--resolution", "2x2", "-o", "a.ply"}, "too few");
        refused({"--shape", "torus", "--resolution", "2by2", "-o", "a.ply"}, "--resolution");
        refused({"--shape", "torus", "--resolution", "0", "-o", "a.ply"}, "--resolution");
        refused({"--shape", "torus", "--resolution", "60000x60000", "-o", "a.ply"}, "too many");
        refused({torus, "--resolution", "4", "-o", "a.ply"}, "as it is");
        refused({"cage.obj", "--subdivide", "catmark", "--resolution", "4x5", "-o", "a.ply"}, "one number");
        refused({"cage.obj", "--subdivide", "bilinear", "-o", "a.ply"}, "--subdivide");
        refused({torus, "--uv-smoothing", "all", "-o", "a.ply"}, "--uv-smoothing");
        refused({"cage.obj", "--subdivide", "catmark", "--uv-smoothing", "some", "-o", "a.ply"}, "--uv-smoothing");
        refused({torus, "-o", "a.obj", "--attributes", "curvature"}, ".ply or .glb");
        refused({torus, "-o", "a.obj", "--attributes", "normal,tangent"}, ".ply or .glb");
        refused({torus, "-o", "a"}, ".ply, .glb or .obj");
        refused({torus, "-o", "a.ply", "--maps", "normal"}, "--maps-out");
        refused({torus, "--maps-out", "m", "--attributes", "normal"}, "--attributes");
        refused({torus, "--maps-out", "m", "--maps", "normals"},
                "choose from position,normal,pu,pv,tangent,mean-curvature,gauss-curvature");
        refused({torus, "--maps-out", "m", "--maps", "normal,"}, "'' is no map");
        refused({torus, "--maps-out", "m", "--maps", "normal,normal"}, "twice");
        refused({torus, "--maps-out", "m", "--size", "0"}, "--size");
        refused({torus, "--maps-out", "m", "--padding", "-1"}, "--padding");
        refused({torus, "-o", "a.ply", "--nosuch"}, "--nosuch");
    }

    TEST_CASE("surface: it does not write over what it is made from") {
        const Folder folder;
        write_mesh(folder / "a.ply", read_mesh(torus));
        const std::string before = contents(folder / "a.ply");
        check_refused(folder, {"surface", "a.ply", "-o", "a.ply"}, 2,
                      "would replace a file that the output is made from");
        CHECK(contents(folder / "a.ply") == before);
    }

    TEST_CASE("surface: unreadable, unsuitable and unwritable files have their codes") {
        const Folder folder;
        const auto refused = [&](std::vector<std::string> arguments, int code, const std::string& named) {
            arguments.insert(arguments.begin(), "surface");
            check_refused(folder, arguments, code, named);
        };
        refused({"absent.obj", "-o", "a.ply"}, 3, "absent.obj");
        refused({"--shape", "bezier:file=absent.txt", "-o", "a.ply"}, 3, "absent.txt");
        refused({"--shape", "revolution:profile=absent.txt", "-o", "a.ply"}, 3, "absent.txt");
        refused({nonmanifold, "--subdivide", "catmark", "-o", "a.ply"}, 4, "nonmanifold_edge.obj");
        refused({torus, "--subdivide", "catmark", "-o", "nowhere/a.ply"}, 5, "nowhere");
        refused({torus, "--maps-out", "nowhere/m"}, 5, "nowhere");
    }

    TEST_CASE("surface: an output that cannot be written leaves no other behind") {
        const Folder folder;
        check_refused(folder, {"surface", torus, "-o", "nowhere/a.ply", "--maps-out", "m", "--size", "16"}, 5,
                      "nowhere");
    }
}

TEST_SUITE("real" * doctest::skip(test::no_shared_data())) {

    TEST_CASE("surface: meshes and cages of the shared collection") {
        const auto data = shared_data();
        const Folder folder;
        const std::string meshes = (data / "meshes").string() + "/";
        const auto spot =
            surface(folder, {meshes + "spot/spot_control_mesh.obj", "--subdivide", "catmark", "-o", "spot.glb",
                             "--maps-out", "spot", "--maps", "position,mean-curvature", "--size", "256"});
        CHECK(spot["texels"]["largest_uv_distance"].get<double>() < 1e-9);
        CHECK(spot["degenerate_count"] == 0);
        write_mesh(folder / "spot.ply", read_mesh(meshes + "spot/spot_control_mesh.obj"));
        surface(folder, {"spot.ply", "--subdivide", "catmark", "-o", "limit.ply"});
        const Connectivity of_ply = topology(folder / "limit.ply"), of_obj = topology(folder / "spot.glb");
        CHECK(of_ply.components == of_obj.components);
        CHECK(of_ply.boundary_edges == 0);
        // The surface through the limit points of Spot's own fine mesh has nearly its area.
        const auto fine = surface(folder, {meshes + "spot/spot_quadrangulated.obj", "-o", "fine.ply"});
        CHECK(fine["area"].get<double>() == Approx(spot["area"].get<double>()).epsilon(0.02));
        const auto teapot = surface(folder, {meshes + "materialx/teapot.obj", "-o", "teapot.ply", "--maps-out",
                                             "teapot", "--maps", "normal", "--size", "128"});
        CHECK(teapot["texels"]["overlapped"].get<int>() > 1000); // its lid and body share the square
        const auto head = surface(folder, {meshes + "leeperrysmith/LeePerrySmith.obj", "-o", "head.glb"});
        CHECK(head["degenerate"][0]["what"] == "no area in uv");
    }
}
