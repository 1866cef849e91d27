#include "folders.h"
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <doctest/doctest.h>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <sys/wait.h>
#include <unistd.h>

namespace fs = std::filesystem;

namespace {

struct Result {
    int code = -1;
    std::string out, err;
};

std::string read_all(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

struct Folder {
    fs::path path = fs::temp_directory_path() / ("bake_check_cli_" + std::to_string(getpid()));
    Folder() { fs::create_directories(path); }
    ~Folder() { fs::remove_all(path); }
    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream(path / name, std::ios::binary) << text;
        return (path / name).string();
    }
    Result check(const std::string& args) const {
        const char* bake = std::getenv("BAKE");
        REQUIRE(bake);
        const fs::path out = path / "stdout", err = path / "stderr";
        const int status = std::system(
            ("'" + std::string(bake) + "' check " + args + " >'" + out.string() + "' 2>'" + err.string() + "'")
                .c_str());
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_all(out), read_all(err)};
    }
};

std::size_t lines(const std::string& text) { return std::size_t(std::count(text.begin(), text.end(), '\n')); }

const char* const square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";

} // namespace

TEST_SUITE("cli") {
    TEST_CASE("bake check: exit codes of good, wrong, unreadable and no input") {
        const Folder folder;
        const std::string good = folder.write("good.obj", std::string(square) + "f 1/1 2/2 3/3 4/4\n");
        const std::string wrong =
            folder.write("wrong.obj", std::string(square) + "f 1/1 2/2 3/3 4/4\nf 1/1 2/2 3/3 4/4\n");
        const std::string broken = folder.write("broken.obj", "v 0 0 0\nf 1 2 3\n");
        CHECK(folder.check(good).code == 0);
        CHECK(folder.check("--strict " + good).code == 0);
        CHECK(folder.check(wrong).code == 0);
        CHECK(folder.check("--strict " + wrong).code == 1);
        CHECK(folder.check("").code == 2);
        CHECK(folder.check("--no-such-option " + good).code == 2);
        CHECK(folder.check("--help").code == 0);
        const Result bad = folder.check(broken);
        CHECK(bad.code == 3);
        CHECK(lines(bad.err) == 1);
        CHECK(bad.err.find("broken.obj") != std::string::npos);
        CHECK(folder.check((folder.path / "absent.png").string()).code == 3);
    }

    TEST_CASE("bake check: a bad file does not keep the others from being looked at") {
        const Folder folder;
        const std::string good = folder.write("good.obj", std::string(square) + "f 1/1 2/2 3/3 4/4\n");
        const std::string empty = folder.write("empty.obj", "v 0 0 0\n"),
                          text = folder.write("text.png", "not a picture");
        const Result r = folder.check(empty + " " + good + " " + text);
        CHECK(r.code == 4); // of the first bad one
        CHECK(lines(r.err) == 2);
        CHECK(r.out.find("good.obj") != std::string::npos);
        const auto json = nlohmann::json::parse(folder.check("--json " + empty + " " + good + " " + text).out);
        REQUIRE(json["files"].size() == 3);
        CHECK(json["files"][0]["code"] == 4);
        CHECK(json["files"][1]["kind"] == "mesh");
        CHECK(json["files"][1]["uv"]["triangles"] == 2);
        CHECK(json["files"][2]["code"] == 3);
    }

    TEST_CASE("bake check: pairs may be given again, and files may follow them") {
        const Folder folder;
        const std::string good = folder.write("good.obj", std::string(square) + "f 1/1 2/2 3/3 4/4\n");
        const auto json =
            nlohmann::json::parse(folder.check("--json --pair a.png b.png --pair c.png d.png " + good).out);
        REQUIRE(json["files"].size() == 3);
        CHECK(json["files"][0]["kind"] == "mesh");
        CHECK(json["files"][2]["code"] == 3);
        CHECK(folder.check("--pair a.png").code == 2);
    }

    TEST_CASE("bake check --expect: exit 1 unless green points the way that is asked for") {
        const Folder folder;
        const std::string bricks = (bake::test::own_meshes() / "bricks.png").string(),
                          bake = "'" + std::string(std::getenv("BAKE")) + "' normal-map '" + bricks + "' --quiet -o ";
        const std::string up = (folder.path / "up.png").string(), down = (folder.path / "down.png").string();
        REQUIRE(std::system((bake + up).c_str()) == 0);
        REQUIRE(std::system((bake + down + " --directx").c_str()) == 0);
        const auto expect = [&](const std::string& convention, const std::string& normals) {
            return folder.check("--pair '" + bricks + "' " + normals + " --expect " + convention);
        };
        CHECK(expect("opengl", up).code == 0);
        CHECK(expect("directx", down).code == 0);
        CHECK(expect("directx", down).out.find("warning: DirectX") == std::string::npos);
        const Result wrong = expect("opengl", down);
        CHECK(wrong.code == 1);
        CHECK(wrong.out.find("green points down (DirectX), where OpenGL is expected") != std::string::npos);
        CHECK(expect("directx", up).code == 1);
        // What shows another relief says nothing of its green.
        CHECK(expect("opengl", (bake::test::own_meshes() / "dots.png").string()).code != 0);
        CHECK(folder.check("--expect opengl " + up).code == 2); // no pair
    }

    TEST_CASE("bake check --against: distances of two meshes, and exit 1 over --limit") {
        const Folder folder;
        const std::string low = folder.write("low.obj", std::string(square) + "f 1/1 2/2 3/3 4/4\n");
        const std::string high = folder.write("high.obj", "v 0 0 .25\nv 1 0 .25\nv 1 1 .25\nv 0 1 .25\nf 1 2 3 4\n");
        const Result plain = folder.check(low + " --against " + high);
        CHECK(plain.code == 0);
        CHECK(plain.out.find("low.obj against ") != std::string::npos);
        CHECK(plain.out.find("hausdorff      0.25 to 0.25") != std::string::npos);
        const Result over = folder.check("--json --limit 0.2 --against " + high + " " + low + " " + high);
        CHECK(over.code == 1);
        const auto json = nlohmann::json::parse(over.out);
        REQUIRE(json["files"].size() == 2);
        CHECK(json["files"][0]["kind"] == "distance");
        CHECK(json["files"][0]["hausdorff"]["upper"] == 0.25);
        CHECK(double(json["files"][0]["there"]["rms"]) == doctest::Approx(0.25));
        CHECK(json["files"][0]["back"]["facet_normals_deg"]["max"] == 0);
        CHECK(json["files"][0]["warnings"].size() == 1);
        CHECK(double(json["files"][1]["hausdorff"]["upper"]) < 1e-15);
        CHECK(folder.check("--limit 0.25 " + low + " --against " + high).code == 0);

        CHECK(folder.check("--limit 0.1 " + low).code == 2);
        CHECK(folder.check("--limit 0 " + low + " --against " + high).code == 2);
        CHECK(folder.check("--against " + high).code == 2);
        CHECK(folder.check("--audit " + low + " --against " + high).code == 2);
        CHECK(folder.check(low + " --against " + folder.write("text.png", "not a mesh")).code == 3);
        CHECK(folder.check(low + " --against " + (folder.path / "absent.obj").string()).code == 3);
    }

    TEST_CASE("bake check --audit: what cuts itself is told with its place") {
        const Folder folder;
        const std::string cross = folder.write("cross.obj", "v 0 0 0\nv 2 0 0\nv 1 2 0\nv 1 1 -1\nv 1 1 1\nv 1 3 0\n"
                                                            "f 1 2 3\nf 4 5 6\n");
        const Result r = folder.check("--audit " + cross);
        CHECK(r.code == 0);
        const auto json = nlohmann::json::parse(folder.check("--json --audit " + cross).out)["files"][0];
        if (!json.contains("audit")) {
            CHECK(r.out.find("no audit: this build has no CGAL") != std::string::npos);
            return;
        }
        CHECK(json["audit"]["self_intersections"] == 1);
        CHECK(json["audit"]["first_intersection"]["faces"] == nlohmann::json({0, 1}));
        CHECK(json["audit"]["closed"] == false);
        CHECK(r.out.find("1 self intersection, not closed (0 of 2 components are)") != std::string::npos);
        CHECK(r.out.find("first in faces 0 and 1 near (1 1.5 0)") != std::string::npos);
        CHECK(folder.check("--audit --strict " + cross).code == 1);
    }
}

