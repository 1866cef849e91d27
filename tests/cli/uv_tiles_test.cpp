// Charts outside the unit square, sets of uvs and names of tiles, from outside.
#include "bake/picture/image_io.h"
#include "cli/command.h"
#include "mesh/gltf/gltf_files.h"
#include "picture/texels.h"
#include <nlohmann/json.hpp>

namespace {
using namespace bake;
using namespace bake_tests;

const std::string bricks = (test::own_meshes() / "bricks.png").string();

/// The torus, with its uvs moved by whole tiles.
std::string torus(const test::Folder& folder, const std::string& name, const Vec2f& move) {
    Mesh mesh = read_mesh((test::own_meshes() / "torus.obj").string());
    // A float has fewer digits behind the point in other tiles.
    for (Vec2f& uv : mesh.uvs) uv = Vec2f(std::round(uv.x * 1024), std::round(uv.y * 1024)) / 1024.0f + move;
    write_mesh(folder / name, mesh);
    return name;
}

test::Run normal_map(const test::Folder& folder, const std::string& mesh, const std::string& out,
                     const std::vector<std::string>& more = {}) {
    std::vector<std::string> all = {"normal-map", mesh,     "--height", bricks, "--amplitude",
                                    "1%",         "--size", "64",       "-o",   out};
    all.insert(all.end(), more.begin(), more.end());
    return test::run_bake(folder, all, {.seconds = 60});
}

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }
} // namespace