TEST_SUITE("real" * doctest::skip(bake::test::no_shared_data())) {
    TEST_CASE("bake check: the same bytes for 1, 2 and 7 threads") {
        const fs::path data = bake::test::shared_data();
        const Folder folder;
        const std::string files = (data / "meshes/spot/spot_control_mesh.obj").string() + " " +
                                  (data / "textures/heights/plain_heightmap.png").string() + " --pair " +
                                  (data / "textures/pairs/bevy_parallax_cube/cube_depth.png").string() + " " +
                                  (data / "textures/pairs/bevy_parallax_cube/cube_normal.png").string();
        const Result one = folder.check("--json --threads 1 " + files);
        CHECK(one.code == 0);
        const auto reports = nlohmann::json::parse(one.out)["files"];
        CHECK(reports.size() == 3);
        for (const char* threads : {"2", "7"})
            CHECK(nlohmann::json::parse(
                      folder.check("--json --threads " + std::string(threads) + " " + files).out)["files"] == reports);
    }

    TEST_CASE("bake check: every damaged file is answered at once, refused in one line or looked at whole") {
        const fs::path bad = bake::test::shared_data() / "bad";
        const Folder folder;
        for (const auto& entry : fs::recursive_directory_iterator(bad)) {
            if (!entry.is_regular_file()) continue;
            CAPTURE(entry.path().string());
            const auto start = std::chrono::steady_clock::now();
            const Result r = folder.check("'" + entry.path().string() + "'");
            CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(10));
            const bool refused = r.code == 3 || r.code == 4;
            CHECK((refused || r.code == 0));
            CHECK(lines(r.err) == (refused ? 1 : 0));
            if (refused) CHECK(r.err.find(entry.path().filename().string()) != std::string::npos);
            else CHECK(!r.out.empty());
        }
    }
}