TEST_SUITE("cli") {
    TEST_CASE("uv tiles: charts in one other tile give the map and the maps of the unit square, and a note") {
        const test::Folder folder;
        torus(folder, "unit.obj", {0, 0});
        torus(folder, "moved.obj", {0, 1});
        REQUIRE(normal_map(folder, "unit.obj", "a.exr", {"--depth", "float"}).code == 0);
        const test::Run moved = normal_map(folder, "moved.obj", "b.exr", {"--depth", "float"});
        REQUIRE_MESSAGE(moved.code == 0, moved.err);
        CHECK(says(moved.err, "moved.obj: its charts lie in 1011 of the uvs' tiles and are baked modulo 1"));
        CHECK(says(moved.out, "charts cover 100.0 %"));
        const Image<float> a = read_image(folder / "a.exr"), b = read_image(folder / "b.exr");
        double most = 0;
        for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(double(a.data()[i]) - b.data()[i]));
        CHECK(most < 1e-3); // what v + 1 rounds

        for (const std::string name : {"unit", "moved"}) {
            const test::Run run = test::run_bake(folder, {"surface", name + ".obj", "--maps", "position", "--size",
                                                          "32", "--maps-out", name, "--quiet"});
            REQUIRE_MESSAGE(run.code == 0, run.err);
        }
        const Image<float> p = read_image(folder / "unit_position.exr"), q = read_image(folder / "moved_position.exr");
        most = 0;
        for (std::size_t i = 0; i < p.size(); ++i) most = std::max(most, std::abs(double(p.data()[i]) - q.data()[i]));
        CHECK(most < 1e-3);
        const test::Run check = test::run_bake(folder, {"check", "--strict", "moved.obj"});
        CHECK(says(check.out, "the charts lie in one tile, 1011: a bake takes them modulo 1"));
    }

    TEST_CASE("uv tiles: charts in several tiles are refused with the tiles named, and baked one by one") {
        const test::Folder folder;
        test::write_file(
            folder / "udim.obj",
            "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 2 0\n"
            "vt 2 1\nf 1/1 2/2 3/3 4/4\nf 2/2 5/5 6/6 3/3\n");
        const std::vector<std::string> bake_it = {"normal-map", "udim.obj", "--height", bricks, "--amplitude",
                                                  "1%",         "--size",   "16",       "-o",   "n.png"};
        test::check_refused(folder, bake_it, 4, "1001, 1002");
        test::check_refused(folder, bake_it, 4, "--tile");
        for (const std::string tile : {"1001", "1002"}) {
            const test::Run run = normal_map(folder, "udim.obj", tile + ".png", {"--tile", tile});
            CHECK(run.code == 0);
            CHECK(says(run.out, "charts cover 100.0 %"));
            CHECK(says(run.err, "1 faces lie outside the tile"));
        }
        test::check_refused(folder, {"surface", "udim.obj", "--maps", "normal", "--maps-out", "m", "--size", "16"}, 4,
                            "1001, 1002");
        CHECK(says(test::run_bake(folder, {"check", "udim.obj"}).out, "the charts lie in several tiles (1001, 1002)"));
        test::check_refused(folder, bake_it, 4, "<UDIM>");
        CHECK(normal_map(folder, "udim.obj", "n.png", {"--tile", "1003"}).code == 4);
        CHECK(normal_map(folder, "udim.obj", "n.png", {"--tile", "7"}).code == 2);
    }

    TEST_CASE("uv tiles: <UDIM> in a name writes the map of every tile, the same as --tile does") {
        const test::Folder folder;
        test::write_file(
            folder / "udim.obj",
            "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 2 0\n"
            "vt 2 1\nf 1/1 2/2 3/3 4/4\nf 2/2 5/5 6/6 3/3\n");
        const auto check_tiles = [&](const std::vector<std::string>& verb, const std::string& out,
                                     const std::string& ending) {
            for (const std::string tile : {"1001", "1002", "<UDIM>"}) {
                std::vector<std::string> line = verb;
                line.insert(line.end(), {out, "t" + tile + ending});
                if (tile == "<UDIM>") {
                    for (const std::string made : {"t1001", "t1002"})
                        std::filesystem::rename(folder / (made + ending), folder / made);
                } else {
                    line.insert(line.end(), {"--tile", tile});
                }
                const test::Run run = test::run_bake(folder, line);
                CHECK_MESSAGE(run.code == 0, run.err);
                if (tile != "<UDIM>") continue;
                CHECK_FALSE(says(run.err, "outside the tile"));
                for (const std::string made : {"t1001", "t1002"})
                    CHECK(test::texels_of(folder / (made + ending)) == test::texels_of(folder / made));
            }
        };
        const std::vector<std::string> height = {"--height", bricks, "--amplitude", "1%", "--size", "16"};
        std::vector<std::string> baked = {"normal-map", "udim.obj"}, cast = baked;
        baked.insert(baked.end(), height.begin(), height.end());
        cast.insert(cast.end(), {"--high", "udim.obj", "--size", "16"});
        check_tiles(baked, "-o", ".png");
        check_tiles(cast, "-o", ".exr");
        const auto is_map = [&](const std::string& tile) {
            return std::filesystem::exists(folder / ("m" + tile + "_normal.exr"));
        };
        CHECK(
            test::run_bake(folder, {"surface", "udim.obj", "--maps", "normal", "--size", "16", "--maps-out", "m<UDIM>"})
                .code == 0);
        CHECK(is_map("1001"));
        CHECK(is_map("1002"));
        CHECK_FALSE(is_map("1003"));
        baked.insert(baked.end(), {"-o", "j<UDIM>.png", "--json"});
        const auto json = nlohmann::json::parse(test::run_bake(folder, baked).out);
        CHECK(json["tiles"][1]["tile"] == 1002);
        CHECK(json["tiles"][1]["out"] == "j1002.png");
        baked.insert(baked.end(), {"--tile", "1001"});
        test::check_refused(folder, baked, 2, "--tile: <UDIM> in the name of the map asks for all tiles");
        test::check_refused(folder, {"surface", "udim.obj", "--maps-out", "m<UDIM>", "--tile", "1001"}, 2,
                            "--tile: <UDIM> in the name of the maps asks for all tiles");
        cast.insert(cast.end(), {"-o", "<UDIM>.png", "--maps", "height", "--maps-out", "one"});
        test::check_refused(folder, cast, 2, "of all files or in none");
        test::write_file(folder / "below.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt -1 0\nvt 0 0\nvt 0 1\nf 1/1 2/2 3/3\n");
        test::check_refused(folder, {"normal-map", "below.obj", "--high", "below.obj", "-o", "<UDIM>.png"}, 4,
                            "(-1, 0)");
    }

    TEST_CASE("uv tiles: a name with the place of a number is refused where there are no tiles, and no such file is "
              "written") {
        const test::Folder folder;
        const std::string mesh = (test::own_meshes() / "torus.obj").string();
        for (const std::string place : {"<UDIM>", "<udim>", "<UVTILE>", "%d", "%04d", "%(UDIM)d"}) {
            CAPTURE(place);
            const std::string name = "n." + place;
            for (const std::vector<std::string>& verb :
                 std::vector<std::vector<std::string>>{{"bump-table", bricks, "-o", name + ".exr"},
                                                       {"displace", mesh, "--height", bricks, "-o", name + ".ply"},
                                                       {"surface", mesh, "-o", name + ".glb"}})
                test::check_refused(folder, verb, 2, "stands for the number");
            if (place == "<UDIM>") continue;
            for (const std::vector<std::string>& verb : std::vector<std::vector<std::string>>{
                     {"normal-map", mesh, "--height", bricks, "--amplitude", "1%", "--size", "16", "-o", name + ".png"},
                     {"surface", mesh, "--maps", "normal", "--size", "16", "--maps-out", name}})
                test::check_refused(folder, verb, 2, "stands for the number");
        }
        test::check_refused(folder, {"normal-map", bricks, "-o", "n<UDIM>.png"}, 2, "there is no mesh");
        CHECK(normal_map(folder, mesh, "100%dirt, <b>.png").code == 0);
    }

    TEST_CASE("uv sets: normal-map bakes on the set of the normal texture, and --uv-set on another") {
        const test::Folder folder;
        Gltf gltf{rich_triangles(4, 2), {}, {}, {}};
        gltf.mesh.groups.clear(), gltf.mesh.face_group.clear();
        gltf.images = {{"", "image/png", "", {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n', 0}}};
        gltf.materials = {{.name = "brick", .normal = GltfTexture{0, 1, 1, {}}}, {.name = "plaster"}};
        gltf.materials[1] = gltf.materials[0], gltf.materials[1].name = "plaster";
        write_gltf(folder / "second.glb", gltf);
        gltf.materials = {{.name = "brick"}, {.name = "plaster"}};
        write_gltf(folder / "none.glb", gltf);
        const auto map = [&](const std::string& mesh, const std::vector<std::string>& more = {}) {
            const test::Run run = normal_map(folder, mesh, "n.png", more);
            CHECK_MESSAGE(run.code == 0, run.err);
            return test::texels_of(folder / "n.png");
        };
        CHECK(map("second.glb") == map("none.glb", {"--uv-set", "1"}));
        CHECK(map("none.glb") == map("second.glb", {"--uv-set", "0"}));
        CHECK(map("none.glb") != map("second.glb"));
        CHECK(says(normal_map(folder, "second.glb", "n.png").err, "lie on TEXCOORD_1"));
        CHECK(normal_map(folder, "second.glb", "n.png", {"--quiet"}).err == "");
        CHECK(says(normal_map(folder, "second.glb", "n.png", {"--json"}).out, "lie on TEXCOORD_1"));
        CHECK(says(test::run_bake(folder, {"check", "second.glb"}).out, "lie on TEXCOORD_1"));
        test::check_refused(folder, {"check", "second.glb", "--uv-set", "3"}, 4, "no uvs of set 3");
        test::check_refused(folder, {"displace", "second.glb", "--height", bricks, "--uv-set", "3", "-o", "d.ply"}, 4,
                            "set 3");

        test::write_file(folder / "s.toml", "material = [{name = \"m\"}]\n"
                                            "mesh = [{file = \"second.glb\", material = \"m\", uv-set = 3}]\n");
        test::check_refused(folder, {"render", "s.toml", "-o", "s.png", "--size", "8"}, 4, "set 3");
        test::write_file(folder / "own.toml", "mesh = [{file = \"second.glb\", uv-set = 3}]\n");
        CHECK(says(test::run_bake(folder, {"render", "own.toml", "-o", "s.png", "--size", "8"}).err,
                   "its own materials name their sets of uvs"));
    }
} // cli
